// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/unit_bench.h"

#include <set>
#include <span>
#include <utility>

#include "risorius/blendshapes/shape_player.h"
#include "risorius/core/read_file.h"
#include "risorius/core/result_cache.h"
#include "risorius/face/statics.h"

namespace risorius::inverse {

namespace {

constexpr int kMostIterations = 400;
constexpr double kTolerated_m = 5e-5, kPlanesMove_m = 1e-4;  // as for blend shapes
// Intensities of units, and activations of muscles, at which their shapes are simulated: what is seen most
constexpr double kUnitAt = 0.7, kMuscleAt = 0.3;
constexpr double kShared_mm = 15;  // half width of the strip in the middle that both sides share
constexpr double kProbe = 0.5;

}  // namespace

UnitBench::UnitBench(face::FaceTeam& team, const UnitSources& sources, std::vector<int> vertices)
    : team_(team), sources_(sources), vertices_(std::move(vertices)) {}

Points UnitBench::at_rest() const { return team_.first().head().vertices(vertices_, Eigen::all); }

void UnitBench::go_to(face::Face& face, const Eigen::VectorXd& weight,
                      const ProgressMonitor& monitor) const {
    const track::Drive drive = sources_.drive_of(weight);
    track::Drive rest;
    rest.excitation = Eigen::VectorXd::Zero(drive.excitation.size());
    face.start([&](double) { return rest; });
    face.solve_equilibrium(drive.excitation, drive,
                           {.iterations = kMostIterations,
                            .tolerance_m = kTolerated_m,
                            .planes_m = kPlanesMove_m,
                            .stopped = monitor.stopped});
    monitor.throw_if_stopped();
}

Eigen::VectorXd UnitBench::displacement(const Points& vertices) const {
    const Points moved = vertices(vertices_, Eigen::all) - at_rest();
    return Eigen::Map<const Eigen::VectorXd>(moved.data(), moved.size());
}

std::vector<Eigen::VectorXd> UnitBench::moved(const std::vector<Eigen::VectorXd>& weights,
                                              const ProgressMonitor& monitor) const {
    std::vector<Eigen::VectorXd> out(weights.size());
    TaskProgress progress(monitor, static_cast<int>(weights.size()));
    team_.each(static_cast<int>(weights.size()), [&](int i, face::Face& face) {
        progress.begin("units");
        const auto index = static_cast<std::size_t>(i);
        go_to(face, weights[index], monitor);
        out[index] = displacement(face.pose().vertices);
    });
    return out;
}

UnitState UnitBench::state(const Eigen::VectorXd& weight, const ProgressMonitor& monitor) const {
    std::vector<track::Expansion> changes;
    std::set<int> columns;
    std::set<track::Kinematic> channels;
    for (long s = 0; s < sources_.count(); ++s) {
        changes.push_back(sources_.change_of(static_cast<std::size_t>(s), weight[s]));
        for (long c = 0; c < changes.back().excitation.size(); ++c)
            if (changes.back().excitation[c] != 0) columns.insert(static_cast<int>(c));
        for (std::size_t k = 0; k < changes.back().kinematic.size(); ++k)
            if (changes.back().kinematic[k] != 0) channels.insert(static_cast<track::Kinematic>(k));
    }
    const std::vector<int> column_list(columns.begin(), columns.end());
    const std::vector<track::Kinematic> channel_list(channels.begin(), channels.end());
    UnitState out{weight,
                  {},
                  Eigen::MatrixXd::Zero(3 * static_cast<long>(vertices_.size()), sources_.count())};
    // By each number of the drive. Each of two tasks does every other column; the second one does the channels, too.
    const auto count = static_cast<long>(column_list.size() + channel_list.size());
    Eigen::MatrixXd by(out.way.rows(), count);
    team_.each(2, [&](int part, face::Face& face) {
        go_to(face, weight, monitor);
        if (part == 0) out.moved = displacement(face.pose().vertices);
        const auto half = static_cast<long>(column_list.size()) / 2;
        const long first = part == 0 ? 0 : half,
                   last = part == 0 ? half : static_cast<long>(column_list.size());
        const std::vector<Points> fields = face.statics().sensitivities(
            std::span(column_list)
                .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first)),
            std::span(channel_list).first(part == 0 ? 0 : channel_list.size()));
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const Points own = fields[i](vertices_, Eigen::all);
            by.col(first + static_cast<long>(i)) =
                Eigen::Map<const Eigen::VectorXd>(own.data(), own.size());
        }
        monitor.throw_if_stopped();
    });
    for (std::size_t s = 0; s < changes.size(); ++s) {
        auto way = out.way.col(static_cast<long>(s));
        for (std::size_t i = 0; i < column_list.size(); ++i)
            way += changes[s].excitation[column_list[i]] * by.col(static_cast<long>(i));
        for (std::size_t i = 0; i < channel_list.size(); ++i)
            way += changes[s].kinematic[static_cast<std::size_t>(channel_list[i])] *
                   by.col(static_cast<long>(column_list.size() + i));
    }
    return out;
}

