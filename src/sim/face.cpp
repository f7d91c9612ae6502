#include "sim/face.h"

#include <chrono>
#include <cmath>
#include <optional>
#include <set>

#include "muscle/activation.h"
#include "muscle/fibre_set.h"
#include "sim/attachments.h"
#include "sim/contact_search.h"
#include "sim/follow.h"
#include "sim/jaw.h"
#include "sim/lids.h"
#include "sim/muscle_placement.h"
#include "sim/polyline.h"
#include "sim/shell.h"
#include "sim/skin_binding.h"
#include "sim/tissue_mesh.h"
#include "solve/metric_builder.h"
#include "solve/quasi_newton.h"
#include "solve/sparse_cholesky.h"
#include "tissue/contacts.h"
#include "tissue/dead_loads.h"
#include "tissue/skin_sheet.h"
#include "tissue/tet_solid.h"
#include "tissue/tethers.h"
#include "track/channels.h"

namespace risorius::sim {

namespace {

constexpr double kStaticStep_s = 0.5;        // of the pseudo-time steps towards equilibrium
constexpr double kLidTether_pa_per_m = 5e6;  // tarsal plate holding its lid
constexpr int kMemory = 8;
constexpr double kStepCap_m = 6e-3;
constexpr int kContactRefresh = 6;  // iterations between searches while settling

Mat3 gaze_rotation(double yaw_deg, double pitch_deg) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    return (Eigen::AngleAxisd(yaw_deg * kDegree, Vec3::UnitY()) *
            Eigen::AngleAxisd(-pitch_deg * kDegree, Vec3::UnitX()))
        .toRotationMatrix();
}

Rigid head_motion(const rig::Head& head, const track::Drive& drive) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    const Vec3 pivot(0, head.mm(-30), head.mm(-10));  // atlanto-occipital joint
    Rigid motion = Rigid::Identity();
    motion.translate(pivot + Vec3(0, 0, head.mm(drive.at(track::Kinematic::kHeadForward))));
    motion.rotate(Eigen::AngleAxisd(drive.at(track::Kinematic::kHeadYaw) * kDegree, Vec3::UnitY()));
    motion.rotate(
        Eigen::AngleAxisd(-drive.at(track::Kinematic::kHeadPitch) * kDegree, Vec3::UnitX()));
    // Tilting to the left lowers the left ear: a turn about the forward axis from left to down.
    motion.rotate(
        Eigen::AngleAxisd(-drive.at(track::Kinematic::kHeadRoll) * kDegree, Vec3::UnitZ()));
    motion.translate(-pivot);
    return motion;
}

}  // namespace

Quality quality_named(const std::string& name) {
    if (name == "preview") return {"preview", 800, 6, 6, 0.0};
    if (name == "video") return {"video", 800, 80, 6, 0.005e-3};
    if (name == "fine") return {"fine", 1700, 120, 6, 0.005e-3};
    throw Error("--quality", "\"preview\", \"video\" or \"fine\"", "\"" + name + "\"");
}

struct Face::Impl {
    rig::RigDescription rig;
    Quality quality;
    double build_s = 0;
    rig::Head head;
    std::array<EyeLids, 2> lids;
    Jaw jaw;
    Shell shell;
    TissueMesh mesh;
    MusclePlacement muscles;
    std::vector<Attachment> attachments;
    std::vector<char> fixed;

    std::optional<tissue::TetSolid> tets;
    std::optional<tissue::SkinSheet> skin;
    std::optional<tissue::Tethers> tethers;  // attachments, then lids
    std::optional<muscle::FibreSet> fibres;
    std::optional<ContactSearch> search;
    tissue::Contacts contacts;
    tissue::DeadLoads air;
    struct LidTether {
        int side;
        LidMember member;
        Vec3 rest;
    };
    std::vector<LidTether> lid_tethers;
    std::vector<std::pair<int, Vec3>> buccal;  // deep node, outward area m^2
    Eigen::VectorXd mass;
    Eigen::SparseMatrix<double> damping;  // Ks, full symmetric, N/m
    std::optional<solve::SparseCholesky> metric, static_metric;
    solve::QuasiNewton newton;
    std::optional<SkinBinding> binding;
    std::optional<Follow>
        follow;  // what rides on the face: lids, eyes, teeth, tongue, lashes, neck

