// SPDX-License-Identifier: MIT
#include "risorius/inverse/fit_activations.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "risorius/core/progress_monitor.h"
#include "risorius/face/statics.h"
#include "risorius/solve/box_quadratic.h"

namespace risorius::inverse {

namespace {

// The V x 3 displacement, scaled by the square root of the area, as one vector over vertices with weight
class Weighting {
  public:
    explicit Weighting(const Eigen::VectorXd& area) {
        for (long v = 0; v < area.size(); ++v)
            if (area[v] > 0) {
                vertex_.push_back(v);
                root_.push_back(std::sqrt(area[v]));
            }
    }
    Eigen::VectorXd operator()(const Points& field) const {
        Eigen::VectorXd out(3 * static_cast<long>(vertex_.size()));
        for (std::size_t i = 0; i < vertex_.size(); ++i)
            out.segment<3>(3 * static_cast<long>(i)) = root_[i] * field.row(vertex_[i]).transpose();
        return out;
    }

  private:
    std::vector<long> vertex_;
    std::vector<double> root_;
};

}  // namespace

double value_of(const ActivationUnknown& unknown, const track::Drive& drive) {
    if (!unknown.columns.empty()) {
        double sum = 0;
        for (const int column : unknown.columns) sum += drive.excitation[column];
        return sum / static_cast<double>(unknown.columns.size());
    }
    return drive.at(unknown.channels.front()) / unknown.scale;
}

void set_value(const ActivationUnknown& unknown, double value, track::Drive& drive) {
    for (const int column : unknown.columns) drive.excitation[column] = value;
    for (const track::Kinematic channel : unknown.channels)
        drive.kinematic[static_cast<std::size_t>(channel)] = value * unknown.scale;
}

std::vector<ActivationUnknown> activation_unknowns(const rig::RigDescription& rig,
                                                   const track::Drive& begin, bool sided) {
    const track::ChannelTable channels = rig.channels();
    std::set<std::string> moves{"levator_palpebrae_superioris", "superior_tarsal"};
    for (const rig::MuscleBand& band : rig.atlas.bands) moves.insert(band.muscle);
    std::vector<ActivationUnknown> out;
    for (const track::MuscleChannel& muscle : channels.muscles) {
        if (!moves.count(muscle.id)) continue;
        const int left = channels.column(muscle.id, Side::kLeft),
                  right = channels.column(muscle.id, Side::kRight);
        ActivationUnknown unknown;
        unknown.min = muscle.min;
        if (!sided || left == right) {
            unknown.name = muscle.id;
            unknown.columns =
                left == right ? std::vector<int>{left} : std::vector<int>{left, right};
            out.push_back(unknown);
        } else {
            for (const int column : {left, right}) {
                unknown.name = muscle.id + (column == left ? ".l" : ".r");
                unknown.columns = {column};
                out.push_back(unknown);
            }
        }
    }
    const auto channel = [&](track::Kinematic which) {
        const track::KinematicChannel& range =
            track::kinematic_channels()[static_cast<std::size_t>(which)];
        const double scale = range.max;
        out.push_back({.name = std::string(range.name),
                       .columns = {},
                       .channels = {which},
                       .min = range.min / scale,
                       .max = 1,
                       .scale = scale});
    };
    channel(track::Kinematic::kJawOpen);
    channel(track::Kinematic::kJawForward);
    if (sided || begin.at(track::Kinematic::kJawSide) != 0) channel(track::Kinematic::kJawSide);
    if (begin.at(track::Kinematic::kMouthPressure) != 0) {
        channel(track::Kinematic::kMouthPressure);
        out.back().min = std::max(out.back().min, 0.0);
    }
    return out;
}

track::Drive fit_activations(face::Face& face, const std::vector<ActivationUnknown>& unknowns,
                             const Points& measured, const Eigen::VectorXd& area,
                             const track::Drive& begin, const ActivationFitOptions& options) {
    const Weighting weighted(area);
    const Eigen::VectorXd goal = weighted(measured);
    const double size = options.size > 0 ? options.size : goal.squaredNorm();
    const Points& rest = face.head().vertices;
    const long count = static_cast<long>(unknowns.size());

    track::Drive drive = begin;
    Eigen::VectorXd x(count);
    for (long i = 0; i < count; ++i) x[i] = value_of(unknowns[static_cast<std::size_t>(i)], begin);
    const auto equilibrium_miss = [&](const Eigen::VectorXd& at) {
        for (long i = 0; i < count; ++i)
            set_value(unknowns[static_cast<std::size_t>(i)], at[i], drive);
        face.solve_equilibrium(drive.excitation, drive, options.rest);
        if (options.rest.stopped && options.rest.stopped()) throw Interrupted();
        return Eigen::VectorXd(weighted(face.pose().vertices - rest) - goal);
    };
    const auto cost = [&](const Eigen::VectorXd& miss, const Eigen::VectorXd& at) {
        return 0.5 * miss.squaredNorm() / size + options.l1_weight * at.lpNorm<1>() +
               0.5 * options.l2_weight * at.squaredNorm() +
               (options.keep > 0 ? 0.5 * options.keep * (at - options.near).squaredNorm() : 0.0);
    };
    Eigen::VectorXd miss = equilibrium_miss(x);
    double min = cost(miss, x);
    double longest = options.longest_step;
    for (int round = 0; round < options.rounds && longest > 0.01; ++round) {
        std::vector<int> columns;
        std::vector<track::Kinematic> channels;
        for (const ActivationUnknown& unknown : unknowns) {
            columns.insert(columns.end(), unknown.columns.begin(), unknown.columns.end());
            channels.insert(channels.end(), unknown.channels.begin(), unknown.channels.end());
        }
        const std::vector<Points> moved = face.statics().sensitivities(columns, channels);
        Eigen::MatrixXd J = Eigen::MatrixXd::Zero(goal.size(), count);
        std::size_t by_column = 0, by_channel = columns.size();
        for (long i = 0; i < count; ++i) {
            const ActivationUnknown& unknown = unknowns[static_cast<std::size_t>(i)];
            for (std::size_t k = 0; k < unknown.columns.size(); ++k)
                J.col(i) += weighted(moved[by_column++]);
            for (std::size_t k = 0; k < unknown.channels.size(); ++k)
                J.col(i) += unknown.scale * weighted(moved[by_channel++]);
        }
        solve::BoxQuadratic problem;
        problem.A = J.transpose() * J / size;
        problem.A.diagonal().array() += options.l2_weight + options.keep;
        // The model is written in the new value instead of the change from x, so that the L1 penalty counts from 0.
        problem.b = J.transpose() * (miss - J * x) / size;
        if (options.keep > 0) problem.b -= options.keep * options.near;
        problem.l1_weight = Eigen::VectorXd::Constant(count, options.l1_weight);
        bool better = false;
        while (!better && longest > 0.01) {
            problem.min.resize(count);
            problem.max.resize(count);
            for (long i = 0; i < count; ++i) {
                const ActivationUnknown& unknown = unknowns[static_cast<std::size_t>(i)];
                problem.min[i] = std::max(unknown.min, x[i] - longest);
                problem.max[i] = std::min(unknown.max, x[i] + longest);
            }
            Eigen::VectorXd next = x;
            solve::minimise(problem, next);
            const Eigen::VectorXd next_miss = equilibrium_miss(next);
            const double next_cost = cost(next_miss, next);
            better = next_cost < min;
            if (!better) {
                longest *= 0.4;
                continue;
            }
            const double gain = (min - next_cost) / min;
            x = next;
            miss = next_miss;
            min = next_cost;
            if (gain < options.min_gain) longest = 0;
        }
    }
    equilibrium_miss(x);
    return drive;
}

}  // namespace risorius::inverse
