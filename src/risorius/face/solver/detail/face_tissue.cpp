// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/face_tissue.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "risorius/face/muscle/detail/muscle_placement.h"
#include "risorius/face/solver/detail/collagen.h"
#include "risorius/face/solver/detail/terms/attachment_term.h"
#include "risorius/face/solver/detail/terms/fibre_term.h"
#include "risorius/face/solver/detail/terms/lip_term.h"
#include "risorius/face/solver/detail/terms/load_term.h"
#include "risorius/face/solver/detail/terms/pull_term.h"
#include "risorius/face/solver/detail/terms/tissue_term.h"
#include "risorius/face/solver/detail/terms/volume_muscle_term.h"
#include "risorius/geom/polyline.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::face {

namespace {

constexpr double kTarsalPlate_pa_per_m = 5e6;  // tarsal plate holding its lid

// Ratios to the tissue of the face, for the floor of the mouth. Fat below the mandible is loose. It has to keep its volume while the
// opening jaw takes a third of its base away. Estimates; with them the measured jawOpen of ICT is met best.
constexpr double kFloorShearRatio = 0.5, kFloorBulkRatio = 0.8;

constexpr double kAboutMouth_mm = 20;    // radius around the line between the lips, average adult
constexpr double kMouthTolerance = 0.1;  // of the mouth's own iterations, ratio to that of the step

}  // namespace

FaceTissue::FaceTissue(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
                       const std::array<EyeLids, 2>& lids, const Shell& shell,
                       const TissueMesh& mesh)
    : head_(head),
      rig_(rig),
      jaw_(jaw),
      lids_(lids),
      shell_(shell),
      mesh_(mesh),
      lips_(lip_line(head)),
      cheek_(head),
      attachments_(place_attachments(head, rig, jaw, shell, mesh)),
      search_(head, jaw, shell, mesh, lids, rig.tissue.contact_pa_per_m) {
    solids_.emplace(head, rig, jaw, shell, mesh, attachments_);
    rest_.resize(nodes() + solids_->nodes(), 3);
    rest_ << mesh_.nodes, solids_->rest();
    fixed_.assign(static_cast<std::size_t>(rest_.rows()), 0);
    for (int i = 0; i < solids_->nodes(); ++i)
        fixed_[static_cast<std::size_t>(nodes() + i)] = solids_->on_bone(i) ? 1 : 0;
    for (std::size_t v = 0; v < shell_.vertex.size(); ++v)
        if (shell_.fixed[v])
            for (Layer layer : {kDeep, kMiddle, kSkin})
                fixed_[node_of(static_cast<int>(v), layer)] = 1;

    build_tissue();
    build_skin();
    hill_.passive_strain = rig_.tissue.fibre_passive_strain;
    hill_.zajac = rig_.tissue.bundles == "musculotendon";
    muscles_ = place_muscles(head_, rig_, shell_, mesh_);
    fibres_.emplace(muscles_.points, muscles_.fibres, mesh_.nodes, hill_);
    lip_drive_.emplace(head_, rig_, shell_, mesh_, attachments_);
    mass_.resize(rest_.rows());
    mass_ << tets_->lumped_mass(rig_.tissue.density_kg_m3, nodes()), solids_->mass();
    find_cheeks(jaw);
    build_terms();
}

// Returns the fraction of lid tissue at a skin point: 1 in the lids, 0 away from the eyes.
double FaceTissue::lid_fraction(const Vec3& p) const {
    double fraction = 0;
    for (const EyeLids& lid : lids_)
        fraction =
            std::max(fraction, 1.0 - geom::smoothstep(lid.zone_m(), lid.zone_m() + head_.mm(5.5),
                                                      (p - lid.centre()).norm()));
    return fraction;
}

// Returns the fraction of lip tissue at a skin point: 1 at the line between the lips, 0 at the height of a lip from it.
double FaceTissue::lip_fraction(const Vec3& p) const {
    return 1.0 - geom::smoothstep(head_.mm(6), head_.mm(14), geom::distance_to_polyline(p, lips_));
}

// Returns the ratio of the stiffness of cheek tissue to other tissue at a point.
double FaceTissue::cheek_ratio(const Vec3& p) const {
    return std::pow(rig_.tissue.crease_shear_ratio, cheek_.crease(p)) *
           std::pow(rig_.tissue.malar_shear_ratio, cheek_.fat(p));
}