    // State: now and one step before, for frames between steps
    struct State {
        Points x;
        Eigen::VectorXd activation;
        track::Drive drive;
    };
    State now, before;
    Points velocity;
    long steps = 0;
    std::vector<StepFigures> history;
    std::optional<muscle::ActivationDynamics> dynamics;
    track::ChannelTable channels;
    std::vector<Vec3> lips;
    Points work_, damped_;

    Impl(const rig::RigDescription& rig_description, const geom::PolygonMesh& polygon_mesh,
         const Quality& q, const std::string& place)
        : rig(rig_description),
          quality(q),
          head(rig::place_head(rig, polygon_mesh, place)),
          lids{EyeLids(head, 0, rig.eyes.lid_closed_share),
               EyeLids(head, 1, rig.eyes.lid_closed_share)},
          jaw(head, rig.jaw),
          shell(build_shell(head, jaw, lids, {q.shell_vertices})),
          mesh(build_tissue_mesh(head, rig, shell, lids)),
          muscles(place_muscles(head, rig, shell, mesh)),
          attachments(place_attachments(head, rig, jaw, shell, mesh)),
          channels(rig.channels()),
          lips(lip_line(head)) {
        build_terms();
        binding.emplace(head, jaw, shell);
        follow.emplace(head, rig, lids, *binding);
        dynamics.emplace(rig.muscles.activation_s(), rig.muscles.deactivation_s());
        now.x = mesh.nodes;
        now.activation = Eigen::VectorXd::Zero(channels.column_count());
        now.drive.excitation = now.activation;
        before = now;
        velocity = Points::Zero(mesh.nodes.rows(), 3);
    }

    int nodes() const { return static_cast<int>(mesh.nodes.rows()); }

    // Share of lid softness at a skin point: 1 in the lids, 0 away from the eyes.
    double lid_share(const Vec3& p) const {
        double share = 0;
        for (const EyeLids& lid : lids)
            share = std::max(share, 1.0 - smoothstep(lid.zone_m(), lid.zone_m() + head.mm(5.5),
                                                     (p - lid.centre()).norm()));
        return share;
    }

    // Share of lip softness at a skin point: 1 at the line between the lips, 0 a lip's height away.
    double lip_share(const Vec3& p) const {
        return 1.0 - smoothstep(head.mm(6), head.mm(14), distance_to_polyline(p, lips));
    }

