// SPDX-License-Identifier: MIT
/// \file
/// Pressure and friction between surfaces in contact: a soft penalty on the gap, and Coulomb friction smoothed near zero slip.
///
///   g  gap, m     t  thickness, m     k  stiffness, Pa/m     p  pressure, Pa, = - dw/dg     w  energy, J/m^2
///   p = k (t - g)^2 / (2 t) for 0 < g < t,   k (t/2 - g) for g <= 0;   w has two continuous derivatives by g
///   u  slip in a step of h, m    e = v_s h    v_s  slip speed below which friction grows with speed, m/s
///   friction = mu N f1(u),  f1 = 2 u/e - u^2/e^2 for u < e, 1 for u >= e,  f0 the integral of f1;  N  normal force, N
///
/// mu is the coefficient of friction. Because of the smoothing, a body at rest on a slope slides slowly, with a speed below
/// v_s. In explicit steps, friction near zero slip is a damper of d = 2 mu N / v_s, N s/m. A step is stable up to a length of
/// about 2 m / d for a mass m (2.8 m / d with the Runge-Kutta method of order 4).
///
/// Source: Li et al. 2020, Incremental Potential Contact, ACM TOG 39(4), for smoothed friction with the normal force at the
/// start of the step.
#pragma once

#include <cmath>
#include <string>

#include "risorius/core/types.h"

namespace risorius::contact {

/// The parameters of a contact. The field names are the keys of "contact" in a file.
struct ContactMaterial {
    double stiffness_pa_per_m = 1e6;   ///< k     (0, inf)
    double thickness_m = 1e-3;         ///< t: gap at which contact begins     (0, inf)
    double friction = 0;               ///< mu, tangential force / normal force     [0, inf)
    double slip_speed_m_per_s = 1e-3;  ///< v_s     (0, inf)
    double damping_s = 0;              ///< damping of approach / stiffness     [0, inf)
};

/// Throws Error when a value is outside its range. The message names the field by its path, which begins with `place`.
void check(const ContactMaterial& material, const std::string& place);

/// The stiffness with which the pressure at gap 0 is `pressure_pa`, Pa/m.
inline double stiffness_for(double pressure_pa, double thickness_m) {
    return 2 * pressure_pa / thickness_m;
}

/// w, m^2, p, m, and -dp/dg, each divided by the stiffness k.
struct Penalty {
    double energy, pressure, slope;
};

/// The penalty at a gap.
inline Penalty penalty(double gap_m, double thickness_m) {
    const double depth = thickness_m - gap_m, t = thickness_m;
    if (depth <= 0) return {0, 0, 0};
    if (gap_m > 0) return {depth * depth * depth / (6 * t), depth * depth / (2 * t), depth / t};
    return {t * t / 6 - gap_m * t / 2 + gap_m * gap_m / 2, t / 2 - gap_m, 1};
}

/// f0, m, f1 / u, 1/m, and f0'', 1/m.
struct SlipShape {
    double potential, force_over_slip, slope;
};

/// The friction law at the slip u >= 0, m. `e` is e, m.
inline SlipShape slip_shape(double u, double e) {
    if (u < e) return {u * u / e * (1 - u / (3 * e)), 2 / e - u / (e * e), 2 / e * (1 - u / e)};
    return {u - e / 3, 1 / u, 0};
}

/// Second derivative of f0(|u|) by the slip vector u, 1/m.
inline Mat3 slip_curvature(const Vec3& u, const SlipShape& shape) {
    const double squared = u.squaredNorm();
    Mat3 curvature = shape.force_over_slip * Mat3::Identity();
    if (squared > 0)
        curvature += (shape.slope - shape.force_over_slip) / squared * (u * u.transpose());
    return curvature;
}

/// The matrix with its negative eigenvalues replaced by zero.
Mat3 positive_part(const Mat3& symmetric);

}  // namespace risorius::contact
