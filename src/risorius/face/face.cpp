// SPDX-License-Identifier: MIT
#include "risorius/face/face.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

#include "risorius/core/known_names.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/skin/detail/face_poser.h"
#include "risorius/face/skin/detail/head_motion.h"
#include "risorius/face/solver/detail/driven_jaw.h"
#include "risorius/face/solver/detail/face_statics.h"
#include "risorius/face/solver/detail/face_tissue.h"
#include "risorius/face/solver/detail/tissue_motion.h"
#include "risorius/face/view/detail/muscle_ribbons.h"
#include "risorius/muscle/activation.h"
#include "risorius/track/channels.h"

namespace risorius::face {

namespace {

constexpr int kMemory = 6;
constexpr double kStepCap_m = 6e-3;

// A frame that falls on a step shows that step, whatever rounding made of its time.
double exact_step(double t_s, double step_s) {
    const double place = t_s / step_s;
    const double nearest = std::round(place);
    return std::abs(place - nearest) < 1e-6 ? nearest : place;
}

}  // namespace

Quality quality_named(const std::string& name) {
    if (name == "draft")
        return {.name = "draft",
                .iterations = 8,
                .mouth_passes = 10,
                .step_s = 2 * kStep_s,
                .max_substep_s = 2 * kStep_s};
    if (name == "preview") return {.name = "preview", .iterations = 6, .mouth_passes = 9};
    if (name == "video")
        return {.name = "video",
                .iterations = 80,
                .min_iterations = 4,
                .tolerance_rms_m = 0.0025e-3,
                .max_substep_s = kStep_s / 2};
    if (name == "fine")
        return {.name = "fine",
                .shell_vertices = 1700,
                .iterations = 120,
                .min_iterations = 4,
                .tolerance_rms_m = 0.0025e-3,
                .max_substep_s = kStep_s / 2};
    throw Error(option_name("quality"),
                "\"draft\", \"preview\", \"video\" or \"fine\"" +
                    did_you_mean(name, {"draft", "preview", "video", "fine"}),
                "\"" + name + "\"");
}

struct Face::Impl {
    rig::RigDescription rig;
    Quality quality;
    int substeps;      // of a step
    double substep_s;  // what is solved at once
    double build_s = 0;
    rig::Head head;
    std::array<EyeLids, 2> lids;
    Jaw jaw;
    Shell shell;
    TissueMesh mesh;
    FaceTissue tissue;
    std::optional<FacePoser> poser;

    // State: now and one step before, for frames between steps
    struct State {
        Points x;
        Eigen::VectorXd activation;
        track::Drive drive;
        JawDynamics::State jaw;  // when muscles move it
    };
    State now, before;
    std::optional<FaceStatics> statics;
    DrivenJaw driven_jaw;
    bool went_back = false;  // the last piece, on the one before
    Points last_move;        // of x within the last piece against what rides on bone, or no rows
    Neck neck;
    TissueMotion motion;
    std::optional<Vec3> gravity{JawDynamics::upright_gravity()};
    Motion how = Motion::kDynamic;
    long done = 0;         // pieces
    bool in_step = false;  // since it last was at rest
    std::vector<StepStats> history;
    std::optional<muscle::ActivationDynamics> dynamics;
    track::ChannelTable channels;
    MuscleSurfaces surfaces;
    std::optional<MuscleRibbons> straps;  // of the surfaces, when they were asked for

    Impl(const rig::RigDescription& rig_description, const geom::PolygonMesh& polygon_mesh,
         const Quality& q, const std::string& place)
        : rig(rig_description),
          quality(q),
          substeps(std::max(1, static_cast<int>(std::ceil(q.step_s / q.max_substep_s - 1e-6)))),
          substep_s(q.step_s / substeps),
          head(rig::place_head(rig, polygon_mesh, place)),
          lids{EyeLids(head, 0, rig.eyes.lid_closed_fraction),
               EyeLids(head, 1, rig.eyes.lid_closed_fraction)},
          jaw(head, rig.jaw),
          shell(drop_unsupported_vertices(build_shell(head, jaw, lids, {q.shell_vertices}), head,
                                          rig, lids)),
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
        dynamics.emplace(
            rig.muscles.activation_s(), rig.muscles.deactivation_s(),
            muscle::ActivationLaw{.form = rig.activation.law == "smooth"
                                              ? muscle::ActivationLaw::Form::kSmooth
                                              : muscle::ActivationLaw::Form::kThelen2003,
                                  .steepness = rig.activation.steepness});
        now.x = tissue.rest();
        now.activation = Eigen::VectorXd::Zero(channels.column_count());
        now.drive.excitation = now.activation;
        before = now;
        statics.emplace(
            tissue,
            [this](const Eigen::VectorXd& a, const track::Drive& d) {
                set_boundary_conditions(a, d);
            },
            [this](const Points& x, const Eigen::VectorXd& a, const track::Drive& d) {
                return pose_of({x, a, d, {}}).vertices;
            },
            channels.column_min());
    }