    void build_terms() {
        const int n = nodes();
        fixed.assign(static_cast<std::size_t>(n), 0);
        for (std::size_t v = 0; v < shell.vertex.size(); ++v)
            if (shell.fixed[v])
                for (Layer layer : {kDeep, kMiddle, kSkin})
                    fixed[node_of(static_cast<int>(v), layer)] = 1;

        // Tissue: soft fat below, firmer above, very soft lids, a firm knot at each mouth corner
        Eigen::VectorXd mu(mesh.tets.rows()), bulk(mesh.tets.rows());
        const std::array<Vec3, 2> modiolus{Vec3(head.landmark("nl3_l")),
                                           Vec3(head.landmark("nl3_r"))};
        for (long t = 0; t < mesh.tets.rows(); ++t) {
            Vec3 centre = Vec3::Zero();
            for (int k = 0; k < 4; ++k)
                centre += 0.25 * mesh.nodes.row(mesh.tets(t, k)).transpose();
            double ratio = std::pow(rig.tissue.lid_shear_ratio, lid_share(centre)) *
                           std::pow(rig.tissue.lip_shear_ratio, lip_share(centre));
            for (const Vec3& knot : modiolus)
                if ((centre - knot).norm() < head.mm(9)) ratio *= rig.tissue.modiolus_shear_ratio;
            mu[t] = ratio * (mesh.tet_layer[t] == kMiddle ? rig.tissue.deep_shear_pa
                                                          : rig.tissue.superficial_shear_pa);
            bulk[t] = std::pow(rig.tissue.lid_shear_ratio, lid_share(centre)) * rig.tissue.bulk_pa;
        }
        tets.emplace(mesh.tets, mesh.nodes, mu, bulk);

        Triangles sheet = shell.triangles;
        Eigen::VectorXd membrane(sheet.rows()), bending(sheet.rows());
        for (long f = 0; f < sheet.rows(); ++f) {
            Vec3 centre = Vec3::Zero();
            for (int k = 0; k < 3; ++k) {
                centre += mesh.nodes.row(node_of(shell.triangles(f, k), kSkin)).transpose() / 3.0;
                sheet(f, k) = node_of(shell.triangles(f, k), kSkin);
            }
            const double ratio = std::pow(rig.skin.lid_membrane_ratio, lid_share(centre)) *
                                 std::pow(rig.tissue.lip_shear_ratio, lip_share(centre));
            membrane[f] = ratio * rig.skin.membrane_n_per_m;
            bending[f] = ratio * rig.skin.bending_n_m;
        }
        skin.emplace(sheet, mesh.nodes, membrane, bending);

        // Attachments to bone, and lids to their tarsal plates
        std::vector<tissue::Tethers::Tether> held;
        for (const Attachment& a : attachments) {
            const int node = node_of(a.shell_vertex, kDeep);
            held.push_back({node, mesh.nodes.row(node).transpose(), mesh.direction[a.shell_vertex],
                            a.normal_n_per_m, a.tangential_n_per_m});
        }
        for (std::size_t v = 0; v < shell.vertex.size(); ++v) {
            if (shell.fixed[v]) continue;
            const Vec3 p = mesh.nodes.row(node_of(static_cast<int>(v), kSkin)).transpose();
            for (int side = 0; side < 2; ++side) {
                if ((p - lids[side].centre()).norm() > lids[side].zone_m() + head.mm(3)) continue;
                const LidMember member =
                    lids[side].classify(p, head.mm(2.0), head.mm(4.0), head.mm(2.8));
                if (member.weight < 1e-3) continue;
                for (Layer layer : {kDeep, kMiddle, kSkin}) {
                    const int node = node_of(static_cast<int>(v), layer);
                    const double k = member.weight * kLidTether_pa_per_m * mesh.area_m2[v];
                    held.push_back({node, mesh.nodes.row(node).transpose(), Vec3::UnitZ(), k, k});
                    lid_tethers.push_back({side, member, mesh.nodes.row(node).transpose()});
                }
            }
        }
        tethers.emplace(held);
        muscle::HillShape hill;
        hill.passive_strain = rig.tissue.fibre_passive_strain;
        fibres.emplace(muscles.points, muscles.fibres, mesh.nodes, hill);
        search.emplace(head, jaw, shell, mesh, lids, rig.tissue.contact_pa_per_m);

        // Air presses where the deep tissue is free: the cheeks
        for (const Attachment& a : attachments) {
            const double log_stiffness =
                std::log10(a.normal_n_per_m / mesh.area_m2[a.shell_vertex]);
            const Vec3 p = mesh.nodes.row(node_of(a.shell_vertex, kSkin)).transpose();
            // Lips that hold the air in are not blown open by it.
            const double sealed =
                smoothstep(head.mm(8), head.mm(20), distance_to_polyline(p, lips));
            const double open = sealed * (1.0 - smoothstep(3.5, 4.7, log_stiffness));
            if (open > 0 && lid_share(p) == 0 && p.y() < head.landmark("sn").y())
                buccal.push_back(
                    {node_of(a.shell_vertex, kDeep),
                     open * mesh.area_m2[a.shell_vertex] * mesh.direction[a.shell_vertex]});
        }

        mass = tets->lumped_mass(rig.tissue.density_kg_m3, n);
        solve::MetricBuilder laplacian(n);
        tets->add_laplacian(laplacian, 1.0);
        damping = laplacian.build({}).selfadjointView<Eigen::Lower>();
        metric.emplace(build_metric(kStep_s));
    }

