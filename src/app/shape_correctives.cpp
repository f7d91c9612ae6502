#include "app/shape_correctives.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/expression_score.h"
#include "app/stopwatch.h"
#include "shapes/low_rank.h"

namespace risorius::app {

namespace {

constexpr double kSharedStrip_mm = 15;  // of the middle of the face, as of halves
constexpr double kShares_m = 0.3e-3;    // skin that either of two shapes moves by more is shared

constexpr double kFadesWith = 0.05;  // of a shape's motion that another has too

// Mean squares of terms, of a part of a shape's way (the mean of 36 w^4 (1 - w)^4) and w_a w_b, where weights are anything from 0 to 1.
// and what w^2 (1 - w)^2 is of w^2.
constexpr double kSquareOfPart = 2.0 / 35.0, kSquareOfProduct = 1.0 / 9.0, kSquareOfFading = 0.1;
constexpr double kBentPair_m = 1e-3;  // pairs whose sum errs by more are looked at on their way
// A shape that is at work is on its way whatever else is there, while a given other one is there in a fifth of its frames
// (random weights, four of 52 at a time: less; faces that speak and feel: less for most pairs).
constexpr double kPairIsMet = 0.2;

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

// What a shape lacks a quarter, a half and three quarters of its way, as parts of it (shapes/linear_rig.h).
std::array<Points, 3> parts_of_way(const std::array<const Points*, 3>& lacking) {
    Eigen::Matrix3d values;
    for (int at = 0; at < 3; ++at)
        for (int part = 1; part <= 3; ++part)
            values(at, part - 1) =
                shapes::Term{"", {0}, part}.value(Eigen::VectorXd::Constant(1, 0.25 * (at + 1)));
    const Eigen::Matrix3d inverse = values.inverse();
    std::array<Points, 3> out;
    for (int part = 0; part < 3; ++part) {
        out[static_cast<std::size_t>(part)] = inverse(part, 0) * *lacking[0];
        for (std::size_t at : {std::size_t{1}, std::size_t{2}})
            out[static_cast<std::size_t>(part)] +=
                inverse(part, static_cast<int>(at)) * *lacking[at];
    }
    return out;
}

// Of pairs that are looked at on their way: the weights of both, and of which of the factors (1 - a), (1 - b) each puts a term right.
struct PairOnItsWay {
    double a, b;
    bool fades_with_a, fades_with_b;
};
constexpr std::array<PairOnItsWay, 3> kPairsOnTheirWay{
    {{0.5, 1.0, true, false}, {1.0, 0.5, false, true}, {0.5, 0.5, true, true}}};

/// Makes terms of what shapes and pairs lack, a left and a right one where they have sides.
class TermMaker {
  public:
    TermMaker(const rig::Head& head, const MadeShapes& shapes, const std::vector<Unit>& units,
              const Eigen::VectorXd& area)
        : head_(head), shapes_(shapes), units_(units), area_(area) {
        for (const Unit& unit : units) moved_.push_back(unit.field.rowwise().norm());
    }

    /// What a shape lacks half way, and its poses a quarter and three quarters of the way.
    void add_way(const Unit& unit, const Points& lacks, const SolvedPose& quarter,
                 const SolvedPose& three_quarters) {
        // A pose that did not come to rest: as if it went there in an even bend
        const auto lacking_at = [&](const SolvedPose& pose, double weight) {
            return pose.figures.converged ? Points(pose.moved - weight * unit.field)
                                          : Points(0.75 * lacks);
        };
        const Points first = lacking_at(quarter, 0.25), last = lacking_at(three_quarters, 0.75);
        const std::array<Points, 3> parts = parts_of_way({&first, &lacks, &last});
        const std::vector<std::size_t> others = sharing(unit);
        const bool of_two = unit.parts.size() > 1,
                   sided =
                       of_two || std::any_of(others.begin(), others.end(), [&](std::size_t other) {
                           return units_[other].parts.size() > 1;
                       });
        for (int part = 1; part <= 3; ++part)
            add(
                parts[static_cast<std::size_t>(part - 1)], sided,
                [&](std::size_t side) {
                    shapes::Term out{"", {driver(unit, side)}, part};
                    for (const std::size_t other : others)
                        out.fades_with.push_back(driver(units_[other], side));
                    return out;
                },
                sided && !of_two ? std::array{"left", "right"} : std::array{"", ""});
    }

    /// From here on pairs, which lack what is left by the shapes' own ways.
    void shapes_are_done() { of_shapes_ = terms_.size(); }

