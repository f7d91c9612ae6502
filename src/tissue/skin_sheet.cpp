#include "tissue/skin_sheet.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "tissue/detail/sheet_edges.h"

namespace risorius::tissue {

using solve::Lanes;

namespace {

constexpr double kHingeRounding = 0.1;  ///< of a hinge's rest length

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

SkinSheet::SkinSheet(const Triangles& triangles, const Points& rest,
                     const Eigen::VectorXd& membrane_n_per_m, const Eigen::VectorXd& bending_n_m)
    : triangle_count_(static_cast<int>(triangles.rows())) {
    assert(membrane_n_per_m.size() == triangles.rows() && bending_n_m.size() == triangles.rows());
    triangles_.resize(static_cast<std::size_t>((triangle_count_ + 3) / 4));
    for (int slot = 0; slot < 4 * static_cast<int>(triangles_.size()); ++slot) {
        // The last group is filled up with copies of the last triangle that have no stiffness.
        const int t = std::min(slot, triangle_count_ - 1);
        const Vec3 e1 = point(rest, triangles(t, 1)) - point(rest, triangles(t, 0));
        const Vec3 e2 = point(rest, triangles(t, 2)) - point(rest, triangles(t, 0));
        const double doubled_area = e1.cross(e2).norm();
        if (!(doubled_area > 0))
            throw std::invalid_argument("SkinSheet: triangle " + std::to_string(t) +
                                        " has no area at rest");
        const double l = e1.norm(), ex = e2.dot(e1) / l, ey = doubled_area / l;
        TriangleGroup& group = triangles_[static_cast<std::size_t>(slot / 4)];
        const int lane = slot % 4;
        group.b00[lane] = 1.0 / l;
        group.b01[lane] = -ex / (l * ey);
        group.b11[lane] = 1.0 / ey;
        group.stiffness[lane] =
            slot < triangle_count_ ? 0.5 * doubled_area * membrane_n_per_m[t] : 0.0;
        for (int k = 0; k < 3; ++k) group.node[k][lane] = triangles(t, k);
    }
    add_hinges(triangles, rest, bending_n_m);
}

void SkinSheet::add_hinges(const Triangles& triangles, const Points& rest,
                           const Eigen::VectorXd& bending_n_m) {
    const auto edges = detail::inner_edges(triangles);
    hinge_count_ = static_cast<int>(edges.size());
    hinges_.resize((edges.size() + 3) / 4);
    const auto opposite = [&](const EdgeSide& side) {
        return triangles(side.triangle, (side.edge + 2) % 3);
    };
    for (int slot = 0; slot < 4 * static_cast<int>(hinges_.size()); ++slot) {
        const auto& [first, second] =
            edges[static_cast<std::size_t>(std::min(slot, hinge_count_ - 1))];
        const int nodes[4] = {first.low, first.high, opposite(first), opposite(second)};
        const Vec3 x0 = point(rest, nodes[0]), x1 = point(rest, nodes[1]);
        const Vec3 xa = point(rest, nodes[2]), xb = point(rest, nodes[3]);
        const double at_0a = cotangent(x0, x1, xa), at_0b = cotangent(x0, x1, xb);
        const double at_1a = cotangent(x1, x0, xa), at_1b = cotangent(x1, x0, xb);
        const double c[4] = {at_1a + at_1b, at_0a + at_0b, -at_0a - at_1a, -at_0b - at_1b};
        const double s = (c[0] * (x0 - xb) + c[1] * (x1 - xb) + c[2] * (xa - xb)).norm();
        const double areas =
            area(rest, triangles, first.triangle) + area(rest, triangles, second.triangle);
        const double bending = 0.5 * (bending_n_m[first.triangle] + bending_n_m[second.triangle]);

        HingeGroup& group = hinges_[static_cast<std::size_t>(slot / 4)];
        const int lane = slot % 4;
        const double rounding = kHingeRounding * s;
        group.w[lane] = slot < hinge_count_ ? 3.0 * bending / areas : 0.0;
        group.rest_length[lane] = std::sqrt(s * s + rounding * rounding);
        group.squared_rounding[lane] = rounding * rounding;
        for (int k = 0; k < 4; ++k) {
            group.c[k][lane] = c[k];
            group.node[k][lane] = nodes[k];
        }
    }
}

double SkinSheet::membrane_energy() const {
    const Lanes one = Lanes{} + 1.0;
    Lanes energy{};
    for (const TriangleGroup& g : triangles_) {
        Lanes e1[3], e2[3];
        {
            Lanes r1[4], r2[4];
            for (int lane = 0; lane < 4; ++lane) {
                const Lanes p0 = x_[g.node[0][lane]];
                r1[lane] = x_[g.node[1][lane]] - p0;
                r2[lane] = x_[g.node[2][lane]] - p0;
            }
            solve::rows_to_lanes(r1[0], r1[1], r1[2], r1[3], e1[0], e1[1], e1[2]);
            solve::rows_to_lanes(r2[0], r2[1], r2[2], r2[3], e2[0], e2[1], e2[2]);
        }
        Lanes f0[3], f1[3];
        for (int i = 0; i < 3; ++i) {
            f0[i] = e1[i] * g.b00;
            f1[i] = e1[i] * g.b01 + e2[i] * g.b11;
        }
        const Lanes c00 = f0[0] * f0[0] + f0[1] * f0[1] + f0[2] * f0[2] - one;
        const Lanes c11 = f1[0] * f1[0] + f1[1] * f1[1] + f1[2] * f1[2] - one;
        const Lanes c01 = f0[0] * f1[0] + f0[1] * f1[1] + f0[2] * f1[2];
        energy += g.stiffness * 0.25 * (c00 * c00 + c11 * c11 + 2.0 * (c01 * c01));

        Lanes h1[3], h2[3];
        for (int i = 0; i < 3; ++i) {
            const Lanes p0 = g.stiffness * (f0[i] * c00 + f1[i] * c01);
            const Lanes p1 = g.stiffness * (f0[i] * c01 + f1[i] * c11);
            h1[i] = p0 * g.b00 + p1 * g.b01;
            h2[i] = p1 * g.b11;
        }
        Lanes r1[4], r2[4];
        solve::lanes_to_rows(h1[0], h1[1], h1[2], r1[0], r1[1], r1[2], r1[3]);
        solve::lanes_to_rows(h2[0], h2[1], h2[2], r2[0], r2[1], r2[2], r2[3]);
        for (int lane = 0; lane < 4; ++lane) {
            gradient_[g.node[0][lane]] -= r1[lane] + r2[lane];
            gradient_[g.node[1][lane]] += r1[lane];
            gradient_[g.node[2][lane]] += r2[lane];
        }
    }
    return solve::sum_lanes(energy);
}

double SkinSheet::bending_energy() const {
    Lanes energy{};
    for (const HingeGroup& g : hinges_) {
        // l = sum c_i (x_i - x_3): the c_i add up to zero, and differences keep the digits far from
        // the origin
        Lanes l[3]{};
        for (int k = 0; k < 3; ++k) {
            Lanes r[4], d[3];
            for (int lane = 0; lane < 4; ++lane)
                r[lane] = x_[g.node[k][lane]] - x_[g.node[3][lane]];
            solve::rows_to_lanes(r[0], r[1], r[2], r[3], d[0], d[1], d[2]);
            for (int i = 0; i < 3; ++i) l[i] += g.c[k] * d[i];
        }
        const Lanes squared = l[0] * l[0] + l[1] * l[1] + l[2] * l[2] + g.squared_rounding;
        Lanes s, divisor;
        for (int lane = 0; lane < 4; ++lane) {
            s[lane] = std::sqrt(squared[lane]);
            divisor[lane] = std::max(s[lane], std::numeric_limits<double>::min());
        }
        const Lanes stretch = s - g.rest_length;
        energy += g.w * 0.5 * stretch * stretch;

        // w (s - S) / s = w - w S / s; where S = 0 the second part is zero even at s = 0
        const Lanes pull = g.w - g.w * g.rest_length / divisor;
        for (int i = 0; i < 3; ++i) l[i] *= pull;
        for (int k = 0; k < 4; ++k) {
            Lanes r[4];
            solve::lanes_to_rows(g.c[k] * l[0], g.c[k] * l[1], g.c[k] * l[2], r[0], r[1], r[2],
                                 r[3]);
            for (int lane = 0; lane < 4; ++lane) gradient_[g.node[k][lane]] += r[lane];
        }
    }
    return solve::sum_lanes(energy);
}

double SkinSheet::add_energy(const Points& x, Points& gradient) const {
    assert(gradient.rows() == x.rows());
    x_.copy(x);
    gradient_.set_zero(x.rows());
    const double energy = membrane_energy() + bending_energy();
    gradient_.add_to(gradient);
    return energy;
}

void SkinSheet::add_metric(solve::MetricBuilder& builder) const {
    for (int t = 0; t < triangle_count_; ++t) {
        const TriangleGroup& group = triangles_[static_cast<std::size_t>(t / 4)];
        const int lane = t % 4;
        Eigen::Matrix<double, 3, 2> g;
        g.row(1) << group.b00[lane], group.b01[lane];
        g.row(2) << 0.0, group.b11[lane];
        g.row(0) = -(g.row(1) + g.row(2));
        const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> block =
            2.0 * group.stiffness[lane] * (g * g.transpose());
        const int nodes[3] = {group.node[0][lane], group.node[1][lane], group.node[2][lane]};
        builder.add_block(nodes, block.data(), 3);
    }
    for (int h = 0; h < hinge_count_; ++h) {
        const HingeGroup& group = hinges_[static_cast<std::size_t>(h / 4)];
        const int lane = h % 4;
        int nodes[4];
        double c[4];
        for (int k = 0; k < 4; ++k) {
            nodes[k] = group.node[k][lane];
            c[k] = group.c[k][lane];
        }
        builder.add_outer(nodes, c, 4, group.w[lane]);
    }
}

}  // namespace risorius::tissue