    Eigen::SparseMatrix<double> build_metric(double h) const {
        solve::MetricBuilder builder(nodes());
        tets->add_metric(builder);
        tets->add_laplacian(builder, rig.tissue.damping_s / h);
        skin->add_metric(builder);
        tethers->add_metric(builder);
        fibres->add_metric(builder);
        for (std::size_t i = 0; i < search->nodes().size(); ++i)
            builder.add_diagonal(search->nodes()[i], 0.5 * search->node_stiffness()[i]);
        for (int i = 0; i < nodes(); ++i) builder.add_diagonal(i, mass[i] / (h * h) + 1e-9);
        return builder.build(fixed);
    }

    LidPose lid_pose(int side, const Eigen::VectorXd& activation, const track::Drive& drive) const {
        const Side s = side == 0 ? Side::kLeft : Side::kRight;
        const auto of = [&](const char* id) {
            const int column = channels.column(id, s);
            return column < 0 ? 0.0 : activation[column];
        };
        // A lid falls when the levator lets go, is pressed shut by orbicularis, and opens wide with levator and tarsal muscle.
        const double levator = of("levator_palpebrae_superioris");
        const double upper = of("orbicularis_oculi_palpebral_upper");
        const double lower = of("orbicularis_oculi_palpebral_lower");
        LidPose pose;
        pose.upper_closure = std::min(1.0, 0.95 * std::max(0.0, -levator) + 0.2 * upper);
        pose.lower_closure = (1.0 - pose.upper_closure) * 4.0 * lower + pose.upper_closure;
        constexpr double kDegree = 3.14159265358979323846 / 180.0;
        const double pitch = drive.at(side == 0 ? track::Kinematic::kGazePitchLeft
                                                : track::Kinematic::kGazePitchRight);
        const double open = 1.0 - pose.upper_closure;
        pose.upper_gaze_rad =
            -open * kDegree *
            (pitch > 0 ? rig.eyes.upper_lid_per_gaze_up : rig.eyes.upper_lid_per_gaze_down) * pitch;
        pose.lower_gaze_rad =
            -open * kDegree *
            (pitch > 0 ? rig.eyes.lower_lid_per_gaze_up : rig.eyes.lower_lid_per_gaze_down) * pitch;
        pose.upper_gaze_rad -= kDegree * rig.eyes.wide_deg *
                               (0.8 * std::max(0.0, levator) + 0.2 * of("superior_tarsal"));
        return pose;
    }

    Rigid mandible(const track::Drive& drive) const {
        return jaw.motion(drive.at(track::Kinematic::kJawOpen),
                          drive.at(track::Kinematic::kJawForward),
                          drive.at(track::Kinematic::kJawSide));
    }

    // Moves everything that is prescribed to where the drive wants it.
    void prescribe(const Eigen::VectorXd& activation, const track::Drive& drive) {
        const Rigid moved = mandible(drive);
        std::vector<tissue::Tethers::Tether>& held = tethers->list();
        for (std::size_t i = 0; i < attachments.size(); ++i) {
            const Attachment& a = attachments[i];
            const Vec3 rest = mesh.nodes.row(held[i].node).transpose();
            held[i].target = rest + a.jaw_weight * (moved * rest - rest);
            held[i].normal = ((1 - a.jaw_weight) * mesh.direction[a.shell_vertex] +
                              a.jaw_weight * (moved.linear() * mesh.direction[a.shell_vertex]))
                                 .normalized();
        }
        const std::array<LidPose, 2> lid{lid_pose(0, activation, drive),
                                         lid_pose(1, activation, drive)};
        for (std::size_t i = 0; i < lid_tethers.size(); ++i) {
            const LidTether& t = lid_tethers[i];
            held[attachments.size() + i].target =
                t.rest + lids[t.side].ride(t.rest, t.member.upper, t.member.place, lid[t.side]);
        }
        const std::array<Rigid, kBodies> bodies{Rigid::Identity(), moved};
        fibres->set_body_positions(bodies);
        const double pressure = drive.at(track::Kinematic::kMouthPressure);
        std::vector<tissue::DeadLoads::Load> loads;
        if (pressure != 0)
            for (const auto& [node, area] : buccal) loads.push_back({node, pressure * area});
        air.set(loads);
    }

