// SPDX-License-Identifier: MIT
/// \file
/// The inner loop of a solid of trilinear cells: four cells at a time, without a loop over Gauss points.
///
/// A trilinear map from xi to space has seven modes besides its mean. With xi in [-1,1]^3, its tangents at the Gauss points xi
/// = s / sqrt 3, s = +-1, are
///   t1 = a + s2 d + s3 e + s2 s3 k     t2 = b + s1 d + s3 f + s1 s3 k     t3 = c + s1 e + s2 f + s1 s2 k
/// Here a, b, c are the linear modes, d, e, f are the bilinear modes times 1/sqrt 3, and k is the trilinear mode times 1/3; all
/// of them are scaled by 8. For fixed s3, t1 = p + s2 q and t2 = u + s1 q with p = a + s3 e, q = d + s3 k and u = b + s3 f.
/// Hence
///   t1.t1 = (p.p + q.q) + s2 2 p.q      t1.t2 = p.u + s1 p.q + s2 q.u + s1 s2 q.q
/// lambda is constant in the cell, so the sum of squares over the four points is four times the sum of squares of these
/// coefficients. This needs 36 numbers ("strains") instead of 48 metric entries, and no inverse transform. The volume is
///   64 V = a.(b x c) + a.(d x e) + b.(f x d) + c.(e x f)
/// where V is the volume of the cell. This is exact, because the mean of xi^2 is 1/3, the square of the scale of d, e, f.
#pragma once

#include <cstdint>

#include "risorius/solve/lanes.h"

