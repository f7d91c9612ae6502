#include "app/shape_correctives.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "app/expression_score.h"
#include "app/stopwatch.h"
#include "shapes/corrective_choice.h"

namespace risorius::app {

namespace {

constexpr double kSharedStrip_mm = 15;  // of the middle of the face, as of halves
constexpr double kShares_m = 0.3e-3;    // skin that either of two shapes moves by more is shared

constexpr double kFadesWith = 0.05;  // of a shape's motion that another has too

// Mean squares of the weights of correctives, 4 w (1 - w) and w_a w_b, where those of shapes are anything from 0 to 1.
constexpr double kSquareOfHalf = 8.0 / 15.0, kSquareOfProduct = 1.0 / 9.0;
// A shape that is at work is on its way whatever else is there, while a given other one is there in a fifth of its frames
// (random weights, four of 52 at a time: less; faces that speak and feel: less for most pairs).
constexpr double kPairIsMet = 0.2;

constexpr long kPlayed = 24;  // frames that are simulated, of those that will be played

/// What is tried together: a shape, or both its halves.
struct Unit {
    std::string name;
    std::vector<int> parts;  ///< shapes; left and right when there are two
    track::Drive drive;
    Points field;  ///< V x 3, m
};

track::Drive sum_of(const track::Drive& one, const track::Drive& other, double weight,
                    const track::ChannelTable& channels) {
    track::Drive out = one;
    out.excitation =
        (one.excitation + weight * other.excitation).cwiseMin(1.0).cwiseMax(channels.column_min());
    for (std::size_t k = 0; k < out.kinematic.size(); ++k) {
        const track::KinematicChannel& channel = track::kinematic_channels()[k];
        out.kinematic[k] =
            std::clamp(one.kinematic[k] + weight * other.kinematic[k], channel.min, channel.max);
    }
    return out;
}

track::Drive no_drive(const track::ChannelTable& channels) {
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
    return drive;
}

std::vector<Unit> units_of(const MadeShapes& shapes, const track::ChannelTable& channels,
                           long vertices) {
    std::vector<Unit> out;
    for (std::size_t i = 0; i < shapes.list.size(); ++i) {
        const ShapeGoal& goal = shapes.list[i].goal;
        // Its like is solved with what it lies on already; a right half comes with the left one
        if (goal.on_top_of >= 0 || (goal.sides == Sides::kHalves && !goal.left)) continue;
        Unit unit{
            goal.whole, {static_cast<int>(i)}, goal.drive, shapes.list[i].shape.dense(vertices)};
        if (goal.sides == Sides::kHalves) {
            const auto other = static_cast<std::size_t>(goal.partner);
            unit.parts.push_back(goal.partner);
            unit.drive = sum_of(goal.drive, shapes.list[other].goal.drive, 1, channels);
            shapes.list[other].shape.add_to(unit.field, 1);
        }
        if (!unit.field.isZero(0.0)) out.push_back(std::move(unit));
    }
    return out;
}

struct Candidate {
    std::size_t a, b;  ///< units; the same one: half of it
    double shared = 0;
};

/// How far two units are there at once in any frame: the greatest square of the product of their weights. Once is enough to be
/// seen, so that a rare pair counts like one that is always there.
double met(const Unit& a, const Unit& b, const Eigen::MatrixXd& played) {
    if (played.rows() == 0) return 0;
    double most = 0;
    for (const int i : a.parts)
        for (const int j : b.parts)
            most = std::max(most, played.col(i).cwiseProduct(played.col(j)).maxCoeff());
    return most * most;
}

std::vector<Candidate> candidates_of(const std::vector<Unit>& units, const MadeShapes& shapes,
                                     const Eigen::VectorXd& area, int pairs,
                                     const Eigen::MatrixXd& played) {
    std::vector<Eigen::VectorXd> moved;
    for (const Unit& unit : units) moved.push_back(unit.field.rowwise().norm());
    std::vector<Candidate> out;
    for (std::size_t a = 0; a < units.size(); ++a)
        for (std::size_t b = a + 1; b < units.size(); ++b) {
            const ShapeGoal& goal = shapes.list[static_cast<std::size_t>(units[a].parts[0])].goal;
            if (goal.sides == Sides::kOpposed && goal.partner == units[b].parts[0]) continue;
            double shared = 0;
            for (long v = 0; v < area.size(); ++v)
                if (moved[a][v] > kShares_m && moved[b][v] > kShares_m)
                    shared += area[v] * std::min(moved[a][v], moved[b][v]);
            shared *= kPairIsMet * kSquareOfProduct + met(units[a], units[b], played);
            if (shared > 0) out.push_back({a, b, shared});
        }
    std::stable_sort(out.begin(), out.end(),
                     [](const Candidate& x, const Candidate& y) { return x.shared > y.shared; });
    if (static_cast<int>(out.size()) > pairs) out.resize(static_cast<std::size_t>(pairs));
    for (std::size_t a = 0; a < units.size(); ++a) out.push_back({a, a, 0});
    return out;
}

// A position of 16-bit numbers and a normal of floats with an index each; every other normal turns too little to be written.
long bytes_of(const shapes::SparseShape& shape) {
    return static_cast<long>(shape.vertex.size()) * 15;
}

}  // namespace

std::string weight_rule(const shapes::Corrective& corrective) {
    if (corrective.drivers.size() > 1) return "product";
    return corrective.fades_with.empty() ? "4 w (1 - w)"
                                         : "4 w (1 - w) product of (1 - fades_with)";
}

Correctives find_correctives(const RigFiles& files, const MadeShapes& shapes,
                             const ShapeSolver& solver, const CorrectiveOptions& options,
                             const PlayedFrames& played, const Watch& watch) {
    const rig::Head& head = solver.face().head();
    const track::ChannelTable channels = files.rig.channels();
    const Eigen::VectorXd area = vertex_areas(solver.face().simulated_skin(), head.vertices);
    const std::vector<Unit> units = units_of(shapes, channels, head.vertices.rows());
    const std::vector<Candidate> candidates =
        candidates_of(units, shapes, area, options.pairs, played.weights);

    std::vector<track::Drive> drives;
    const track::Drive rest = no_drive(channels);
    for (const Candidate& one : candidates)
        drives.push_back(one.a == one.b
                             ? sum_of(rest, units[one.a].drive, 0.5, channels)
                             : sum_of(units[one.a].drive, units[one.b].drive, 1, channels));
    // From the first one on, those between the frames that a track is compared at
    std::vector<long> frames;
    for (long i = 0; i < std::min(kPlayed, played.weights.rows()); ++i) {
        frames.push_back(i * played.weights.rows() / std::min(kPlayed, played.weights.rows()));
        drives.push_back(played.drives[static_cast<std::size_t>(frames.back())]);
    }
    const std::vector<SolvedPose> poses = solver.solve(drives, watch, {.again = false});

    // Which others move skin that this one moves
    std::vector<Eigen::VectorXd> moved;
    for (const Unit& unit : units) moved.push_back(unit.field.rowwise().norm());
    const auto sharing = [&](std::size_t unit) {
        std::vector<std::size_t> others;
        for (std::size_t other = 0; other < units.size(); ++other)
            if (other != unit &&
                area.dot(moved[unit].cwiseMin(moved[other])) > kFadesWith * area.dot(moved[unit]))
                others.push_back(other);
        return others;
    };

    Correctives out;
    for (const MadeShape& made : shapes.list) out.rig.shapes.push_back(made.shape);
    std::vector<shapes::OfferedCorrective> found;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        const Unit &a = units[candidates[c].a], &b = units[candidates[c].b];
        const bool half = candidates[c].a == candidates[c].b;
        const Points sum = half ? Points(0.5 * a.field) : Points(a.field + b.field);
        TriedCorrective& tried = out.tried.emplace_back();
        tried.name = half ? a.name + "~half" : a.name + "*" + b.name;
        Points missing = poses[c].moved - sum;
        const shapes::FieldError error = shapes::error_between(poses[c].moved, sum, area);
        tried.greatest_m = error.greatest_m;
        tried.rms_m = error.rms_m;
        tried.at_rest = poses[c].figures.converged;
        if (!tried.at_rest || error.greatest_m < options.tolerance_m) continue;
        shapes::fade_out(missing, {0.5 * options.fade_m, 1.5 * options.fade_m});
        const auto add = [&](const Points& field, std::vector<int> drivers,
                             std::vector<int> fades_with = {}, const std::string& ending = "") {
            shapes::OfferedCorrective one;
            one.corrective.shape = shapes::sparse(field);
            if (one.corrective.shape.empty()) return;
            std::sort(drivers.begin(), drivers.end());
            for (const int driver : drivers)
                one.corrective.name += (one.corrective.name.empty() ? "" : "*") +
                                       shapes.list[static_cast<std::size_t>(driver)].goal.name;
            if (half) one.corrective.name += "~half" + ending;
            one.corrective.drivers = std::move(drivers);
            one.corrective.fades_with = std::move(fades_with);
            one.use = (half ? kSquareOfHalf : kPairIsMet * kSquareOfProduct) *
                      (area.asDiagonal() * field).cwiseProduct(field).sum();
            one.bytes = bytes_of(one.corrective.shape);
            one.group = c;
            found.push_back(std::move(one));
        };
        const std::vector<std::size_t> others =
            half ? sharing(candidates[c].a) : std::vector<std::size_t>{};
        const bool sided = std::any_of(others.begin(), others.end(), [&](std::size_t other) {
            return units[other].parts.size() > 1;
        });
        if (a.parts.size() == 1 && b.parts.size() == 1 && !sided) {
            std::vector<int> fades_with;
            for (const std::size_t other : others) fades_with.push_back(units[other].parts[0]);
            add(missing,
                half ? std::vector<int>{a.parts[0]} : std::vector<int>{a.parts[0], b.parts[0]},
                std::move(fades_with));
            continue;
        }
        const auto [left, right] =
            shapes::left_and_right(head.vertices, missing, head.mm(kSharedStrip_mm));
        const auto driver = [](const Unit& unit, std::size_t side) {
            return unit.parts.size() == 1 ? unit.parts[0] : unit.parts[side];
        };
        for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
            const Points& field = side == 0 ? left : right;
            if (!half) {
                add(field, {driver(a, side), driver(b, side)});
                continue;
            }
            std::vector<int> fades_with;
            for (const std::size_t other : others) fades_with.push_back(driver(units[other], side));
            const char* ending = side == 0 ? "~left" : "~right";
            add(field, {driver(a, side)}, std::move(fades_with), a.parts.size() > 1 ? "" : ending);
        }
    }
    std::vector<shapes::PlayedFrame> left;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const SolvedPose& pose = poses[candidates.size() + f];
        if (!pose.figures.converged) continue;
        shapes::PlayedFrame& frame = left.emplace_back();
        frame.weights = played.weights.row(frames[f]).transpose();
        Points sum = Points::Zero(head.vertices.rows(), 3);
        out.rig.add_to(sum, frame.weights);
        frame.left = pose.moved - sum;
    }
    for (const std::size_t i :
         shapes::choose_correctives(found, std::move(left), area, options.budget_bytes)) {
        out.tried[found[i].group].kept = true;
        out.bytes += found[i].bytes;
        out.rig.correctives.push_back(std::move(found[i].corrective));
    }
    return out;
}

