// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/shape_correctives.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "risorius/blendshapes/detail/corrective_drivers.h"
#include "risorius/blendshapes/detail/low_rank.h"
#include "risorius/face/surfaces.h"
#include "risorius/report/stopwatch.h"
#include "risorius/scene/expression_score.h"

namespace risorius::blendshapes {

namespace {

// Skin is shared when each of two shapes moves it farther than this
constexpr double kShares_m = 0.3e-3;

// Pairs with a larger error are also simulated at intermediate weights, and on one side.
constexpr double kBentPair_m = 1e-3, kOneSidedPair_m = 2e-3;

constexpr int kMostNamed = 64;  // which are less accurate one by one

struct Candidate {
    std::size_t a, b;  ///< units; equal for a unit at weight 1/2
    double matters = 0;
};

/// Largest squared product of the weights of two units in any frame. The maximum is used because an error that occurs once is
/// visible; a rare pair counts like a frequent one.
double met(const Unit& a, const Unit& b, const Eigen::MatrixXd& played) {
    if (played.rows() == 0) return 0;
    double max = 0;
    for (const int i : a.parts)
        for (const int j : b.parts)
            max = std::max(max, played.col(i).cwiseProduct(played.col(j)).maxCoeff());
    return max * max;
}

// Estimates how much two shapes interfere: the largest motion of skin that both move. Over 280 simulated pairs on two heads, this
// predicts the error of the sum with a rank correlation of 0.64; shared area times motion gives 0.49.
std::vector<Candidate> candidates_of(const std::vector<Unit>& units, const MadeShapes& shapes,
                                     const Eigen::VectorXd& area, int pairs,
                                     const Eigen::MatrixXd& played) {
    std::vector<Eigen::VectorXd> moved;
    for (const Unit& unit : units)
        moved.push_back((area.array() > 0).select(unit.field.rowwise().norm(), 0.0));
    std::vector<Candidate> out;
    for (std::size_t a = 0; a < units.size(); ++a)
        for (std::size_t b = a + 1; b < units.size(); ++b) {
            const ShapeGoal& goal = shapes.list[static_cast<std::size_t>(units[a].parts[0])].goal;
            if (goal.sides == Sides::kOpposed && goal.partner == units[b].parts[0]) continue;
            const double both_m = moved[a].cwiseMin(moved[b]).maxCoeff();
            if (both_m < kShares_m) continue;
            out.push_back({a, b,
                           both_m * both_m *
                               (kPairIsMet * kSquareOfProduct + met(units[a], units[b], played))});
        }
    std::stable_sort(out.begin(), out.end(),
                     [](const Candidate& x, const Candidate& y) { return x.matters > y.matters; });
    if (static_cast<int>(out.size()) > pairs) out.resize(static_cast<std::size_t>(pairs));
    for (std::size_t a = 0; a < units.size(); ++a) out.push_back({a, a, 0});
    return out;
}

/// Further poses of candidates: index of the first pose of each kind.
struct CloserPoses {
    std::optional<std::size_t> on_its_way, one_sided;
};
struct CloserLook {
    std::vector<CloserPoses> of;  ///< one per candidate
    std::vector<track::Drive> drives;
};

// Further poses for candidates whose path is not straight: shapes at 1/4 and 3/4, pairs with one or both at 1/2, and for
// candidates with sides, one or both on one side.
CloserLook poses_closer_by(const std::vector<Candidate>& candidates, const std::vector<Unit>& units,
                           const MadeShapes& shapes, const std::vector<Points>& lacking,
                           const std::vector<TriedCorrective>& tried,
                           const CorrectiveOptions& options, const track::ChannelTable& channels) {
    const track::Drive rest = no_drive(channels);
    const auto drive_of = [&](int shape) {
        return shapes.list[static_cast<std::size_t>(shape)].goal.drive;
    };
    CloserLook out;
    out.of.resize(candidates.size());
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        if (lacking[c].size() == 0) continue;
        const Unit &a = units[candidates[c].a], &b = units[candidates[c].b];
        const bool half = candidates[c].a == candidates[c].b;
        if (!half && !options.bent_pairs) continue;
        if (half || tried[c].max_m >= kBentPair_m) out.of[c].on_its_way = out.drives.size();
        if (half)
            for (const double weight : {0.25, 0.75})
                out.drives.push_back(sum_of(rest, a.drive, weight, channels));
        else if (out.of[c].on_its_way)
            for (const PairOnItsWay& at : kPairsOnTheirWay)
                out.drives.push_back(
                    sum_of(sum_of(rest, a.drive, at.a, channels), b.drive, at.b, channels));
        if (half || tried[c].max_m < kOneSidedPair_m) continue;
        out.of[c].one_sided = out.drives.size();
        for (const OneSidedPair& at : one_sided_pairs(a, b))
            out.drives.push_back(sum_of(at.a_alone ? drive_of(a.of_side(at.side)) : a.drive,
                                        at.b_alone ? drive_of(b.of_side(at.side)) : b.drive, 1,
                                        channels));
    }
    return out;
}

// For each simulated frame of the scripts: the error of the sum of shapes. The poses of the frames begin at `first`.
std::vector<blendshapes::PlayedFrame> frames_left_to_explain(
    const ScriptFrames& played, const std::vector<SolvedPose>& poses, std::size_t first,
    const blendshapes::BlendShapeRig& rig) {
    std::vector<blendshapes::PlayedFrame> frames;
    for (std::size_t f = 0; f < played.drives.size(); ++f) {
        const SolvedPose& pose = poses[first + f];
        if (!pose.figures.converged) continue;
        blendshapes::PlayedFrame& frame = frames.emplace_back();
        frame.weights = played.weights.row(played.simulated[f]).transpose();
        Points sum = Points::Zero(pose.moved.rows(), 3);
        rig.add_to(sum, frame.weights);
        frame.left = pose.moved - sum;
    }
    return frames;
}

}  // namespace