    // A drive as constructed has no excitation: nothing is active.
    track::Drive complete(track::Drive drive) const {
        if (drive.excitation.size() == 0)
            drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
        return drive;
    }

    // What activation comes to if the drive lasts.
    Eigen::VectorXd steady_activation(const track::Drive& drive) const {
        Eigen::VectorXd activation = driven_jaw.excitation(drive.excitation, drive);
        for (long i = 0; i < drive.activation.size(); ++i)
            if (!std::isnan(drive.activation[i])) activation[i] = drive.activation[i];
        return activation;
    }

    JawVector jaw_between(double fraction) const {
        return (1 - fraction) * before.jaw.q + fraction * now.jaw.q;
    }

    // In the frame of the head; what rest bears if weight is not to turn.
    Vec3 gravity_at(const track::Drive& drive) const {
        if (!gravity) return JawDynamics::upright_gravity();
        return head_motion(head, drive).linear().transpose() * *gravity;
    }

    // What of it the rest shape does not bear; a turn about the upright axis leaves none, rounding aside.
    Vec3 weight_at(const track::Drive& drive) const {
        const Vec3 weight = gravity_at(drive) - JawDynamics::upright_gravity();
        return weight.norm() < 1e-9 ? Vec3(Vec3::Zero()) : weight;
    }

    BoundaryState prescribed(const Eigen::VectorXd& activation, const track::Drive& drive) const {
        return {driven_jaw.motion(now.jaw.q, drive), poser->lids(activation, drive),
                drive.at(track::Kinematic::kMouthPressure), poser->gaze(drive), weight_at(drive)};
    }

    // Moves bone, lids and air to where the drive wants them, and x with the bone, so that a fast jaw need not be chased.
    void set_boundary_conditions(Points& x, const Eigen::VectorXd& activation,
                                 const track::Drive& drive) {
        tissue.carry_with_bone(x, driven_jaw.motion(now.jaw.q, now.drive),
                               driven_jaw.motion(now.jaw.q, drive));
        set_boundary_conditions(activation, drive);
    }
    void set_boundary_conditions(const Eigen::VectorXd& activation, const track::Drive& drive) {
        tissue.set_boundary_conditions(prescribed(activation, drive));
    }

    StepStats solve_equilibrium(const Eigen::VectorXd& activation, const track::Drive& drive,
                                const StaticOptions& options) {
        Points x = now.x;
        set_boundary_conditions(x, activation, drive);
        const StepStats figures =
            driven_jaw.by_muscles()
                ? driven_jaw.solve_equilibrium(tissue, activation, gravity_at(drive), options, x,
                                               now.jaw)
                : statics->solve_equilibrium(activation, options, x);
        now.x = x;
        now.activation = activation;
        now.drive = drive;
        last_move.resize(0, 3);
        motion.start(now.x, head_motion(head, drive));
        before = now;
        in_step = false;
        return figures;
    }

    /// To keep up, volume muscles need twice as many, a jaw that muscles move once more as many.
    int iterations() const {
        const int times = 1 + (tissue.solids().empty() ? 0 : 1) + (driven_jaw.by_muscles() ? 1 : 0);
        return times * quality.iterations;
    }

