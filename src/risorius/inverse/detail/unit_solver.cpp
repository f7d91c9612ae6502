// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/unit_solver.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "risorius/blendshapes/shape_player.h"
#include "risorius/motion/reduce_keys.h"
#include "risorius/solve/box_quadratic.h"

namespace risorius::inverse {

namespace {

using blendshapes::ShapeGoal;
using track::Kinematic;

constexpr double kRidge = 1e-4;  // of the largest diagonal
// A muscle has to explain this many times as much as a unit, so that units come first.
constexpr double kMusclePrice = 2;
constexpr double kLeastWeight = 0.03;  // units that stay below are left out
constexpr int kRounds = 5, kChoosingRounds = 2;

/// A unit or muscle: one side, or both.
struct Candidate {
    std::string name;
    std::vector<std::size_t> goals;
    bool is_unit = true;
};

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
        add_goals("facs", true);
        add_goals("muscles", false);
        std::vector<Points> linear;
        const blendshapes::ShapeWeights ways(face, channels_, goals_, &linear);
        column_.resize(target_.rows(), static_cast<long>(goals_.size()));
        for (std::size_t s = 0; s < goals_.size(); ++s)
            column_.col(static_cast<long>(s)) = weighted(linear[s]);
        lack_ = Eigen::MatrixXd::Zero(target_.rows(), target_.cols());
    }

    UnitSolution solve(const std::vector<double>& times_s, const ProgressMonitor& monitor) {
        const std::vector<long> frames = frames_to_simulate();
        for (int round = 0; round < kRounds; ++round) {
            monitor.report(0.2 + 0.8 * round / kRounds, "units");
            // What the linear model could not see may need further units.
            const std::size_t before = chosen_.size();
            if (round <= kChoosingRounds) choose();
            simulate_columns(before);
            fit();
            if (round == kChoosingRounds) drop_small();
            correct(frames, times_s);
        }
        UnitSolution out;
        out.simulated.assign(static_cast<std::size_t>(target_.cols()), false);
        for (const long f : frames) out.simulated[static_cast<std::size_t>(f)] = true;
        const Eigen::MatrixXd left = target_ - lack_ - column_ * weight_;
        const double whole = root_.squaredNorm();
        for (long t = 0; t < left.cols(); ++t) {
            out.rms_m.push_back(left.col(t).norm() / std::sqrt(whole));
            double max = 0;
            for (long i = 0; i < root_.size(); ++i)
                max = std::max(max, left.col(t).segment<3>(3 * i).norm() / root_[i]);
            out.max_m.push_back(max);
            out.drives.push_back(drive_of(weight_.col(t)));
        }
        out.curves = curves(times_s);
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

    void add_goals(const std::string& set, bool units) {
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
            known->goals.push_back(goals_.size());
            goals_.push_back(goal);
            goals_.back().on_top_of = goals_.back().partner = -1;
        }
    }

    /// Fits the weights of the chosen goals in every frame.
    void fit() {
        const auto count = static_cast<long>(chosen_.size());
        Eigen::MatrixXd used(column_.rows(), count);
        for (long s = 0; s < count; ++s)
            used.col(s) = column_.col(static_cast<long>(chosen_[static_cast<std::size_t>(s)]));
        solve::BoxQuadratic problem;
        problem.A = used.transpose() * used;
        problem.A.diagonal().array() += kRidge * problem.A.diagonal().maxCoeff();
        problem.l1_weight = problem.min = Eigen::VectorXd::Zero(count);
        problem.max = Eigen::VectorXd::Ones(count);
        weight_ = Eigen::MatrixXd::Zero(column_.cols(), target_.cols());
        for (long t = 0; t < target_.cols(); ++t) {
            problem.b = -used.transpose() * (target_.col(t) - lack_.col(t));
            Eigen::VectorXd w = Eigen::VectorXd::Zero(count);
            solve::minimise(problem, w, 1e-7);
            for (long s = 0; s < count; ++s)
                weight_(static_cast<long>(chosen_[static_cast<std::size_t>(s)]), t) = w[s];
        }
    }

    /// What a candidate explains at best of what is left.
    double gain(const Candidate& candidate, const Eigen::MatrixXd& left) const {
        double sum = 0;
        for (const std::size_t goal : candidate.goals) {
            const auto way = column_.col(static_cast<long>(goal));
            const double size = way.squaredNorm();
            if (size > 0) sum += (left.transpose() * way).cwiseMax(0.0).squaredNorm() / size;
        }
        return candidate.is_unit ? sum : sum / kMusclePrice;
    }

    void choose() {
        const double all = target_.squaredNorm(), enough = options_.enough_m * options_.enough_m *
                                                           root_.squaredNorm() *
                                                           static_cast<double>(target_.cols());
        if (chosen_.empty()) weight_ = Eigen::MatrixXd::Zero(column_.cols(), target_.cols());
        Eigen::MatrixXd left = target_ - lack_ - column_ * weight_;
        while (static_cast<int>(tried_.size()) < options_.most && left.squaredNorm() > enough) {
            const Candidate* best = nullptr;
            double most = options_.least_gain * all;
            for (const Candidate& one : candidates_)
                if (const double by = tried_.count(one.name) ? 0 : gain(one, left); by > most) {
                    most = by;
                    best = &one;
                }
            if (!best) break;
            tried_.insert(best->name);
            chosen_.insert(chosen_.end(), best->goals.begin(), best->goals.end());
            fit();
            left = target_ - lack_ - column_ * weight_;
        }
    }

    void drop_small() {
        std::erase_if(chosen_, [&](std::size_t goal) {
            return weight_.row(static_cast<long>(goal)).maxCoeff() < kLeastWeight;
        });
        if (!chosen_.empty()) fit();
    }