CorrectiveOptions correctives_of_set(const std::string& set) {
    CorrectiveOptions out;
    if (set != "facs") return out;
    out.pairs = 160;
    out.bent_pairs = true;
    out.budget_bytes = 4'000'000;
    out.most = 64;
    out.random_frames = 192;
    return out;
}

Correctives find_correctives(const scene::RigFiles& files, const MadeShapes& shapes,
                             const ShapeSolver& solver, const CorrectiveOptions& options,
                             const ScriptFrames& played, const ProgressMonitor& monitor) {
    const rig::Head& head = solver.face().head();
    const track::ChannelTable channels = files.rig.channels();
    const Eigen::VectorXd area =
        scene::vertex_areas(solver.face().surfaces().simulated_skin(), head.vertices);
    const std::vector<Unit> units = units_of(shapes, channels, head.vertices.rows());
    const std::vector<Candidate> candidates =
        candidates_of(units, shapes, area, options.pairs, played.weights);

    std::vector<track::Drive> drives;
    const track::Drive rest = no_drive(channels);
    for (const Candidate& one : candidates)
        drives.push_back(one.a == one.b
                             ? sum_of(rest, units[one.a].drive, 0.5, channels)
                             : sum_of(units[one.a].drive, units[one.b].drive, 1, channels));
    for (const track::Drive& drive : played.drives) drives.push_back(drive);
    // Fraction of the poses in the first pass, for the progress
    const double first = options.bent_pairs ? 0.4 : 0.6;
    std::vector<SolvedPose> poses =
        solver.solve(drives, monitor.subrange(0, first), {.again = false});

    Correctives out;
    for (const MadeShape& made : shapes.list) out.rig.shapes.push_back(made.shape);
    std::vector<Points> lacking;  // one per candidate; empty: no error, or unknown
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        const Unit &a = units[candidates[c].a], &b = units[candidates[c].b];
        const bool half = candidates[c].a == candidates[c].b;
        const Points sum = half ? Points(0.5 * a.field) : Points(a.field + b.field);
        TriedCorrective& tried = out.tried.emplace_back();
        tried.name = half ? a.name + "~half" : a.name + "*" + b.name;
        const blendshapes::FieldError error = blendshapes::error_between(poses[c].moved, sum, area);
        tried.max_m = error.max_m;
        tried.rms_m = error.rms_m;
        tried.at_rest = poses[c].figures.converged;
        tried.corrected = tried.at_rest && error.max_m >= options.tolerance_m;
        lacking.push_back(tried.corrected ? Points(poses[c].moved - sum) : Points());
    }

    const CloserLook closer =
        poses_closer_by(candidates, units, shapes, lacking, out.tried, options, channels);
    const std::vector<SolvedPose> near =
        solver.solve(closer.drives, monitor.subrange(first, 1), {.again = false});

    DriverMaker drivers(head, shapes, units, area);
    for (std::size_t c = 0; c < candidates.size(); ++c)
        if (const std::optional<std::size_t> way = closer.of[c].on_its_way;
            way && candidates[c].a == candidates[c].b)
            drivers.add_way(units[candidates[c].a], lacking[c], near[*way], near[*way + 1]);
    drivers.shapes_are_done();
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        const Candidate& one = candidates[c];
        if (lacking[c].size() == 0 || one.a == one.b) continue;
        const auto poses_from = [&](std::optional<std::size_t> at) {
            return at ? &near[*at] : nullptr;
        };
        drivers.add_pair(units[one.a], units[one.b], lacking[c],
                         {poses_from(closer.of[c].on_its_way), poses_from(closer.of[c].one_sided)});
    }

    const std::vector<blendshapes::PlayedFrame> frames =
        frames_left_to_explain(played, poses, candidates.size(), out.rig);
    const auto reduced = options.named ? blendshapes::one_of_each : blendshapes::low_rank;
    blendshapes::LowRank made =
        reduced(drivers.take(), frames, head.vertices, scene::seen_areas(solver.face()),
                {.fade = {0.5 * options.fade_m, 1.5 * options.fade_m},
                 .half_width_m = head.mm(kSharedStrip_mm),
                 .most = options.named ? kMostNamed : options.most,
                 .budget_bytes = options.budget_bytes});
    out.rig.drivers = std::move(made.drivers);
    out.rig.correctives = std::move(made.correctives);
    out.bytes = made.bytes;
    return out;
}

