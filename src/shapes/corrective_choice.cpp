#include "shapes/corrective_choice.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace risorius::shapes {

namespace {

// Share of what is left that a corrective has to take off the frames to be kept for them, and that one kept for others may put on.
constexpr double kWorthIt = 0.005, kHarm = 0.002;

struct Group {
    std::size_t first, end;
    double use = 0;
    long bytes = 0;
    bool kept = false;
};

std::vector<Group> groups_of(const std::vector<OfferedCorrective>& offered) {
    std::vector<Group> out;
    for (std::size_t i = 0; i < offered.size(); ++i) {
        if (out.empty() || offered[out.back().first].group != offered[i].group)
            out.push_back({i, i});
        out.back().end = i + 1;
        out.back().use += offered[i].use;
        out.back().bytes += offered[i].bytes;
    }
    return out;
}

class FramesLeft {
  public:
    FramesLeft(const std::vector<OfferedCorrective>& offered, std::vector<PlayedFrame> frames,
               const Eigen::VectorXd& area)
        : offered_(offered), frames_(std::move(frames)), area_(area) {
        for (const PlayedFrame& frame : frames_) much_ += fourth_powers(frame.left);
    }

    /// By how much less is left with a group.
    double gain(const Group& group) const {
        double out = 0;
        for (const PlayedFrame& frame : frames_)
            if (const Points left = without(frame, group); left.size() > 0)
                out += fourth_powers(frame.left) - fourth_powers(left);
        return out;
    }
    void take(const Group& group) {
        much_ -= gain(group);
        for (PlayedFrame& frame : frames_)
            if (Points left = without(frame, group); left.size() > 0) frame.left = std::move(left);
    }
    double much() const { return much_; }
    bool empty() const { return frames_.empty(); }

  private:
    double fourth_powers(const Points& left) const {
        return area_.dot(left.rowwise().squaredNorm().cwiseAbs2());
    }
    /// Empty where the group does nothing.
    Points without(const PlayedFrame& frame, const Group& group) const {
        Points left;
        for (std::size_t i = group.first; i < group.end; ++i) {
            const double w = offered_[i].corrective.weight(frame.weights);
            if (w == 0) continue;
            if (left.size() == 0) left = frame.left;
            offered_[i].corrective.shape.add_to(left, -w);
        }
        return left;
    }

    const std::vector<OfferedCorrective>& offered_;
    std::vector<PlayedFrame> frames_;
    const Eigen::VectorXd& area_;
    double much_ = 0;
};

}  // namespace

std::vector<std::size_t> choose_correctives(const std::vector<OfferedCorrective>& offered,
                                            std::vector<PlayedFrame> frames,
                                            const Eigen::VectorXd& area, long budget_bytes) {
    std::vector<Group> groups = groups_of(offered);
    FramesLeft left(offered, std::move(frames), area);
    std::vector<std::size_t> out;
    long bytes = 0;
    const auto fits = [&](const Group& group) {
        return !group.kept && bytes + group.bytes <= budget_bytes;
    };
    const auto keep = [&](Group& group) {
        group.kept = true;
        bytes += group.bytes;
        left.take(group);
        for (std::size_t i = group.first; i < group.end; ++i) out.push_back(i);
    };

    // For the frames
    while (!left.empty()) {
        Group* best = nullptr;
        double most = 0;
        for (Group& group : groups) {
            if (!fits(group)) continue;
            const double gain = left.gain(group);
            const double by_size = gain / static_cast<double>(group.bytes);
            if (gain > kWorthIt * left.much() && by_size > most) {
                most = by_size;
                best = &group;
            }
        }
        if (best == nullptr) break;
        keep(*best);
    }

    // For any others
    std::vector<std::size_t> by_use(groups.size());
    std::iota(by_use.begin(), by_use.end(), std::size_t{0});
    std::stable_sort(by_use.begin(), by_use.end(), [&](std::size_t x, std::size_t y) {
        return groups[x].use * static_cast<double>(groups[y].bytes) >
               groups[y].use * static_cast<double>(groups[x].bytes);
    });
    for (const std::size_t g : by_use)
        if (fits(groups[g]) && left.gain(groups[g]) >= -kHarm * left.much()) keep(groups[g]);
    return out;
}

}  // namespace risorius::shapes
