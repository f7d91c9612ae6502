// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/landmark_target.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/core/rotations.h"
#include "risorius/inverse/detail/landmark_recording.h"
#include "risorius/landmarks/similarity.h"

namespace risorius::inverse {

namespace {

// Landmarks that no muscle moves farther determine the motion of the head
constexpr double kOnTheSkull_m = 1e-3;
constexpr int kRounds = 4;  // for the motion of a head
// How much earlier a frame may come than its rate says, in frames: files round their times.
constexpr double kEarly = 0.05;

std::vector<Vec3> list_of(const Points& points) {
    std::vector<Vec3> out;
    for (long i = 0; i < points.rows(); ++i) out.emplace_back(points.row(i).transpose());
    return out;
}

/// Brings frames back to where the head of the sitter is.
class Head {
  public:
    Head(const LandmarkRecording& seen, const std::vector<double>& max_m, double metres)
        : seen_(seen), max_m_(max_m), metres_(metres) {
        for (std::size_t i = 0; i < max_m.size(); ++i)
            if (max_m[i] <= kOnTheSkull_m) on_skull_.push_back(static_cast<long>(i));
    }

    Points brought_back(std::size_t frame, const Points& to) const {
        Points out = seen_.at[frame];
        if (!seen_.of_rig()) {
            std::vector<double> may_move = max_m_;
            for (int round = 0; round < kRounds; ++round) {
                const landmarks::Similarity back = landmarks::nearest_similarity(
                    list_of(seen_.at[frame]), list_of(to), weights(frame, may_move));
                for (long i = 0; i < out.rows(); ++i)
                    out.row(i) = back(Vec3(seen_.at[frame].row(i).transpose())).transpose();
                for (std::size_t i = 0; i < may_move.size(); ++i) {
                    const auto row = static_cast<long>(i);
                    may_move[i] =
                        std::min(max_m_[i], metres_ * (out.row(row) - to.row(row)).norm());
                }
            }
        } else if (on_skull_.size() >= 3) {
            const Rigid back =
                nearest_motion(out(on_skull_, Eigen::all), to(on_skull_, Eigen::all));
            for (long i = 0; i < out.rows(); ++i)
                out.row(i) = (back * Vec3(out.row(i).transpose())).transpose();
        }
        return out;
    }

  private:
    std::vector<double> weights(std::size_t frame, const std::vector<double>& may_move) const {
        std::vector<double> out;
        double sum = 0;
        for (std::size_t i = 0; i < may_move.size(); ++i) {
            out.push_back(seen_.confidence(static_cast<long>(i), static_cast<long>(frame)) /
                          (may_move[i] * may_move[i] + kOnTheSkull_m * kOnTheSkull_m));
            sum += out.back();
        }
        // A face that was not seen stays where it is.
        if (!(sum > 0)) out.assign(out.size(), 1);
        return out;
    }