    StepStats substep(const DriveAt& drive_at) {
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

        before = now;
        Points x = now.x;
        const TissueMotion::Step& moves = motion.begin(head_motion(head, drive));
        const double h = motion.effective_step_s();
        tissue.fibres().begin_step(moves.start, moves.expected, h);
        set_boundary_conditions(x, activation, drive);
        tissue.find_contacts(x);
        const Points carried = x;
        // The move of the piece before is likely to go on: its curvature is the first the search knows.
        // One that went back on the one before is not: it would be sent to and fro.
        const std::span<const Points> warm_start(&last_move,
                                                 last_move.rows() > 0 && !went_back ? 1 : 0);
        const StepStats figures =
            driven_jaw.implicit_step(tissue, h, substep_s, moves.start, moves.aim, activation,
                                     {moves.moved, gravity_at(drive)},
                                     {.iterations = iterations(),
                                      .min_iterations = quality.min_iterations,
                                      .memory = kMemory,
                                      .pairs = quality.precision,
                                      .step_cap_m = kStepCap_m,
                                      .tolerance_rms_m = quality.tolerance_rms_m,
                                      .trust_last = quality.tolerance_rms_m == 0},
                                     x, now.jaw, warm_start);
        Points move = x - carried;
        went_back = last_move.rows() > 0 && last_move.cwiseProduct(move).sum() < 0;
        last_move.swap(move);
        tissue.fibres().end_step();
        motion.end(x);
        statics->moved();
        in_step = true;
        now.x = x;
        now.activation = activation;
        now.drive = drive;
        ++done;
        history.push_back(figures);
        return figures;
    }

    // Linear between the last two steps; the drives that move bone and lids are interpolated, not their results.
    track::Drive drive_between(double fraction) const {
        track::Drive drive = now.drive;
        for (std::size_t k = 0; k < drive.kinematic.size(); ++k)
            drive.kinematic[k] =
                (1 - fraction) * before.drive.kinematic[k] + fraction * now.drive.kinematic[k];
        return drive;
    }

    // Where t lies between the last two steps, 0..1
    double fraction_of_step(double t_s) const {
        if (how == Motion::kQuasiStatic) return 1.0;
        return 1.0 - (static_cast<double>(done) - exact_step(t_s, substep_s));
    }

    void make_surfaces() {
        if (straps) return;
        straps.emplace(head, rig, tissue.muscles(), surfaces);
        tissue.solids().add_surfaces(surfaces);
    }

    Points muscle_vertices(double fraction) {
        make_surfaces();
        const State state = between(fraction);
        const JawVector& q = state.jaw.q;
        Points vertices = surfaces.rest;
        const Points x = shown(state);
        straps->place(x,
                      {driven_jaw.motion(q, state.drive),
                       driven_jaw.by_muscles() ? Vec3(q.segment<3>(kHyoid)) : Vec3::Zero()},
                      vertices);
        tissue.solids().place_surfaces(x, vertices);
        poser->turn_with_head(head_motion(head, state.drive), surfaces.rest, vertices);
        return vertices;
    }

    State between(double fraction) const {
        return {(1 - fraction) * before.x + fraction * now.x,
                (1 - fraction) * before.activation + fraction * now.activation,
                drive_between(fraction),
                {.q = jaw_between(fraction)}};
    }

    // Nodes as they are shown: steps leave surfaces in each other, equilibria hardly.
    Points shown(const State& state) const {
        return in_step ? tissue.resolve_penetration(state.x,
                                                    driven_jaw.motion(state.jaw.q, state.drive),
                                                    poser->gaze(state.drive))
                       : state.x;
    }

    FacePose pose(double fraction) const {
        State state = between(fraction);
        state.x = shown(state);
        return pose_of(state);
    }

    Points pull_back(const Points& slope) const {
        return poser->pull_back(
            {now.x, now.activation, now.drive, driven_jaw.motion(now.jaw.q, now.drive)}, slope);
    }

    FaceStatics::Pose at_rest() const {
        if (driven_jaw.by_muscles())
            throw std::logic_error("an equilibrium's slopes while muscles move the jaw");
        return {now.x, now.activation, now.drive};
    }

    FacePose pose_of(const State& state) const {
        const JawVector& q = state.jaw.q;
        FacePose out = poser->pose(
            {state.x, state.activation, state.drive, driven_jaw.motion(q, state.drive)});
        driven_jaw.report(q, out);
        return out;
    }
};

Face::Face(const rig::RigDescription& rig, const geom::PolygonMesh& mesh, const Quality& quality,
           const std::string& place) {
    const auto begin = std::chrono::steady_clock::now();
    impl_ = std::make_unique<Impl>(rig, mesh, quality, place);
    impl_->build_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}
