// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/detail/jaw_dynamics.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace risorius::face {

namespace {

constexpr double kMass_kg =
    0.2;  // with teeth and the tissue that moves with it: Hannam et al. 2008
// About the centre of mass: transverse, upright and forward axis. Products of inertia are less than a tenth and are left out.
const Vec3 kInertia_kg_m2(182.2e-6, 125.2e-6, 92.19e-6);
const Vec3 kCentreOfMass_mm(0, -50, 48);  // estimate: two thirds of the way from condyles to chin
const Vec3 kHyoid_mm(0, -88, 38);
constexpr double kHyoidMass_kg = 0.01;
const Vec3 kHyoidAtFullOpening_mm(0, -10, -14);
constexpr double kFullTurn_rad = 32 * 3.14159265358979323846 / 180.0;
// Activation of the closing muscles of a resting jaw: 1 to 3 % is measured
constexpr double kTone = 0.012;
constexpr const char* kTonic[] = {"masseter_superficial", "masseter_deep", "temporalis_anterior",
                                  "temporalis_middle", "pterygoid_medial"};
constexpr double kSling_n_per_m = 40e3;
// Damping of joint, capsule and saliva; the surrounding tissue has its own
const JawVector kDamping_n_s_per_m = (JawVector() << 4, 10, 10, 20, 5, 5, 5).finished();
constexpr double kNewtonTolerance_m = 1e-9, kGoodEnough_m = 1e-7;
constexpr int kHalvings = 30;

}  // namespace

JawDynamics::MassPoints JawDynamics::still() {
    MassPoints out;
    out.fill(Vec3::Zero());
    return out;
}

JawDynamics::JawDynamics(const rig::Head& head, const rig::RigDescription& rig,
                         const std::set<std::string>& solids)
    : joint_(head, rig.jaw),
      muscles_(head, rig, solids),
      hyoid_at_full_opening_(head.mm(1.0) * kHyoidAtFullOpening_mm),
      columns_(rig.channels().column_count()) {
    // Six equal masses on the axes, at distances that give the moments of inertia
    const double volume = std::pow(head.size, 3);
    for (int k = 0; k < 3; ++k) {
        const double spread = 0.5 * kInertia_kg_m2.sum() - kInertia_kg_m2[k];
        const Vec3 out = head.size * std::sqrt(3 * spread / kMass_kg) * Vec3::Unit(k);
        rest_points_[2 * k] = head.mm(1.0) * kCentreOfMass_mm + out;
        rest_points_[2 * k + 1] = head.mm(1.0) * kCentreOfMass_mm - out;
        mass_[2 * k] = mass_[2 * k + 1] = volume * kMass_kg / 6;
    }
    rest_points_.back() = head.mm(1.0) * kHyoid_mm;
    mass_.back() = volume * kHyoidMass_kg;
    balance_rest();
}

void JawDynamics::balance_rest() {
    const auto gradient_at_rest = [&] {
        JawVector gradient;
        JawMatrix hessian;
        energy(begin(1.0, {}, relaxed()), JawVector::Zero(), gradient, hessian);
        return gradient;
    };
    // The pull of the tone beyond the weight presses the teeth together; the capsules hold the slides
    for (const JawMuscle& muscle : muscles_.list())
        if (std::find(std::begin(kTonic), std::end(kTonic), muscle.id) != std::end(kTonic))
            tonic_columns_.push_back(muscle.column);
    joint_.close_with(gradient_at_rest()[kOpen]);
    rest_load_ = -gradient_at_rest();
}

double JawDynamics::mass_kg() const {
    double sum = 0;
    for (int i = 0; i + 1 < kMassPoints; ++i) sum += mass_[i];
    return sum;
}

JawDynamics::MassPoints JawDynamics::mass_points(const JawPose& pose, const JawVector& q) const {
    MassPoints out;
    for (int i = 0; i + 1 < kMassPoints; ++i) out[i] = pose.motion * rest_points_[i];
    out.back() = rest_points_.back() + q.segment<3>(kHyoid);
    return out;
}

Eigen::VectorXd JawDynamics::with_tone(const Eigen::VectorXd& activation) const {
    Eigen::VectorXd out = activation;
    for (const JawMuscle& muscle : muscles_.list())
        if (muscle.tone_only) out[muscle.column] = 0;
    for (const int column : tonic_columns_) out[column] = std::min(1.0, out[column] + kTone);
    return out;
}

JawDynamics::Step JawDynamics::begin(double h, const State& state,
                                     const Eigen::VectorXd& activation,
                                     const Carriage& carriage) const {
    Step step;
    step.h = h;
    step.start = state.q;
    const JawPose pose = joint_.pose(state.q);
    step.from = mass_points(pose, state.q);
    for (int i = 0; i < kMassPoints; ++i) {
        step.from[i] = carriage.moved * step.from[i];
        step.aim[i] = step.from[i] + h * (carriage.moved.linear() * state.velocity[i]);
    }
    step.gravity_m_s2 = carriage.gravity_m_s2;
    step.drive = muscles_.drive(pose, state.q.segment<3>(kHyoid), with_tone(activation));
    const double opened = state.q[kOpen] / joint_.lever_m() / kFullTurn_rad;
    step.sling = std::clamp(opened, 0.0, 1.0) * hyoid_at_full_opening_;
    return step;
}