    const LandmarkRecording& seen_;
    const std::vector<double>& max_m_;
    double metres_;  ///< per unit of the recording
    std::vector<long> on_skull_;
};

/// The frames of the time in which the face is neutral.
std::vector<std::size_t> neutral_frames(const LandmarkRecording& seen,
                                        const LandmarkOptions& options) {
    std::vector<std::size_t> out;
    if (!options.neutral_s) return {0};
    for (std::size_t t = 0; t < seen.times_s.size(); ++t) {
        const double at = seen.times_s[t] - seen.times_s[0];
        if (at >= (*options.neutral_s)[0] && at <= (*options.neutral_s)[1]) out.push_back(t);
    }
    if (out.empty())
        throw Error(option_name("neutral"),
                    "a time within the " +
                        format_number(seen.times_s.back() - seen.times_s.front()) + " s of rows",
                    format_number((*options.neutral_s)[0]) + " to " +
                        format_number((*options.neutral_s)[1]) + " s");
    return out;
}

/// The mean of the neutral frames, each landmark by its confidence.
Points sitter_of(const LandmarkRecording& seen, const Head& head,
                 const std::vector<std::size_t>& neutral) {
    const Points first = seen.at[neutral[0]];
    Points sum = Points::Zero(first.rows(), 3);
    Eigen::VectorXd all = Eigen::VectorXd::Zero(first.rows());
    for (const std::size_t t : neutral) {
        const Points at = head.brought_back(t, first);
        const Eigen::VectorXd sure = seen.confidence.col(static_cast<long>(t));
        sum += sure.asDiagonal() * at;
        all += sure;
    }
    for (long i = 0; i < first.rows(); ++i)
        if (all[i] > 0)
            sum.row(i) /= all[i];
        else
            sum.row(i) = first.row(i);
    return sum;
}

/// What brings the sitter to the rig at rest. A flat sitter lies in the plane of the picture.
landmarks::Similarity size_of(const LandmarkRecording& seen, const Points& sitter, Points rest,
                              const std::string& place) {
    if (seen.of_rig()) return {};
    if (seen.flat) rest.col(2).setZero();
    landmarks::Similarity out = landmarks::nearest_similarity(list_of(sitter), list_of(rest));
    double squares = 0;
    for (long i = 0; i < rest.rows(); ++i)
        squares += (out(Vec3(sitter.row(i).transpose())) - rest.row(i).transpose()).squaredNorm();
    // Faces differ by some millimetres; what is mirrored, or no face, by centimetres.
    constexpr double kAnotherFace_m = 0.015;
    const double off_m = std::sqrt(squares / static_cast<double>(rest.rows()));
    if (!(off_m < kAnotherFace_m) || !(out.scale > 0))
        throw Error(
            place, "points of a face that is not mirrored",
            format_number(std::round(1e3 * off_m)) + " mm RMS between it and the rig at rest");
    return out;
}

}  // namespace

FitTarget given_landmarks(const std::filesystem::path& file, const LandmarkOptions& options,
                          const scene::LandmarkPoints& points,
                          const std::function<std::vector<double>()>& max_m, const Points& rest) {
    const std::vector<std::string> all = points.ids();
    const LandmarkRecording seen = read_landmark_recording(file, all, options.picture_px);
    const std::vector<std::size_t> neutral = neutral_frames(seen, options);
    const std::vector<double> max_of_all_m = max_m();
    std::vector<double> own_max_m;
    Points at_rest(static_cast<long>(seen.ids.size()), 3);
    for (std::size_t i = 0; i < seen.ids.size(); ++i) {
        own_max_m.push_back(max_of_all_m[static_cast<std::size_t>(
            std::find(all.begin(), all.end(), seen.ids[i]) - all.begin())]);
        at_rest.row(static_cast<long>(i)) = points.at(seen.ids[i], rest).transpose();
    }
    const Head head(seen, own_max_m,
                    size_of(seen, seen.at[neutral[0]], at_rest, file.string()).scale);
    const Points sitter = sitter_of(seen, head, neutral);
    const landmarks::Similarity size = size_of(seen, sitter, at_rest, file.string());
    FitTarget out;
    out.notes = seen.notes;
    out.set = seen.set;
    if (!seen.of_rig()) {
        char text[96];
        std::snprintf(text, sizeof text, "%zu landmarks of the rig from the points of %s%s",
                      seen.ids.size(), seen.set.c_str(), seen.flat ? ", without depth" : "");
        out.notes.emplace_back(text);
        out.sitter_scale = size.scale;
    }
    const double surest = seen.confidence.maxCoeff();
    const bool all_sure = !seen.flat && seen.confidence.minCoeff() == surest && surest > 0;
    out.weight = Eigen::VectorXd::Zero(rest.rows());
    std::vector<int> vertices;
    for (std::size_t i = 0; i < seen.ids.size(); ++i) {
        vertices.push_back(points.vertex(seen.ids[i]));
        if (seen.confidence.row(static_cast<long>(i)).maxCoeff() > 0)
            out.weight[vertices.back()] = 1;
    }
    double next_s = seen.times_s[0];
    for (std::size_t t = 0; t < seen.times_s.size(); ++t) {
        if (seen.times_s[t] < next_s - kEarly / options.fps) continue;
        next_s = std::max(next_s + 1.0 / options.fps, seen.times_s[t]);
        const Points moved =
            size.scale * (head.brought_back(t, sitter) - sitter) * size.rotation.transpose();
        Points& field = out.fields.emplace_back(Points::Zero(rest.rows(), 3));
        Eigen::VectorXd sure = Eigen::VectorXd::Zero(rest.rows());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            field.row(vertices[i]) = moved.row(static_cast<long>(i));
            sure[vertices[i]] = seen.confidence(static_cast<long>(i), static_cast<long>(t)) /
                                std::max(surest, 1e-9);
        }
        if (!all_sure) out.sure.push_back(std::move(sure));
        out.times_s.push_back(seen.times_s[t] - seen.times_s[0]);
        out.names.push_back("frame " + std::to_string(t));
    }
    out.flat = seen.flat;
    return out;
}

}  // namespace risorius::inverse