void FaceTissue::build_tissue() {
    // Soft deep fat, firmer tissue above, very soft lids and lips, a firm modiolus at each mouth corner, a cheek that folds, and a
    // loose floor of the mouth
    Eigen::VectorXd mu(mesh_.tets.rows()), bulk(mesh_.tets.rows());
    const std::array<Vec3, 2> modiolus{Vec3(head_.landmark("nl3_l")),
                                       Vec3(head_.landmark("nl3_r"))};
    for (long t = 0; t < mesh_.tets.rows(); ++t) {
        Vec3 centre = Vec3::Zero();
        for (int k = 0; k < 4; ++k) centre += 0.25 * mesh_.nodes.row(mesh_.tets(t, k)).transpose();
        double ratio = std::pow(rig_.tissue.lid_shear_ratio, lid_fraction(centre)) *
                       std::pow(rig_.tissue.lip_shear_ratio, lip_fraction(centre));
        const double floor = jaw_.in_floor(centre);
        ratio *= cheek_ratio(centre) * std::pow(kFloorShearRatio, floor);
        for (const Vec3& knot : modiolus)
            if ((centre - knot).norm() < head_.mm(9)) ratio *= rig_.tissue.modiolus_shear_ratio;
        mu[t] = ratio * (mesh_.tet_layer[t] == kMiddle ? rig_.tissue.deep_shear_pa
                                                       : rig_.tissue.superficial_shear_pa);
        bulk[t] = std::pow(rig_.tissue.lid_shear_ratio, lid_fraction(centre)) *
                  std::pow(rig_.tissue.lip_shear_ratio, 0.5 * lip_fraction(centre)) *
                  std::pow(kFloorBulkRatio, floor) * rig_.tissue.bulk_pa;
    }
    solids_->add_sheaths(mesh_.nodes, mesh_.tets, mu);
    tets_.emplace(mesh_.tets, mesh_.nodes, mu, bulk);
}

void FaceTissue::build_skin() {
    Triangles& triangles = sheet_.triangles;
    triangles = shell_.triangles;
    sheet_.membrane_n_per_m.resize(triangles.rows());
    sheet_.bending_n_m.resize(triangles.rows());
    for (long f = 0; f < triangles.rows(); ++f) {
        Vec3 centre = Vec3::Zero();
        for (int k = 0; k < 3; ++k) {
            centre += mesh_.nodes.row(node_of(shell_.triangles(f, k), kSkin)).transpose() / 3.0;
            triangles(f, k) = node_of(shell_.triangles(f, k), kSkin);
        }
        const double ratio = std::pow(rig_.skin.lid_membrane_ratio, lid_fraction(centre)) *
                             std::pow(rig_.tissue.lip_shear_ratio, lip_fraction(centre)) *
                             cheek_ratio(centre);
        sheet_.membrane_n_per_m[f] = ratio * rig_.skin.membrane_n_per_m;
        sheet_.bending_n_m[f] = ratio * rig_.skin.bending_n_m;
    }
    skin_.emplace(triangles, mesh_.nodes, sheet_.membrane_n_per_m, sheet_.bending_n_m);
}

std::shared_ptr<FaceTerm> FaceTissue::make_attachment_term() const {
    // Attachments to bone first, then those of the lids to their tarsal plates
    std::vector<tissue::ZeroLengthSprings::Spring> held;
    std::vector<LidSpring> lid_springs;
    for (const Attachment& a : attachments_) {
        const int node = node_of(a.shell_vertex, kDeep);
        held.push_back({node, mesh_.nodes.row(node).transpose(), mesh_.direction[a.shell_vertex],
                        a.normal_n_per_m, a.tangential_n_per_m});
    }
    for (std::size_t v = 0; v < shell_.vertex.size(); ++v) {
        if (shell_.fixed[v]) continue;
        const Vec3 p = mesh_.nodes.row(node_of(static_cast<int>(v), kSkin)).transpose();
        for (int side = 0; side < 2; ++side) {
            if ((p - lids_[side].centre()).norm() > lids_[side].zone_m() + head_.mm(3)) continue;
            const LidMember member = lids_[side].member(p);
            const double firmness = EyeLids::firmness(member, 0.4, 1.15, 0.2, 0.65);
            if (firmness < 1e-3) continue;
            for (Layer layer : {kDeep, kMiddle, kSkin}) {
                const int node = node_of(static_cast<int>(v), layer);
                const double k = firmness * kTarsalPlate_pa_per_m * mesh_.area_m2[v];
                held.push_back({node, mesh_.nodes.row(node).transpose(), Vec3::UnitZ(), k, k});
                lid_springs.push_back({side, member, mesh_.nodes.row(node).transpose()});
            }
        }
    }
    return std::make_shared<AttachmentTerm>(std::move(held), std::move(lid_springs), attachments_,
                                            mesh_, jaw_, lids_);
}

