// SPDX-License-Identifier: MIT
#include "risorius/perform/rig_reader.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "risorius/core/counter_rng.h"
#include "risorius/core/dense_algebra.h"
#include "risorius/core/error.h"
#include "risorius/core/parallel.h"
#include "risorius/core/result_cache.h"

namespace risorius::perform {

namespace {

// lambda: of the squared change that a picture shows, in distances of the eyes
constexpr double kRidge = 1e-5;
constexpr int kMixedPoses = 160, kFolds = 5, kMostWorkers = 4;
constexpr double kActs = 0.05;       // a channel below does not count as acting
constexpr double kLeastSlope = 0.4;  // of a curve: below, noise would become values
constexpr double kShownYaw_deg = 12, kShownPitch_deg = 9, kTurned = 0.6, kOneSided = 0.35;

/// A unit of the mixed poses, and how often it acts.
struct MixedUnit {
    const char* name;
    bool sided;
    double share;
};
// Units that a camera can see at all. A jaw is a kinematic channel. The sides of some are not told apart by the network.
constexpr std::array<MixedUnit, 12> kUnits{{{"AU1", true, 0.25},
                                            {"AU2", true, 0.3},
                                            {"AU4", false, 0.25},
                                            {"AU45", true, 0.35},
                                            {"AU6", false, 0.12},
                                            {"AU9", false, 0.12},
                                            {"AU10", false, 0.12},
                                            {"AU12", true, 0.35},
                                            {"AU15", false, 0.12},
                                            {"AU18", false, 0.12},
                                            {"AU20", false, 0.12},
                                            {"jaw_open", false, 0.4}}};

/// Without its side.
std::string unit_of(const std::string& channel) { return channel.substr(0, channel.find('.')); }

struct KnownUnit {
    MixedUnit unit;
    bool sided;
};

std::vector<KnownUnit> units_of(const rig::RigDescription& rig) {
    std::vector<KnownUnit> out;
    for (const MixedUnit& one : kUnits) {
        const auto unit =
            std::find_if(rig.facs.units.begin(), rig.facs.units.end(),
                         [&](const track::ActionUnit& u) { return u.id == one.name; });
        const bool known = unit != rig.facs.units.end() && unit->unsupported.empty();
        const bool jaw = std::string("jaw_open") == one.name;
        if (known || jaw) out.push_back({one, one.sided && (jaw || unit->sided)});
    }
    return out;
}

/// The pictures that a rig is learnt on.
struct Lessons {
    std::vector<Pose> poses;  ///< the levels of all units, the ranges, the mixed poses
    std::size_t ranges_from = 0, mixed_from = 0;
};

/// Some units at once, and a turn of the head.
Pose mixed_pose(const std::vector<KnownUnit>& units, int number) {
    RandomSequence random(static_cast<std::uint64_t>(number) << 8);
    Pose out;
    for (const KnownUnit& one : units) {
        const double acts = random.next(), value = random.next(), side = random.next();
        if (acts >= one.unit.share) continue;
        std::string name = one.unit.name;
        if (one.sided && side < kOneSided) name += side < 0.5 * kOneSided ? ".l" : ".r";
        out.emplace_back(name, value);
    }
    for (const auto& [name, most_deg] :
         {std::pair{"head_yaw_deg", kShownYaw_deg}, std::pair{"head_pitch_deg", kShownPitch_deg}}) {
        const double turns = random.next(), angle_deg = most_deg * (2 * random.next() - 1);
        if (turns < kTurned) out.emplace_back(name, angle_deg);
    }
    return out;
}

Lessons lessons_of(const std::vector<KnownUnit>& units) {
    Lessons out;
    for (const KnownUnit& one : units)
        for (int level = 1; level <= RigReader::kLevels; ++level)
            out.poses.push_back({{one.unit.name, static_cast<double>(level) / RigReader::kLevels}});
    out.ranges_from = out.poses.size();
    for (const Range& range : ranges()) {
        Pose pose;
        for (const std::string& unit : range.units)
            if (std::any_of(units.begin(), units.end(),
                            [&](const KnownUnit& one) { return one.unit.name == unit; }))
                pose.emplace_back(unit, 1.0);
        out.poses.push_back(pose);
    }
    out.mixed_from = out.poses.size();
    for (int i = 0; i < kMixedPoses; ++i) out.poses.push_back(mixed_pose(units, i));
    return out;
}

/// The value of a channel in a pose.
double value_in(const Pose& pose, const std::string& channel) {
    for (const auto& [name, value] : pose)
        if (name == channel || name == unit_of(channel)) return value;
    return 0;
}

/// What the networks see in the pictures: one row per look, kLooks for each pose. `first`: pictures of the rig.
Eigen::MatrixXd looked_at(const std::shared_ptr<const scene::RigFiles>& rig,
                          std::unique_ptr<RigPictures> first, const Networks& networks,
                          const std::vector<Pose>& poses, const ProgressMonitor& monitor,
                          SeenFace& rest) {
    TaskProgress progress(monitor, static_cast<int>(poses.size()) + 1);
    progress.begin("the face at rest");
    const Image picture = first->draw({});
    const auto seen = find_face(networks.face, picture);
    if (!seen)
        throw Error("the face of the rig", "one that the face network sees",
                    "none in a picture from the front");
    const Crop near = seen->next;
    rest = mean_look(networks, picture, looks_at(networks.face, picture, near));
    Eigen::MatrixXd out(static_cast<Eigen::Index>(poses.size()) * kLooks,
                        numbers_of(change_of(rest, rest)).size());
    const int workers = std::clamp(ThreadLimit().count(), 1, kMostWorkers);
    parallel_for(workers, {}, [&](int worker) {
        std::unique_ptr<RigPictures> pictures =
            worker == 0 ? std::move(first) : std::make_unique<RigPictures>(rig);
        for (std::size_t i = static_cast<std::size_t>(worker); i < poses.size();
             i += static_cast<std::size_t>(workers)) {
            progress.begin(poses[i].empty() ? "the face at rest" : poses[i].front().first);
            const Image shown = pictures->draw(poses[i]);
            std::vector<SeenFace> looks =
                looks_at(networks.face, shown, look_at(networks.face, shown, near).next);
            const SeenFace mean = mean_look(networks, shown, looks);
            for (int look = 0; look < kLooks; ++look) {
                SeenFace& one = looks[static_cast<std::size_t>(look)];
                one.eyes = mean.eyes;
                out.row(static_cast<Eigen::Index>(i) * kLooks + look) =
                    numbers_of(change_of(rest, one)).transpose();
            }
        }
    });
    return out;
}

/// The sums that a ridge regression needs, over some of the poses.
struct Sums {
    Eigen::MatrixXd xx, xv;
    double rows = 0;

