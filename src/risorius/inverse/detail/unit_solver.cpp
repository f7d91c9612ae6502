// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/unit_solver.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "risorius/blendshapes/shape_player.h"
#include "risorius/face/statics.h"
#include "risorius/motion/reduce_keys.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/solve/box_quadratic.h"

namespace risorius::inverse {

namespace {

using blendshapes::ShapeGoal;
using track::Kinematic;

constexpr double kRidge = 1e-6;  // of the squared weights, relative to the squares of the target
constexpr double kPrice =
    4e-4;  // of a weight of 1 while units are sought; that of muscles is larger
constexpr double kMusclePrice = 4;     // relative to units
constexpr double kSmallPrice = 1e-5;   // of those that are kept
constexpr double kLeastWeight = 0.03;  // what stays below is left out
constexpr double kStill =
    1e-4;  // a frame with smaller squares, relative to the largest, is at rest
constexpr double kLongestStep = 0.4, kShortestStep = 0.02;
constexpr double kSecant = 0.1;      // change of a weight over which its effect is taken
constexpr double kKeep = 2e-4;       // of squared differences from the weights that are expected
constexpr double kLeastGain = 0.02;  // of the cost in a round; with less the search ends
constexpr int kSeekingRounds = 6, kKeptRounds = 3;

/// A unit or muscle: one side, or both.
struct Candidate {
    std::string name;
    std::vector<std::size_t> goals;
    bool is_unit = true;
};

/// What a unit or a muscle of one side adds to the drive.
struct Source {
    std::string name;
    track::Expansion drives;  ///< at 1
    track::UnitCurves curve;
};

/// A face in equilibrium, and how it changes with the weights.
struct State {
    Eigen::VectorXd weight;  ///< by source
    Eigen::VectorXd moved;   ///< weighted displacement of the points
    Eigen::MatrixXd way;  ///< change of `moved` per weight, one column per source; empty: unknown
};

/// The value of keys at a time, linear between them.
double value_at(const std::vector<track::Key>& keys, double t_s) {
    const auto next = std::find_if(keys.begin(), keys.end(),
                                   [&](const track::Key& key) { return key.time_s >= t_s; });
    if (next == keys.begin()) return keys.front().value;
    if (next == keys.end()) return keys.back().value;
    const track::Key &from = *(next - 1), &to = *next;
    return from.value + (to.value - from.value) * (t_s - from.time_s) / (to.time_s - from.time_s);
}

class UnitSolver {
  public:
    UnitSolver(face::Face& face, const scene::RigFiles& files, const FitTarget& given,
               const UnitSolveOptions& options)
        : face_(face), files_(files), channels_(files.rig.channels()), options_(options) {
        for (long v = 0; v < given.weight.size(); ++v)
            if (given.weight[v] > 0) vertex_.push_back(static_cast<int>(v));
        root_.resize(static_cast<long>(vertex_.size()));
        for (std::size_t i = 0; i < vertex_.size(); ++i)
            root_[static_cast<long>(i)] = std::sqrt(given.weight[vertex_[i]]);
        target_.resize(3 * root_.size(), static_cast<long>(given.fields.size()));
        for (std::size_t t = 0; t < given.fields.size(); ++t)
            target_.col(static_cast<long>(t)) = weighted(given.fields[t]);
        size_ = target_.colwise().squaredNorm().maxCoeff(&peak_);
        add_sources("facs", true);
        add_sources("muscles", false);
    }

