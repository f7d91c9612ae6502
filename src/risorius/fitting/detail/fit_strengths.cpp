// SPDX-License-Identifier: MIT
#include "risorius/fitting/detail/fit_strengths.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>

#include "risorius/core/error.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/calibration.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/statics.h"
#include "risorius/fitting/detail/fit_tolerance.h"
#include "risorius/solve/box_quadratic.h"

namespace risorius::fitting {

namespace {

constexpr double kMax = 1.0;  // largest |z|
constexpr double kLongestStep = 0.5;
constexpr double kDifference = 0.02;  // step of z for finite differences
constexpr int kIterations = 200;      // solver iterations per expression
constexpr double kMinRatio = 0.1;     // smaller relative differences count by their square
constexpr double kIdle = 0.02;  // less active muscles hardly show in an expression and are ignored

/// The numbers of the lips in z, after those of the muscles.
enum LipRatio { kUpperTurn, kLowerTurn, kUpperPush, kLowerPush, kPuff };

constexpr auto kPressure = static_cast<std::size_t>(track::Kinematic::kMouthPressure);

/// A face with its present z.
class ScaledFace {
  public:
    ScaledFace(face::Face& face, const rig::RigDescription& rig, const std::string& place,
               const std::vector<std::string>& muscles)
        : ways(face, rig, place), face_(face), muscles_(muscles), lips_(rig.lips) {
        for (const std::string& muscle : muscles)
            strength_.push_back(face.calibration().strength(muscle));
        for (double* ratio : {&lips_.upper_turn, &lips_.lower_turn, &lips_.upper_push,
                              &lips_.lower_push, &lips_.puff})
            lip_ratios_.push_back({ratio, *ratio});
        z_ = Eigen::VectorXd::Zero(static_cast<long>(muscles_.size() + lip_ratios_.size()));
    }

    const Eigen::VectorXd& z() const { return z_; }
    const rig::LipsDescription& lips() const { return lips_; }
    void set(const Eigen::VectorXd& z) {
        for (long i = 0; i < z.size(); ++i) set(i, z[i]);
    }
    void set(long i, double value) {
        if (value == z_[i]) return;
        const auto muscles = static_cast<long>(muscles_.size());
        if (i < muscles) {
            const auto m = static_cast<std::size_t>(i);
            face_.calibration().set_strength(muscles_[m], strength_[m] * std::exp(value));
        } else {
            auto& [ratio, first] = lip_ratios_[static_cast<std::size_t>(i - muscles)];
            *ratio = first * std::exp(value);
            face_.calibration().scale_lips(lips_);
        }
        z_[i] = value;
    }
    /// The drive of the table with the pressure that puffs this head.
    track::Drive puffed(track::Drive drive) const {
        drive.kinematic[kPressure] *= std::exp(z_[static_cast<long>(muscles_.size()) + kPuff]);
        return drive;
    }
    Eigen::MatrixXd slopes(const track::Drive& drive, const std::vector<char>& works);

    scene::LandmarkDisplacements ways;