    // Moves the tissue with the bone before solving, so that a fast jaw does not have to be chased.
    void predict(Points& x, const track::Drive& from, const track::Drive& to) const {
        const Rigid a = mandible(from), b = mandible(to);
        if (a.isApprox(b, 0.0)) return;
        for (const Attachment& at : attachments)
            for (Layer layer : {kDeep, kMiddle, kSkin}) {
                const int node = node_of(at.shell_vertex, layer);
                const Vec3 rest = mesh.nodes.row(node).transpose();
                x.row(node) += at.jaw_weight * (b * rest - a * rest).transpose();
            }
    }

    double potential(const Points& x, const Eigen::VectorXd& activation, Points& gradient) const {
        double energy = tets->add_energy(x, gradient);
        energy += skin->add_energy(x, gradient);
        energy += tethers->add_energy(x, gradient);
        energy += fibres->add_energy(x, activation, gradient);
        energy += contacts.add_energy(x, gradient);
        energy += air.add_energy(x, gradient);
        return energy;
    }

    void clear_fixed(Points& gradient) const {
        for (int i = 0; i < nodes(); ++i)
            if (fixed[i]) gradient.row(i).setZero();
    }

    // One implicit step of length h from `start` at `speed`, beginning the search at x.
    StepFigures implicit_step(const solve::SparseCholesky& factor, double h, const Points& start,
                              const Points& aim, const Eigen::VectorXd& activation,
                              const solve::QuasiNewtonOptions& options, Points& x) {
        const double inertia = 1.0 / (h * h), viscous = rig.tissue.damping_s / h;
        const auto energy = [&](const Points& at, Points& gradient) {
            work_ = at - start;
            damped_.noalias() = damping * work_;
            gradient = viscous * damped_;
            double value = 0.5 * viscous * work_.cwiseProduct(damped_).sum();
            work_ = at - aim;
            for (int i = 0; i < nodes(); ++i) {
                value += 0.5 * inertia * mass[i] * work_.row(i).squaredNorm();
                gradient.row(i) += inertia * mass[i] * work_.row(i);
            }
            value += potential(at, activation, gradient);
            clear_fixed(gradient);
            return value;
        };
        const solve::StepReport report = newton.minimise(energy, factor, x, options);
        StepFigures figures;
        figures.iterations = report.iterations;
        figures.evaluations = report.evaluations;
        figures.last_step_rms_m = report.last_step_rms_m;
        figures.converged = report.converged;
        figures.contact_depth_m = ContactSearch::deepest(contacts.list(), x);
        return figures;
    }

    StepFigures settle(const Eigen::VectorXd& activation, const track::Drive& drive,
                       int iterations) {
        if (!static_metric) static_metric.emplace(build_metric(kStaticStep_s));
        Points x = now.x;
        predict(x, now.drive, drive);
        prescribe(activation, drive);
        StepFigures figures;
        while (figures.iterations < iterations) {
            contacts.set(search->find(x, mandible(drive)));
            const Points start = x;
            const StepFigures part =
                implicit_step(*static_metric, kStaticStep_s, start, start, activation,
                              {.iterations = std::max(kContactRefresh, 20),
                               .memory = kMemory,
                               .step_cap_m = kStepCap_m,
                               .tolerance_rms_m = 1e-6},
                              x);
            figures.iterations += std::max(1, part.iterations);
            figures.evaluations += part.evaluations;
            figures.contact_depth_m = part.contact_depth_m;
            const double moved = std::sqrt((x - start).squaredNorm() / nodes());
            figures.last_step_rms_m = moved;
            if (moved < 5e-6) {
                figures.converged = true;
                break;
            }
        }
        now.x = x;
        now.activation = activation;
        now.drive = drive;
        velocity.setZero();
        before = now;
        return figures;
    }