    /// What a pair lacks where both are whole, and its poses on its way, as many as kPairsOnTheirWay, if it was looked at there.
    void add_pair(const Unit& a, const Unit& b, const Points& lacks, const SolvedPose* on_its_way) {
        // Of a b, a b (1 - a), a b (1 - b) and a b (1 - a) (1 - b)
        std::array<Points, 4> field;
        field[0] = lacks;
        for (std::size_t k = 0; on_its_way && k < kPairsOnTheirWay.size(); ++k) {
            if (!on_its_way[k].figures.converged) continue;
            const PairOnItsWay& at = kPairsOnTheirWay[k];
            Points& missing = field[k + 1];
            missing = on_its_way[k].moved - at.a * a.field - at.b * b.field - at.a * at.b * lacks;
            Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<long>(shapes_.list.size()));
            for (const int part : a.parts) weights[part] = at.a;
            for (const int part : b.parts) weights[part] = at.b;
            for (std::size_t t = 0; t < of_shapes_; ++t)
                if (const double value = terms_[t].term.value(weights); value != 0)
                    missing -= value * terms_[t].field;
            if (k == 2)
                for (const std::size_t before : {std::size_t{1}, std::size_t{2}})
                    if (field[before].size() > 0) missing -= 0.125 * field[before];
            missing *= k == 2 ? 16 : 4;
        }
        const bool sided = a.parts.size() > 1 || b.parts.size() > 1;
        for (std::size_t k = 0; k < field.size(); ++k) {
            if (field[k].size() == 0) continue;
            const std::string ending = k == 0 ? "" : "~" + std::to_string(k);
            add(
                field[k], sided,
                [&](std::size_t side) {
                    shapes::Term out{"", {driver(a, side), driver(b, side)}};
                    if (k > 0 && kPairsOnTheirWay[k - 1].fades_with_a)
                        out.fades_with.push_back(driver(a, side));
                    if (k > 0 && kPairsOnTheirWay[k - 1].fades_with_b)
                        out.fades_with.push_back(driver(b, side));
                    return out;
                },
                std::array{ending.c_str(), ending.c_str()});
        }
    }

    std::vector<shapes::TermField> take() { return std::move(terms_); }

  private:
    static int driver(const Unit& unit, std::size_t side) {
        return unit.parts.size() == 1 ? unit.parts[0] : unit.parts[side];
    }
    // Others that move skin that this one moves
    std::vector<std::size_t> sharing(const Unit& unit) const {
        const Eigen::VectorXd& own = moved_[static_cast<std::size_t>(&unit - units_.data())];
        std::vector<std::size_t> others;
        for (std::size_t other = 0; other < units_.size(); ++other)
            if (&units_[other] != &unit &&
                area_.dot(own.cwiseMin(moved_[other])) > kFadesWith * area_.dot(own))
                others.push_back(other);
        return others;
    }
    template <class TermOfSide>
    void add(const Points& field, bool sided, const TermOfSide& term,
             const std::array<const char*, 2>& endings) {
        if (!sided) {
            add(field, term(0), endings[0]);
            return;
        }
        const auto [left, right] =
            shapes::left_and_right(head_.vertices, field, head_.mm(kSharedStrip_mm));
        add(left, term(0), endings[0]);
        add(right, term(1), endings[1]);
    }
    void add(const Points& field, shapes::Term term, const std::string& ending) {
        if (field.isZero(0.0)) return;
        std::sort(term.drivers.begin(), term.drivers.end());
        for (const int i : term.drivers)
            term.name += (term.name.empty() ? "" : "*") +
                         shapes_.list[static_cast<std::size_t>(i)].goal.name;
        const bool single = term.drivers.size() == 1;
        term.name += (single ? "~" + std::to_string(term.part) : "") + ending;
        double use = single ? kSquareOfPart : kPairIsMet * kSquareOfProduct;
        for (std::size_t k = 0; !single && k < term.fades_with.size(); ++k) use *= kSquareOfFading;
        terms_.push_back({std::move(term), field, use});
    }

    const rig::Head& head_;
    const MadeShapes& shapes_;
    const std::vector<Unit>& units_;
    const Eigen::VectorXd& area_;
    std::vector<Eigen::VectorXd> moved_;  // of each unit, by each vertex
    std::vector<shapes::TermField> terms_;
    std::size_t of_shapes_ = 0;
};

}  // namespace

CorrectiveOptions correctives_of_set(const std::string& set) {
    CorrectiveOptions out;
    if (set != "facs") return out;
    out.pairs = 160;
    out.bent_pairs = true;
    out.budget_bytes = 2'000'000;
    out.random_frames = 192;
    return out;
}