  private:
    face::Face& face_;
    const std::vector<std::string>& muscles_;
    std::vector<double> strength_;
    rig::LipsDescription lips_;
    std::vector<std::pair<double*, double>> lip_ratios_;  // and their previous values
    Eigen::VectorXd z_;
};

// d(displacements)/dz in the current equilibrium, in the memory order of Points. `works`: whether a number of z changes anything.
Eigen::MatrixXd ScaledFace::slopes(const track::Drive& drive, const std::vector<char>& works) {
    const Points nodes = face_.statics().nodes();
    std::vector<Points> force;
    for (long i = 0; i < z_.size(); ++i) {
        if (!works[static_cast<std::size_t>(i)]) {
            force.emplace_back();
            continue;
        }
        const double at = z_[i];
        set(i, at + kDifference);
        const Points more = face_.statics().gradient(nodes, drive.excitation, puffed(drive));
        set(i, at - kDifference);
        const Points less = face_.statics().gradient(nodes, drive.excitation, puffed(drive));
        force.push_back((more - less) / (2 * kDifference));
        set(i, at);
    }
    const long count = static_cast<long>(ways.landmarks().size());
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * count, z_.size());
    for (long i = 0; i < z_.size(); ++i) {
        if (force[static_cast<std::size_t>(i)].size() == 0) continue;
        const Points moved = face_.statics().solve(-force[static_cast<std::size_t>(i)]);
        Points moves = Points::Zero(count, 3);
        for (long k = 0; k < count; ++k) {
            const int v = face_.diagnostics().shell().collapsed_to[static_cast<std::size_t>(
                ways.vertex(static_cast<std::size_t>(k)))];
            if (v >= 0) moves.row(k) = moved.row(face::node_of(v, face::kSkin)) / face_.head().size;
        }
        out.col(i) = Eigen::Map<const Eigen::VectorXd>(moves.data(), moves.size());
    }
    return out;
}

class Fit {
  public:
    Fit(face::FaceTeam& team, const rig::RigDescription& rig,
        const scene::DisplacementTable& standard, const StrengthFitOptions& options,
        const std::string& place, const ProgressMonitor& monitor)
        : team_(team), channels_(rig.channels()), options_(options), monitor_(monitor) {
        std::set<std::string> seen;
        for (const rig::MuscleBand& band : rig.atlas.bands)
            if (seen.insert(band.muscle).second) muscles_.push_back(band.muscle);
        team.all([&](face::Face& face) {
            scaled_.emplace(&face, std::make_unique<ScaledFace>(face, rig, place, muscles_));
        });
        z_ = first().z();
        keep_ = Eigen::VectorXd::Constant(z_.size(), options.keep);
        keep_[static_cast<long>(muscles_.size()) + kLowerPush] = options.keep_lower_push;
        const std::vector<std::string>& landmarks = first().ways.landmarks();
        for (const auto& [name, table] : standard) {
            Points goal(static_cast<long>(landmarks.size()), 3);
            for (std::size_t i = 0; i < landmarks.size(); ++i) {
                const auto way = table.find(landmarks[i]);
                if (way == table.end())
                    throw Error("ways of \"" + name + "\"", "landmark " + landmarks[i], "none");
                goal.row(static_cast<long>(i)) = way->second.transpose();
            }
            if (goal.isZero(0.0)) continue;
            expressions_.push_back({name, first().ways.drive(name), goal});
        }
    }

    StrengthFit run() {
        StrengthFit out;
        Eigen::VectorXd best = z_;
        double best_cost = 0, reach = 1;
        solve::BoxQuadratic problem;
        for (int round = 0; round <= options_.rounds; ++round) {
            solve::BoxQuadratic model;
            const auto [cost, difference] = look(round, round < options_.rounds ? &model : nullptr);
            if (round == 0) out.difference_before = difference;
            if (round == 0 || cost < best_cost) {
                best = z_;
                best_cost = cost;
                out.difference = difference;
                problem = std::move(model);
            } else {
                reach *= 0.4;
            }
            if (round == options_.rounds) break;
            const Eigen::VectorXd step =
                Eigen::VectorXd::Constant(best.size(), reach * kLongestStep);
            problem.min = (best - step).cwiseMax(-kMax);
            problem.max = (best + step).cwiseMin(kMax);
            Eigen::VectorXd next = best;
            solve::minimise(problem, next, 1e-6, 400);
            set(next);
        }
        set(best);
        for (std::size_t m = 0; m < muscles_.size(); ++m)
            out.factor[muscles_[m]] = std::exp(best[static_cast<long>(m)]);
        out.lips = first().lips();
        return out;
    }

  private:
    struct Expression {
        std::string name;
        track::Drive drive;
        Points goal;
    };

    /// An expression as it is, and the part of the model that it adds.
    struct Looked {
        double cost, ratio;
        solve::BoxQuadratic model;
    };

    ScaledFace& first() const { return *scaled_.at(&team_.first()); }
    void set(const Eigen::VectorXd& z) {
        for (const auto& [face, scaled] : scaled_) scaled->set(z);
        z_ = z;
    }

