// SPDX-License-Identifier: MIT
#include "risorius/tissue/tet_solid.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <string>

namespace risorius::tissue {

using solve::Lanes;

namespace {

Mat3 edges(const Points& x, const Tets& tets, int tet) {
    Mat3 d;
    for (int k = 0; k < 3; ++k)
        d.col(k) = (x.row(tets(tet, k + 1)) - x.row(tets(tet, 0))).transpose();
    return d;
}

}  // namespace

TetSolid::TetSolid(const Tets& tets, const Points& rest, const Eigen::VectorXd& mu_pa,
                   const Eigen::VectorXd& bulk_pa)
    : TetSolid(tets, rest, mu_pa, bulk_pa, find_fans(tets)) {}

TetSolid::TetSolid(const Tets& tets, const Points& rest, const Eigen::VectorXd& mu_pa,
                   const Eigen::VectorXd& bulk_pa, const TetFans& fans)
    : tets_(tets), rest_(rest), rest_volume_(tets.rows()), mu_(mu_pa), bulk_(bulk_pa) {
    assert(mu_pa.size() == tets.rows() && bulk_pa.size() == tets.rows());
    for (int tet = 0; tet < size(); ++tet) {
        const Mat3 rest_edges = edges(rest_, tets_, tet);
        rest_volume_[tet] = rest_edges.determinant() / 6.0;
        if (!(rest_volume_[tet] > 0))
            throw std::invalid_argument("TetSolid: tet " + std::to_string(tet) +
                                        " has no positive volume at rest");
        inverse_.push_back(rest_edges.inverse());
    }
    place(fans);
    fill(double_, fans);
    fill(single_, fans);
}

void TetSolid::place(const TetFans& found) {
    place_.resize(static_cast<std::size_t>(size()));
    const auto add = [&](int count, const TetFan& fan) {
        Fan kept{.nodes = count + 3, .tets = fan.tets, .node = fan.nodes};
        for (int k = 0; k < count; ++k) kept.bulk += rest_volume_[fan.tets[k]] * bulk_[fan.tets[k]];
        const int number = static_cast<int>(fans_.size());
        for (int k = 0; k < count; ++k) {
            const int tet = fan.tets[k];
            Place& place = place_[static_cast<std::size_t>(tet)];
            place.fan = number;
            place.share = kept.bulk > 0 ? rest_volume_[tet] * bulk_[tet] / kept.bulk : 1.0 / count;
            for (int corner = 0; corner < 4; ++corner) {
                const auto in_fan =
                    std::find(kept.node.begin(), kept.node.end(), tets_(tet, corner));
                place.corner[corner] =
                    number * (kFanTets + 3) + static_cast<int>(in_fan - kept.node.begin());
            }
        }
        fans_.push_back(kept);
    };
    for (const TetFan& fan : found.fans) add(kFanTets, fan);
    for (int tet : found.alone)
        add(1, {{tet}, {tets_(tet, 0), tets_(tet, 1), tets_(tet, 2), tets_(tet, 3), -1, -1}});
}

template <class Real>
void TetSolid::fill(Work<Real>& work, const TetFans& found) const {
    fill(work.fans, found.fans);
    std::vector<TetFan> alone;
    for (int tet : found.alone)
        alone.push_back({{tet}, {tets_(tet, 0), tets_(tet, 1), tets_(tet, 2), tets_(tet, 3)}});
    fill(work.alone, alone);
}

template <class Real, int kTets>
void TetSolid::fill(Groups<Real, kTets>& groups, const std::vector<TetFan>& fans) const {
    constexpr int kWidth = Group<Real, kTets>::kWidth;
    const int count = static_cast<int>(fans.size());
    groups.list.resize(static_cast<std::size_t>((count + kWidth - 1) / kWidth));
    groups.start.resize(groups.list.size());
    for (int slot = 0; slot < kWidth * static_cast<int>(groups.list.size()); ++slot) {
        // The last group is filled with copies of the last fan that have no stiffness.
        const TetFan& fan = fans[static_cast<std::size_t>(std::min(slot, count - 1))];
        Group<Real, kTets>& group = groups.list[static_cast<std::size_t>(slot / kWidth)];
        const int lane = slot % kWidth;
        for (int k = 0; k < kTets + 3; ++k) group.node[k][lane] = fan.nodes[k];
        for (int i = 0; i < kTets; ++i) {
            Mat3 d;
            const auto along = [&](int node) -> Vec3 {
                return (rest_.row(fan.nodes[node]) - rest_.row(fan.nodes[0])).transpose();
            };
            d << along(1), along(2 + i), along(3 + i);
            const Mat3 b = d.inverse();
            const double weight = slot < count ? rest_volume_[fan.tets[i]] : 0.0;
            auto& tet = group.tet[i];
            for (int k = 0; k < 3; ++k)
                for (int j = 0; j < 3; ++j) tet.b[3 * k + j][lane] = static_cast<Real>(b(k, j));
            tet.shear[lane] = static_cast<Real>(weight * mu_[fan.tets[i]]);
            tet.bulk[lane] = static_cast<Real>(weight * bulk_[fan.tets[i]]);
            tet.share[lane] =
                static_cast<Real>(place_[static_cast<std::size_t>(fan.tets[i])].share);
        }
    }
}

namespace {

// Coordinates of the edges of displacement from node a: [other node][coordinate].
template <class Real, class Group, int kEdges>
[[gnu::always_inline]] inline void gather(const solve::PaddedRows<Real>& u, const Group& g,
                                          typename Group::Lane (&edge)[kEdges][3]) {
    using Point = typename solve::LanesOf<Real>::Point;
    Point origin[Group::kWidth], r[Group::kWidth];
    for (int lane = 0; lane < Group::kWidth; ++lane) origin[lane] = u[g.node[0][lane]];
    for (int k = 0; k < kEdges; ++k) {
        for (int lane = 0; lane < Group::kWidth; ++lane)
            r[lane] = u[g.node[k + 1][lane]] - origin[lane];
        solve::rows_to_lanes(r, edge[k][0], edge[k][1], edge[k][2]);
    }
}

// Adds forces on the ends of the edges. Node a gets the negative sum of all of them.
template <class Real, class Group, int kEdges>
[[gnu::always_inline]] inline void scatter(const typename Group::Lane (&force)[kEdges][3],
                                           const Group& g, solve::PaddedRows<Real>& out) {
    using Point = typename solve::LanesOf<Real>::Point;
    Point sum[Group::kWidth]{}, r[Group::kWidth];
    for (int k = 0; k < kEdges; ++k) {
        solve::lanes_to_rows(force[k][0], force[k][1], force[k][2], r);
        for (int lane = 0; lane < Group::kWidth; ++lane) {
            out[g.node[k + 1][lane]] += r[lane];
            sum[lane] += r[lane];
        }
    }
    for (int lane = 0; lane < Group::kWidth; ++lane) out[g.node[0][lane]] -= sum[lane];
}

template <class Lane>
Lane dot(const Lane& a0, const Lane& b0, const Lane& a1, const Lane& b1, const Lane& a2,
         const Lane& b2) {
    return solve::fused(a2, b2, solve::fused(a1, b1, a0 * b0));
}

// H = D B; the columns of D are the edges of displacement.
template <class Lane>
[[gnu::always_inline]] inline void gradient_of(const Lane (&d0)[3], const Lane (&d1)[3],
                                               const Lane (&d2)[3], const Lane (&b)[9],
                                               Lane (&h)[3][3]) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) h[i][j] = dot(d0[i], b[j], d1[i], b[3 + j], d2[i], b[6 + j]);
}