track::Drive drive_of_weights(const MadeShapes& shapes, const Eigen::VectorXd& weights,
                              const track::ChannelTable& channels) {
    track::Drive out = no_drive(channels);
    for (std::size_t s = 0; s < shapes.list.size(); ++s)
        if (const double w = weights[static_cast<long>(s)]; w != 0) {
            const int base = shapes.list[s].goal.on_top_of;
            out.excitation += w * shapes.list[s].goal.drive.excitation;
            // It was solved with the jaw of the shape below it, but without that shape's muscles.
            if (base >= 0)
                out.excitation -=
                    w * shapes.list[static_cast<std::size_t>(base)].goal.drive.excitation;
            for (std::size_t k = 0; k < out.kinematic.size(); ++k)
                out.kinematic[k] += w * shapes.list[s].goal.drive.kinematic[k];
        }
    return sum_of(no_drive(channels), out, 1, channels);
}

TrackError track_error(const std::string& name, const blendshapes::BlendShapeRig& rig,
                       const ShapeSolver& solver, const std::vector<track::Drive>& drives,
                       const std::vector<Eigen::VectorXd>& weights,
                       const ProgressMonitor& monitor) {
    const rig::Head& head = solver.face().head();
    const Eigen::VectorXd area =
        scene::vertex_areas(solver.face().surfaces().simulated_skin(), head.vertices);
    const std::vector<SolvedPose> poses = solver.solve(drives, monitor, {.again = false});
    blendshapes::BlendShapeRig plain{rig.shapes};
    TrackError out;
    out.name = name;
    out.frames = static_cast<int>(drives.size());
    const report::CoreStopwatch playing;
    for (const Eigen::VectorXd& frame : weights) {
        Points vertices = head.vertices;
        rig.add_to(vertices, frame);
    }
    out.play_s = playing.seconds() / static_cast<double>(std::max<std::size_t>(1, weights.size()));
    const auto add = [&](const blendshapes::BlendShapeRig& linear, std::size_t f, double& squares,
                         double& max) {
        const double before = max;
        Points moved = Points::Zero(head.vertices.rows(), 3);
        linear.add_to(moved, weights[f]);
        const blendshapes::FieldError error =
            blendshapes::error_between(moved, poses[f].moved, area);
        squares += error.rms_m * error.rms_m / static_cast<double>(drives.size());
        max = std::max(max, error.max_m);
        return max > before ? std::optional(error.where) : std::nullopt;
    };
    for (std::size_t f = 0; f < drives.size(); ++f) {
        if (const std::optional<long> where = add(rig, f, out.rms_m, out.max_m)) {
            out.worst = static_cast<int>(f);
            out.worst_vertex = *where;
        }
        add(plain, f, out.plain_rms_m, out.plain_max_m);
    }
    out.rms_m = std::sqrt(out.rms_m);
    out.plain_rms_m = std::sqrt(out.plain_rms_m);
    return out;
}

}  // namespace risorius::blendshapes