Eigen::MatrixXd UnitBench::unit_shapes(const ProgressMonitor& monitor) const {
    const std::vector<UnitCandidate>& candidates = sources_.candidates();
    std::vector<Eigen::VectorXd> weights;
    for (const UnitCandidate& one : candidates) {
        Eigen::VectorXd& weight = weights.emplace_back(Eigen::VectorXd::Zero(sources_.count()));
        for (const std::size_t s : one.sources)
            weight[static_cast<long>(s)] = one.is_unit ? kUnitAt : kMuscleAt;
    }
    const std::vector<Eigen::VectorXd> found = moved(weights, monitor);
    const Points at_rest = this->at_rest();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(at_rest.size(), sources_.count());
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        const Eigen::VectorXd shape = found[c] / (candidates[c].is_unit ? kUnitAt : kMuscleAt);
        const Points field = Eigen::Map<const Points>(shape.data(), at_rest.rows(), 3);
        const auto [left, right] = blendshapes::left_and_right(at_rest, field, 1e-3 * kShared_mm);
        for (const std::size_t s : candidates[c].sources) {
            const int side = sources_.at(s).side;
            const Points& own = side < 0 ? field : side == 0 ? left : right;
            out.col(static_cast<long>(s)) =
                Eigen::Map<const Eigen::VectorXd>(own.data(), own.size());
        }
    }
    return out;
}

UnitState UnitBench::rest(const scene::RigFiles& files, const std::string& quality,
                          const ProgressMonitor& monitor) const {
    // The forces of all muscles, and of tissue that is stretched, stand for whatever the face is made of.
    face::Face& face = team_.first();
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(files.rig.channels().column_count());
    face.start([&](double) { return drive; });
    const Points nodes = face.statics().nodes();
    CacheKey key("inverse/unit_shapes");
    key.add(read_file(files.file, {"a rig", kMegabyte * 100})).add(quality).add(vertices_);
    key.add(face.head().vertices);
    key.add(face.statics().gradient(
        nodes, Eigen::VectorXd::Constant(drive.excitation.size(), kProbe), drive));
    key.add(face.statics().gradient((1 + 1e-3) * nodes, drive.excitation, drive));
    for (long s = 0; s < sources_.count(); ++s) {
        const track::Drive full =
            sources_.drive_of(kUnitAt * Eigen::VectorXd::Unit(sources_.count(), s));
        key.add(full.excitation).add(full.kinematic);
    }
    struct Kept {
        Eigen::MatrixXd shapes;
    };
    const Kept kept = cached_result(
        key.finish(), [&] { return Kept{unit_shapes(monitor)}; },
        [&](Kept& result, const auto& visit) {
            std::vector<double> numbers(result.shapes.data(),
                                        result.shapes.data() + result.shapes.size());
            visit(numbers);
            result.shapes = Eigen::Map<const Eigen::MatrixXd>(
                numbers.data(),
                sources_.count() > 0 ? static_cast<long>(numbers.size()) / sources_.count() : 0,
                sources_.count());
        });
    return {Eigen::VectorXd::Zero(sources_.count()), Eigen::VectorXd::Zero(kept.shapes.rows()),
            kept.shapes};
}

}  // namespace risorius::inverse