namespace risorius::tissue::detail {

using solve::Lanes;

enum Component { k11, k22, k33, k12, k13, k23 };
constexpr int kStrains = 36;

/// Tensor component of each strain; see measure().
constexpr Component kComponent[kStrains] = {
    k11, k11, k22, k22, k12, k12, k12, k12, k11, k11, k22, k22, k12, k12, k12, k12,  // s3 = +, -
    k33, k33, k13, k13, k13, k13, k33, k33, k13, k13, k13, k13,                      // s2 = +, -
    k23, k23, k23, k23, k23, k23, k23, k23};                                         // s1 = +, -
/// Shear strains count twice, as G_ij and G_ji.
constexpr double multiplicity(int strain) { return kComponent[strain] <= k33 ? 1.0 : 2.0; }

/// Four cells, one per lane.
struct alignas(64) CellGroup {
    Lanes elastic[6];           ///< lambda in the scale of the modes
    Lanes damping[6];           ///< omega in the scale of the modes
    Lanes rest[6];              ///< t_i . t_j of the rest shape, for cells that are parallelepipeds
    Lanes bulk;                 ///< psi_c in the scale of the modes
    Lanes rest_volume;          ///< 64 V_c0
    std::int32_t vertex[8][4];  ///< [corner][lane]
};

/// A vector of each of four cells.
struct LaneVector {
    Lanes x, y, z;
};
inline LaneVector operator+(const LaneVector& a, const LaneVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline LaneVector operator-(const LaneVector& a, const LaneVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline LaneVector operator*(const Lanes& s, const LaneVector& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline void operator+=(LaneVector& a, const LaneVector& b) { a = a + b; }
inline Lanes dot(const LaneVector& a, const LaneVector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline LaneVector cross(const LaneVector& a, const LaneVector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The seven modes of each of four cells, as in the formulas above.
struct Modes {
    LaneVector a, b, c, d, e, f, k;
};

constexpr double kGauss = 0.57735026918962576451;  // 1 / sqrt 3

inline Modes modes_of(const CellGroup& g, const solve::PaddedPoints& x) {
    LaneVector v[8];
    for (int corner = 0; corner < 8; ++corner)
        solve::rows_to_lanes(x[g.vertex[corner][0]], x[g.vertex[corner][1]], x[g.vertex[corner][2]],
                             x[g.vertex[corner][3]], v[corner].x, v[corner].y, v[corner].z);
    // Sums and differences along a3, a2, a1
    LaneVector s[4], d[4];
    for (int i = 0; i < 4; ++i) {
        s[i] = v[2 * i + 1] + v[2 * i];
        d[i] = v[2 * i + 1] - v[2 * i];
    }
    const LaneVector s0 = s[1] + s[0], s1 = s[3] + s[2], sd0 = s[1] - s[0], sd1 = s[3] - s[2];
    const LaneVector d0 = d[1] + d[0], d1 = d[3] + d[2], dd0 = d[1] - d[0], dd1 = d[3] - d[2];
    const Lanes scale = Lanes{} + kGauss, square = Lanes{} + 1.0 / 3.0;
    return {s1 - s0,
            sd1 + sd0,
            d1 + d0,
            scale * (sd1 - sd0),
            scale * (d1 - d0),
            scale * (dd1 + dd0),
            square * (dd1 - dd0)};
}

/// Converts the derivative `m` by the modes into the derivative by the vertices, and adds that to `gradient`.
inline void scatter(const CellGroup& g, const Modes& m, solve::PaddedPoints& gradient) {
    const Lanes scale = Lanes{} + kGauss, square = Lanes{} + 1.0 / 3.0;
    const LaneVector d = scale * m.d, e = scale * m.e, f = scale * m.f, k = square * m.k;
    // Along a1, a2, a3. Index: 2 b2 + b3 of the remaining corners.
    const LaneVector zero_low = LaneVector{} - m.a, b_low = m.b - d, b_high = m.b + d;
    const LaneVector c_low = m.c - e, c_high = m.c + e, f_low = f - k, f_high = f + k;
    LaneVector v[8];
    const auto spread = [&](int from, const LaneVector& mean, const LaneVector& b,
                            const LaneVector& c, const LaneVector& bc) {
        const LaneVector low = mean - b, high = mean + b, c0 = c - bc, c1 = c + bc;
        v[from] = low - c0;
        v[from + 1] = low + c0;
        v[from + 2] = high - c1;
        v[from + 3] = high + c1;
    };
    spread(0, zero_low, b_low, c_low, f_low);
    spread(4, m.a, b_high, c_high, f_high);
    for (int corner = 0; corner < 8; ++corner) {
        Lanes r[4];
        solve::lanes_to_rows(v[corner].x, v[corner].y, v[corner].z, r[0], r[1], r[2], r[3]);
        for (int lane = 0; lane < 4; ++lane) gradient[g.vertex[corner][lane]] += r[lane];
    }
}

/// The strains of one pair of axes at one sign of the third axis. `own` is the number of diagonal components that are written.
inline void measure_pair(const LaneVector& p, const LaneVector& q, const LaneVector& u, int first,
                         int own, Lanes* strain) {
    const Lanes qq = dot(q, q), y = dot(q, u), z = dot(p, q);
    int k = first;
    if (own == 2) {  // t1 and t2
        strain[k++] = dot(p, p) + qq;
        strain[k++] = z + z;
    }
    if (own >= 1) {  // t2, or t3
        strain[k++] = dot(u, u) + qq;
        strain[k++] = y + y;
    }
    strain[k++] = dot(p, u);
    strain[k++] = y;
    strain[k++] = z;
    strain[k] = qq;
}

/// All kStrains strains of the modes.
inline void measure(const Modes& m, Lanes* strain) {
    measure_pair(m.a + m.e, m.d + m.k, m.b + m.f, 0, 2, strain);
    measure_pair(m.a - m.e, m.d - m.k, m.b - m.f, 8, 2, strain);
    measure_pair(m.a + m.d, m.e + m.k, m.c + m.f, 16, 1, strain);
    measure_pair(m.a - m.d, m.e - m.k, m.c - m.f, 22, 1, strain);
    measure_pair(m.b + m.d, m.f + m.k, m.c + m.e, 28, 0, strain);
    measure_pair(m.b - m.d, m.f - m.k, m.c - m.e, 32, 0, strain);
}

/// Time derivative of the strains of measure_pair(), when p, q and u change at the rates dp, dq and du.
inline void measure_rate_pair(const LaneVector& p, const LaneVector& q, const LaneVector& u,
                              const LaneVector& dp, const LaneVector& dq, const LaneVector& du,
                              int first, int own, Lanes* rate) {
    const Lanes half_qq = dot(q, dq), y = dot(q, du) + dot(dq, u), z = dot(p, dq) + dot(dp, q);
    const Lanes qq = half_qq + half_qq;
    int k = first;
    if (own == 2) {
        const Lanes pp = dot(p, dp);
        rate[k++] = pp + pp + qq;
        rate[k++] = z + z;
    }
    if (own >= 1) {
        const Lanes uu = dot(u, du);
        rate[k++] = uu + uu + qq;
        rate[k++] = y + y;
    }
    rate[k++] = dot(p, du) + dot(dp, u);
    rate[k++] = y;
    rate[k++] = z;
    rate[k] = qq;
}

/// Time derivative of all strains when the modes m change at the rates n.
inline void measure_rate(const Modes& m, const Modes& n, Lanes* rate) {
    measure_rate_pair(m.a + m.e, m.d + m.k, m.b + m.f, n.a + n.e, n.d + n.k, n.b + n.f, 0, 2, rate);
    measure_rate_pair(m.a - m.e, m.d - m.k, m.b - m.f, n.a - n.e, n.d - n.k, n.b - n.f, 8, 2, rate);
    measure_rate_pair(m.a + m.d, m.e + m.k, m.c + m.f, n.a + n.d, n.e + n.k, n.c + n.f, 16, 1,
                      rate);
    measure_rate_pair(m.a - m.d, m.e - m.k, m.c - m.f, n.a - n.d, n.e - n.k, n.c - n.f, 22, 1,
                      rate);
    measure_rate_pair(m.b + m.d, m.f + m.k, m.c + m.e, n.b + n.d, n.f + n.k, n.c + n.e, 28, 0,
                      rate);
    measure_rate_pair(m.b - m.d, m.f - m.k, m.c - m.e, n.b - n.d, n.f - n.k, n.c - n.e, 32, 0,
                      rate);
}

/// Indices of the strains that are not zero in a parallelepiped.
constexpr int kConstantStrains[12] = {0, 2, 4, 8, 10, 12, 16, 18, 22, 24, 28, 32};
constexpr bool is_constant(int strain) {
    for (const int k : kConstantStrains)
        if (k == strain) return true;
    return false;
}

/// Stress of the strains, from their targets and stiffness.
template <bool kTargets, bool kRates>
struct CellLaw {
    const CellGroup& g;
    const Lanes* stiffness;  ///< per component: lambda, or lambda + omega/h
    const Lanes* target;     ///< kStrains values, when kTargets
    const Lanes* rate;       ///< kStrains values, when kRates
    Lanes energy{};

    /// dE/dstrain of strain k
    template <int k>
    Lanes stress(const Lanes& strain) {
        constexpr Component component = kComponent[k];
        Lanes deviation = strain;
        if constexpr (kTargets)
            deviation = strain - target[k];
        else if constexpr (is_constant(k))
            deviation = strain - g.rest[component];
        Lanes half = stiffness[component] * deviation;
        if constexpr (component > k33) half += half;
        energy += half * deviation;
        if constexpr (kRates) {
            Lanes viscous = g.damping[component] * rate[k];
            if constexpr (component > k33) viscous += viscous;
            half += viscous;
        }
        return half + half;
    }
};

/// Derivative of the energy of one pair of axes at one sign of the third axis, by p, q and u.
template <int kFirst, int kOwn, class Law>
inline void pull_pair(Law& law, const LaneVector& p, const LaneVector& q, const LaneVector& u,
                      LaneVector& dp, LaneVector& dq, LaneVector& du) {
    const Lanes qq = dot(q, q), y = dot(q, u), z = dot(p, q);
    constexpr int kU = kFirst + (kOwn == 2 ? 2 : 0), kX = kU + (kOwn >= 1 ? 2 : 0);
    Lanes on_x = law.template stress<kX>(dot(p, u));
    Lanes on_y = law.template stress<kX + 1>(y);
    Lanes on_z = law.template stress<kX + 2>(z);
    Lanes on_qq = law.template stress<kX + 3>(qq);
    dp = on_x * u;
    du = on_x * p;
    if constexpr (kOwn == 2) {
        const Lanes on_p = law.template stress<kFirst>(dot(p, p) + qq);
        const Lanes on_slope = law.template stress<kFirst + 1>(z + z);
        on_z += on_slope + on_slope;
        on_qq += on_p;
        dp += (on_p + on_p) * p;
    }
    if constexpr (kOwn >= 1) {
        const Lanes on_u = law.template stress<kU>(dot(u, u) + qq);
        const Lanes on_slope = law.template stress<kU + 1>(y + y);
        on_y += on_slope + on_slope;
        on_qq += on_u;
        du += (on_u + on_u) * u;
    }
    dp += on_z * q;
    du += on_y * q;
    dq = on_z * p + on_y * u + (on_qq + on_qq) * q;
}

/// Derivative of the metric term by the modes. Its energy is added to law.energy.
template <class Law>
inline Modes metric_gradient(Law& law, const Modes& m) {
    Modes out;
    LaneVector p0, q0, u0, p1, q1, u1;
    pull_pair<0, 2>(law, m.a + m.e, m.d + m.k, m.b + m.f, p0, q0, u0);
    pull_pair<8, 2>(law, m.a - m.e, m.d - m.k, m.b - m.f, p1, q1, u1);
    out.a = p0 + p1;
    out.e = p0 - p1;
    out.d = q0 + q1;
    out.k = q0 - q1;
    out.b = u0 + u1;
    out.f = u0 - u1;
    pull_pair<16, 1>(law, m.a + m.d, m.e + m.k, m.c + m.f, p0, q0, u0);
    pull_pair<22, 1>(law, m.a - m.d, m.e - m.k, m.c - m.f, p1, q1, u1);
    out.a += p0 + p1;
    out.d += p0 - p1;
    out.e += q0 + q1;
    out.k += q0 - q1;
    out.c = u0 + u1;
    out.f += u0 - u1;
    pull_pair<28, 0>(law, m.b + m.d, m.f + m.k, m.c + m.e, p0, q0, u0);
    pull_pair<32, 0>(law, m.b - m.d, m.f - m.k, m.c - m.e, p1, q1, u1);
    out.b += p0 + p1;
    out.d += p0 - p1;
    out.f += q0 + q1;
    out.k += q0 - q1;
    out.c += u0 + u1;
    out.e += u0 - u1;
    return out;
}

/// Adds the derivative of the volume energy bulk (64 V - 64 V0)^2 by the modes to `out`. Returns this energy.
inline Lanes add_volume_gradient(const CellGroup& g, const Modes& m, Modes& out) {
    const LaneVector da = cross(m.b, m.c) + cross(m.d, m.e);
    const LaneVector fd = cross(m.f, m.d), ef = cross(m.e, m.f);
    const Lanes volume = dot(m.a, da) + dot(m.b, fd) + dot(m.c, ef);
    const Lanes excess = volume - g.rest_volume;
    const Lanes half = g.bulk * excess;
    const Lanes q = half + half;
    out.a += q * da;
    out.b += q * (cross(m.c, m.a) + fd);
    out.c += q * (cross(m.a, m.b) + ef);
    out.d += q * (cross(m.e, m.a) + cross(m.b, m.f));
    out.e += q * (cross(m.a, m.d) + cross(m.f, m.c));
    out.f += q * (cross(m.d, m.b) + cross(m.c, m.e));
    return half * excess;
}

}  // namespace risorius::tissue::detail