void FaceTissue::find_cheeks(const Jaw& jaw) {
    // Air fills the vestibule behind cheeks and lips: from the fold below the nose down to that above the border of the mandible, and
    // back to the masseter. Closed lips are pushed forwards together, which does not open them.
    const double fold_y = head_.landmark("sn").y();
    for (const Attachment& a : attachments_) {
        const Vec3 p = mesh_.nodes.row(node_of(a.shell_vertex, kSkin)).transpose();
        const double near = 1.0 - geom::smoothstep(head_.mm(38), head_.mm(52),
                                                   geom::distance_to_polyline(p, lips_));
        const double below = geom::smoothstep(head_.mm(-2), head_.mm(8), fold_y - p.y());
        const double above = geom::smoothstep(head_.mm(6), head_.mm(20), jaw.height_over_border(p));
        const double rim = 0.4 + 0.6 * geom::smoothstep(head_.mm(2), head_.mm(10),
                                                        geom::distance_to_polyline(p, lips_));
        const double fraction = near * below * above * rim;
        const int node = node_of(a.shell_vertex, kDeep);
        const bool in_tissue =
            mass_[node] > 0;  // a node without mass would have no tissue to resist the air
        if (fraction > 0 && in_tissue && lid_fraction(p) == 0)
            cheeks_.push_back(
                {node, fraction * mesh_.area_m2[a.shell_vertex] * mesh_.direction[a.shell_vertex]});
    }
}

const solve::SparseCholesky& FaceTissue::metric(double h) {
    for (const Metric& known : metrics_)
        if (known.h == h) return known.factor;
    solve::MetricBuilder builder(nodes());
    terms_.add_metric(h, builder);
    for (int i = 0; i < nodes(); ++i) builder.add_diagonal(i, mass_[i] / (h * h) + 1e-9);
    metrics_.push_back(
        {h, solve::SparseCholesky(builder.build({fixed_.begin(), fixed_.begin() + nodes()}),
                                  solve::Precision::kSingle)});
    return metrics_.back().factor;
}

void FaceTissue::prepare(double h) {
    metric(h);
    if (refines_mouth(h)) mouth_.emplace(make_mouth(h));
}

void FaceTissue::set_boundary_conditions(const BoundaryState& boundary) {
    mandible_ = boundary.mandible;
    gaze_ = boundary.gaze;
    terms_.set_boundary_conditions(boundary);
}

// A new force is one line here. The order of the lines is the order of summation.
void FaceTissue::build_terms() {
    terms_.add(std::make_shared<TissueTerm>(*tets_, rig_.tissue.damping_s, inputs_));
    terms_.add(std::make_shared<SkinTerm>(*skin_, sheet_, inputs_));
    terms_.add(make_attachment_term());
    terms_.add(std::make_shared<FibreTerm>(*fibres_, hill_, inputs_));
    terms_.add(std::make_shared<VolumeMuscleTerm>(*solids_, inputs_), {.last_on_mandible = true});
    contact_term_ = std::make_shared<ContactTerm>(contacts_, search_);
    terms_.add(contact_term_, {.changing_pairs = true});
    terms_.add(std::make_shared<LoadTerm>(cheeks_, mass_, fixed_));
    terms_.add(std::make_shared<LipTerm>(*lip_drive_, inputs_));
    terms_.add(std::make_shared<PullTerm>());
    if (!rig_.tissue.collagen.empty()) {
        collagen_ = std::make_shared<tissue::CollagenTets>(
            place_collagen(head_, rig_.tissue.collagen, mesh_), mesh_.nodes);
        terms_.add(collagen_);
    }
}

void FaceTissue::add_term(std::shared_ptr<solve::EnergyTerm> term) {
    terms_.add(std::move(term));
    metrics_.clear();
    forget_mouth();
}

void FaceTissue::find_contacts(const Points& x) {
    contacts_.set(search_.find(x, mandible_, gaze_));
    contact_term_->note(mandible_);
}