    UnitSolution solve(const std::vector<double>& times_s, const ProgressMonitor& monitor) {
        UnitSolution out;
        if (!(size_ > 0)) return out;
        track::Drive rest;
        rest.excitation = Eigen::VectorXd::Zero(channels_.column_count());
        face_.start([&](double) { return rest; });
        State top = choose(monitor);
        const std::vector<long> frames = frames_to_simulate();
        std::vector<State> states;
        for (std::size_t k = 0; k < frames.size(); ++k) {
            monitor.report(0.5 + 0.4 * static_cast<double>(k) / static_cast<double>(frames.size()),
                           "units");
            const auto goal = target_.col(frames[k]);
            const double share = std::clamp(goal.dot(target_.col(peak_)) / size_, 0.0, 1.0);
            const Eigen::VectorXd expected = share * top.weight;
            states.push_back(frames[k] == peak_ ? top : state_at(expected));
            if (frames[k] != peak_ && goal.squaredNorm() > kStill * size_)
                improve(states.back(), goal, kKeptRounds, prices(kSmallPrice), &expected);
            find_ways(states.back());
            ways_.push_back(states.back().way);
        }
        weight_ = Eigen::MatrixXd::Zero(static_cast<long>(sources_.size()), target_.cols());
        for (long t = 0; t < target_.cols(); ++t) fit_between(frames, states, times_s, t);
        out.curves = curves(times_s);
        for (std::size_t k = 0; k < frames.size(); ++k)  // as it is written
            states[k].moved +=
                state_at(weight_.col(frames[k])).moved - model(states[k], weight_.col(frames[k]));
        out.simulated.assign(static_cast<std::size_t>(target_.cols()), false);
        for (const long f : frames) out.simulated[static_cast<std::size_t>(f)] = true;
        const double whole = root_.squaredNorm();
        for (long t = 0; t < target_.cols(); ++t) {
            const auto [before, after, share] = neighbours(frames, times_s, t);
            const Eigen::VectorXd left = (1 - share) * model(states[before], weight_.col(t)) +
                                         share * model(states[after], weight_.col(t)) -
                                         target_.col(t);
            out.rms_m.push_back(left.norm() / std::sqrt(whole));
            double max = 0;
            for (long i = 0; i < root_.size(); ++i)
                max = std::max(max, left.segment<3>(3 * i).norm() / root_[i]);
            out.max_m.push_back(max);
            out.drives.push_back(drive_of(weight_.col(t)));
        }
        return out;
    }

  private:
    Eigen::VectorXd weighted(const Points& field) const {
        Eigen::VectorXd out(3 * root_.size());
        for (long i = 0; i < root_.size(); ++i)
            out.segment<3>(3 * i) =
                root_[i] * field.row(vertex_[static_cast<std::size_t>(i)]).transpose();
        return out;
    }

    void add_sources(const std::string& set, bool units) {
        const blendshapes::ShapeSet found =
            blendshapes::shape_set(files_.rig, set, {}, files_.place());
        for (const ShapeGoal& goal : found.goals) {
            const auto moves = [&](Kinematic k) { return goal.drive.at(k) != 0; };
            if ((!options_.pressure && moves(Kinematic::kMouthPressure)) ||
                (!options_.tongue && (moves(Kinematic::kTongueOut) || moves(Kinematic::kTongueUp))))
                continue;
            // Jaw and gaze alone are no muscles, and a muscle that relaxes is no channel.
            const bool alone = std::any_of(goal.drive.kinematic.begin(), goal.drive.kinematic.end(),
                                           [](double value) { return value != 0; }) ||
                               goal.drive.excitation.minCoeff() < 0;
            if (!units && alone) continue;
            const bool halves = goal.sides == blendshapes::Sides::kHalves;
            const std::string name = halves ? goal.whole : goal.name;
            auto known = std::find_if(candidates_.begin(), candidates_.end(), [&](const auto& one) {
                return one.is_unit == units && one.name == name;
            });
            if (known == candidates_.end())
                known = candidates_.insert(candidates_.end(), Candidate{name, {}, units});
            known->goals.push_back(sources_.size());
            const track::ActionUnit* const unit =
                units ? files_.rig.facs.find(track::split_side(goal.name).id) : nullptr;
            sources_.push_back({goal.name,
                                {goal.drive.excitation, goal.drive.kinematic},
                                unit ? unit->curve : track::UnitCurves{}});
            active_.push_back(units);
        }
    }

    track::Drive drive_of(const Eigen::VectorXd& weights) const {
        track::Expansion sum = track::Expansion::none(channels_);
        for (std::size_t s = 0; s < sources_.size(); ++s)
            if (const double w = weights[static_cast<long>(s)]; w > 0)
                sum.add(sources_[s].drives, sources_[s].curve, w);
        return rig::clamped_drive(sum, channels_);
    }

    State state_at(const Eigen::VectorXd& weights) const {
        const track::Drive drive = drive_of(weights);
        face_.solve_equilibrium(drive.excitation, drive, options_.rest);
        if (options_.rest.stopped && options_.rest.stopped()) throw Interrupted();
        return {weights, weighted(face_.pose().vertices - face_.head().vertices), {}};
    }

