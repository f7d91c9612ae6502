// SPDX-License-Identifier: MIT
/// \file
/// Pressure and friction between surfaces in contact: a soft penalty on the gap, and Coulomb friction smoothed near zero slip.
///
///   g  gap, m     t  thickness, m     k  stiffness, Pa/m     p  pressure, Pa, = - dw/dg     w  energy, J/m^2
///   p = k (t - g)^2 / (2 t) for 0 < g < t,   k (t/2 - g) for g <= 0: two continuous derivatives of the energy
///   u  slip in a step of h, m    e = v_s h    v_s  slip speed below which friction grows with speed, m/s
///   friction = mu N f1(u),  f1 = 2 u/e - u^2/e^2 for u < e, 1 beyond; f0 its integral
///
/// Because of the smoothing, a body on a slope creeps at less than v_s. In explicit steps, friction near zero slip is a damper
/// of 2 mu N / v_s. These steps are stable below about 2 m / (2 mu N / v_s) (RK4: 2.8 instead of 2).
///
/// Source: Li et al. 2020, Incremental Potential Contact, ACM TOG 39(4), for smoothed friction with the normal force of the
/// step's start.
#pragma once

#include <cmath>
#include <string>

#include "risorius/core/types.h"

namespace risorius::contact {

/// The parameters of a contact. Field names are keys of "contact".
struct ContactMaterial {
    double stiffness_pa_per_m = 1e6;   ///< k     (0, inf)
    double thickness_m = 1e-3;         ///< t: gap at which contact begins     (0, inf)
    double friction = 0;               ///< mu, tangential force / normal force     [0, inf)
    double slip_speed_m_per_s = 1e-3;  ///< v_s     (0, inf)
    double damping_s = 0;  ///< approach is damped by this times the stiffness     [0, inf)
};

/// Throws Error that names the field below `place`.
void check(const ContactMaterial& material, const std::string& place);

/// The stiffness for which surfaces at gap 0 carry the given pressure, Pa/m.
inline double stiffness_for(double pressure_pa, double thickness_m) {
    return 2 * pressure_pa / thickness_m;
}

/// Energy, pressure and -dp/dg per unit of stiffness.
struct Penalty {
    double energy, pressure, slope;
};

/// The penalty at a gap, for unit stiffness.
inline Penalty penalty(double gap_m, double thickness_m) {
    const double depth = thickness_m - gap_m, t = thickness_m;
    if (depth <= 0) return {0, 0, 0};
    if (gap_m > 0) return {depth * depth * depth / (6 * t), depth * depth / (2 * t), depth / t};
    return {t * t / 6 - gap_m * t / 2 + gap_m * gap_m / 2, t / 2 - gap_m, 1};
}

/// f0, f1 / u and f0'' at the slip u >= 0, m.
struct SlipShape {
    double potential, force_over_slip, slope;
};

/// The friction potential at the slip u >= 0, m.
inline SlipShape slip_shape(double u, double e) {
    if (u < e) return {u * u / e * (1 - u / (3 * e)), 2 / e - u / (e * e), 2 / e * (1 - u / e)};
    return {u - e / 3, 1 / u, 0};
}

/// Second derivative of f0(|u|) by the slip vector.
inline Mat3 slip_curvature(const Vec3& u, const SlipShape& shape) {
    const double squared = u.squaredNorm();
    Mat3 curvature = shape.force_over_slip * Mat3::Identity();
    if (squared > 0)
        curvature += (shape.slope - shape.force_over_slip) / squared * (u * u.transpose());
    return curvature;
}

/// The matrix without its negative eigenvalues.
Mat3 positive_part(const Mat3& symmetric);

}  // namespace risorius::contact
