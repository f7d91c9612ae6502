// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/unit_bench.h"

#include <array>
#include <set>
#include <span>
#include <stdexcept>
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
// What faces show most, and how strongly
constexpr std::array kUsual{"happiness", "sadness",  "anger", "fear",          "disgust",
                            "surprise",  "contempt", "pain",  "embarrassment", "smile_amused"};
constexpr std::array kUsualAt{0.45, 0.85};

}  // namespace

UnitBench::UnitBench(face::FaceTeam& team, const UnitSources& sources, std::vector<int> vertices)
    : team_(team), sources_(sources), vertices_(std::move(vertices)) {}

Points UnitBench::at_rest() const { return team_.first().head().vertices(vertices_, Eigen::all); }

void UnitBench::go_to(face::Face& face, const Eigen::VectorXd& weight,
                      const ProgressMonitor& monitor) const {
    track::Drive rest;
    rest.excitation = Eigen::VectorXd::Zero(sources_.drive_of(weight).excitation.size());
    face.start([&](double) { return rest; });
    go_on_to(face, weight, monitor);
}

Eigen::VectorXd UnitBench::displacement(const Points& vertices) const {
    const Points moved = vertices(vertices_, Eigen::all) - at_rest();
    return Eigen::Map<const Eigen::VectorXd>(moved.data(), moved.size());
}

void UnitBench::go_on_to(face::Face& face, const Eigen::VectorXd& weight,
                         const ProgressMonitor& monitor) const {
    const track::Drive drive = sources_.drive_of(weight);
    face.solve_equilibrium(drive.excitation, drive,
                           {.iterations = kMostIterations,
                            .tolerance_m = kTolerated_m,
                            .planes_m = kPlanesMove_m,
                            .stopped = monitor.stopped});
    monitor.throw_if_stopped();
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

UnitBench::Inputs UnitBench::inputs_of(const Eigen::VectorXd& weight,
                                       const std::vector<bool>& wanted) const {
    Inputs out;
    std::set<int> columns;
    std::set<track::Kinematic> channels;
    for (long s = 0; s < sources_.count(); ++s) {
        track::Expansion& change =
            out.changes.emplace_back(sources_.change_of(static_cast<std::size_t>(s), weight[s]));
        if (!wanted.empty() && !wanted[static_cast<std::size_t>(s)]) {
            change.excitation.setZero();
            change.kinematic = {};
        }
        for (long c = 0; c < change.excitation.size(); ++c)
            if (change.excitation[c] != 0) columns.insert(static_cast<int>(c));
        for (std::size_t k = 0; k < change.kinematic.size(); ++k)
            if (change.kinematic[k] != 0) channels.insert(static_cast<track::Kinematic>(k));
    }
    out.columns.assign(columns.begin(), columns.end());
    out.channels.assign(channels.begin(), channels.end());
    return out;
}

Eigen::MatrixXd UnitBench::derivatives(face::Face& face, std::span<const int> columns,
                                       std::span<const track::Kinematic> channels) const {
    const std::vector<Points> fields = face.statics().sensitivities(columns, channels);
    Eigen::MatrixXd out(3 * static_cast<long>(vertices_.size()), static_cast<long>(fields.size()));
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const Points own = fields[i](vertices_, Eigen::all);
        out.col(static_cast<long>(i)) = Eigen::Map<const Eigen::VectorXd>(own.data(), own.size());
    }
    return out;
}

Eigen::MatrixXd UnitBench::derivatives(
    const Inputs& inputs, const std::function<void(int task, face::Face& face)>& place) const {
    // The second task does the channels, too.
    const std::size_t half = inputs.columns.size() / 2;
    const std::span<const int> columns(inputs.columns);
    std::array<Eigen::MatrixXd, 2> parts;
    team_.each(2, [&](int task, face::Face& face) {
        place(task, face);
        parts[static_cast<std::size_t>(task)] =
            task == 0 ? derivatives(face, columns.first(half), {})
                      : derivatives(face, columns.subspan(half), inputs.channels);
    });
    Eigen::MatrixXd by(parts[0].rows(), parts[0].cols() + parts[1].cols());
    by << parts[0], parts[1];
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(by.rows(), sources_.count());
    for (std::size_t s = 0; s < inputs.changes.size(); ++s) {
        auto way = out.col(static_cast<long>(s));
        for (std::size_t i = 0; i < inputs.columns.size(); ++i)
            way += inputs.changes[s].excitation[inputs.columns[i]] * by.col(static_cast<long>(i));
        for (std::size_t i = 0; i < inputs.channels.size(); ++i)
            way += inputs.changes[s].kinematic[static_cast<std::size_t>(inputs.channels[i])] *
                   by.col(static_cast<long>(inputs.columns.size() + i));
    }
    return out;
}

