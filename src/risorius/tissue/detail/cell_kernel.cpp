// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/cell_kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "risorius/tissue/detail/cell_point.h"

namespace risorius::tissue::detail {

namespace {

constexpr int kRow[6] = {0, 1, 2, 0, 0, 1}, kColumn[6] = {0, 1, 2, 1, 2, 2};
constexpr int kOf[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
/// Modes beyond those of a parallelepiped count as zero below this fraction of its edges: rounding errors of the grid.
constexpr double kStraight = 1e-12;

/// Tangents t1, t2, t3 (8 times the derivatives by xi) at Gauss point g, from the modes.
void tangents(const Modes& m, int g, LaneVector (&t)[3]) {
    const Lanes s1 = Lanes{} + ((g & 4) ? 1.0 : -1.0), s2 = Lanes{} + ((g & 2) ? 1.0 : -1.0),
                s3 = Lanes{} + ((g & 1) ? 1.0 : -1.0);
    t[0] = m.a + s2 * m.d + s3 * m.e + (s2 * s3) * m.k;
    t[1] = m.b + s1 * m.d + s3 * m.f + (s1 * s3) * m.k;
    t[2] = m.c + s1 * m.e + s2 * m.f + (s1 * s2) * m.k;
}

/// S = C T C for symmetric 3 x 3 matrices, six components each.
void sandwich(const Lanes (&c)[6], const Lanes (&t)[6], Lanes (&s)[6]) {
    Lanes ct[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            ct[i][j] = c[kOf[i][0]] * t[kOf[0][j]] + c[kOf[i][1]] * t[kOf[1][j]] +
                       c[kOf[i][2]] * t[kOf[2][j]];
    for (int n = 0; n < 6; ++n)
        s[n] = ct[kRow[n]][0] * c[kOf[0][kColumn[n]]] + ct[kRow[n]][1] * c[kOf[1][kColumn[n]]] +
               ct[kRow[n]][2] * c[kOf[2][kColumn[n]]];
}

}  // namespace

CellKernel::CellKernel(const CellBody& body, const Points& rest_vertices,
                       const Eigen::VectorXd& rest_volume) {
    const auto& cells = body.mesh.cells();
    const int count = static_cast<int>(cells.size());
    groups_.resize(static_cast<std::size_t>((count + 3) / 4));

    // Are all cells parallelepipeds, and are they rectangular?
    bool straight = true, rectangular = true;
    for (const CellMesh::Cell& cell : cells) {
        const CellCorners rest(cell, rest_vertices);
        const Mat3 first = tangents_at(rest, cell.size, 0);
        for (int g = 1; g < 8; ++g)
            straight = straight &&
                       (tangents_at(rest, cell.size, g) - first).norm() <= kStraight * first.norm();
        const Mat3 metric = first.transpose() * first;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < i; ++j)
                rectangular = rectangular && std::abs(metric(i, j)) <=
                                                 kStraight * std::sqrt(metric(i, i) * metric(j, j));
    }
    const bool pointwise = !body.moduli.empty() && !(straight && rectangular);
    if (pointwise) curved_.resize(groups_.size());

    for (int slot = 0; slot < 4 * static_cast<int>(groups_.size()); ++slot) {
        // The last group is filled with copies of the last cell that have no stiffness.
        const int c = std::min(slot, count - 1);
        const auto index = static_cast<std::size_t>(c);
        const CellMesh::Cell& cell = cells[index];
        const double fraction = slot < count ? 1.0 : 0.0;
        const int lane = slot % 4;
        CellGroup& group = groups_[static_cast<std::size_t>(slot / 4)];
        for (int k = 0; k < 8; ++k)
            group.vertex[k][lane] = cell.vertex[static_cast<std::size_t>(k)];

        const CellCorners rest(cell, rest_vertices);
        const double weight = fraction * cell.size.prod() / 8;
        CellParameters parameters;
        if (body.moduli.empty()) {
            parameters = body.parameters[index];
        } else if (!pointwise) {
            // lambda_ij = mu V0 / (Li^2 Lj^2) for a rectangular cell
            const Mat3 r = tangents_at(rest, cell.size, 0);
            const double volume = rest_volume[c] / cell.size.prod();
            const CellModuli& moduli = body.moduli[index];
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) {
                    const double s = volume / (r.col(i).squaredNorm() * r.col(j).squaredNorm());
                    parameters.elastic_n_per_m3(i, j) = moduli.mu_pa * s;
                    parameters.damping_ns_per_m3(i, j) = moduli.viscosity_pa_s * s;
                }
            parameters.incompressibility_n_per_m5 = moduli.bulk_pa / (2 * volume);
        }
        const CellMaterialLaw law = body.moduli.empty() ? CellMaterialLaw(body.parameters[index])
                                                        : CellMaterialLaw(body.moduli[index]);
        group.bulk[lane] = fraction * volume_stiffness(law, cell.size, rest_volume[c]) / 4096;
        group.rest_volume[lane] = 64 * rest_volume[c];

        const Mat3 metric = metric_at(rest, cell.size, 0);
        for (int n = 0; n < 6; ++n) {
            const int i = kRow[n], j = kColumn[n];
            const double scale = 16 * cell.size[i] * cell.size[j];  // t_i . t_j = scale G_ij
            group.elastic[n][lane] = weight * parameters.elastic_n_per_m3(i, j) / (scale * scale);
            group.damping[n][lane] = weight * parameters.damping_ns_per_m3(i, j) / (scale * scale);
            group.rest[n][lane] = scale * metric(i, j);
            damped_ = damped_ || group.damping[n][lane] > 0;
        }
        if (!pointwise) continue;
        CurvedGroup& curved = curved_[static_cast<std::size_t>(slot / 4)];
        curved.mu[lane] = body.moduli[index].mu_pa;
        curved.eta[lane] = body.moduli[index].viscosity_pa_s;
        damped_ = damped_ || body.moduli[index].viscosity_pa_s > 0;
        for (int g = 0; g < 8; ++g) {
            const Mat3 r = tangents_at(rest, cell.size, g);
            const Mat3 at = r.transpose() * r;
            const Mat3 inverse = std::sqrt(weight * r.determinant()) * at.inverse();
            for (int n = 0; n < 6; ++n) {
                const double scale = 16 * cell.size[kRow[n]] * cell.size[kColumn[n]];
                curved.inverse_metric[g][n][lane] = inverse(kRow[n], kColumn[n]) / scale;
                curved.rest[g][n][lane] = scale * at(kRow[n], kColumn[n]);
            }
        }
    }
    if (!straight && !pointwise) {
        rest_targets_.resize(groups_.size() * kStrains);
        x_.copy(rest_vertices);
        for (std::size_t g = 0; g < groups_.size(); ++g)
            measure(modes_of(groups_[g], x_), rest_targets_.data() + g * kStrains);
    }
}

void CellKernel::load(const CellMesh& mesh, const Points& x, solve::PaddedPoints& padded) const {
    if (mesh.hanging().empty()) {
        padded.copy(x);
        return;
    }
    padded.set_zero(mesh.vertex_count());
    for (int i = 0; i < mesh.node_count(); ++i) padded[i] = Lanes{x(i, 0), x(i, 1), x(i, 2), 0.0};
    mesh.spread(padded);
}

void CellKernel::unload(const CellMesh& mesh, Points& gradient) {
    if (mesh.hanging().empty()) {
        gradient_.add_to(gradient);
        return;
    }
    mesh.gather(gradient_);
    for (int i = 0; i < mesh.node_count(); ++i)
        for (int k = 0; k < 3; ++k) gradient(i, k) += gradient_[i][k];
}

template <bool kTargets, bool kRates>
Lanes CellKernel::add_fast(const Lanes* stiffness, const Lanes* targets) {
    Lanes energy{};
    Lanes rate[kStrains];
    for (std::size_t index = 0; index < groups_.size(); ++index) {
        const CellGroup& g = groups_[index];
        const Modes modes = modes_of(g, x_);
        if constexpr (kRates) measure_rate(modes, modes_of(g, v_), rate);
        CellLaw<kTargets, kRates> law{
            g,
            stiffness ? stiffness + 6 * index : g.elastic,
            kTargets ? targets + kStrains * index : nullptr,
            rate,
        };
        Modes out = metric_gradient(law, modes);
        energy += law.energy;
        energy += add_volume_gradient(g, modes, out);
        scatter(g, out, gradient_);
    }
    return energy;
}

template <bool kRates>
Lanes CellKernel::add_curved(bool damped_step) {
    Lanes energy{};
    for (std::size_t index = 0; index < groups_.size(); ++index) {
        const CellGroup& g = groups_[index];
        const CurvedGroup& curved = curved_[index];
        const Modes modes = modes_of(g, x_);
        Modes speed{}, out{};
        if constexpr (kRates) speed = modes_of(g, v_);
        const Lanes factor = damped_step ? step_stiffness_[index] : curved.mu;
        for (int point = 0; point < 8; ++point) {
            LaneVector t[3], rate[3];
            tangents(modes, point, t);
            if constexpr (kRates) tangents(speed, point, rate);
            const Lanes* const target = damped_step ? step_targets_.data() + 48 * index +
                                                          static_cast<std::size_t>(6 * point)
                                                    : curved.rest[point];
            Lanes deviation[6], weighed[6], stress[6];
            for (int n = 0; n < 6; ++n) {
                deviation[n] = dot(t[kRow[n]], t[kColumn[n]]) - target[n];
                weighed[n] = factor * deviation[n];
            }
            sandwich(curved.inverse_metric[point], weighed, stress);
            const Lanes shear =
                stress[3] * deviation[3] + stress[4] * deviation[4] + stress[5] * deviation[5];
            energy += 0.25 * (stress[0] * deviation[0] + stress[1] * deviation[1] +
                              stress[2] * deviation[2] + shear + shear);
            if constexpr (kRates) {
                Lanes viscous[6];
                for (int n = 0; n < 6; ++n)
                    weighed[n] = curved.eta * (dot(rate[kRow[n]], t[kColumn[n]]) +
                                               dot(t[kRow[n]], rate[kColumn[n]]));
                sandwich(curved.inverse_metric[point], weighed, viscous);
                for (int n = 0; n < 6; ++n) stress[n] += viscous[n];
            }
            LaneVector p[3];
            for (int i = 0; i < 3; ++i)
                p[i] =
                    stress[kOf[i][0]] * t[0] + stress[kOf[i][1]] * t[1] + stress[kOf[i][2]] * t[2];
            const Lanes s1 = Lanes{} + ((point & 4) ? 1.0 : -1.0),
                        s2 = Lanes{} + ((point & 2) ? 1.0 : -1.0),
                        s3 = Lanes{} + ((point & 1) ? 1.0 : -1.0);
            out.a += p[0];
            out.b += p[1];
            out.c += p[2];
            out.d += s2 * p[0] + s1 * p[1];
            out.e += s3 * p[0] + s1 * p[2];
            out.f += s3 * p[1] + s2 * p[2];
            out.k += (s2 * s3) * p[0] + (s1 * s3) * p[1] + (s1 * s2) * p[2];
        }
        energy += add_volume_gradient(g, modes, out);
        scatter(g, out, gradient_);
    }
    return energy;
}

double CellKernel::add_gradient(const CellMesh& mesh, const Points& x, const Points* v,
                                Points& gradient) {
    load(mesh, x, x_);
    gradient_.set_zero(mesh.vertex_count());
    const bool rates = v != nullptr && damped_;
    if (rates) load(mesh, *v, v_);
    const Lanes* const targets = rest_targets_.empty() ? nullptr : rest_targets_.data();
    Lanes energy;
    if (!curved_.empty())
        energy = rates ? add_curved<true>(/*damped_step=*/false)
                       : add_curved<false>(/*damped_step=*/false);
    else if (rates)
        energy = targets ? add_fast<true, true>(nullptr, targets)
                         : add_fast<false, true>(nullptr, nullptr);
    else
        energy = targets ? add_fast<true, false>(nullptr, targets)
                         : add_fast<false, false>(nullptr, nullptr);
    unload(mesh, gradient);
    return solve::sum_lanes(energy);
}

// lambda (g - g0)^2 + omega/h (g - gn)^2 = (lambda + omega/h) (g - gm)^2 + a constant
void CellKernel::prepare_step(const CellMesh& mesh, const solve::ImplicitStep& step) {
    if (step.step_s == step_s_ && step.start.rows() == step_start_.rows() &&
        step.start == step_start_)
        return;
    step_s_ = step.step_s;
    step_start_ = step.start;
    const double rate_hz = step.rate_hz();
    load(mesh, step.start, x_);
    Lanes left{};
    const auto blend = [&](const Lanes& elastic, const Lanes& viscous, const Lanes& rest,
                           const Lanes& start, Lanes& target) {
        const Lanes sum = elastic + viscous;
        for (int lane = 0; lane < 4; ++lane)
            target[lane] =
                sum[lane] > 0
                    ? (elastic[lane] * rest[lane] + viscous[lane] * start[lane]) / sum[lane]
                    : rest[lane];
    };
    if (!curved_.empty()) {
        step_targets_.resize(groups_.size() * 48);
        step_stiffness_.resize(groups_.size());
        for (std::size_t index = 0; index < groups_.size(); ++index) {
            const CurvedGroup& curved = curved_[index];
            const Modes modes = modes_of(groups_[index], x_);
            const Lanes viscous = rate_hz * curved.eta;
            step_stiffness_[index] = curved.mu + viscous;
            for (int point = 0; point < 8; ++point) {
                LaneVector t[3];
                tangents(modes, point, t);
                Lanes from_rest[6], from_start[6], stress[6];
                for (int n = 0; n < 6; ++n) {
                    const Lanes start = dot(t[kRow[n]], t[kColumn[n]]);
                    Lanes& target =
                        step_targets_[48 * index + static_cast<std::size_t>(6 * point + n)];
                    blend(curved.mu, viscous, curved.rest[point][n], start, target);
                    from_rest[n] = target - curved.rest[point][n];
                    from_start[n] = target - start;
                }
                for (int part = 0; part < 2; ++part) {
                    Lanes(&from)[6] = part == 0 ? from_rest : from_start;
                    sandwich(curved.inverse_metric[point], from, stress);
                    Lanes sum = stress[3] * from[3] + stress[4] * from[4] + stress[5] * from[5];
                    sum += sum + stress[0] * from[0] + stress[1] * from[1] + stress[2] * from[2];
                    left += 0.25 * (part == 0 ? curved.mu : viscous) * sum;
                }
            }
        }
    } else {
        step_targets_.resize(groups_.size() * kStrains);
        step_stiffness_.resize(groups_.size() * 6);
        Lanes strain[kStrains];
        for (std::size_t index = 0; index < groups_.size(); ++index) {
            const CellGroup& g = groups_[index];
            measure(modes_of(g, x_), strain);
            for (std::size_t n = 0; n < 6; ++n)
                step_stiffness_[6 * index + n] = g.elastic[n] + rate_hz * g.damping[n];
            for (int k = 0; k < kStrains; ++k) {
                const Component n = kComponent[k];
                const std::size_t at = kStrains * index + static_cast<std::size_t>(k);
                const Lanes rest = !rest_targets_.empty() ? rest_targets_[at]
                                   : is_constant(k)       ? g.rest[n]
                                                          : Lanes{};
                const Lanes viscous = rate_hz * g.damping[n];
                Lanes& target = step_targets_[at];
                blend(g.elastic[n], viscous, rest, strain[k], target);
                left += multiplicity(k) * (g.elastic[n] * (target - rest) * (target - rest) +
                                           viscous * (target - strain[k]) * (target - strain[k]));
            }
        }
    }
    step_energy_ = solve::sum_lanes(left);
}

double CellKernel::add_potential(const CellMesh& mesh, const solve::ImplicitStep& step,
                                 const Points& x, Points& gradient) {
    if (!damped_ || !std::isfinite(step.step_s)) return add_gradient(mesh, x, nullptr, gradient);
    prepare_step(mesh, step);
    load(mesh, x, x_);
    gradient_.set_zero(mesh.vertex_count());
    const Lanes energy = curved_.empty()
                             ? add_fast<true, false>(step_stiffness_.data(), step_targets_.data())
                             : add_curved<false>(/*damped_step=*/true);
    unload(mesh, gradient);
    return solve::sum_lanes(energy) + step_energy_;
}

}  // namespace risorius::tissue::detail