Face::~Face() = default;
Face::Face(Face&&) noexcept = default;

void Face::drive_jaw_by(track::JawDrive by) {
    impl_->driven_jaw.drive_by(by, impl_->channels, impl_->motion.effective_step_s(),
                               impl_->tissue);
}
void Face::move(Motion how) { impl_->how = how; }
void Face::set_gravity(const std::optional<Vec3>& gravity_m_s2) { impl_->gravity = gravity_m_s2; }
void Face::set_bite_block(double height_m) { impl_->driven_jaw.set_bite_block(height_m); }

track::Drive Face::driven(track::Drive drive) const {
    drive = impl_->complete(std::move(drive));
    drive.excitation = impl_->driven_jaw.excitation(drive.excitation, drive);
    return drive;
}

void Face::start(const DriveAt& drive) {
    const track::Drive first = impl_->complete(drive(0.0));
    const Eigen::VectorXd activation = impl_->steady_activation(first);
    impl_->done = 0;
    impl_->history.clear();
    impl_->tissue.forget_contacts();
    impl_->dynamics->set_activation(activation);
    const bool at_rest = activation.isZero(0.0) &&
                         impl_->driven_jaw.wanted(first).isApprox(Rigid::Identity(), 0.0) &&
                         first.at(track::Kinematic::kMouthPressure) == 0.0 &&
                         impl_->weight_at(first).isZero(0.0);
    impl_->now.x = impl_->tissue.rest();
    impl_->now.drive.kinematic.fill(0.0);
    impl_->now.jaw = {};
    impl_->motion.start(impl_->now.x, head_motion(impl_->head, first));
    impl_->statics->forget();
    impl_->tissue.solids().forget();
    impl_->last_move.resize(0, 3);
    if (at_rest) {
        impl_->now.activation = activation;
        impl_->now.drive = first;
        Points x = impl_->now.x;  // a face used before may have left its jaw elsewhere
        impl_->set_boundary_conditions(x, activation, first);
        impl_->before = impl_->now;
        impl_->in_step = false;
    } else {
        impl_->solve_equilibrium(activation, first, {.iterations = kRestIterations});
    }
}

StepStats Face::step(const DriveAt& drive) {
    StepStats sum = impl_->substep(drive);
    for (int i = 1; i < impl_->substeps; ++i) {
        const StepStats next = impl_->substep(drive);
        const StepStats before = sum;
        sum = next;
        sum.iterations += before.iterations;
        sum.evaluations += before.evaluations;
        sum.converged = before.converged && next.converged;
    }
    return sum;
}

FacePose Face::pose_at(double t_s, const DriveAt& drive) {
    if (impl_->how == Motion::kQuasiStatic) {
        const track::Drive now = impl_->complete(drive(t_s));
        impl_->history.push_back(impl_->solve_equilibrium(impl_->steady_activation(now), now,
                                                          {.iterations = kRestIterations}));
        return impl_->pose(1.0);
    }
    while (static_cast<double>(impl_->done) < exact_step(t_s, impl_->substep_s))
        impl_->substep(drive);
    return impl_->pose(impl_->fraction_of_step(t_s));
}

const MuscleSurfaces& Face::muscle_surfaces() const {
    impl_->make_surfaces();
    return impl_->surfaces;
}

Points Face::muscle_vertices_at(double t_s) const {
    return impl_->muscle_vertices(impl_->fraction_of_step(t_s));
}

Eigen::VectorXd Face::activation_at(double t_s) const {
    const double fraction = impl_->fraction_of_step(t_s);
    return (1 - fraction) * impl_->before.activation + fraction * impl_->now.activation;
}

StepStats Face::solve_equilibrium(const Eigen::VectorXd& activation, const track::Drive& kinematic,
                                  const StaticOptions& options) {
    const Eigen::VectorXd given =
        activation.size() > 0
            ? activation
            : Eigen::VectorXd(Eigen::VectorXd::Zero(impl_->channels.column_count()));
    return impl_->solve_equilibrium(impl_->driven_jaw.excitation(given, kinematic),
                                    impl_->complete(kinematic), options);
}

