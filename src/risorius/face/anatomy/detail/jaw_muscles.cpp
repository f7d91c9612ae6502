// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/detail/jaw_muscles.h"

#include <array>
#include <cmath>

#include "risorius/rig/muscle_force.h"
#include "risorius/rig/muscle_path.h"

namespace risorius::face {

namespace {

using Body = rig::PathPoint::Body;

constexpr double kDamping = 0.05;  // b

Vec3 place_of(const JawMuscle::Point& point, const JawPose& pose, const Vec3& hyoid) {
    if (point.body == Body::kMandible) return pose.motion * point.rest;
    if (point.body == Body::kHyoid) return point.rest + hyoid;
    return point.rest;
}

double path_length(const JawMuscle& muscle, const JawPose& pose, const Vec3& hyoid) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < muscle.path.size(); ++i)
        length +=
            (place_of(muscle.path[i + 1], pose, hyoid) - place_of(muscle.path[i], pose, hyoid))
                .norm();
    return length;
}

// A tendon longer than its path is slack; the fibre is then as long as the muscle is thick.
double fibre_of(const JawMuscle& muscle, double path_m) {
    return std::hypot(std::max(0.0, path_m - muscle.slack_m), muscle.thickness_m);
}

JawMuscle placed(const rig::Head& head, const rig::Muscle& muscle, Side side, int column) {
    constexpr double kRadians = 3.14159265358979323846 / 180.0;
    JawMuscle out;
    out.id = muscle.id;
    out.side = side;
    out.column = column;
    out.f0_n = rig::line_force_n(muscle, head.size);
    const rig::MusclePath path =
        side == Side::kLeft ? muscle.paths.front() : rig::mirrored(muscle.paths.front());
    for (const rig::PathPoint& point : path) {
        if (point.body != Body::kSkull && point.body != Body::kMandible &&
            point.body != Body::kHyoid)
            throw Error("muscle " + muscle.id, "a path on skull, mandible and hyoid",
                        "another body");
        out.path.push_back({rig::place_on(head, point, muscle.id), point.body});
    }
    const double thickness = muscle.optimal_length_m * std::sin(muscle.pennation_deg * kRadians);
    const double fibre = muscle.rest_stretch * muscle.optimal_length_m;
    const double scale =
        path_length(out, JawPose(), Vec3::Zero()) /
        (muscle.tendon_slack_m + std::sqrt(std::max(0.0, fibre * fibre - thickness * thickness)));
    out.optimal_m = scale * muscle.optimal_length_m;
    out.slack_m = scale * muscle.tendon_slack_m;
    out.thickness_m = scale * thickness;
    out.max_speed_m_s = muscle.max_speed_hz * out.optimal_m;
    return out;
}

}  // namespace

JawMuscles::JawMuscles(const rig::Head& head, const rig::RigDescription& rig,
                       const std::set<std::string>& solids)
    : curves_(muscle::zajac_curves({.passive_strain = kJawPassiveStrain})) {
    const track::ChannelTable channels = rig.channels();
    for (const rig::Muscle& muscle : rig.muscles.muscles) {
        if ((muscle.group != "jaw" && muscle.group != "hyoid") || muscle.paths.empty()) continue;
        for (const Side side : {Side::kLeft, Side::kRight}) {
            muscles_.push_back(placed(head, muscle, side, channels.column(muscle.id, side)));
            muscles_.back().tone_only = solids.count(muscle.id) > 0;
        }
    }
}

double JawMuscles::fibre_length_m(std::size_t muscle, const JawPose& pose,
                                  const Vec3& hyoid) const {
    return fibre_of(muscles_[muscle], path_length(muscles_[muscle], pose, hyoid));
}

double JawMuscles::isometric_n(std::size_t muscle, const JawPose& pose, const Vec3& hyoid,
                               double activation) const {
    const JawMuscle& one = muscles_[muscle];
    const double stretch = fibre_length_m(muscle, pose, hyoid) / one.optimal_m;
    return one.f0_n * (activation * curves_.active.value(stretch) + curves_.passive.value(stretch));
}