    StepFigures step(const DriveAt& drive_at) {
        const double from = static_cast<double>(steps) * kStep_s,
                     to = static_cast<double>(steps + 1) * kStep_s;
        const track::Drive drive = drive_at(to);
        Eigen::VectorXd excitation;
        dynamics->advance(
            [&](double t) -> const Eigen::VectorXd& {
                excitation = drive_at(t).excitation;
                return excitation;
            },
            drive.activation, from, to);
        const Eigen::VectorXd activation = dynamics->activation();

        before = now;
        Points x = now.x;
        predict(x, now.drive, drive);
        prescribe(activation, drive);
        contacts.set(search->find(x, mandible(drive)));
        const Points aim = now.x + kStep_s * velocity;
        const StepFigures figures = implicit_step(*metric, kStep_s, now.x, aim, activation,
                                                  {.iterations = quality.iterations,
                                                   .least_iterations = quality.least_iterations,
                                                   .memory = kMemory,
                                                   .step_cap_m = kStepCap_m,
                                                   .tolerance_rms_m = quality.tolerance_rms_m},
                                                  x);
        velocity = (x - now.x) / kStep_s;
        now.x = x;
        now.activation = activation;
        now.drive = drive;
        ++steps;
        history.push_back(figures);
        return figures;
    }