double JawDynamics::energy(const Step& step, const JawVector& q, JawVector& gradient,
                           JawMatrix& hessian) const {
    const JawPose pose = joint_.pose(q);
    const Vec3 hyoid = q.segment<3>(kHyoid);
    gradient.setZero();
    hessian.setZero();
    double sum = 0;

    // Inertia and weight
    const MassPoints points = mass_points(pose, q);
    for (int i = 0; i + 1 < kMassPoints; ++i) {
        const double inertia = mass_[i] / (step.h * step.h);
        const Vec3 off = points[i] - step.aim[i];
        sum += 0.5 * inertia * off.squaredNorm() - mass_[i] * step.gravity_m_s2.dot(points[i]);
        const Vec3 force = inertia * off - mass_[i] * step.gravity_m_s2;
        Eigen::Matrix<double, 3, kMandibleCoordinates> moves;
        for (int k = 0; k < kMandibleCoordinates; ++k) moves.col(k) = pose.velocity(k, points[i]);
        gradient.head<kMandibleCoordinates>() += moves.transpose() * force;
        hessian.topLeftCorner<kMandibleCoordinates, kMandibleCoordinates>() +=
            inertia * moves.transpose() * moves;
    }
    const double hyoid_inertia = mass_.back() / (step.h * step.h);
    const Vec3 off = points.back() - step.aim.back(), from_sling = hyoid - step.sling;
    sum +=
        0.5 * hyoid_inertia * off.squaredNorm() + 0.5 * kSling_n_per_m * from_sling.squaredNorm();
    gradient.segment<3>(kHyoid) += hyoid_inertia * off + kSling_n_per_m * from_sling;
    hessian.bottomRightCorner<3, 3>().diagonal().array() += hyoid_inertia + kSling_n_per_m;

    // Damping, and the constant forces that balance rest
    const JawVector moved = q - step.start;
    const JawVector drag = kDamping_n_s_per_m.cwiseProduct(moved) / step.h;
    sum += 0.5 * drag.dot(moved) + rest_load_.dot(q);
    gradient += drag + rest_load_;
    hessian.diagonal() += kDamping_n_s_per_m / step.h;

    sum += joint_.add_stops(q, pose, gradient, hessian);
    sum += muscles_.add_energy(step.drive, step.h, pose, hyoid, gradient, hessian);
    return sum;
}

JawDynamics::Report JawDynamics::minimise(const Step& step, JawVector& q, const JawLoad* load,
                                          int iterations) const {
    const auto evaluate = [&](const JawVector& at, JawVector& gradient, JawMatrix& hessian) {
        double e = energy(step, at, gradient, hessian);
        if (load) {
            const JawVector off = at - load->at, pull = load->stiffness * off;
            e += off.dot(load->gradient) + 0.5 * off.dot(pull);
            gradient += load->gradient + pull;
            hessian += load->stiffness;
        }
        return e;
    };
    Report report;
    JawVector gradient, trial_gradient;
    JawMatrix hessian, trial_hessian;
    double e = evaluate(q, gradient, hessian);
    while (report.iterations < iterations) {
        const JawVector direction = -solved_positive(hessian, gradient);
        const double slope = gradient.dot(direction);
        report.last_step_m = direction.norm();
        if (!(report.last_step_m > kNewtonTolerance_m)) break;
        double t = 1.0;
        bool accepted = false;
        for (int halving = 0; halving < kHalvings && !accepted; ++halving, t *= 0.5) {
            const JawVector trial = q + t * direction;
            const double lower = evaluate(trial, trial_gradient, trial_hessian);
            if (!(lower <= e + 1e-4 * t * slope)) continue;
            accepted = true;
            q = trial;
            e = lower;
            gradient = trial_gradient;
            hessian = trial_hessian;
        }
        ++report.iterations;
        if (!accepted) break;  // no lower energy within rounding
    }
    report.converged = report.last_step_m < kGoodEnough_m;
    return report;
}

JawDynamics::State JawDynamics::end(const Step& step, const JawVector& q) const {
    State out;
    out.q = q;
    const MassPoints now = mass_points(joint_.pose(q), q);
    for (int i = 0; i < kMassPoints; ++i) out.velocity[i] = (now[i] - step.from[i]) / step.h;
    return out;
}

JawDynamics::Report JawDynamics::advance(double h, const Eigen::VectorXd& activation,
                                         State& state) const {
    const Step step = begin(h, state, activation);
    JawVector q = state.q;
    const Report report = minimise(step, q);
    state = end(step, q);
    return report;
}

double JawDynamics::kinetic_energy_j(const State& state) const {
    double sum = 0;
    for (int i = 0; i < kMassPoints; ++i) sum += 0.5 * mass_[i] * state.velocity[i].squaredNorm();
    return sum;
}

double JawDynamics::potential_energy_j(const JawVector& q) const {
    // A step that starts here with zero velocity has neither inertia nor damping at q
    State here;
    here.q = q;
    Step step = begin(1.0, here, relaxed());
    JawVector gradient;
    JawMatrix hessian;
    return energy(step, q, gradient, hessian) +
           muscles_.active_energy_j(joint_.pose(q), q.segment<3>(kHyoid), with_tone(relaxed()));
}

}  // namespace risorius::face