KnownUnits UnitBench::state(const Eigen::VectorXd& weight, const ProgressMonitor& monitor) const {
    KnownUnits out{{weight, {}, {}}, {}};
    out.state.way = derivatives(inputs_of(weight, {}), [&](int task, face::Face& face) {
        go_to(face, weight, monitor);
        if (task > 0) return;
        out.state.moved = displacement(face.pose().vertices);
        out.nodes = face.statics().nodes();
    });
    monitor.throw_if_stopped();
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

std::vector<Eigen::VectorXd> UnitBench::usual_weights(const scene::RigFiles& files) const {
    std::vector<Eigen::VectorXd> out;
    for (const char* name : kUsual)
        if (const track::Expression* one = files.rig.expressions.find(name))
            for (const double intensity : kUsualAt)
                out.push_back(sources_.weights_of(one->parts, intensity));
    return out;
}

Points UnitBench::nodes_at_rest() const {
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(sources_.count());
    const track::Drive rest = sources_.drive_of(none);
    team_.first().start([&](double) { return rest; });
    return team_.first().statics().nodes();
}

std::string UnitBench::key_of(const scene::RigFiles& files, const std::string& quality) const {
    // The forces of all muscles, and of tissue that is stretched, stand for whatever the face is made of.
    const Points nodes = nodes_at_rest();
    const face::Face& face = team_.first();
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(files.rig.channels().column_count());
    CacheKey key("inverse/known_units");
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
    for (const Eigen::VectorXd& weights : usual_weights(files)) key.add(weights);
    return key.finish();
}

std::vector<KnownUnits> UnitBench::known(const scene::RigFiles& files, const std::string& quality,
                                         const ProgressMonitor& monitor) const {
    // One after the other: the weights of a state, what they move, the derivatives, and the nodes.
    struct Kept {
        std::vector<double> numbers;
    };
    const auto keep = [](const KnownUnits& known, Kept& kept) {
        const auto add = [&](const auto& part) {
            kept.numbers.insert(kept.numbers.end(), part.data(), part.data() + part.size());
        };
        add(known.state.weight);
        add(known.state.moved);
        add(known.state.way);
        add(known.nodes);
    };
    const Points rest = nodes_at_rest();
    const long sources = sources_.count(), rows = 3 * static_cast<long>(vertices_.size());
    const auto one = static_cast<std::size_t>(sources + rows + rows * sources + rest.size());
    const std::vector<Eigen::VectorXd> usual = usual_weights(files);
    const Kept kept = cached_result(
        key_of(files, quality),
        [&] {
            Kept made;
            constexpr double kShapes = 0.3;
            keep({{Eigen::VectorXd::Zero(sources), Eigen::VectorXd::Zero(rows),
                   unit_shapes(monitor.subrange(0, kShapes))},
                  rest},
                 made);
            for (std::size_t i = 0; i < usual.size(); ++i) {
                monitor.report(kShapes + (1 - kShapes) * static_cast<double>(i) /
                                             static_cast<double>(usual.size()),
                               "usual expressions");
                keep(state(usual[i], {.progress = {}, .stopped = monitor.stopped}), made);
            }
            return made;
        },
        [&](Kept& result, const auto& visit) {
            visit(result.numbers);
            if (result.numbers.size() != one * (usual.size() + 1))
                throw std::out_of_range("states of units");
        });
    std::vector<KnownUnits> out;
    for (std::size_t i = 0; i < kept.numbers.size(); i += one) {
        const double* at = &kept.numbers[i];
        const auto next = [&](long so_many_rows, long columns) {
            const double* const from = at;
            at += so_many_rows * columns;
            return Eigen::Map<const Eigen::MatrixXd>(from, so_many_rows, columns);
        };
        KnownUnits& known = out.emplace_back();
        known.state.weight = next(sources, 1);
        known.state.moved = next(rows, 1);
        known.state.way = next(rows, sources);
        known.nodes = Eigen::Map<const Points>(at, rest.rows(), 3);
    }
    return out;
}

}  // namespace risorius::inverse