std::vector<Eigen::VectorXd> random_weights(const MadeShapes& shapes, int frames, unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    constexpr int kAtATime = 4;
    std::vector<Eigen::VectorXd> out;
    for (int f = 0; f < frames; ++f) {
        Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<long>(shapes.list.size()));
        for (int n = 0; n < kAtATime; ++n) {
            const auto i =
                static_cast<std::size_t>(uniform() * static_cast<double>(shapes.list.size()));
            const ShapeGoal& goal = shapes.list[i].goal;
            const double weight = shapes.list[i].solved_at * uniform();
            const bool both = uniform() < 0.7;  // faces are more often alike on both sides than not
            if (goal.sides == Sides::kOpposed && weights[goal.partner] != 0) continue;
            weights[static_cast<long>(i)] = weight;
            if (goal.sides == Sides::kHalves && both) weights[goal.partner] = weight;
            // What shuts lips over an open jaw goes as far as the jaw
            if (goal.on_top_of >= 0)
                weights[goal.on_top_of] = std::max(weights[goal.on_top_of], weight);
        }
        out.push_back(std::move(weights));
    }
    return out;
}

track::Drive drive_of_weights(const MadeShapes& shapes, const Eigen::VectorXd& weights,
                              const track::ChannelTable& channels) {
    track::Drive out = no_drive(channels);
    for (std::size_t s = 0; s < shapes.list.size(); ++s)
        if (const double w = weights[static_cast<long>(s)]; w != 0) {
            const int base = shapes.list[s].goal.on_top_of;
            out.excitation += w * shapes.list[s].goal.drive.excitation;
            // It was solved over the jaw of what it lies on, without the muscles of that
            if (base >= 0)
                out.excitation -=
                    w * shapes.list[static_cast<std::size_t>(base)].goal.drive.excitation;
            for (std::size_t k = 0; k < out.kinematic.size(); ++k)
                out.kinematic[k] += w * shapes.list[s].goal.drive.kinematic[k];
        }
    return sum_of(no_drive(channels), out, 1, channels);
}

