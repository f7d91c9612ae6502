// SPDX-License-Identifier: MIT
#include "risorius/face/muscle/detail/mesh_belly.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "risorius/geom/polyline.h"
#include "risorius/geom/tet_boundary.h"
#include "risorius/solve/energy_term.h"

namespace risorius::face {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kSections = 5;

Mat3 edges_in(const Points& x, const Tets& tets, int tet) {
    Mat3 out;
    for (int k = 0; k < 3; ++k)
        out.col(k) = (x.row(tets(tet, k + 1)) - x.row(tets(tet, 0))).transpose();
    return out;
}

}  // namespace

MeshBelly::MeshBelly(const SolidPart& place, const SolidPlacement& nodes,
                     const rig::RigDescription& rig)
    : SolidBelly(place, nodes), damping_s_(rig.tissue.damping_s) {
    const rig::SolidMuscle& solid = *place_.solid;
    const rig::Muscle& muscle = *place_.muscle;
    const auto count = place_.tets.rows();
    for (int t = 0; t < static_cast<int>(count); ++t)
        rest_volume_ += edges_in(rest_, place_.tets, t).determinant() / 6;
    const double tension_pa = place_.f0_n * place_.length_m / rest_volume_;
    const double own =
        std::min(std::max(kOwnVolume * tension_pa, 10 * solid.shear_pa), 0.5 * solid.volume_pa);
    tissue::TetFans apart;  // each tetrahedron keeps its own volume
    for (int t = 0; t < static_cast<int>(count); ++t) apart.alone.push_back(t);
    shape_ = std::make_unique<tissue::TetSolid>(place_.tets, rest_,
                                                Eigen::VectorXd::Constant(count, solid.shear_pa),
                                                Eigen::VectorXd::Constant(count, own), apart);
    volumes_ = std::make_unique<tissue::NodeVolumes>(place_.tets, rest_, solid.volume_pa - own);
    const muscle::ZajacShape curves = this->curves(rig);
    if (solid.is_stiffer_along())
        along_.emplace(tissue::strain_points(place_.tets, rest_, place_.fibres), along_moduli());
    f0_n_ = built_f0_n_ = place_.f0_n;
    fibres_ = std::make_unique<muscle::FibreTets>(
        muscle::FibreTetsParameters{.tension_pa = 1,
                                    .optimal_stretch = 1 / muscle.rest_stretch,
                                    .max_speed_hz = muscle.max_speed_hz,
                                    .curves = curves,
                                    .active_by_mean = true},
        rest_, place_.tets, place_.fibres, [this](double) { return activation_; }, place_.density);
    set_strength(1);
    for (int t = 0; t < static_cast<int>(count); ++t)
        inverse_.push_back(edges_in(rest_, place_.tets, t).inverse());
    own_ = std::make_unique<solve::HessianBuilder>(static_cast<int>(rest_.rows()),
                                                   std::vector<char>{});
}

void MeshBelly::set_strength(double factor) {
    f0_n_ = factor * built_f0_n_;
    fibres_->set_tension_pa(f0_n_ * place_.length_m / rest_volume_);
}

void MeshBelly::begin_step(double h, const Points& start) {
    step_s_ = h;
    if (std::isfinite(h)) shape_->begin_step(start, damping_s_ / h, solve::Precision::kDouble);
}

void MeshBelly::add_energy(const Points& x, double activation, double& energy,
                           Points& gradient) const {
    const solve::ImplicitStep still{0.0, kInfinite, rest_};
    activation_ = activation;
    energy += std::isfinite(step_s_)
                  ? shape_->add_step_energy(x, gradient, solve::Precision::kDouble)
                  : shape_->add_energy(x, gradient);
    energy += volumes_->add_potential(still, x, gradient);
    if (along_) energy += along_->add_potential(still, x, gradient);
    energy += fibres_->add_potential(still, x, gradient);
}