    track::Drive drive_of(const Eigen::VectorXd& weights) const {
        track::Drive out;
        out.excitation = Eigen::VectorXd::Zero(channels_.column_count());
        for (const std::size_t goal : chosen_) {
            const double w = weights[static_cast<long>(goal)];
            out.excitation += w * goals_[goal].drive.excitation;
            for (std::size_t k = 0; k < out.kinematic.size(); ++k)
                out.kinematic[k] += w * goals_[goal].drive.kinematic[k];
        }
        out.excitation = out.excitation.cwiseMin(1.0).cwiseMax(channels_.column_min());
        return out;
    }

    Eigen::VectorXd simulated(const track::Drive& drive) const {
        face_.solve_equilibrium(drive.excitation, drive, options_.rest);
        if (options_.rest.stopped && options_.rest.stopped()) throw Interrupted();
        return weighted(face_.pose().vertices - face_.head().vertices);
    }

    /// Columns of what the goals do that were chosen from `first` on, at the largest weight that they have so far.
    void simulate_columns(std::size_t first) {
        for (std::size_t i = first; i < chosen_.size(); ++i) {
            const auto at = static_cast<long>(chosen_[i]);
            const double most = weight_.row(at).maxCoeff();
            if (most < kLeastWeight) continue;
            column_.col(at) =
                simulated(drive_of(most * Eigen::VectorXd::Unit(column_.cols(), at))) / most;
        }
    }

    /// The first and the last frame, that of the largest motion, and some between that are equally far apart in motion.
    std::vector<long> frames_to_simulate() const {
        const long all = target_.cols();
        std::vector<double> way{0};
        for (long t = 1; t < all; ++t)
            way.push_back(way.back() + (target_.col(t) - target_.col(t - 1)).norm());
        std::set<long> out{all - 1};
        long largest = 0;
        target_.colwise().squaredNorm().maxCoeff(&largest);
        out.insert(largest);
        const int more = std::max(1, options_.simulated_frames - 2);
        for (int k = 0; k < more; ++k) {
            const double at = way.back() * (k + 0.5) / more;
            out.insert(std::lower_bound(way.begin(), way.end(), at) - way.begin());
        }
        return {out.begin(), out.end()};
    }

    void correct(const std::vector<long>& frames, const std::vector<double>& times_s) {
        Eigen::MatrixXd known(target_.rows(), static_cast<long>(frames.size()));
        for (std::size_t k = 0; k < frames.size(); ++k) {
            const Eigen::VectorXd w = weight_.col(frames[k]);
            known.col(static_cast<long>(k)) = simulated(drive_of(w)) - column_ * w;
        }
        // Linear in time between them; at the first frame the face is at rest and lacks nothing.
        for (long t = 0; t < target_.cols(); ++t) {
            const auto next = static_cast<std::size_t>(
                std::lower_bound(frames.begin(), frames.end(), t) - frames.begin());
            if (next == frames.size()) {
                lack_.col(t) = known.col(static_cast<long>(next) - 1);
                continue;
            }
            const long from = next == 0 ? 0 : frames[next - 1], to = frames[next];
            const double span = times_s[static_cast<std::size_t>(to)] -
                                times_s[static_cast<std::size_t>(from)],
                         share = span > 0 ? (times_s[static_cast<std::size_t>(t)] -
                                             times_s[static_cast<std::size_t>(from)]) /
                                                span
                                          : 1;
            lack_.col(t) = share * known.col(static_cast<long>(next));
            if (next > 0) lack_.col(t) += (1 - share) * known.col(static_cast<long>(next) - 1);
        }
    }

    std::vector<UnitCurve> curves(const std::vector<double>& times_s) const {
        std::vector<UnitCurve> out;
        const auto add = [&](const std::string& name, const Eigen::VectorXd& values) {
            const std::vector<double> list(values.data(), values.data() + values.size());
            out.push_back({name, motion::reduce_keys(times_s, list, options_.key_tolerance)});
        };
        for (const Candidate& one : candidates_) {
            std::vector<std::size_t> used;
            for (const std::size_t goal : one.goals)
                if (std::find(chosen_.begin(), chosen_.end(), goal) != chosen_.end())
                    used.push_back(goal);
            const auto curve = [&](std::size_t goal) -> Eigen::VectorXd {
                return weight_.row(static_cast<long>(goal)).transpose();
            };
            if (used.size() == 2 &&
                (curve(used[0]) - curve(used[1])).cwiseAbs().maxCoeff() < options_.same_sides) {
                add(one.name, 0.5 * (curve(used[0]) + curve(used[1])));
                continue;
            }
            for (const std::size_t goal : used) add(goals_[goal].name, curve(goal));
        }
        return out;
    }

    face::Face& face_;
    const scene::RigFiles& files_;
    track::ChannelTable channels_;
    const UnitSolveOptions& options_;
    std::vector<int> vertex_;  ///< those with weight
    Eigen::VectorXd root_;     ///< square roots of their weights
    std::vector<ShapeGoal> goals_;
    std::vector<Candidate> candidates_;
    std::vector<std::size_t> chosen_;  ///< goals
    std::set<std::string> tried_;      ///< names of candidates
    Eigen::MatrixXd target_, lack_;    ///< weighted, one column per frame
    Eigen::MatrixXd column_;           ///< weighted, one column per goal
    Eigen::MatrixXd weight_;           ///< goals x frames
};

}  // namespace

UnitSolution solve_units(face::Face& face, const scene::RigFiles& files, const FitTarget& given,
                         const UnitSolveOptions& options, const ProgressMonitor& monitor) {
    return UnitSolver(face, files, given, options).solve(given.times_s, monitor);
}

}  // namespace risorius::inverse