std::string weight_rule(const shapes::Term& term) {
    if (term.drivers.size() > 1) return "product";
    static const std::array<const char*, 3> kRules{"4 w (1 - w)^3", "6 w^2 (1 - w)^2",
                                                   "4 w^3 (1 - w)"};
    return kRules.at(static_cast<std::size_t>(term.part - 1));
}

Correctives find_correctives(const RigFiles& files, const MadeShapes& shapes,
                             const ShapeSolver& solver, const CorrectiveOptions& options,
                             const ScriptFrames& played, const Watch& watch) {
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
    for (const track::Drive& drive : played.drives) drives.push_back(drive);
    std::vector<SolvedPose> poses = solver.solve(drives, watch.part(0, 0.6), {.again = false});

    Correctives out;
    for (const MadeShape& made : shapes.list) out.rig.shapes.push_back(made.shape);
    std::vector<Points> lacking;  // of each candidate; empty: nothing to put right, or not known
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        const Unit &a = units[candidates[c].a], &b = units[candidates[c].b];
        const bool half = candidates[c].a == candidates[c].b;
        const Points sum = half ? Points(0.5 * a.field) : Points(a.field + b.field);
        TriedCorrective& tried = out.tried.emplace_back();
        tried.name = half ? a.name + "~half" : a.name + "*" + b.name;
        const shapes::FieldError error = shapes::error_between(poses[c].moved, sum, area);
        tried.greatest_m = error.greatest_m;
        tried.rms_m = error.rms_m;
        tried.at_rest = poses[c].figures.converged;
        tried.kept = tried.at_rest && error.greatest_m >= options.tolerance_m;
        lacking.push_back(tried.kept ? Points(poses[c].moved - sum) : Points());
    }

    // Those that go round a corner, on their way: shapes a quarter and three quarters of it, pairs where either or both are half way
    std::vector<std::size_t> ways;  // candidates, of each pose
    drives.clear();
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        if (lacking[c].size() == 0) continue;
        const Unit &a = units[candidates[c].a], &b = units[candidates[c].b];
        if (candidates[c].a == candidates[c].b) {
            for (const double weight : {0.25, 0.75}) {
                ways.push_back(c);
                drives.push_back(sum_of(rest, a.drive, weight, channels));
            }
        } else if (options.bent_pairs && out.tried[c].greatest_m >= kBentPair_m) {
            for (const PairOnItsWay& at : kPairsOnTheirWay) {
                ways.push_back(c);
                drives.push_back(
                    sum_of(sum_of(rest, a.drive, at.a, channels), b.drive, at.b, channels));
            }
        }
    }
    const std::vector<SolvedPose> on_the_way =
        solver.solve(drives, watch.part(0.6, 1), {.again = false});

    TermMaker terms(head, shapes, units, area);
    for (std::size_t w = 0; w < ways.size(); ++w)
        if (const Candidate& one = candidates[ways[w]]; one.a == one.b) {
            terms.add_way(units[one.a], lacking[ways[w]], on_the_way[w], on_the_way[w + 1]);
            ++w;  // both quarters are done
        }
    terms.shapes_are_done();
    for (std::size_t c = 0, w = 0; c < candidates.size(); ++c) {
        while (w < ways.size() && ways[w] < c) ++w;
        const Candidate& one = candidates[c];
        if (lacking[c].size() == 0 || one.a == one.b) continue;
        const bool looked_at = w < ways.size() && ways[w] == c;
        terms.add_pair(units[one.a], units[one.b], lacking[c],
                       looked_at ? &on_the_way[w] : nullptr);
    }

    std::vector<shapes::PlayedFrame> frames;
    for (std::size_t f = 0; f < played.drives.size(); ++f) {
        const SolvedPose& pose = poses[candidates.size() + f];
        if (!pose.figures.converged) continue;
        shapes::PlayedFrame& frame = frames.emplace_back();
        frame.weights = played.weights.row(played.simulated[f]).transpose();
        Points sum = Points::Zero(head.vertices.rows(), 3);
        out.rig.add_to(sum, frame.weights);
        frame.left = pose.moved - sum;
    }
    shapes::LowRank made =
        shapes::low_rank(terms.take(), frames, head.vertices, seen_areas(solver.face()),
                         {.fade = {0.5 * options.fade_m, 1.5 * options.fade_m},
                          .half_width_m = head.mm(kSharedStrip_mm),
                          .budget_bytes = options.budget_bytes});
    out.rig.terms = std::move(made.terms);
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
    shapes::LinearRig plain{rig.shapes};
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
