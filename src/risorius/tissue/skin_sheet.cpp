// SPDX-License-Identifier: MIT
#include "risorius/tissue/skin_sheet.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "risorius/tissue/detail/sheet_edges.h"

namespace risorius::tissue {

using solve::Lanes;

namespace {

constexpr double kHingeRounding = 0.1;  ///< fraction of a hinge's rest length

using detail::EdgeSide;
using detail::point;

/// Cotangent of the angle at `apex` between the directions to a and b.
double cotangent(const Vec3& apex, const Vec3& a, const Vec3& b) {
    const Vec3 u = a - apex, v = b - apex;
    return u.dot(v) / u.cross(v).norm();
}

double area(const Points& x, const Triangles& triangles, int t) {
    const Vec3 p = point(x, triangles(t, 0));
    return 0.5 * (point(x, triangles(t, 1)) - p).cross(point(x, triangles(t, 2)) - p).norm();
}

}  // namespace

SkinSheet::SkinSheet(const Triangles& all_triangles, const Points& all_rest,
                     const Eigen::VectorXd& membrane_n_per_m, const Eigen::VectorXd& bending_n_m)
    : triangle_count_(static_cast<int>(all_triangles.rows())) {
    assert(membrane_n_per_m.size() == triangle_count_ && bending_n_m.size() == triangle_count_);
    // The sheet has only some of the nodes of the body it lies on.
    std::vector<int> place(static_cast<std::size_t>(all_rest.rows()), -1);
    for (int node : all_triangles.reshaped()) place[static_cast<std::size_t>(node)] = 0;
    for (std::size_t node = 0; node < place.size(); ++node)
        if (place[node] == 0) {
            place[node] = static_cast<int>(rows_.size());
            rows_.push_back(static_cast<int>(node));
        }
    rest_ = all_rest(rows_, Eigen::all);
    const Triangles triangles =
        all_triangles.unaryExpr([&](int node) { return place[static_cast<std::size_t>(node)]; });
    const Points& rest = rest_;
    std::vector<Triangle> sheet;
    for (int t = 0; t < triangle_count_; ++t) {
        const Vec3 e1 = point(rest, triangles(t, 1)) - point(rest, triangles(t, 0));
        const Vec3 e2 = point(rest, triangles(t, 2)) - point(rest, triangles(t, 0));
        const double doubled_area = e1.cross(e2).norm();
        if (!(doubled_area > 0))
            throw std::invalid_argument("SkinSheet: triangle " + std::to_string(t) +
                                        " has no area at rest");
        const double l = e1.norm(), ex = e2.dot(e1) / l, ey = doubled_area / l;
        sheet.push_back({{triangles(t, 0), triangles(t, 1), triangles(t, 2)},
                         1.0 / l,
                         -ex / (l * ey),
                         1.0 / ey,
                         0.5 * doubled_area * membrane_n_per_m[t],
                         {e1 / l, (e2 - ex / l * e1) / ey}});
    }
    const std::vector<Hinge> hinges = hinges_of(triangles, bending_n_m);
    hinge_count_ = static_cast<int>(hinges.size());
    fill(sheet, hinges, double_);
    fill(sheet, hinges, single_);
}

std::vector<SkinSheet::Hinge> SkinSheet::hinges_of(const Triangles& triangles,
                                                   const Eigen::VectorXd& bending_n_m) const {
    std::vector<Hinge> out;
    const auto opposite = [&](const EdgeSide& side) {
        return triangles(side.triangle, (side.edge + 2) % 3);
    };
    for (const auto& [first, second] : detail::inner_edges(triangles)) {
        Hinge hinge{.node = {first.low, first.high, opposite(first), opposite(second)}};
        const Vec3 x0 = point(rest_, hinge.node[0]), x1 = point(rest_, hinge.node[1]);
        const Vec3 xa = point(rest_, hinge.node[2]), xb = point(rest_, hinge.node[3]);
        const double at_0a = cotangent(x0, x1, xa), at_0b = cotangent(x0, x1, xb);
        const double at_1a = cotangent(x1, x0, xa), at_1b = cotangent(x1, x0, xb);
        double* const c = hinge.c;
        c[0] = at_1a + at_1b;
        c[1] = at_0a + at_0b;
        c[2] = -at_0a - at_1a;
        c[3] = -at_0b - at_1b;
        hinge.rest = c[0] * (x0 - xb) + c[1] * (x1 - xb) + c[2] * (xa - xb);
        const double s = hinge.rest.norm(), rounding = kHingeRounding * s;
        const double areas =
            area(rest_, triangles, first.triangle) + area(rest_, triangles, second.triangle);
        hinge.w =
            3.0 * (0.5 * (bending_n_m[first.triangle] + bending_n_m[second.triangle])) / areas;
        hinge.squared_rounding = rounding * rounding;
        out.push_back(hinge);
    }
    return out;
}

// The last groups are filled with copies of the last element that have no stiffness.
template <class Real>
void SkinSheet::fill(const std::vector<Triangle>& triangles, const std::vector<Hinge>& hinges,
                     Work<Real>& work) {
    constexpr std::size_t kWidth = solve::LanesOf<Real>::kWidth;
    const auto real = [](double value) { return static_cast<Real>(value); };
    work.triangles.resize((triangles.size() + kWidth - 1) / kWidth);
    for (std::size_t slot = 0; slot < kWidth * work.triangles.size(); ++slot) {
        const Triangle& from = triangles[std::min(slot, triangles.size() - 1)];
        TriangleGroup<Real>& group = work.triangles[slot / kWidth];
        const std::size_t lane = slot % kWidth;
        group.b00[lane] = real(from.b00);
        group.b01[lane] = real(from.b01);
        group.b11[lane] = real(from.b11);
        group.stiffness[lane] = real(slot < triangles.size() ? from.stiffness : 0.0);
        for (int k = 0; k < 3; ++k) {
            group.t[0][k][lane] = real(from.t[0][k]);
            group.t[1][k][lane] = real(from.t[1][k]);
            group.node[k][lane] = from.node[k];
        }
    }
    work.hinges.resize((hinges.size() + kWidth - 1) / kWidth);
    for (std::size_t slot = 0; slot < kWidth * work.hinges.size(); ++slot) {
        const Hinge& from = hinges[std::min(slot, hinges.size() - 1)];
        HingeGroup<Real>& group = work.hinges[slot / kWidth];
        const std::size_t lane = slot % kWidth;
        group.w[lane] = real(slot < hinges.size() ? from.w : 0.0);
        group.squared_rounding[lane] = real(from.squared_rounding);
        for (int k = 0; k < 3; ++k) group.rest[k][lane] = real(from.rest[k]);
        for (int k = 0; k < 4; ++k) {
            group.c[k][lane] = real(from.c[k]);
            group.node[k][lane] = from.node[k];
        }
    }
    // Rounded like the energy, so that the rest shape is exact.
    for (HingeGroup<Real>& g : work.hinges)
        g.rest_length = solve::sqrt_lanes(g.rest[0] * g.rest[0] + g.rest[1] * g.rest[1] +
                                          g.rest[2] * g.rest[2] + g.squared_rounding);
}

template <class Real>
double SkinSheet::membrane_energy(Work<Real>& work) {
    using Lane = typename solve::LanesOf<Real>::Lane;
    using Point = typename solve::LanesOf<Real>::Point;
    constexpr int kWidth = solve::LanesOf<Real>::kWidth;
    Lanes energy{};
    for (const TriangleGroup<Real>& g : work.triangles) {
        Lane d1[3], d2[3];
        {
            Point r1[kWidth], r2[kWidth];
            for (int lane = 0; lane < kWidth; ++lane) {
                const Point p0 = work.displacement[g.node[0][lane]];
                r1[lane] = work.displacement[g.node[1][lane]] - p0;
                r2[lane] = work.displacement[g.node[2][lane]] - p0;
            }
            solve::rows_to_lanes(r1, d1[0], d1[1], d1[2]);
            solve::rows_to_lanes(r2, d2[0], d2[1], d2[2]);
        }
        // F = T + H, C = F^T F - I = T^T H + H^T T + H^T H
        Lane h0[3], h1[3], f0[3], f1[3];
        for (int i = 0; i < 3; ++i) {
            h0[i] = d1[i] * g.b00;
            h1[i] = d1[i] * g.b01 + d2[i] * g.b11;
            f0[i] = g.t[0][i] + h0[i];
            f1[i] = g.t[1][i] + h1[i];
        }
        Lane c00{}, c11{}, c01{};
        for (int i = 0; i < 3; ++i) {
            c00 += h0[i] * (g.t[0][i] + f0[i]);
            c11 += h1[i] * (g.t[1][i] + f1[i]);
            c01 += g.t[0][i] * h1[i] + h0[i] * f1[i];
        }
        const Lane cross = c01 * c01;
        solve::add_lanes(energy,
                         g.stiffness * Real(0.25) * (c00 * c00 + c11 * c11 + cross + cross));

        Lane along1[3], along2[3];
        for (int i = 0; i < 3; ++i) {
            const Lane p0 = g.stiffness * (f0[i] * c00 + f1[i] * c01);
            const Lane p1 = g.stiffness * (f0[i] * c01 + f1[i] * c11);
            along1[i] = p0 * g.b00 + p1 * g.b01;
            along2[i] = p1 * g.b11;
        }
        Point r1[kWidth], r2[kWidth];
        solve::lanes_to_rows(along1[0], along1[1], along1[2], r1);
        solve::lanes_to_rows(along2[0], along2[1], along2[2], r2);
        for (int lane = 0; lane < kWidth; ++lane) {
            work.gradient[g.node[0][lane]] -= r1[lane] + r2[lane];
            work.gradient[g.node[1][lane]] += r1[lane];
            work.gradient[g.node[2][lane]] += r2[lane];
        }
    }
    return solve::sum_lanes(energy);
}

template <class Real>
double SkinSheet::bending_energy(Work<Real>& work) {
    using Lane = typename solve::LanesOf<Real>::Lane;
    using Point = typename solve::LanesOf<Real>::Point;
    constexpr int kWidth = solve::LanesOf<Real>::kWidth;
    const Lane min = Lane{} + std::numeric_limits<Real>::min();
    Lanes energy{};
    for (const HingeGroup<Real>& g : work.hinges) {
        // l = sum c_i x_i. The c_i add up to zero, so three differences of displacements are enough.
        Lane l[3] = {g.rest[0], g.rest[1], g.rest[2]};
        for (int k = 0; k < 3; ++k) {
            Point r[kWidth];
            for (int lane = 0; lane < kWidth; ++lane)
                r[lane] = work.displacement[g.node[k][lane]] - work.displacement[g.node[3][lane]];
            Lane d[3];
            solve::rows_to_lanes(r, d[0], d[1], d[2]);
            for (int i = 0; i < 3; ++i) l[i] += g.c[k] * d[i];
        }
        const Lane s =
            solve::sqrt_lanes(l[0] * l[0] + l[1] * l[1] + l[2] * l[2] + g.squared_rounding);
        const Lane stretch = s - g.rest_length;
        solve::add_lanes(energy, g.w * Real(0.5) * stretch * stretch);

        // w (s - S) / s; where S = 0 there is no force at s = 0
        const Lane pull = g.w * (stretch / (s > min ? s : min));
        for (int i = 0; i < 3; ++i) l[i] *= pull;
        Point sum[kWidth] = {};
        for (int k = 0; k < 3; ++k) {
            Point r[kWidth];
            solve::lanes_to_rows(g.c[k] * l[0], g.c[k] * l[1], g.c[k] * l[2], r);
            for (int lane = 0; lane < kWidth; ++lane) {
                work.gradient[g.node[k][lane]] += r[lane];
                sum[lane] += r[lane];
            }
        }
        for (int lane = 0; lane < kWidth; ++lane) work.gradient[g.node[3][lane]] -= sum[lane];
    }
    return solve::sum_lanes(energy);
}

template <class Real>
double SkinSheet::add_energy_in(Work<Real>& work, const Points& x, Points& gradient) const {
    work.displacement.copy_difference(x, rows_, rest_);
    work.gradient.set_zero(rest_.rows());
    const double energy = membrane_energy(work) + bending_energy(work);
    work.gradient.add_to(gradient, rows_);
    return energy;
}

double SkinSheet::add_energy(const Points& x, Points& gradient, solve::Precision precision) const {
    assert(gradient.rows() == x.rows());
    return precision == solve::Precision::kSingle ? add_energy_in(single_, x, gradient)
                                                  : add_energy_in(double_, x, gradient);
}

void SkinSheet::add_metric(solve::MetricBuilder& builder) const {
    for (int t = 0; t < triangle_count_; ++t) {
        const TriangleGroup<double>& group = double_.triangles[static_cast<std::size_t>(t / 4)];
        const int lane = t % 4;
        Eigen::Matrix<double, 3, 2> g;
        g.row(1) << group.b00[lane], group.b01[lane];
        g.row(2) << 0.0, group.b11[lane];
        g.row(0) = -(g.row(1) + g.row(2));
        const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> block =
            2.0 * group.stiffness[lane] * (g * g.transpose());
        const int nodes[3] = {node_of(group, 0, lane), node_of(group, 1, lane),
                              node_of(group, 2, lane)};
        builder.add_block(nodes, block.data(), 3);
    }
    for (int h = 0; h < hinge_count_; ++h) {
        const HingeGroup<double>& group = double_.hinges[static_cast<std::size_t>(h / 4)];
        const int lane = h % 4;
        int nodes[4];
        double c[4];
        for (int k = 0; k < 4; ++k) {
            nodes[k] = node_of(group, k, lane);
            c[k] = group.c[k][lane];
        }
        builder.add_outer(nodes, c, 4, group.w[lane]);
    }
}

}  // namespace risorius::tissue