void MeshBelly::add_hessian(const Points& x, double activation, solve::Curvature curvature,
                            const std::vector<int>& row, solve::HessianBuilder& hessian) const {
    const solve::ImplicitStep still{0.0, kInfinite, rest_};
    activation_ = activation;
    own_->clear();
    shape_->add_hessian(x, curvature, *own_);
    volumes_->add_hessian(still, x, curvature, *own_);
    if (along_) along_->add_hessian(still, x, curvature, *own_);
    fibres_->add_hessian(still, x, curvature, *own_);
    add_blocks(own_->build_blocks(), row, hessian);
}

void MeshBelly::add_stiffness(const Points& x, double activation, const std::vector<int>& row,
                              solve::HessianBuilder& hessian) const {
    add_hessian(x, activation, solve::Curvature::kPositive, row, hessian);
}

double MeshBelly::mean_stretch(const Points& x, double /*activation*/) const {
    return fibres_->mean_stretch(x) / place_.muscle->rest_stretch;
}

std::vector<muscle::ChainSet::State> MeshBelly::chain_states(const Points& x,
                                                             double activation) const {
    activation_ = activation;
    muscle::ChainSet::State out;
    out.length_m = place_.length_m * mean_stretch(x, activation);
    out.stretch = fibres_->mean_stretch(x);
    double force = 0, most = 0;
    const std::vector<muscle::FibreTets::State> states = fibres_->states(0, x);
    for (int t = 0; t < static_cast<int>(states.size()); ++t) {
        const double volume = edges_in(rest_, place_.tets, t).determinant();
        force += volume * states[static_cast<std::size_t>(t)].tension_pa;
        most += volume * density(t) * fibres_->parameters().tension_pa;
    }
    if (most > 0) out.force_n = f0_n_ * force / most;
    return {out};
}

muscle::ChainProperties MeshBelly::chain() const {
    return {.f0_n = f0_n_, .rest_stretch = place_.muscle->rest_stretch};
}

double MeshBelly::thickness(const Points& x) const {
    Vec3 first = Vec3::Zero(), last = Vec3::Zero(), middle = Vec3::Zero();
    double firsts = 0, lasts = 0, middles = 0;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const double t = place_.along[static_cast<std::size_t>(i)];
        if (t < 1.0 / 3)
            first += x.row(i).transpose(), ++firsts;
        else if (t > 2.0 / 3)
            last += x.row(i).transpose(), ++lasts;
        else
            middle += x.row(i).transpose(), ++middles;
    }
    const Vec3 axis = (last / lasts - first / firsts).normalized();
    double sum = 0;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const double t = place_.along[static_cast<std::size_t>(i)];
        if (t < 1.0 / 3 || t > 2.0 / 3) continue;
        const Vec3 off = x.row(i).transpose() - middle / middles;
        sum += (off - off.dot(axis) * axis).squaredNorm();
    }
    return std::sqrt(sum / middles);
}

SolidFigures MeshBelly::figures(const Points& x, double activation) const {
    SolidFigures out{.muscle = place_.muscle->id, .side = place_.side};
    out.volume_ratio = volume(x) / rest_volume_;
    out.min_cell_ratio = shape_->min_relative_volume(x);
    out.mean_stretch = mean_stretch(x, activation);
    out.thickness_ratio = thickness(x) / thickness(rest_);
    return out;
}