    /// What a source adds per change of its weight.
    track::Expansion change_of(std::size_t source, double weight) const {
        const double step = weight + kSecant <= 1 ? kSecant : -kSecant;
        track::Expansion out = track::Expansion::none(channels_), before = out;
        out.add(sources_[source].drives, sources_[source].curve, weight + step);
        before.add(sources_[source].drives, sources_[source].curve, weight);
        out.add(before, -1);
        out.excitation /= step;
        for (double& value : out.kinematic) value /= step;
        return out;
    }

    /// Fills in the ways of the active sources. The face has to be in this state.
    void find_ways(State& state) const {
        if (state.way.size() > 0) return;
        std::vector<track::Expansion> changes(sources_.size());
        std::set<int> columns;
        std::set<Kinematic> channels;
        for (std::size_t s = 0; s < sources_.size(); ++s) {
            if (!active_[s]) continue;
            changes[s] = change_of(s, state.weight[static_cast<long>(s)]);
            for (long c = 0; c < changes[s].excitation.size(); ++c)
                if (changes[s].excitation[c] != 0) columns.insert(static_cast<int>(c));
            for (std::size_t k = 0; k < changes[s].kinematic.size(); ++k)
                if (changes[s].kinematic[k] != 0) channels.insert(static_cast<Kinematic>(k));
        }
        const std::vector<int> column_list(columns.begin(), columns.end());
        const std::vector<Kinematic> channel_list(channels.begin(), channels.end());
        std::vector<Eigen::VectorXd> moved;
        for (const Points& one : face_.statics().sensitivities(column_list, channel_list))
            moved.push_back(weighted(one));
        state.way = Eigen::MatrixXd::Zero(target_.rows(), static_cast<long>(sources_.size()));
        for (std::size_t s = 0; s < sources_.size(); ++s) {
            if (!active_[s]) continue;
            auto way = state.way.col(static_cast<long>(s));
            for (std::size_t i = 0; i < column_list.size(); ++i)
                way += changes[s].excitation[column_list[i]] * moved[i];
            for (std::size_t i = 0; i < channel_list.size(); ++i)
                way += changes[s].kinematic[static_cast<std::size_t>(channel_list[i])] *
                       moved[column_list.size() + i];
        }
    }

    Eigen::VectorXd model(const State& state, const Eigen::VectorXd& weights) const {
        return state.moved + state.way * (weights - state.weight);
    }

    Eigen::VectorXd prices(double of_units) const {
        Eigen::VectorXd out(static_cast<long>(sources_.size()));
        for (const Candidate& one : candidates_)
            for (const std::size_t s : one.goals)
                out[static_cast<long>(s)] = (one.is_unit ? 1 : kMusclePrice) * of_units;
        return out;
    }

    /// Weights that reproduce `goal` best where the displacement is `moved` + `way` (weights - `at`).
    Eigen::VectorXd fitted(const Eigen::VectorXd& at, const Eigen::VectorXd& moved,
                           const Eigen::MatrixXd& way, const Eigen::VectorXd& goal, double step,
                           const Eigen::VectorXd& price, const Eigen::VectorXd* expected) const {
        solve::BoxQuadratic problem;
        problem.A = way.transpose() * way / size_;
        problem.A.diagonal().array() += expected ? kKeep : kRidge;
        problem.b = way.transpose() * (moved - way * at - goal) / size_;
        if (expected) problem.b -= kKeep * *expected;
        problem.l1_weight = price;
        problem.min = (at.array() - step).cwiseMax(0.0);
        problem.max = (at.array() + step).cwiseMin(1.0);
        for (std::size_t s = 0; s < sources_.size(); ++s)
            if (!active_[s])
                problem.min[static_cast<long>(s)] = problem.max[static_cast<long>(s)] = 0;
        Eigen::VectorXd out = at.cwiseMax(problem.min).cwiseMin(problem.max);
        solve::minimise(problem, out, 1e-7);
        return out;
    }