    // Objective and mean difference at z. `model`: receives the quadratic model about z.
    std::pair<double, double> look(int round, solve::BoxQuadratic* model) {
        double cost = 0.5 * keep_.dot(z_.cwiseAbs2()), sum = 0;
        if (model != nullptr) {
            model->A = keep_.asDiagonal();
            model->b = model->l1_weight = Eigen::VectorXd::Zero(z_.size());
        }
        const auto count = static_cast<int>(expressions_.size());
        const ProgressMonitor part =
            monitor_.subrange(static_cast<double>(round) / (options_.rounds + 1),
                              static_cast<double>(round + 1) / (options_.rounds + 1));
        TaskProgress progress(part, count);
        std::vector<Looked> looked(expressions_.size());
        team_.each(count, [&](int e, face::Face& face) {
            const Expression& one = expressions_[static_cast<std::size_t>(e)];
            progress.begin(one.name);
            looked[static_cast<std::size_t>(e)] =
                look_at(one, *scaled_.at(&face), model != nullptr);
        });
        for (const Looked& one : looked) {
            cost += one.cost;
            sum += one.ratio / static_cast<double>(count);
            if (model == nullptr) continue;
            model->A += one.model.A;
            model->b += one.model.b;
        }
        return {cost, sum};
    }

    Looked look_at(const Expression& one, ScaledFace& scaled, bool with_model) const {
        Looked out;
        const Points miss =
            scaled.ways.solve_equilibrium(scaled.puffed(one.drive), kIterations, kFitTolerance_m) -
            one.goal;
        const double length = one.goal.norm();
        out.ratio = miss.norm() / length;
        const Eigen::VectorXd r = Eigen::Map<const Eigen::VectorXd>(miss.data(), miss.size());
        const Points way = miss + one.goal;
        const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(way.data(), way.size());
        const double longer = u.norm() / length - 1;
        out.cost = out.ratio + options_.length * std::abs(longer);
        if (!with_model) return out;
        const Eigen::MatrixXd J = scaled.slopes(one.drive, works(one.drive));
        const double weight = 1 / (length * length * std::max(out.ratio, kMinRatio));
        out.model.A = weight * (J.transpose() * J);
        out.model.b = weight * (J.transpose() * (r - J * z_));
        if (!(u.norm() > 0)) return out;
        const Eigen::VectorXd slope = J.transpose() * u / (u.norm() * length);
        const double heavy = options_.length / std::max(std::abs(longer), kMinRatio);
        out.model.A += heavy * slope * slope.transpose();
        out.model.b += heavy * slope * (longer - slope.dot(z_));
        return out;
    }

    // For each number of z whether it changes what the drive does.
    std::vector<char> works(const track::Drive& drive) const {
        std::vector<char> out;
        for (long i = 0; i < z_.size(); ++i) out.push_back(works(i, drive));
        return out;
    }
    bool works(long i, const track::Drive& drive) const {
        const auto muscles = static_cast<long>(muscles_.size());
        if (i == muscles + kPuff) return drive.kinematic[kPressure] != 0;
        if (i >= muscles) {  // turn and push act through the lip's own muscles
            const bool upper = i == muscles + kUpperTurn || i == muscles + kUpperPush;
            const std::string lip = upper ? "upper" : "lower";
            for (const char* part : {"_marginal", "_peripheral"})
                if (drive.excitation[channels_.column("orbicularis_oris_" + lip + part,
                                                      Side::kLeft)] > kIdle)
                    return true;
            return false;
        }
        for (const Side side : {Side::kLeft, Side::kRight})
            if (drive.excitation[channels_.column(muscles_[static_cast<std::size_t>(i)], side)] >
                kIdle)
                return true;
        return false;
    }

    face::FaceTeam& team_;
    const track::ChannelTable channels_;
    const StrengthFitOptions options_;
    const ProgressMonitor& monitor_;
    std::vector<std::string> muscles_;
    std::map<const face::Face*, std::unique_ptr<ScaledFace>> scaled_;
    std::vector<Expression> expressions_;
    Eigen::VectorXd z_, keep_;
};

}  // namespace

StrengthFit fit_strengths(face::FaceTeam& team, const rig::RigDescription& rig,
                          const scene::DisplacementTable& standard,
                          const StrengthFitOptions& options, const std::string& place,
                          const ProgressMonitor& monitor) {
    StrengthFit out = Fit(team, rig, standard, options, place, monitor).run();
    track::Drive rest;
    rest.excitation = Eigen::VectorXd::Zero(rig.channels().column_count());
    team.all([&](face::Face& face) { face.start([&](double) { return rest; }); });
    return out;
}

}  // namespace risorius::fitting
