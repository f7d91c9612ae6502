// SPDX-License-Identifier: MIT
#include "risorius/fitting/detail/fit_strengths.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "risorius/core/error.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/calibration.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/statics.h"
#include "risorius/solve/box_quadratic.h"

namespace risorius::fitting {

namespace {

constexpr double kMax = 1.0;  // largest |z|
constexpr double kLongestStep = 0.5;
constexpr double kDifference = 0.02;  // step of z for finite differences
constexpr int kIterations = 200;      // solver iterations per expression
constexpr double kMinRatio = 0.1;     // smaller relative differences count by their square
constexpr double kIdle = 0.02;  // less active muscles hardly show in an expression and are ignored

constexpr auto kPressure = static_cast<std::size_t>(track::Kinematic::kMouthPressure);

class Fit {
  public:
    Fit(face::Face& face, const rig::RigDescription& rig, const scene::DisplacementTable& standard,
        const StrengthFitOptions& options, const std::string& place, const ProgressMonitor& monitor)
        : face_(face),
          channels_(rig.channels()),
          ways_(face, rig, place),
          options_(options),
          monitor_(monitor),
          lips_(rig.lips) {
        std::set<std::string> seen;
        for (const rig::MuscleBand& band : rig.atlas.bands)
            if (seen.insert(band.muscle).second) muscles_.push_back(band.muscle);
        for (double* ratio : {&lips_.upper_turn, &lips_.lower_turn, &lips_.upper_push,
                              &lips_.lower_push, &lips_.puff})
            lip_ratios_.push_back({ratio, *ratio});
        z_ = Eigen::VectorXd::Zero(static_cast<long>(muscles_.size() + lip_ratios_.size()));
        keep_ = Eigen::VectorXd::Constant(z_.size(), options.keep);
        for (std::size_t i = 0; i < lip_ratios_.size(); ++i)
            if (lip_ratios_[i].first == &lips_.lower_push)
                keep_[static_cast<long>(muscles_.size() + i)] = options.keep_lower_push;
        for (const auto& [name, table] : standard) {
            Points goal(static_cast<long>(ways_.landmarks().size()), 3);
            for (std::size_t i = 0; i < ways_.landmarks().size(); ++i) {
                const auto way = table.find(ways_.landmarks()[i]);
                if (way == table.end())
                    throw Error("ways of \"" + name + "\"", "landmark " + ways_.landmarks()[i],
                                "none");
                goal.row(static_cast<long>(i)) = way->second.transpose();
            }
            if (goal.isZero(0.0)) continue;
            expressions_.push_back({name, ways_.drive(name), goal});
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
        out.lips = lips_;
        return out;
    }

  private:
    struct Expression {
        std::string name;
        track::Drive drive;
        Points goal;
    };

    void set(const Eigen::VectorXd& z) {
        for (long i = 0; i < z.size(); ++i) set(i, z[i]);
    }
    void set(long i, double value) {
        if (value == z_[i]) return;
        const auto muscles = static_cast<long>(muscles_.size());
        if (i < muscles) {
            face_.calibration().scale_muscle(muscles_[static_cast<std::size_t>(i)],
                                             std::exp(value - z_[i]));
        } else {
            auto& [ratio, first] = lip_ratios_[static_cast<std::size_t>(i - muscles)];
            *ratio = first * std::exp(value);
            face_.calibration().scale_lips(lips_);
        }
        z_[i] = value;
    }

    // Objective and mean difference at z. `model`: receives the quadratic model about z.
    std::pair<double, double> look(int round, solve::BoxQuadratic* model) {
        double cost = 0.5 * keep_.dot(z_.cwiseAbs2()), sum = 0;
        if (model != nullptr) {
            model->A = keep_.asDiagonal();
            model->b = model->l1_weight = Eigen::VectorXd::Zero(z_.size());
        }
        for (std::size_t e = 0; e < expressions_.size(); ++e) {
            const Expression& one = expressions_[e];
            monitor_.report(
                (round + static_cast<double>(e) / static_cast<double>(expressions_.size())) /
                    (options_.rounds + 1),
                one.name);
            const Points miss = ways_.solve_equilibrium(scaled(one.drive), kIterations) - one.goal;
            const double length = one.goal.norm(), ratio = miss.norm() / length;
            const Eigen::VectorXd r = Eigen::Map<const Eigen::VectorXd>(miss.data(), miss.size());
            const Points way = miss + one.goal;
            const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(way.data(), way.size());
            const double longer = u.norm() / length - 1;
            cost += ratio + options_.length * std::abs(longer);
            sum += ratio / static_cast<double>(expressions_.size());
            if (model == nullptr) continue;
            const Eigen::MatrixXd J = slopes(one.drive);
            const double weight = 1 / (length * length * std::max(ratio, kMinRatio));
            model->A += weight * (J.transpose() * J);
            model->b += weight * (J.transpose() * (r - J * z_));
            if (!(u.norm() > 0)) continue;
            const Eigen::VectorXd slope = J.transpose() * u / (u.norm() * length);
            const double heavy = options_.length / std::max(std::abs(longer), kMinRatio);
            model->A += heavy * slope * slope.transpose();
            model->b += heavy * slope * (longer - slope.dot(z_));
        }
        return {cost, sum};
    }

    // The drive of the table with the pressure that puffs this head.
    track::Drive scaled(track::Drive drive) const {
        drive.kinematic[kPressure] *= std::exp(z_[z_.size() - 1]);
        return drive;
    }

    bool works(long i, const track::Drive& drive) const {
        const auto muscles = static_cast<long>(muscles_.size());
        if (i == z_.size() - 1) return drive.kinematic[kPressure] != 0;
        if (i >= muscles) {  // turn and push act through the lip's own muscles
            const std::string lip = (i - muscles) % 2 == 0 ? "upper" : "lower";
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

    // d(displacements)/dz in the current equilibrium, in the memory order of Points.
    Eigen::MatrixXd slopes(const track::Drive& drive) {
        const Points nodes = face_.statics().nodes();
        std::vector<Points> force;
        for (long i = 0; i < z_.size(); ++i) {
            if (!works(i, drive)) {
                force.emplace_back();
                continue;
            }
            const double at = z_[i];
            set(i, at + kDifference);
            const Points more = face_.statics().gradient(nodes, drive.excitation, scaled(drive));
            set(i, at - kDifference);
            const Points less = face_.statics().gradient(nodes, drive.excitation, scaled(drive));
            force.push_back((more - less) / (2 * kDifference));
            set(i, at);
        }
        const long count = static_cast<long>(ways_.landmarks().size());
        Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * count, z_.size());
        for (long i = 0; i < z_.size(); ++i) {
            if (force[static_cast<std::size_t>(i)].size() == 0) continue;
            const Points moved = face_.statics().solve(-force[static_cast<std::size_t>(i)]);
            Points ways = Points::Zero(count, 3);
            for (long k = 0; k < count; ++k) {
                const int v = face_.diagnostics().shell().collapsed_to[static_cast<std::size_t>(
                    ways_.vertex(static_cast<std::size_t>(k)))];
                if (v >= 0)
                    ways.row(k) = moved.row(face::node_of(v, face::kSkin)) / face_.head().size;
            }
            out.col(i) = Eigen::Map<const Eigen::VectorXd>(ways.data(), ways.size());
        }
        return out;
    }

    face::Face& face_;
    const track::ChannelTable channels_;
    scene::LandmarkDisplacements ways_;
    const StrengthFitOptions options_;
    const ProgressMonitor& monitor_;
    std::vector<std::string> muscles_;
    rig::LipsDescription lips_;
    std::vector<std::pair<double*, double>> lip_ratios_;  // and their previous values
    std::vector<Expression> expressions_;
    Eigen::VectorXd z_, keep_;
};

}  // namespace

StrengthFit fit_strengths(face::Face& face, const rig::RigDescription& rig,
                          const scene::DisplacementTable& standard,
                          const StrengthFitOptions& options, const std::string& place,
                          const ProgressMonitor& monitor) {
    StrengthFit out = Fit(face, rig, standard, options, place, monitor).run();
    track::Drive rest;
    rest.excitation = Eigen::VectorXd::Zero(rig.channels().column_count());
    face.start([&](double) { return rest; });
    return out;
}

}  // namespace risorius::fitting