    /// `expected`: weights that it keeps near, or null.
    void improve(State& state, const Eigen::VectorXd& goal, int rounds,
                 const Eigen::VectorXd& price, const Eigen::VectorXd* expected = nullptr) const {
        const auto cost = [&](const State& of) {
            return 0.5 * (of.moved - goal).squaredNorm() / size_ + price.dot(of.weight) +
                   (expected ? 0.5 * kKeep * (of.weight - *expected).squaredNorm() : 0.0);
        };
        double step = kLongestStep;
        for (int round = 0; round < rounds && step > kShortestStep; ++round) {
            find_ways(state);
            State next =
                state_at(fitted(state.weight, state.moved, state.way, goal, step, price, expected));
            const double before = cost(state), after = cost(next);
            if (after < before)
                state = std::move(next);
            else
                step *= 0.3;
            if (std::abs(before - after) < kLeastGain * before) break;
        }
    }

    /// Leaves out what stays small, and all but those that matter most.
    void keep_those_that_matter(State& state) {
        find_ways(state);
        std::vector<std::pair<double, const Candidate*>> by_worth;
        for (const Candidate& one : candidates_) {
            double highest = 0, worth = 0;
            for (const std::size_t s : one.goals) {
                const double w = state.weight[static_cast<long>(s)];
                highest = std::max(highest, w);
                worth += (w * state.way.col(static_cast<long>(s))).squaredNorm();
            }
            for (const std::size_t s : one.goals) active_[s] = false;
            if (highest >= kLeastWeight && worth > options_.least_gain * size_)
                by_worth.emplace_back(-worth, &one);
        }
        std::stable_sort(by_worth.begin(), by_worth.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        if (static_cast<int>(by_worth.size()) > options_.most)
            by_worth.resize(static_cast<std::size_t>(options_.most));
        for (const auto& [worth, one] : by_worth)
            for (const std::size_t s : one->goals) active_[s] = true;
        for (std::size_t s = 0; s < sources_.size(); ++s)
            if (!active_[s]) state.weight[static_cast<long>(s)] = 0;
        state = state_at(state.weight);
    }

    /// The state at the largest motion, with the units that make it.
    State choose(const ProgressMonitor& monitor) {
        const auto goal = target_.col(peak_);
        monitor.report(0.1, "units");
        State state = state_at(Eigen::VectorXd::Zero(static_cast<long>(sources_.size())));
        improve(state, goal, kSeekingRounds, prices(kPrice));
        keep_those_that_matter(state);
        improve(state, goal, kKeptRounds, prices(kSmallPrice));
        const double left = (state.moved - goal).norm() / root_.norm();
        if (left > options_.enough_m) {
            // Muscles for what is left
            monitor.report(0.4, "units");
            State with = state_at(state.weight);
            const std::vector<bool> units_alone = active_;
            for (const Candidate& one : candidates_)
                if (!one.is_unit)
                    for (const std::size_t s : one.goals) active_[s] = true;
            improve(with, goal, kKeptRounds, prices(0.1 * kPrice));
            keep_those_that_matter(with);
            improve(with, goal, kKeptRounds, prices(kSmallPrice));
            if ((with.moved - goal).norm() < 0.8 * left * root_.norm()) {
                find_ways(with);
                return with;
            }
            active_ = units_alone;
            state = state_at(state.weight);
        }
        find_ways(state);
        return state;
    }

    /// The simulated frames around a frame, and the share of the later one.
    struct Neighbours {
        std::size_t before, after;
        double share;
    };
    static Neighbours neighbours(const std::vector<long>& frames,
                                 const std::vector<double>& times_s, long frame) {
        const auto after = static_cast<std::size_t>(
            std::lower_bound(frames.begin(), frames.end(), frame) - frames.begin());
        if (after == frames.size()) return {after - 1, after - 1, 0};
        if (after == 0 || frames[after] == frame) return {after, after, 0};
        const double from_s = times_s[static_cast<std::size_t>(frames[after - 1])],
                     to_s = times_s[static_cast<std::size_t>(frames[after])];
        return {after - 1, after,
                (times_s[static_cast<std::size_t>(frame)] - from_s) / (to_s - from_s)};
    }

    void fit_between(const std::vector<long>& frames, const std::vector<State>& states,
                     const std::vector<double>& times_s, long t) {
        const auto [before, after, share] = neighbours(frames, times_s, t);
        const State &a = states[before], &b = states[after];
        const Eigen::MatrixXd way = (1 - share) * a.way + share * b.way;
        const Eigen::VectorXd at_zero =
            (1 - share) * model(a, Eigen::VectorXd::Zero(a.weight.size())) +
            share * model(b, Eigen::VectorXd::Zero(a.weight.size()));
        const Eigen::VectorXd expected = (1 - share) * a.weight + share * b.weight;
        weight_.col(t) = fitted(Eigen::VectorXd::Zero(a.weight.size()), at_zero, way,
                                target_.col(t), 1, prices(kSmallPrice), &expected);
    }

    /// The first and the last frame, that of the largest motion, and some between that are equally far apart in motion.
    std::vector<long> frames_to_simulate() const {
        const long all = target_.cols();
        std::vector<double> way{0};
        for (long t = 1; t < all; ++t)
            way.push_back(way.back() + (target_.col(t) - target_.col(t - 1)).norm());
        std::set<long> out{0, peak_, all - 1};
        const int more = std::max(1, options_.simulated_frames - 3);
        for (int k = 0; k < more; ++k) {
            const double at = way.back() * (k + 0.5) / more;
            out.insert(std::lower_bound(way.begin(), way.end(), at) - way.begin());
        }
        return {out.begin(), out.end()};
    }

    /// How far keys may be from a curve: as far as it moves the points by less than options_.key_error_m in any state.
    double tolerance(const std::vector<std::size_t>& sources) const {
        double most = 0;
        for (const Eigen::MatrixXd& ways : ways_) {
            Eigen::VectorXd way = Eigen::VectorXd::Zero(target_.rows());
            for (const std::size_t s : sources) way += ways.col(static_cast<long>(s));
            most = std::max(most, way.norm());
        }
        constexpr double kMost = 3;
        return std::clamp(options_.key_error_m * root_.norm() / most, options_.key_tolerance,
                          kMost * options_.key_tolerance);
    }

    /// The weights as curves with few keys. Afterwards the weights are what the curves have.
    std::vector<UnitCurve> curves(const std::vector<double>& times_s) {
        std::vector<UnitCurve> out;
        const auto add = [&](const std::string& name, const std::vector<std::size_t>& goals) {
            Eigen::VectorXd mean = Eigen::VectorXd::Zero(weight_.cols());
            for (const std::size_t goal : goals)
                mean += weight_.row(static_cast<long>(goal)).transpose() /
                        static_cast<double>(goals.size());
            const std::vector<double> list(mean.data(), mean.data() + mean.size());
            out.push_back({name, motion::reduce_keys(times_s, list, tolerance(goals))});
            for (long t = 0; t < weight_.cols(); ++t)
                for (const std::size_t goal : goals)
                    weight_(static_cast<long>(goal), t) =
                        value_at(out.back().keys, times_s[static_cast<std::size_t>(t)]);
        };
        for (const Candidate& one : candidates_) {
            std::vector<std::size_t> used;
            for (const std::size_t goal : one.goals)
                if (active_[goal] &&
                    weight_.row(static_cast<long>(goal)).maxCoeff() >= kLeastWeight)
                    used.push_back(goal);
                else
                    weight_.row(static_cast<long>(goal)).setZero();
            if (used.size() == 2 &&
                (weight_.row(static_cast<long>(used[0])) - weight_.row(static_cast<long>(used[1])))
                        .cwiseAbs()
                        .maxCoeff() < options_.same_sides)
                add(one.name, used);
            else
                for (const std::size_t goal : used) add(sources_[goal].name, {goal});
        }
        return out;
    }

    face::Face& face_;
    const scene::RigFiles& files_;
    track::ChannelTable channels_;
    const UnitSolveOptions& options_;
    std::vector<int> vertex_;  ///< those with weight
    Eigen::VectorXd root_;     ///< square roots of their weights
    Eigen::MatrixXd target_;   ///< weighted, one column per frame
    double size_ = 0;          ///< its squares in the frame of the largest motion
    Eigen::Index peak_ = 0;    ///< this frame
    std::vector<Candidate> candidates_;
    std::vector<Source> sources_;
    std::vector<bool> active_;           ///< by source: whether it may have a weight
    Eigen::MatrixXd weight_;             ///< sources x frames
    std::vector<Eigen::MatrixXd> ways_;  ///< of the simulated frames
};

}  // namespace

UnitSolution solve_units(face::Face& face, const scene::RigFiles& files, const FitTarget& given,
                         const UnitSolveOptions& options, const ProgressMonitor& monitor) {
    return UnitSolver(face, files, given, options).solve(given.times_s, monitor);
}

}  // namespace risorius::inverse
