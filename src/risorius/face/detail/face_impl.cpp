// SPDX-License-Identifier: MIT
#include "risorius/face/detail/face_impl.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "risorius/core/error.h"
#include "risorius/face/skin/detail/head_motion.h"

namespace risorius::face {

namespace {

constexpr int kMemory = 6;
constexpr double kStepCap_m = 6e-3;
// Far below the error of a step. A held pose comes to rest there, instead of looking for decreases of the energy that rounding hides.
constexpr double kShortestMove_m = 1e-7;
// A drive that bends more than this within two substeps has jumped: of the range of a kinematic channel, and of an activation.
constexpr double kJump = 0.1, kActivationJump = 0.5;

}  // namespace

FaceImpl::FaceImpl(const rig::RigDescription& rig_description,
                   const geom::PolygonMesh& polygon_mesh, const Quality& q,
                   const std::string& place)
    : rig(rig_description),
      quality(q),
      substeps(std::max(1, static_cast<int>(std::ceil(q.step_s / q.max_substep_s - 1e-6)))),
      substep_s(q.step_s / substeps),
      head(rig::place_head(rig, polygon_mesh, place)),
      lids{EyeLids(head, 0, rig.eyes.lid_closed_fraction),
           EyeLids(head, 1, rig.eyes.lid_closed_fraction)},
      jaw(head, rig.jaw),
      shell(drop_unsupported_vertices(build_shell(head, jaw, lids, {q.shell_vertices}), head, rig,
                                      lids)),
      mesh(build_tissue_mesh(head, rig, shell, lids)),
      tissue(head, rig, jaw, lids, shell, mesh),
      driven_jaw(head, rig, jaw),
      neck(head),
      motion(neck, tissue.rest(), substep_s),
      channels(rig.channels()) {
    tissue.step_in(quality.precision);
    tissue.refine_mouth(quality.mouth_passes);
    tissue.prepare(motion.effective_step_s());
    poser.emplace(head, rig, jaw, driven_jaw.joint(), lids, shell, mesh);
    dynamics.emplace(rig.muscles.activation_s(), rig.muscles.deactivation_s(),
                     muscle::ActivationLaw{.form = rig.activation.law == "smooth"
                                                       ? muscle::ActivationLaw::Form::kSmooth
                                                       : muscle::ActivationLaw::Form::kThelen2003,
                                           .steepness = rig.activation.steepness});
    now.x = tissue.rest();
    now.activation = Eigen::VectorXd::Zero(channels.column_count());
    now.drive.excitation = now.activation;
    before = earlier = now;
    equilibrium.emplace(
        tissue,
        [this](const Eigen::VectorXd& a, const track::Drive& d) { set_boundary_conditions(a, d); },
        [this](const Points& x, const Eigen::VectorXd& a, const track::Drive& d) {
            return pose_of({x, a, d, {}}).vertices;
        },
        channels.column_min());
}

track::Drive FaceImpl::complete(track::Drive drive) const {
    if (drive.excitation.size() == 0)
        drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
    const auto check = [&](const char* what, const Eigen::VectorXd& values) {
        if (values.size() != channels.column_count())
            throw Error(std::string("drive: ") + what,
                        std::to_string(channels.column_count()) +
                            " values, one for each column of the rig's channels",
                        std::to_string(values.size()));
    };
    check("excitation", drive.excitation);
    if (drive.activation.size() > 0) check("activation", drive.activation);
    if (!drive.excitation.allFinite())
        throw Error("drive: excitation", "finite numbers", "NaN or infinity");
    return drive;
}

Eigen::VectorXd FaceImpl::steady_activation(const track::Drive& drive) const {
    Eigen::VectorXd activation = driven_jaw.excitation(drive.excitation, drive);
    for (long i = 0; i < drive.activation.size(); ++i)
        if (!std::isnan(drive.activation[i])) activation[i] = drive.activation[i];
    return activation;
}

Vec3 FaceImpl::gravity_at(const track::Drive& drive) const {
    if (!gravity) return JawDynamics::upright_gravity();
    return head_motion(head, drive).linear().transpose() * *gravity;
}

// A turn about the upright axis changes nothing except for rounding, hence the threshold.
Vec3 FaceImpl::weight_at(const track::Drive& drive) const {
    const Vec3 weight = gravity_at(drive) - JawDynamics::upright_gravity();
    return weight.norm() < 1e-9 ? Vec3(Vec3::Zero()) : weight;
}

BoundaryState FaceImpl::boundary_state(const Eigen::VectorXd& activation,
                                       const track::Drive& drive) const {
    return {driven_jaw.motion(now.jaw.q, drive),
            poser->lids(activation, drive),
            drive.at(track::Kinematic::kMouthPressure),
            poser->gaze(drive),
            weight_at(drive),
            pull_springs(drive)};
}

// The nodes start where the bone carries them, so that the solver does not have to catch up with a fast jaw.
void FaceImpl::set_boundary_conditions(Points& x, const Eigen::VectorXd& activation,
                                       const track::Drive& drive) {
    tissue.carry_with_bone(x, driven_jaw.motion(now.jaw.q, now.drive),
                           driven_jaw.motion(now.jaw.q, drive));
    set_boundary_conditions(activation, drive);
}

void FaceImpl::set_boundary_conditions(const Eigen::VectorXd& activation,
                                       const track::Drive& drive) {
    tissue.set_boundary_conditions(boundary_state(activation, drive));
}

StepStats FaceImpl::solve_equilibrium(const Eigen::VectorXd& activation, const track::Drive& drive,
                                      const StaticOptions& options) {
    Points x = now.x;
    set_boundary_conditions(x, activation, drive);
    const StepStats figures = driven_jaw.by_muscles()
                                  ? driven_jaw.solve_equilibrium(
                                        tissue, activation, gravity_at(drive), options, x, now.jaw)
                                  : equilibrium->solve_equilibrium(activation, options, x);
    now.x = x;
    now.activation = activation;
    now.drive = drive;
    last_move.resize(0, 3);
    motion.start(now.x, head_motion(head, drive));
    before = earlier = now;
    in_step = false;
    return figures;
}

StepStats FaceImpl::substep(const DriveAt& drive_at) {
    const double from = static_cast<double>(done) * substep_s,
                 to = static_cast<double>(done + 1) * substep_s;
    const track::Drive drive = complete(drive_at(to));
    Eigen::VectorXd excitation;
    dynamics->advance(
        [&](double t) -> const Eigen::VectorXd& {
            const track::Drive then = complete(drive_at(t));
            excitation = driven_jaw.excitation(then.excitation, then);
            return excitation;
        },
        drive.activation, from, to);
    const Eigen::VectorXd activation = dynamics->activation();

    earlier = std::move(before);
    before = now;
    Points x = now.x;
    const TissueMotion::Step& moves = motion.begin(head_motion(head, drive));
    const double h = motion.effective_step_s();
    tissue.fibres().begin_step(moves.start, moves.expected, h);
    set_boundary_conditions(x, activation, drive);
    tissue.find_contacts(x);
    const Points carried = x;
    // The move of the last substep usually continues, so it is the first curvature pair of L-BFGS. A move that reversed the
    // one before is left out: with it the nodes would oscillate.
    const std::span<const Points> warm_start(&last_move,
                                             last_move.rows() > 0 && !went_back ? 1 : 0);
    const StepStats figures = driven_jaw.implicit_step(tissue, h, substep_s, moves.start, moves.aim,
                                                       activation, {moves.moved, gravity_at(drive)},
                                                       {.iterations = quality.iterations,
                                                        .min_iterations = quality.min_iterations,
                                                        .memory = kMemory,
                                                        .pairs = quality.precision,
                                                        .step_cap_m = kStepCap_m,
                                                        .tolerance_rms_m = quality.tolerance_rms_m,
                                                        .shortest_m = kShortestMove_m,
                                                        .trust_last = quality.tolerance_rms_m == 0},
                                                       x, now.jaw, warm_start);
    Points move = x - carried;
    went_back = last_move.rows() > 0 && last_move.cwiseProduct(move).sum() < 0;
    last_move.swap(move);
    tissue.fibres().end_step();
    motion.end(x);
    equilibrium->moved();
    in_step = true;
    now.x = x;
    now.activation = activation;
    now.drive = drive;
    ++done;
    history.push_back(figures);
    return figures;
}

bool FaceImpl::jumped() const {
    const auto bend = [](double e, double b, double n) { return std::abs(n - 2 * b + e); };
    const auto& channel = track::kinematic_channels();
    for (std::size_t k = 0; k < channel.size(); ++k)
        if (bend(earlier.drive.kinematic[k], before.drive.kinematic[k], now.drive.kinematic[k]) >
            kJump * (channel[k].max - channel[k].min))
            return true;
    return ((now.activation - 2 * before.activation + earlier.activation).array().abs() >
            kActivationJump)
        .any();
}

StateWeights FaceImpl::weights(double fraction) const {
    return jumped() ? straight(fraction) : smooth(fraction);
}

track::Drive FaceImpl::drive_between(const StateWeights& w) const {
    track::Drive drive = now.drive;
    const auto& channel = track::kinematic_channels();
    for (std::size_t k = 0; k < drive.kinematic.size(); ++k)
        drive.kinematic[k] = std::clamp(
            w.of(earlier.drive.kinematic[k], before.drive.kinematic[k], now.drive.kinematic[k]),
            channel[k].min, channel[k].max);
    return drive;
}

double FaceImpl::fraction_of_step(double t_s) const {
    if (how == Motion::kQuasiStatic) return 1.0;
    return 1.0 - (static_cast<double>(done) - substeps_until(t_s));
}

void FaceImpl::make_surfaces() {
    if (ribbons) return;
    ribbons.emplace(head, rig, tissue.muscles(), surfaces);
    tissue.solids().add_surfaces(surfaces);
}

Points FaceImpl::muscle_vertices(double fraction) {
    make_surfaces();
    const State state = between(fraction);
    const JawVector& q = state.jaw.q;
    Points vertices = surfaces.rest;
    const Points x = shown(state);
    ribbons->place(x,
                   {driven_jaw.motion(q, state.drive),
                    driven_jaw.by_muscles() ? Vec3(q.segment<3>(kHyoid)) : Vec3::Zero()},
                   vertices);
    tissue.solids().place_surfaces(x, vertices);
    poser->turn_with_head(head_motion(head, state.drive), surfaces.rest, vertices);
    return vertices;
}

FaceImpl::State FaceImpl::between(double fraction) const {
    const StateWeights w = weights(fraction);
    return {w.of(earlier.x, before.x, now.x),
            activation_between(fraction),
            drive_between(w),
            {.q = w.of(earlier.jaw.q, before.jaw.q, now.jaw.q)}};
}

Eigen::VectorXd FaceImpl::activation_between(double fraction) const {
    return weights(fraction)
        .of(earlier.activation, before.activation, now.activation)
        .cwiseMax(channels.column_min())
        .cwiseMin(1.0);
}

Points FaceImpl::shown(const State& state) const {
    return in_step
               ? tissue.resolve_penetration(state.x, driven_jaw.motion(state.jaw.q, state.drive),
                                            poser->gaze(state.drive))
               : state.x;
}

FacePose FaceImpl::pose(double fraction) const {
    State state = between(fraction);
    state.x = shown(state);
    return pose_of(state);
}

Equilibrium::Pose FaceImpl::equilibrium_pose() const {
    if (driven_jaw.by_muscles())
        throw std::logic_error("an equilibrium's slopes while muscles move the jaw");
    return {now.x, now.activation, now.drive};
}

FacePose FaceImpl::pose_of(const State& state) const {
    const JawVector& q = state.jaw.q;
    FacePose out =
        poser->pose({state.x, state.activation, state.drive, driven_jaw.motion(q, state.drive)});
    driven_jaw.report(q, out);
    return out;
}

void FaceImpl::forget() {
    done = 0;
    history.clear();
    tissue.forget_contacts();
    equilibrium->forget();
    tissue.solids().forget();
    last_move.resize(0, 3);
}

void FaceImpl::start(const DriveAt& drive) {
    const track::Drive first = complete(drive(0.0));
    const Eigen::VectorXd activation = steady_activation(first);
    forget();
    dynamics->set_activation(activation);
    const bool at_rest = activation.isZero(0.0) &&
                         driven_jaw.wanted(first).isApprox(Rigid::Identity(), 0.0) &&
                         first.pulls.empty() && first.at(track::Kinematic::kMouthPressure) == 0.0 &&
                         weight_at(first).isZero(0.0);
    now.x = tissue.rest();
    now.drive.kinematic.fill(0.0);
    now.jaw = {};
    motion.start(now.x, head_motion(head, first));
    if (at_rest) {
        now.activation = activation;
        now.drive = first;
        Points x = now.x;  // a face used before may have left its jaw elsewhere
        set_boundary_conditions(x, activation, first);
        before = earlier = now;
        in_step = false;
    } else {
        solve_equilibrium(activation, first, {.iterations = kRestIterations});
    }
}

void FaceImpl::go_back_to(State found) {
    if (driven_jaw.by_muscles())
        throw std::logic_error("a kept equilibrium while muscles move the jaw");
    forget();
    equilibrium->forget(true);
    dynamics->set_activation(found.activation);
    now = std::move(found);
    set_boundary_conditions(now.activation, now.drive);
    motion.start(now.x, head_motion(head, now.drive));
    before = earlier = now;
    in_step = false;
}

FaceImpl::Kept FaceImpl::keep() const {
    return {now,
            before,
            earlier,
            motion.past(),
            last_move,
            went_back,
            in_step,
            done,
            tissue.contacts().memory(),
            tissue.solids().factorised()};
}

void FaceImpl::go_back_to(const Kept& then) {
    equilibrium->forget(true);
    dynamics->set_activation(then.now.activation);
    now = then.now;
    before = then.before;
    earlier = then.earlier;
    motion.go_back_to(then.motion);
    last_move = then.last_move;
    went_back = then.went_back;
    in_step = then.in_step;
    done = then.done;
    history.resize(std::min(history.size(), static_cast<std::size_t>(done)));
    tissue.recall_contacts(then.contacts);
    tissue.solids().go_back_to(then.solids);
    set_boundary_conditions(now.activation, now.drive);
}

double FaceImpl::substeps_until(double t_s) const {
    const double place = t_s / substep_s;
    const double nearest = std::round(place);
    return std::abs(place - nearest) < 1e-6 ? nearest : place;
}

}  // namespace risorius::face