// How the cofactor of F and J - 1 follow from H = F - I, so that they are accurate near the rest shape:
//   cof F = (1 + tr H) I - H^T + cof H,   J - 1 = tr H + tr cof H + det H
template <class Real, class Lane>
[[gnu::always_inline]] inline Lane volume_change_of(const Lane (&h)[3][3], Lane (&cof)[3][3]) {
    for (int i = 0; i < 3; ++i) {
        const int m = (i + 1) % 3, n = (i + 2) % 3;
        for (int j = 0; j < 3; ++j) {
            const int q = (j + 1) % 3, r = (j + 2) % 3;
            cof[i][j] = solve::fused(h[m][q], h[n][r], -(h[m][r] * h[n][q]));
        }
    }
    const Lane trace = h[0][0] + h[1][1] + h[2][2];
    const Lane j_minus_1 = trace + (cof[0][0] + cof[1][1] + cof[2][2]) +
                           dot(h[0][0], cof[0][0], h[0][1], cof[0][1], h[0][2], cof[0][2]);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            cof[i][j] = i == j ? cof[i][j] + (trace - h[i][i] + Real(1)) : cof[i][j] - h[j][i];
    return j_minus_1;
}

// Energy of a tet, and its first Piola-Kirchhoff stress P, both times V. M is the mean J of its fan.
//   P = mu F C + K ((1 - s) (M - 1) + s (J - 1) + c min(0, J - J_c)) cof F,   C = F^T F - I
// On return, `cof` is P.
template <class Real, class Lane>
[[gnu::always_inline]] inline Lane stress_of(const Lane (&h)[3][3], const Lane& j_minus_1,
                                             const Lane& mean_minus_1, const Lane& shear,
                                             const Lane& bulk, Lane (&cof)[3][3]) {
    constexpr Real kHalf = Real(0.5);
    constexpr Real kOwn = Real(TetSolid::kOwnVolume), kShared = Real(1 - TetSolid::kOwnVolume);
    constexpr Real kSpare = Real(1 - TetSolid::kCrushed), kMore = Real(TetSolid::kHardens);
    // C = H + H^T + H^T H
    Lane c[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) {
            c[i][j] = h[i][j] + h[j][i];
            for (int k = 0; k < 3; ++k) c[i][j] = solve::fused(h[k][i], h[k][j], c[i][j]);
        }

    const Lane spare = j_minus_1 + kSpare;
    const Lane crushed = kMore * (spare < Real(0) ? spare : Lane{});
    const Lane own = kOwn * j_minus_1, shared = kShared * mean_minus_1;
    const Lane pressure = bulk * (own + shared + crushed);

    const Lane off_diagonal = dot(c[0][1], c[0][1], c[0][2], c[0][2], c[1][2], c[1][2]);
    const Lane squares =
        dot(c[0][0], c[0][0], c[1][1], c[1][1], c[2][2], c[2][2]) + off_diagonal + off_diagonal;
    const Lane twice = solve::fused(
        shear * kHalf, squares,
        bulk * dot(shared, mean_minus_1, own, j_minus_1, (1 / kMore) * crushed, crushed));

    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) c[j][i] = c[i][j] = shear * c[i][j];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            cof[i][j] = solve::fused(pressure, cof[i][j], c[i][j]);
            for (int k = 0; k < 3; ++k) cof[i][j] = solve::fused(h[i][k], c[k][j], cof[i][j]);
        }
    return kHalf * twice;
}

}  // namespace

