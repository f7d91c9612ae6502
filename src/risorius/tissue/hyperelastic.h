// SPDX-License-Identifier: MIT
/// \file
/// Hyperelastic materials of compressible, nearly incompressible solids: neo-Hookean, Mooney-Rivlin, Ogden, and transversely isotropic
/// after Weiss. W is the energy density, J per rest volume:
///
///   W = c10 (I1 - 3) + c01 (I2 - 3) + sum m_p / a_p (s1^a_p + s2^a_p + s3^a_p - 3) + W_f(l) + B/2 (J - 1)^2
///
///   F         deformation gradient; J = det F
///   s_i       principal stretches of J^(-1/3) F
///   I1, I2    s1^2 + s2^2 + s3^2,  s1^2 s2^2 + s2^2 s3^2 + s3^2 s1^2
///   l         J^(-1/3) |F a|, the stretch of fibres along the unit vector a at rest
///   l W_f'    0 where l <= 1;  c3 (exp(c4 (l - 1)) - 1) up to l = l*;  then c5 l + c6, with c6 such that it has no jump
///
/// The shear modulus at rest is 2 (c10 + c01) + sum m_p a_p / 2, and the bulk modulus is B. W is infinite where J <= 0.
///
/// Sources: Rivlin & Saunders 1951, Phil. Trans. A 243, 251-288; Ogden 1972, Proc. R. Soc. A 326, 565-584; Weiss, Maker & Govindjee 1996,
/// Comput. Methods Appl. Mech. Eng. 135, 107-128; Blemker, Pinsky & Delp 2005, J. Biomech. 38, 657-665 (l* and constants of muscle).
#pragma once

#include <vector>

#include "risorius/core/types.h"

namespace risorius::tissue {

struct OgdenTerm {
    double modulus_pa = 0;  ///< m_p; m_p a_p > 0
    double exponent = 2;    ///< a_p, not 0
};

/// Fibres that resist stretch.
struct FibreLaw {
    double c3_pa = 0;     ///< [0, inf); 0: no fibres
    double c4 = 1;        ///< (0, inf)
    double c5_pa = 0;     ///< [0, inf)
    double straight = 2;  ///< l*, (1, inf)
};

struct Hyperelastic {
    double c10_pa = 0, c01_pa = 0;
    std::vector<OgdenTerm> ogden = {};
    double bulk_pa = 0;  ///< B
    FibreLaw fibres = {};

    double shear_pa() const;  ///< at rest
};

/// 9 x 9: entry (3 k + i, 3 l + j) is for F_ik and F_jl, as matrices are stored column by column.
using Stiffness = Eigen::Matrix<double, 9, 9>;

/// The energy density and its derivatives at one deformation gradient.
struct Response {
    double energy_pa = 0;
    Mat3 stress_pa = Mat3::Zero();  ///< dW/dF, the first Piola-Kirchhoff stress
};

/// `fibre`: a, a unit vector; not used without fibres.
Response response(const Hyperelastic& material, const Mat3& f, const Vec3& fibre);
Stiffness stiffness(const Hyperelastic& material, const Mat3& f, const Vec3& fibre);
/// The Cauchy stress, dW/dF F^T / J, Pa.
Mat3 cauchy_stress_pa(const Hyperelastic& material, const Mat3& f, const Vec3& fibre);

}  // namespace risorius::tissue