const Points& Face::nodes() const { return impl_->now.x; }
Points Face::static_gradient(const Points& nodes, const Eigen::VectorXd& activation,
                             const track::Drive& drive) const {
    return impl_->statics->gradient(impl_->at_rest(), nodes, activation, drive);
}
Points Face::solve_static(const Points& b) { return impl_->statics->solve(impl_->at_rest(), b); }
std::vector<Points> Face::sensitivities(std::span<const int> columns,
                                        std::span<const track::Kinematic> channels) {
    return impl_->statics->sensitivities(impl_->at_rest(), columns, channels);
}
Points Face::pull_back(const Points& vertex_gradient) const {
    return impl_->pull_back(vertex_gradient);
}

FacePose Face::pose() const { return impl_->pose(1.0); }

FacePose Face::posed(Points vertices, const track::Drive& drive) const {
    return impl_->poser->posed(std::move(vertices), impl_->complete(drive),
                               impl_->driven_jaw.wanted(drive));
}

void Face::fold(FacePose& pose, const track::Drive& drive) const {
    impl_->poser->fold(pose, impl_->complete(drive).excitation);
}

double Face::time_s() const { return static_cast<double>(impl_->done) * impl_->substep_s; }
double Face::step_s() const { return impl_->quality.step_s; }
const Eigen::VectorXd& Face::activation() const { return impl_->now.activation; }
Penetration Face::penetration() const {
    return impl_->tissue.penetration(impl_->shown(impl_->now));
}
int Face::node_count() const { return impl_->tissue.nodes(); }
int Face::tet_count() const { return static_cast<int>(impl_->mesh.tets.rows()); }
int Face::inverted_tets() const { return impl_->tissue.tets().inverted_count(impl_->now.x); }
int Face::dropped_tets() const { return impl_->mesh.dropped_tets; }
int Face::fibre_count() const { return static_cast<int>(impl_->tissue.fibres().fibres().size()); }
double Face::build_s() const { return impl_->build_s; }
const WrinkleLines& Face::wrinkle_lines() const { return impl_->poser->lines(); }
const rig::Head& Face::head() const { return impl_->head; }
const Triangles& Face::simulated_skin() const { return impl_->shell.fine; }
const Shell& Face::shell() const { return impl_->shell; }
const std::vector<StepStats>& Face::history() const { return impl_->history; }

void Face::add_force(std::shared_ptr<solve::EnergyTerm> force) {
    impl_->statics->moved();
    impl_->statics->forget();
    impl_->tissue.add_term(std::move(force));
    impl_->tissue.prepare(impl_->motion.effective_step_s());
}

const Tets& Face::tets() const { return impl_->mesh.tets; }

double Face::energy_j() const {
    Points unused;
    impl_->tissue.begin_rest(impl_->now.x);
    return impl_->tissue.static_energy(impl_->now.x, impl_->now.activation, unused);
}

void Face::scale_muscle(const std::string& muscle, double factor) {
    impl_->statics->moved();
    impl_->tissue.forget_mouth();
    impl_->tissue.solids().scale_strength(muscle, factor);
    for (Side side : {Side::kLeft, Side::kRight}) {
        const int column = impl_->channels.column(muscle, side);
        if (side == Side::kRight && column == impl_->channels.column(muscle, Side::kLeft)) continue;
        for (std::size_t f = 0; f < impl_->tissue.fibres().fibres().size(); ++f)
            if (impl_->tissue.fibres().fibres()[f].column == column)
                impl_->tissue.fibres().set_f0(static_cast<int>(f),
                                              factor * impl_->tissue.fibres().fibres()[f].f0_n);
    }
}

void Face::scale_lips(const rig::LipsDescription& lips) {
    impl_->statics->moved();
    impl_->tissue.scale_lips(lips);
}

std::vector<SolidFigures> Face::solid_figures() const {
    return impl_->tissue.solids().figures(impl_->now.x, impl_->now.activation);
}

