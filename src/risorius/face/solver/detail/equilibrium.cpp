// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/equilibrium.h"

#include <utility>

#include "risorius/solve/energy_term.h"

namespace risorius::face {

namespace {

constexpr double kDifference = 2e-4;  // step of difference quotients / range of the parameter
constexpr int kCorrections = 4;
constexpr double kGain = 0.7,
                 kEnough = 0.01;  // of a correction: ratio to the one before, ratio to dx/dp

}  // namespace

Equilibrium::Equilibrium(FaceTissue& tissue, Prescribe set_boundary_conditions, Vertices vertices,
                         Eigen::VectorXd min)
    : tissue_(tissue),
      prescribe_(std::move(set_boundary_conditions)),
      vertices_(std::move(vertices)),
      min_(std::move(min)),
      solver_(tissue) {}

StepStats Equilibrium::solve_equilibrium(const Eigen::VectorXd& activation,
                                         const StaticOptions& options, Points& x) {
    moved();
    return solver_.solve_equilibrium(activation, options, x);
}

void Equilibrium::prepare(const Pose& pose) {
    prescribe_(pose.activation, pose.drive);
    tissue_.begin_rest(pose.x);
    tissue_.find_rest_contacts(pose.x);
    if (!factored_)
        solver_.factorise(pose.x, pose.activation, solve::Curvature::kExact,
                          solve::Precision::kDouble);
    factored_ = true;
}

Points Equilibrium::gradient(const Pose& pose, const Points& nodes,
                             const Eigen::VectorXd& activation, const track::Drive& drive) {
    prescribe_(activation, drive);
    tissue_.begin_rest(nodes);
    tissue_.find_rest_contacts(nodes);
    Points g;
    tissue_.static_energy(nodes, activation, g);
    prescribe_(pose.activation, pose.drive);
    tissue_.find_rest_contacts(pose.x);
    return g;
}

Points Equilibrium::solve(const Pose& pose, const Points& b) {
    prepare(pose);
    Points y;
    solver_.solve(b, y);
    return y;
}

std::vector<Points> Equilibrium::sensitivities(const Pose& pose, std::span<const int> columns,
                                               std::span<const track::Kinematic> channels) {
    prepare(pose);
    const std::vector<tissue::Contacts::Contact> found = tissue_.contacts().list();
    const Rigid mandible = tissue_.mandible();

    // The drive with one number slightly decreased or increased
    struct Nearby {
        Eigen::VectorXd activation;
        track::Drive drive;
        double away;
    };
    const auto nearby = [&](std::size_t which, double sign) {
        Nearby out{pose.activation, pose.drive, 0};
        if (which < columns.size()) {
            const int column = columns[which];
            out.away = sign * kDifference;
            if (pose.activation[column] + out.away < min_[column]) out.away = 0;
            out.activation[column] += out.away;
        } else {
            const auto channel = static_cast<std::size_t>(channels[which - columns.size()]);
            const track::KinematicChannel& range = track::kinematic_channels()[channel];
            out.away = sign * kDifference * (range.max - range.min);
            out.drive.kinematic[channel] += out.away;
        }
        return out;
    };

    const std::size_t count = columns.size() + channels.size();
    std::vector<Points> out(count);
    Points g, by_nodes, change;
    for (std::size_t p = 0; p < count; ++p) {
        const Nearby less = nearby(p, -1), more = nearby(p, 1);
        const double apart = more.away - less.away;
        const auto gradient_at = [&](const Nearby& there) {
            prescribe_(there.activation, there.drive);
            tissue_.ride_contacts(found, mandible);
            tissue_.static_energy(pose.x, there.activation, g);
            return g;
        };
        const Points above = gradient_at(more), below = gradient_at(less);
        solver_.solve((below - above) / apart, by_nodes);

        // Contact planes turn as tissue slides over them: correct for the gradient that is left with newly found contacts
        double before = by_nodes.norm();
        for (int correction = 0; correction < kCorrections; ++correction) {
            const auto found_anew = [&](const Nearby& there) {
                prescribe_(there.activation, there.drive);
                const Points x = pose.x + there.away * by_nodes;
                tissue_.find_rest_contacts(x);
                tissue_.static_energy(x, there.activation, g);
                return g;
            };
            const Points left = (found_anew(more) - found_anew(less)) / apart;
            solver_.solve(left, change);
            const double length = change.norm();
            if (!(length < kGain * before)) break;
            by_nodes -= change;
            before = length;
            if (length < kEnough * by_nodes.norm()) break;
        }
        out[p] = (vertices_(pose.x + more.away * by_nodes, more.activation, more.drive) -
                  vertices_(pose.x + less.away * by_nodes, less.activation, less.drive)) /
                 apart;
    }
    prescribe_(pose.activation, pose.drive);
    tissue_.ride_contacts(found, mandible);
    return out;
}

}  // namespace risorius::face