void MeshBelly::add_cell_states(const Points& x, double activation,
                                std::vector<SolidCellState>& states) const {
    activation_ = activation;
    const std::vector<muscle::FibreTets::State> fibres = fibres_->states(0, x);
    const Eigen::VectorXd pressure = volumes_->pressures_pa(x);
    for (int t = 0; t < static_cast<int>(place_.tets.rows()); ++t) {
        const Mat3 f = shape_->deformation_gradient(x, t);
        const Vec3 along = place_.fibres.row(t).transpose();
        const muscle::FibreTets::State& fibre = fibres[static_cast<std::size_t>(t)];
        SolidCellState state;
        state.column = place_.column;
        state.volume_ratio = f.determinant();
        state.stress_pa = shape_->cauchy_stress_pa(x, t) + pressure[t] * Mat3::Identity();
        if (along_)
            state.stress_pa += tissue::AlongFibres::cauchy_stress_pa(along_->moduli(), f, along);
        state.direction = (f * along).normalized();
        state.stretch = fibre.stretch;
        if (const double most = density(t) * fibres_->parameters().tension_pa; most > 0)
            state.tension_n = f0_n_ * fibre.tension_pa / most;
        // A hexahedron with corners that coincide
        for (std::size_t k = 0; k < 8; ++k) {
            constexpr std::array<int, 8> kCorner{0, 1, 2, 2, 3, 3, 3, 3};
            state.node[k] = place_.node[static_cast<std::size_t>(place_.tets(t, kCorner[k]))];
        }
        states.push_back(state);
    }
}

std::vector<std::vector<int>> MeshBelly::sections() const {
    std::vector<std::vector<int>> all(kSections), out;
    for (std::size_t i = 0; i < place_.along.size(); ++i)
        all[static_cast<std::size_t>(
                std::min(kSections - 1, static_cast<int>(kSections * place_.along[i])))]
            .push_back(static_cast<int>(i));
    for (std::vector<int>& section : all)
        if (!section.empty()) out.push_back(std::move(section));
    return out;
}

BellySurface MeshBelly::surface(const std::array<bool, 2>& bone_ends) const {
    BellySurface out;
    out.triangles = geom::boundary_of(place_.tets);
    std::vector<int> vertex(static_cast<std::size_t>(rest_.rows()), -1);
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index k = 0; k < out.triangles.size(); ++k) {
        int& node = out.triangles.data()[k];
        int& index = vertex[static_cast<std::size_t>(node)];
        if (index < 0) {
            index = static_cast<int>(entries.size());
            entries.emplace_back(index, node, 1.0);
        }
        node = index;
    }
    const auto count = static_cast<Eigen::Index>(entries.size());
    out.weights.resize(count, rest_.rows());
    out.weights.setFromTriplets(entries.begin(), entries.end());
    // Along and across the fibres; tendon where a muscle with one meets bone
    const Vec3 axis = (rest_.bottomRows(1) - rest_.topRows(1)).transpose().normalized(),
               sideways = axis.unitOrthogonal();
    const double tendon_m = std::min(0.5 * place_.muscle->tendon_slack_m, 0.12 * place_.length_m);
    out.fibre.resize(count, 2);
    for (const Eigen::Triplet<double>& entry : entries) {
        const double along = place_.length_m * place_.along[static_cast<std::size_t>(entry.col())];
        out.fibre.row(entry.row()) << along, rest_.row(entry.col()).dot(sideways.transpose());
        const double from_bone =
            std::min(bone_ends[0] ? along : 1e9, bone_ends[1] ? place_.length_m - along : 1e9);
        out.tendon.push_back(1 -
                             geom::smoothstep(0.5 * tendon_m, 1.5 * tendon_m + 1e-9, from_bone));
    }
    return out;
}

void MeshBelly::find(const Vec3& p, double& least_excess, BellyPoint& best) const {
    for (int t = 0; t < static_cast<int>(place_.tets.rows()); ++t) {
        const Vec3 first = rest_.row(place_.tets(t, 0)).transpose();
        if ((first - p).norm() > 0.03) continue;
        const Vec3 inner = inverse_[static_cast<std::size_t>(t)] * (p - first);
        const std::array<double, 4> weight{1 - inner.sum(), inner[0], inner[1], inner[2]};
        const double out = std::max(0.0, -*std::min_element(weight.begin(), weight.end()));
        if (out >= least_excess) continue;
        least_excess = out;
        best = {.count = 4};
        for (std::size_t k = 0; k < 4; ++k) {
            best.node[k] = place_.tets(t, static_cast<int>(k));
            best.weight[k] = weight[k];
        }
    }
}

}  // namespace risorius::face