std::optional<MuscleState> Face::muscle_state(const std::string& muscle, Side side) const {
    const int column = impl_->channels.column(muscle, side);
    const muscle::FibreSet& fibres = impl_->tissue.fibres();
    const auto states = fibres.states(impl_->now.x, impl_->now.activation);
    MuscleState out{.length_m = 0, .stretch = 0, .force_n = 0};
    int count = 0;
    for (std::size_t f = 0; f < states.size(); ++f) {
        if (column < 0 || fibres.fibres()[f].column != column) continue;
        out.length_m += states[f].length_m;
        out.stretch += states[f].stretch;
        out.force_n += states[f].force_n;
        ++count;
    }
    if (count == 0) return std::nullopt;
    out.length_m /= count;
    out.stretch /= count;
    return out;
}

Vec3 Face::landmark(const std::string& id) const {
    const rig::Head& head = impl_->head;
    const Vec3 rest = head.landmark(id);
    const auto given = impl_->rig.landmarks.find(id);
    int vertex = given != impl_->rig.landmarks.end() ? given->second.vertex : -1;
    Vec3 offset = Vec3::Zero();
    if (vertex < 0) {
        double min_squared = std::numeric_limits<double>::infinity();
        for (const int v : head.skin.reshaped()) {
            const double squared = (head.vertices.row(v).transpose() - rest).squaredNorm();
            if (squared >= min_squared) continue;
            min_squared = squared;
            vertex = v;
        }
        offset = rest - head.vertices.row(vertex).transpose();
    }
    return pose().vertices.row(vertex).transpose() + offset;
}

double Face::mean_stretch(const std::string& muscle) const {
    if (impl_->tissue.solids().is_solid(muscle))
        return impl_->tissue.solids().mean_stretch(muscle, impl_->now.x, impl_->now.activation);
    const Eigen::VectorXd stretch = impl_->tissue.fibres().mean_stretch(impl_->now.x);
    double sum = 0;
    int count = 0;
    for (std::size_t f = 0; f < impl_->tissue.fibres().fibres().size(); ++f)
        for (Side side : {Side::kLeft, Side::kRight})
            if (impl_->tissue.fibres().fibres()[f].column == impl_->channels.column(muscle, side)) {
                sum += stretch[static_cast<long>(f)];
                ++count;
            }
    return count ? sum / count : 1.0;
}

Points Face::skin_nodes() const {
    Points out(static_cast<long>(impl_->shell.vertex.size()), 3);
    for (long v = 0; v < out.rows(); ++v)
        out.row(v) = impl_->now.x.row(node_of(static_cast<int>(v), kSkin));
    return out;
}
Points Face::rest_skin_nodes() const {
    Points out(static_cast<long>(impl_->shell.vertex.size()), 3);
    for (long v = 0; v < out.rows(); ++v)
        out.row(v) = impl_->mesh.nodes.row(node_of(static_cast<int>(v), kSkin));
    return out;
}
double Face::tissue_volume_m3() const {
    const Points& x = impl_->now.x;
    double six = 0;
    for (long t = 0; t < impl_->mesh.tets.rows(); ++t) {
        const auto edge = [&](int k) -> Vec3 {
            return (x.row(impl_->mesh.tets(t, k)) - x.row(impl_->mesh.tets(t, 0))).transpose();
        };
        six += edge(1).dot(edge(2).cross(edge(3)));
    }
    return six / 6;
}
double Face::kinetic_energy_j() const {
    const Points velocity = impl_->motion.velocity();
    double sum = 0;
    for (long i = 0; i < velocity.rows(); ++i)
        sum += 0.5 * impl_->tissue.mass()[i] * velocity.row(i).squaredNorm();
    return sum;
}

struct Face::Variant::Parts {
    const Face::Impl& face;
    rig::RigDescription rig;
    FaceTissue tissue;
    Parts(const Face::Impl& of, const rig::RigDescription& changed)
        : face(of), rig(changed), tissue(of.head, rig, of.jaw, of.lids, of.shell, of.mesh) {}
};
Face::Variant::Variant(const Face& face, const rig::RigDescription& changed)
    : parts_(std::make_unique<Parts>(*face.impl_, changed)) {}
Face::Variant::~Variant() = default;

Points Face::Variant::static_gradient(const Points& nodes, const Eigen::VectorXd& activation,
                                      const track::Drive& drive) {
    parts_->tissue.set_boundary_conditions(parts_->face.prescribed(activation, drive));
    parts_->tissue.begin_rest(nodes);
    return parts_->tissue.static_gradient(nodes, activation);
}

}  // namespace risorius::face