TrackError track_error(const std::string& name, const shapes::LinearRig& rig,
                       const ShapeSolver& solver, const std::vector<track::Drive>& drives,
                       const std::vector<Eigen::VectorXd>& weights, const Watch& watch) {
    const rig::Head& head = solver.face().head();
    const Eigen::VectorXd area = vertex_areas(solver.face().simulated_skin(), head.vertices);
    const std::vector<SolvedPose> poses = solver.solve(drives, watch, {.again = false});
    shapes::LinearRig plain{rig.shapes, {}};
    TrackError out;
    out.name = name;
    out.frames = static_cast<int>(drives.size());
    const CoreStopwatch playing;
    for (const Eigen::VectorXd& frame : weights) {
        Points vertices = head.vertices;
        rig.add_to(vertices, frame);
    }
    out.play_s = playing.seconds() / static_cast<double>(std::max<std::size_t>(1, weights.size()));
    const auto add = [&](const shapes::LinearRig& linear, std::size_t f, double& squares,
                         double& greatest) {
        const double before = greatest;
        Points moved = Points::Zero(head.vertices.rows(), 3);
        linear.add_to(moved, weights[f]);
        const shapes::FieldError error = shapes::error_between(moved, poses[f].moved, area);
        squares += error.rms_m * error.rms_m / static_cast<double>(drives.size());
        greatest = std::max(greatest, error.greatest_m);
        return greatest > before ? std::optional(error.where) : std::nullopt;
    };
    for (std::size_t f = 0; f < drives.size(); ++f) {
        if (const std::optional<long> where = add(rig, f, out.rms_m, out.greatest_m)) {
            out.worst = static_cast<int>(f);
            out.worst_vertex = *where;
        }
        add(plain, f, out.plain_rms_m, out.plain_greatest_m);
    }
    out.rms_m = std::sqrt(out.rms_m);
    out.plain_rms_m = std::sqrt(out.plain_rms_m);
    return out;
}

}  // namespace risorius::app