double TetSolid::add_energy(const Points& x, Points& gradient, solve::Precision precision) const {
    assert(gradient.rows() == x.rows());
    return precision == solve::Precision::kSingle
               ? add_energy_in<float, false>(single_, x, gradient)
               : add_energy_in<double, false>(double_, x, gradient);
}

void TetSolid::begin_step(const Points& start, double viscosity, solve::Precision precision) {
    viscosity_ = viscosity;
    if (precision == solve::Precision::kSingle)
        begin_step_in(single_, start);
    else
        begin_step_in(double_, start);
}

double TetSolid::add_step_energy(const Points& x, Points& gradient,
                                 solve::Precision precision) const {
    assert(gradient.rows() == x.rows());
    return precision == solve::Precision::kSingle
               ? add_energy_in<float, true>(single_, x, gradient)
               : add_energy_in<double, true>(double_, x, gradient);
}

template <class Real>
void TetSolid::begin_step_in(Work<Real>& work, const Points& start) const {
    using Lane = typename solve::LanesOf<Real>::Lane;
    solve::PaddedRows<Real>& u = work.displacement;
    u.copy_difference(start, rest_);
    const auto note = [&]<int kTets>(Groups<Real, kTets>& groups) {
        for (std::size_t n = 0; n < groups.list.size(); ++n) {
            const Group<Real, kTets>& g = groups.list[n];
            Lane edge[kTets + 2][3], h[3][3];
            gather(u, g, edge);
            for (int t = 0; t < kTets; ++t) {
                gradient_of(edge[0], edge[1 + t], edge[2 + t], g.tet[t].b, h);
                for (int k = 0; k < 9; ++k) groups.start[n][t][k] = h[k / 3][k % 3];
            }
        }
    };
    note(work.fans);
    note(work.alone);
}

