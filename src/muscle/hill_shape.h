// Force curves of a Hill-type muscle fibre and their integrals, dimensionless. The integrals are in
// closed form because the line search of the solver needs an energy that agrees with its forces.
//
//   l   fibre length / optimal fibre length              l > 0
//   v   fibre speed / greatest shortening speed          v < 0 shortens
//   f   force / greatest isometric force
//
// Active: the Gaussian bell of Thelen 2003 (J. Biomech. Eng. 125(1), 70-77). Passive: the
// exponential of the same paper with the strain and steepness of resting facial muscle, drawn on
// linearly so that a wild step cannot overflow. Velocity: Hill's hyperbola for shortening, a second
// one for lengthening with the slope matched at rest (C1), faded out beyond v = -0.9.
#pragma once

namespace risorius::muscle {

struct HillShape {
    double active_width = 0.45;        ///< of the bell                              (0, inf)
    double passive_strain = 0.7;       ///< strain at which passive f is 1           (0, inf)
    double passive_exponent = 4.0;     ///< steepness of the passive toe             (0, inf)
    double passive_linear = 1.5;       ///< linear beyond this x passive_strain      (0, inf)
    double velocity_curvature = 0.25;  ///< Hill's a/F0                            (0, inf)
    double lengthening_force = 1.4;    ///< f far beyond v = 0                       (1, inf)
};

double active_force(double l, const HillShape& shape);
double active_force_slope(double l, const HillShape& shape);     ///< df/dl
double active_force_integral(double l, const HillShape& shape);  ///< 0 at l = 1

double passive_force(double l, const HillShape& shape);  ///< 0 for l <= 1
double passive_force_slope(double l, const HillShape& shape);
double passive_force_integral(double l, const HillShape& shape);  ///< 0 for l <= 1

double velocity_force(double v, const HillShape& shape);  ///< 1 at v = 0
double velocity_force_slope(double v, const HillShape& shape);
double velocity_force_integral(double v, const HillShape& shape);  ///< 0 at v = 0

}  // namespace risorius::muscle