    FacePose pose(double share) const {
        // Linear between the last two steps; the drives that move bone and lids are interpolated, not their results.
        track::Drive drive = now.drive;
        for (std::size_t k = 0; k < drive.kinematic.size(); ++k)
            drive.kinematic[k] =
                (1 - share) * before.drive.kinematic[k] + share * now.drive.kinematic[k];
        const Eigen::VectorXd activation = (1 - share) * before.activation + share * now.activation;
        Points displacement(static_cast<long>(shell.vertex.size()), 3);
        for (long v = 0; v < displacement.rows(); ++v) {
            const int node = node_of(static_cast<int>(v), kSkin);
            displacement.row(v) =
                (1 - share) * before.x.row(node) + share * now.x.row(node) - mesh.nodes.row(node);
        }
        FacePose out;
        const Rigid moved = mandible(drive);
        out.jaw_open = drive.at(track::Kinematic::kJawOpen);
        const auto gaze_of = [&](track::Kinematic channel) {
            return std::clamp(drive.at(channel), -rig.eyes.gaze_limit_deg, rig.eyes.gaze_limit_deg);
        };
        const std::array<Mat3, 2> gaze{gaze_rotation(gaze_of(track::Kinematic::kGazeYawLeft),
                                                     gaze_of(track::Kinematic::kGazePitchLeft)),
                                       gaze_rotation(gaze_of(track::Kinematic::kGazeYawRight),
                                                     gaze_of(track::Kinematic::kGazePitchRight))};
        const std::array<LidPose, 2> lid{lid_pose(0, activation, drive),
                                         lid_pose(1, activation, drive)};
        out.vertices = head.vertices;
        binding->apply(displacement, moved, out.vertices);
        out.head = head_motion(head, drive);
        follow->apply({moved, gaze, lid, drive.at(track::Kinematic::kTongueOut), out.head},
                      out.vertices);
        for (int side = 0; side < 2; ++side)
            out.eye_rotation[side] = out.head.linear() * gaze[side];
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

void Face::start(const DriveAt& drive) {
    const track::Drive first = drive(0.0);
    Eigen::VectorXd activation = first.excitation;
    for (long i = 0; i < activation.size(); ++i)
        if (first.activation.size() > 0 && !std::isnan(first.activation[i]))
            activation[i] = first.activation[i];
    impl_->steps = 0;
    impl_->history.clear();
    impl_->dynamics->set_activation(activation);
    const bool at_rest = activation.isZero(0.0) &&
                         impl_->mandible(first).isApprox(Rigid::Identity(), 0.0) &&
                         first.at(track::Kinematic::kMouthPressure) == 0.0;
    impl_->now.x = impl_->mesh.nodes;
    impl_->now.drive.kinematic.fill(0.0);
    impl_->velocity.setZero();
    if (at_rest) {
        impl_->now.activation = activation;
        impl_->now.drive = first;
        impl_->before = impl_->now;
    } else {
        impl_->settle(activation, first, 400);
    }
}

StepFigures Face::step(const DriveAt& drive) { return impl_->step(drive); }

FacePose Face::pose_at(double t_s, const DriveAt& drive) {
    // A frame that falls on a step shows that step, whatever rounding made of its time.
    const double place = t_s / kStep_s;
    const double nearest = std::round(place);
    const double exact = std::abs(place - nearest) < 1e-6 ? nearest : place;
    while (static_cast<double>(impl_->steps) < exact) impl_->step(drive);
    return impl_->pose(1.0 - (static_cast<double>(impl_->steps) - exact));
}

Eigen::VectorXd Face::activation_at(double t_s) const {
    const double place = t_s / kStep_s;
    const double nearest = std::round(place);
    const double exact = std::abs(place - nearest) < 1e-6 ? nearest : place;
    const double share = 1.0 - (static_cast<double>(impl_->steps) - exact);
    return (1 - share) * impl_->before.activation + share * impl_->now.activation;
}

StepFigures Face::settle(const Eigen::VectorXd& activation, const track::Drive& kinematic,
                         int iterations) {
    return impl_->settle(activation, kinematic, iterations);
}

FacePose Face::pose() const { return impl_->pose(1.0); }
double Face::time_s() const { return static_cast<double>(impl_->steps) * kStep_s; }
const Eigen::VectorXd& Face::activation() const { return impl_->now.activation; }
int Face::node_count() const { return impl_->nodes(); }
int Face::tet_count() const { return static_cast<int>(impl_->mesh.tets.rows()); }
int Face::inverted_tets() const { return impl_->tets->inverted_count(impl_->now.x); }
int Face::dropped_tets() const { return impl_->mesh.dropped_tets; }
int Face::fibre_count() const { return static_cast<int>(impl_->muscles.fibres.size()); }
double Face::build_s() const { return impl_->build_s; }
const rig::Head& Face::head() const { return impl_->head; }
const std::vector<StepFigures>& Face::history() const { return impl_->history; }

void Face::scale_muscle(const std::string& muscle, double factor) {
    for (Side side : {Side::kLeft, Side::kRight}) {
        const int column = impl_->channels.column(muscle, side);
        if (side == Side::kRight && column == impl_->channels.column(muscle, Side::kLeft)) continue;
        for (std::size_t f = 0; f < impl_->fibres->fibres().size(); ++f)
            if (impl_->fibres->fibres()[f].column == column)
                impl_->fibres->set_f0(static_cast<int>(f),
                                      factor * impl_->fibres->fibres()[f].f0_n);
    }
}

double Face::mean_stretch(const std::string& muscle) const {
    const Eigen::VectorXd stretch = impl_->fibres->mean_stretch(impl_->now.x);
    double sum = 0;
    int count = 0;
    for (std::size_t f = 0; f < impl_->fibres->fibres().size(); ++f)
        for (Side side : {Side::kLeft, Side::kRight})
            if (impl_->fibres->fibres()[f].column == impl_->channels.column(muscle, side)) {
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
    double sum = 0;
    for (int i = 0; i < impl_->nodes(); ++i)
        sum += 0.5 * impl_->mass[i] * impl_->velocity.row(i).squaredNorm();
    return sum;
}

}  // namespace risorius::sim