template <class Real, bool kInStep>
double TetSolid::add_energy_in(Work<Real>& work, const Points& x, Points& gradient) const {
    using Lane = typename solve::LanesOf<Real>::Lane;
    const Real viscosity = static_cast<Real>(viscosity_);
    solve::PaddedRows<Real>& u = work.displacement;
    solve::PaddedRows<Real>& out = work.gradient;
    u.copy_difference(x, rest_);
    out.set_zero(rest_.rows());
    Lanes energy{};
    const auto add = [&]<int kTets>(const Groups<Real, kTets>& groups) {
        for (std::size_t n = 0; n < groups.list.size(); ++n) {
            const Group<Real, kTets>& g = groups.list[n];
            Lane edge[kTets + 2][3], force[kTets + 2][3]{};
            gather(u, g, edge);
            Lane of_fan{}, mean_minus_1{}, j_minus_1[kTets], of_tet[kTets][3][3],
                stress[kTets][3][3];
            for (int t = 0; t < kTets; ++t) {
                gradient_of(edge[0], edge[1 + t], edge[2 + t], g.tet[t].b, of_tet[t]);
                j_minus_1[t] = volume_change_of<Real>(of_tet[t], stress[t]);
                mean_minus_1 = solve::fused(g.tet[t].share, j_minus_1[t], mean_minus_1);
            }
            for (int t = 0; t < kTets; ++t) {
                const auto& tet = g.tet[t];
                Lane(&h)[3][3] = of_tet[t], (&p)[3][3] = stress[t];
                of_fan += stress_of<Real>(h, j_minus_1[t], mean_minus_1, tet.shear, tet.bulk, p);
                if constexpr (kInStep) {
                    Lane squares{};
                    const Lane damping = viscosity * tet.shear;
                    for (int k = 0; k < 9; ++k) {
                        const Lane flown = h[k / 3][k % 3] - groups.start[n][t][k];
                        squares = solve::fused(flown, flown, squares);
                        p[k / 3][k % 3] = solve::fused(damping, flown, p[k / 3][k % 3]);
                    }
                    of_fan = solve::fused(Real(0.5) * damping, squares, of_fan);
                }
                // P B^T: a column for each edge
                Lane* const ends[3] = {force[0], force[1 + t], force[2 + t]};
                for (int k = 0; k < 3; ++k)
                    for (int i = 0; i < 3; ++i)
                        for (int j = 0; j < 3; ++j)
                            ends[k][i] = solve::fused(p[i][j], tet.b[3 * k + j], ends[k][i]);
            }
            solve::add_lanes(energy, of_fan);
            scatter(force, g, out);
        }
    };
    add(work.fans);
    add(work.alone);
    out.add_to(gradient);
    return solve::sum_lanes(energy);
}