std::vector<JawMuscles::Drive> JawMuscles::drive(const JawPose& pose, const Vec3& hyoid,
                                                 const Eigen::VectorXd& activation) const {
    std::vector<Drive> out;
    out.reserve(muscles_.size());
    for (std::size_t i = 0; i < muscles_.size(); ++i) {
        const double length = fibre_length_m(i, pose, hyoid);
        out.push_back(
            {activation[muscles_[i].column] * curves_.active.value(length / muscles_[i].optimal_m),
             length});
    }
    return out;
}

double JawMuscles::active_energy_j(const JawPose& pose, const Vec3& hyoid,
                                   const Eigen::VectorXd& activation) const {
    double energy = 0;
    for (std::size_t i = 0; i < muscles_.size(); ++i)
        energy +=
            activation[muscles_[i].column] * muscles_[i].f0_n * muscles_[i].optimal_m *
            curves_.active.at(fibre_length_m(i, pose, hyoid) / muscles_[i].optimal_m).integral;
    return energy;
}

double JawMuscles::add_energy(const std::vector<Drive>& drive, double h, const JawPose& pose,
                              const Vec3& hyoid, JawVector& gradient, JawMatrix& hessian) const {
    double energy = 0;
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
        const JawMuscle& muscle = muscles_[m];
        // Length of the path, its derivative, and the rotation of its segments
        double path = 0;
        JawVector along = JawVector::Zero();
        JawMatrix across = JawMatrix::Zero();
        Vec3 here = place_of(muscle.path[0], pose, hyoid);
        for (std::size_t i = 0; i + 1 < muscle.path.size(); ++i) {
            const Vec3 there = place_of(muscle.path[i + 1], pose, hyoid);
            const double length = (there - here).norm();
            if (muscle.path[i].body != muscle.path[i + 1].body && length > 0) {
                const Vec3 direction = (there - here) / length;
                Eigen::Matrix<double, 3, kJawCoordinates> apart =
                    Eigen::Matrix<double, 3, kJawCoordinates>::Zero();
                for (const auto& [point, at, sign] :
                     {std::tuple{i, here, -1.0}, {i + 1, there, 1.0}}) {
                    if (muscle.path[point].body == Body::kMandible)
                        for (int k = 0; k < kMandibleCoordinates; ++k)
                            apart.col(k) += sign * pose.velocity(k, at);
                    if (muscle.path[point].body == Body::kHyoid)
                        apart.rightCols<3>() += sign * Mat3::Identity();
                }
                const JawVector stretch = apart.transpose() * direction;
                along += stretch;
                across.noalias() +=
                    (apart.transpose() * apart - stretch * stretch.transpose()) / length;
            }
            path += length;
            here = there;
        }

        const double length = fibre_of(muscle, path);
        const double span = std::max(0.0, path - muscle.slack_m);
        const double slope = length > 0 ? span / length : 1.0;  // dl/dL
        const double reach = h * muscle.max_speed_m_s;
        const double speed = (length - drive[m].length_m) / reach;
        const auto velocity = curves_.velocity.at(speed);
        const muscle::Curve::Value passive = muscle.tone_only
                                                 ? muscle::Curve::Value()
                                                 : curves_.passive.at(length / muscle.optimal_m);
        const double damping = muscle.tone_only ? 0 : kDamping;
        energy += muscle.f0_n *
                  (drive[m].active * reach * velocity.integral +
                   muscle.optimal_m * passive.integral + 0.5 * damping * reach * speed * speed);
        const double tension =
            muscle.f0_n * (drive[m].active * velocity.value + passive.value + damping * speed);
        const double stiffness =
            muscle.f0_n * ((drive[m].active * velocity.slope + damping) / reach +
                           passive.slope / muscle.optimal_m);
        gradient += tension * slope * along;
        hessian.noalias() += (stiffness * slope * slope) * along * along.transpose();
        if (tension > 0) {
            hessian.noalias() += (tension * slope) * across;
            if (length > 0)
                hessian.noalias() +=
                    (tension * (1 - slope * slope) / length) * along * along.transpose();
        }
    }
    return energy;
}

}  // namespace risorius::face