double FaceTissue::step_energy(double h, const Points& aim, const Eigen::VectorXd& activation,
                               const Points& at, Points& gradient) {
    const double inertia = 1.0 / (h * h);
    double moving = 0;
    gradient.resize(at.rows(), 3);
    for (long i = 0; i < at.rows(); ++i) {
        const Vec3 off = (at.row(i) - aim.row(i)).transpose();
        moving += mass_[i] * off.squaredNorm();
        gradient.row(i) = inertia * mass_[i] * off.transpose();
    }
    double value = 0.5 * inertia * moving;
    inputs_.activation = &activation;
    const FaceTerms::Energy energy = terms_.add_potential({0.0, h, step_start_}, at, gradient);
    value += energy.first;
    value += energy.others;
    for (long i = 0; i < at.rows(); ++i)
        if (fixed_[i]) gradient.row(i).setZero();
    return value;
}

void FaceTissue::begin_step(double h, const Points& start, const Eigen::VectorXd& activation) {
    step_start_ = start;
    inputs_.activation = &activation;
    terms_.begin_step(h, step_start_);
}

StepStats FaceTissue::implicit_step(double h, const Points& start, const Points& aim,
                                    const Eigen::VectorXd& activation,
                                    const solve::QuasiNewtonOptions& options, Points& x,
                                    std::span<const Points> warm_start) {
    const auto energy = [&](const Points& at, Points& gradient) {
        return step_energy(h, aim, activation, at, gradient);
    };
    begin_step(h, start, activation);
    const solve::SparseCholesky& factor = metric(h);
    const auto solve = [&](const Points& b, Points& y) { solids_->precondition(factor, b, y); };
    const solve::StepReport report = newton_.minimise(energy, solve, x, options, warm_start);
    refine(h, start, aim, activation, options, x);
    return end_step(report, x);
}

LocalSolve FaceTissue::make_mouth(double h) const {
    std::vector<char> moves(static_cast<std::size_t>(nodes()), 0);
    for (std::size_t v = 0; v < shell_.vertex.size(); ++v) {
        const Vec3 p = mesh_.nodes.row(node_of(static_cast<int>(v), kSkin)).transpose();
        if (shell_.fixed[v] || geom::distance_to_polyline(p, lips_) > head_.mm(kAboutMouth_mm))
            continue;
        for (Layer layer : {kDeep, kMiddle, kSkin})
            moves[static_cast<std::size_t>(node_of(static_cast<int>(v), layer))] = 1;
    }
    return LocalSolve(terms_, moves, mesh_.nodes, mass_, h);
}

void FaceTissue::refine(double h, const Points& start, const Points& aim,
                        const Eigen::VectorXd& activation, const solve::QuasiNewtonOptions& options,
                        Points& x) {
    if (!refines_mouth(h)) return;
    if (!mouth_ || mouth_->step_s() != h) mouth_.emplace(make_mouth(h));
    solve::QuasiNewtonOptions own = options;
    own.iterations = mouth_iterations_;
    own.min_iterations = 0;
    own.tolerance_rms_m *= kMouthTolerance;
    own.trust_last = true;
    mouth_->advance({h, start, aim, activation, inputs_.precision}, own, x);
}

void FaceTissue::put_depths(const Points& x, StepStats& figures) const {
    figures.contact_depth_m = ContactSearch::deepest(contacts_.list(), x);
    figures.lip_depth_m = ContactSearch::deepest(contacts_.list(), x, kLipBody, kLipBody);
    figures.bone_depth_m = ContactSearch::deepest(contacts_.list(), x, kSkullBody, kMandibleBody);
}

Penetration FaceTissue::penetration(const Points& x) const {
    const std::vector<tissue::Contacts::Contact> pairs = search_.find(x, mandible_, gaze_);
    return {ContactSearch::deepest(pairs, x, kLipBody, kLipBody),
            ContactSearch::deepest(pairs, x, kSkullBody, kMandibleBody),
            ContactSearch::deepest(pairs, x, kGlobeBody, kGlobeBody)};
}

StepStats FaceTissue::end_step(const solve::StepReport& report, const Points& x) {
    StepStats figures;
    figures.iterations = report.iterations;
    figures.evaluations = report.evaluations;
    figures.last_step_rms_m = report.last_step_rms_m;
    figures.converged = report.converged;
    put_depths(x, figures);
    contacts_.remember(x);
    figures.muscle_volume_error = solids_->max_volume_error(x);
    return figures;
}

}  // namespace risorius::face