void TetSolid::add_gradients(solve::MetricBuilder& builder, const Eigen::VectorXd& weight) const {
    for (int tet = 0; tet < size(); ++tet) {
        // Row v of G is the gradient of the shape function of corner v.
        Eigen::Matrix<double, 4, 3> g;
        g.bottomRows<3>() = inverse_[static_cast<std::size_t>(tet)];
        g.row(0) = -(g.row(1) + g.row(2) + g.row(3));
        const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> block =
            weight[tet] * (g * g.transpose());
        builder.add_block(&tets_(tet, 0), block.data(), 4);
    }
}

void TetSolid::add_metric(solve::MetricBuilder& builder) const {
    add_gradients(builder, rest_volume_.cwiseProduct(2.0 * mu_ + bulk_));
}

void TetSolid::add_laplacian(solve::MetricBuilder& builder, double scale) const {
    add_gradients(builder, scale * rest_volume_.cwiseProduct(mu_));
}

double TetSolid::signed_volume(const Points& x, int tet) const {
    return edges(x, tets_, tet).determinant() / 6.0;
}

TetFans TetSolid::fans() const {
    TetFans out;
    for (const Fan& fan : fans_)
        if (fan.nodes == kFanTets + 3)
            out.fans.push_back({fan.tets, fan.node});
        else
            out.alone.push_back(fan.tets[0]);
    return out;
}

double TetSolid::mean_volume_ratio(const Points& x, int tet) const {
    const Fan& fan = fans_[static_cast<std::size_t>(place_[static_cast<std::size_t>(tet)].fan)];
    double mean = 0;
    for (int k = 0; k < fan.nodes - 3; ++k)
        mean += place_[static_cast<std::size_t>(fan.tets[k])].share *
                signed_volume(x, fan.tets[k]) / rest_volume_[fan.tets[k]];
    return mean;
}

Mat3 TetSolid::deformation_gradient(const Points& x, int tet) const {
    return edges(x, tets_, tet) * inverse_[static_cast<std::size_t>(tet)];
}

Mat3 TetSolid::cauchy_stress_pa(const Points& x, int tet) const {
    const Mat3 f = deformation_gradient(x, tet);
    const double j = f.determinant(), bulk = bulk_[tet];
    if (j == 0) return Mat3::Zero();
    const double change = (1 - kOwnVolume) * (mean_volume_ratio(x, tet) - 1) + kOwnVolume * (j - 1);
    const double pressure = bulk * (change + kHardens * std::min(0.0, j - kCrushed));
    return mu_[tet] / j * f * (f.transpose() * f - Mat3::Identity()) * f.transpose() +
           pressure * Mat3::Identity();
}

int TetSolid::inverted_count(const Points& x) const {
    int count = 0;
    for (int tet = 0; tet < size(); ++tet)
        if (!(signed_volume(x, tet) > 0)) ++count;
    return count;
}

double TetSolid::volume(const Points& x) const {
    double sum = 0;
    for (int tet = 0; tet < size(); ++tet) sum += signed_volume(x, tet);
    return sum;
}

double TetSolid::min_relative_volume(const Points& x) const {
    double min = size() == 0 ? 1.0 : signed_volume(x, 0) / rest_volume_[0];
    for (int tet = 1; tet < size(); ++tet)
        min = std::min(min, signed_volume(x, tet) / rest_volume_[tet]);
    return min;
}

Eigen::VectorXd TetSolid::lumped_mass(double density_kg_per_m3, int nodes) const {
    Eigen::VectorXd mass = Eigen::VectorXd::Zero(nodes);
    for (int tet = 0; tet < size(); ++tet)
        for (int k = 0; k < 4; ++k)
            mass[tets_(tet, k)] += 0.25 * density_kg_per_m3 * rest_volume_[tet];
    return mass;
}

}  // namespace risorius::tissue