    Sums(const Eigen::MatrixXd& x, const Eigen::MatrixXd& v)
        : xx(x.transpose() * x), xv(x.transpose() * v), rows(static_cast<double>(x.rows())) {}
    Eigen::MatrixXd readout() const {
        const Eigen::Index n = xx.rows();
        return solved_symmetric(xx + kRidge * rows * Eigen::MatrixXd::Identity(n, n), xv)
            .transpose();
    }
};

Eigen::VectorXd mean_of_looks(const Eigen::MatrixXd& looks, std::size_t pose) {
    return looks.middleRows(static_cast<Eigen::Index>(pose) * kLooks, kLooks)
        .colwise()
        .mean()
        .transpose();
}

/// What is read where each channel acts alone, made to rise.
Eigen::MatrixXd curves_of(const RigReader& reader, const std::vector<KnownUnit>& units,
                          const Eigen::MatrixXd& looks) {
    Eigen::MatrixXd out(static_cast<Eigen::Index>(reader.channels.size()), RigReader::kLevels);
    for (Eigen::Index c = 0; c < out.rows(); ++c) {
        const std::string unit = unit_of(reader.channels[static_cast<std::size_t>(c)].name);
        const auto at = std::find_if(units.begin(), units.end(),
                                     [&](const KnownUnit& one) { return one.unit.name == unit; });
        const auto from = static_cast<std::size_t>(at - units.begin()) * RigReader::kLevels;
        double before = 0;
        for (int level = 0; level < RigReader::kLevels; ++level) {
            const double read = reader.readout.row(c).dot(
                mean_of_looks(looks, from + static_cast<std::size_t>(level)));
            before = std::max(read, before + kLeastSlope / RigReader::kLevels);
            out(c, level) = before;
        }
    }
    return out;
}

/// Reads the mixed poses by regressions that have not seen them.
void judge(const Lessons& lessons, const Eigen::MatrixXd& looks, const Eigen::MatrixXd& truth,
           const Sums& all, RigReader& reader) {
    std::vector<double> acting(reader.channels.size(), 0), resting = acting;
    for (int fold = 0; fold < kFolds; ++fold) {
        std::vector<std::size_t> left_out;
        std::vector<Eigen::Index> rows;
        for (std::size_t i = lessons.mixed_from + static_cast<std::size_t>(fold);
             i < lessons.poses.size(); i += kFolds) {
            left_out.push_back(i);
            for (int look = 0; look < kLooks; ++look)
                rows.push_back(static_cast<Eigen::Index>(i) * kLooks + look);
        }
        Sums sums = all;
        const Sums without(looks(rows, Eigen::all), truth(rows, Eigen::all));
        sums.xx -= without.xx;
        sums.xv -= without.xv;
        sums.rows -= without.rows;
        const Eigen::MatrixXd readout = sums.readout();
        for (const std::size_t i : left_out) {
            const Eigen::VectorXd read = readout * mean_of_looks(looks, i);
            for (std::size_t c = 0; c < reader.channels.size(); ++c) {
                CameraChannel& channel = reader.channels[c];
                const double v = value_in(lessons.poses[i], channel.name),
                             off = reader.value(c, read[static_cast<Eigen::Index>(c)]) - v;
                (v >= kActs ? channel.error : channel.false_rms) += off * off;
                (v >= kActs ? acting : resting)[c] += 1;
            }
        }
    }
    for (std::size_t c = 0; c < reader.channels.size(); ++c) {
        CameraChannel& one = reader.channels[c];
        one.error = std::sqrt(one.error / std::max(1.0, acting[c]));
        one.false_rms = std::sqrt(one.false_rms / std::max(1.0, resting[c]));
    }
}

/// What is learnt, as numbers for the cache.
struct KeptReader {
    std::vector<double> numbers;
};

/// Calls visit(number) for all numbers of a reader whose channels and sizes are set.
template <class Reader, class Visit>
void each_number(Reader& reader, const Visit& visit) {
    for (auto& p : reader.rest.points)
        for (int k = 0; k < 3; ++k) visit(p[k]);
    for (auto& eye : reader.rest.eyes)
        for (auto& p : eye)
            for (int k = 0; k < 2; ++k) visit(p[k]);
    for (auto& one : reader.channels) {
        visit(one.error);
        visit(one.false_rms);
    }
    for (auto* matrix : {&reader.readout, &reader.curves, &reader.full})
        for (Eigen::Index i = 0; i < matrix->size(); ++i) visit((*matrix)(i));
}

void find_reliable(std::vector<CameraChannel>& channels) {
    std::set<std::string> unreliable;
    for (const CameraChannel& one : channels)
        if (one.error > kReliable || one.false_rms > kReliableElsewhere)
            unreliable.insert(unit_of(one.name));
    for (CameraChannel& one : channels) one.reliable = !unreliable.contains(unit_of(one.name));
}

/// A reader with its channels, and room for its numbers.
RigReader empty_reader(const std::vector<KnownUnit>& units) {
    RigReader out;
    for (const KnownUnit& one : units)
        for (const char* side : {".l", ".r"}) {
            out.channels.push_back({one.unit.name + std::string(one.sided ? side : "")});
            if (!one.sided) break;
        }
    out.rest.points.assign(landmarks::kFacePoints, Vec3::Zero());
    for (std::vector<Vec2>& eye : out.rest.eyes) eye.assign(landmarks::kEyePoints, Vec2::Zero());
    const ShapeChange none{{}, out.rest.points, out.rest.eyes};
    const auto channels = static_cast<Eigen::Index>(out.channels.size());
    out.readout.resize(channels, numbers_of(none).size());
    out.curves.resize(channels, RigReader::kLevels);
    out.full.resize(channels, static_cast<Eigen::Index>(ranges().size()));
    return out;
}

/// Pictures of the rig at rest and with each unit stand for whatever it is made of.
std::string key_of(RigPictures& pictures, const std::vector<KnownUnit>& units) {
    CacheKey key("perform/rig_reader 1");
    key.add(pictures.draw({}).rgba);
    for (const KnownUnit& one : units)
        key.add(one.sided).add(pictures.draw({{one.unit.name, 1.0}}).rgba);
    return key.finish();
}

void learn(const std::shared_ptr<const scene::RigFiles>& rig, std::unique_ptr<RigPictures> pictures,
           const Networks& networks, const std::vector<KnownUnit>& units,
           const ProgressMonitor& monitor, RigReader& out) {
    const Lessons lessons = lessons_of(units);
    const Eigen::MatrixXd looks =
        looked_at(rig, std::move(pictures), networks, lessons.poses, monitor, out.rest);
    Eigen::MatrixXd truth(looks.rows(), static_cast<Eigen::Index>(out.channels.size()));
    for (Eigen::Index row = 0; row < truth.rows(); ++row)
        for (Eigen::Index c = 0; c < truth.cols(); ++c)
            truth(row, c) = value_in(lessons.poses[static_cast<std::size_t>(row / kLooks)],
                                     out.channels[static_cast<std::size_t>(c)].name);
    const Sums sums(looks, truth);
    out.readout = sums.readout();
    out.curves = curves_of(out, units, looks);
    for (std::size_t k = 0; k < ranges().size(); ++k)
        out.full.col(static_cast<Eigen::Index>(k)) =
            out.readout * mean_of_looks(looks, lessons.ranges_from + k);
    judge(lessons, looks, truth, sums, out);
}

}  // namespace

const std::vector<Range>& ranges() {
    static const std::vector<Range> all{
        {"brows", {"AU1", "AU2"}}, {"smile", {"AU12"}}, {"open", {"jaw_open"}}, {"shut", {"AU45"}}};
    return all;
}

double RigReader::value(std::size_t channel, double read) const {
    double below = 0;
    for (int level = 0; level < kLevels; ++level) {
        const double above = curves(static_cast<Eigen::Index>(channel), level);
        if (read < above)
            return std::max(0.0, (level + (read - below) / (above - below)) / kLevels);
        below = above;
    }
    return 1;
}

std::vector<double> RigReader::values(const ShapeChange& change) const {
    const Eigen::VectorXd r = readout * numbers_of(change);
    std::vector<double> out;
    for (std::size_t c = 0; c < channels.size(); ++c)
        out.push_back(value(c, r[static_cast<Eigen::Index>(c)]));
    return out;
}

RigReader learn_rig(const std::shared_ptr<const scene::RigFiles>& rig, const Networks& networks,
                    const ProgressMonitor& monitor) {
    const std::vector<KnownUnit> units = units_of(rig->rig);
    auto pictures = std::make_unique<RigPictures>(rig);
    RigReader out = empty_reader(units);
    const KeptReader kept = cached_result(
        cache_folder().empty() ? "" : key_of(*pictures, units),
        [&] {
            KeptReader made;
            learn(rig, std::move(pictures), networks, units, monitor, out);
            each_number(out, [&](double number) { made.numbers.push_back(number); });
            return made;
        },
        [&](KeptReader& result, const auto& visit) {
            visit(result.numbers);
            std::size_t count = 0;
            each_number(out, [&](double) { ++count; });
            if (result.numbers.size() != count) throw std::out_of_range("numbers of a reader");
        });
    std::size_t next = 0;
    each_number(out, [&](double& number) { number = kept.numbers[next++]; });
    find_reliable(out.channels);
    return out;
}

}  // namespace risorius::perform
