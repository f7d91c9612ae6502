// SPDX-License-Identifier: MIT
/// \file
/// The description of the volume-preserving soft object: a grid of M x N x O nodes over material coordinates a in [0,1]^3, any
/// rest shape, and 21 material parameters for each node. So the object may be inhomogeneous and anisotropic.
///
///   lambda_ij  elastic, N/m^3     omega_ij  damping, N s/m^3     psi  incompressibility, N/m^5     c  drag, N s/m
///   energy  integral over a of 1/4 sum lambda_ij (G_ij - G0_ij)^2 + psi (dV - dV0)^2
///   G_ij = r_i . r_j     r_i = dr/da_i     dV = r_1 . (r_2 x r_3)     0: in the rest shape
///
/// Source: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005 ("the thesis"), sections 3.1-3.5, eq. (2)-(10).
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::tissue {

/// Number of nodes along each axis of material coordinates; node [m, n, o] is row (m N + n) O + o.
struct GridShape {
    int m = 2, n = 2, o = 2;  ///< each >= 2
    /// True when a1 is periodic: cells connect the last nodes along a1 with the first; m >= 3. CellSolid supports it,
    /// DifferenceSolid does not.
    bool closed = false;

    int size() const { return m * n * o; }
    int index(int i, int j, int k) const { return (i * n + j) * o + k; }
    int along(int axis) const { return axis == 0 ? m : axis == 1 ? n : o; }
    int cells(int axis) const { return along(axis) - (closed && axis == 0 ? 0 : 1); }
    int next(int i) const { return i + 1 == m && closed ? 0 : i + 1; }  ///< index after i along a1
    double spacing(int axis) const { return 1.0 / cells(axis); }        ///< h_i
};

/// The 21 parameters of a node: 9 of lambda, 9 of omega, and psi, mass and drag.
struct SolidMaterial {
    Mat3 elastic_n_per_m3 = Mat3::Zero();   ///< lambda_ij              [0, inf)
    Mat3 damping_ns_per_m3 = Mat3::Zero();  ///< omega_ij               [0, inf)
    double incompressibility_n_per_m5 = 0;  ///< psi                    [0, inf)
    /// Mass of a whole body of this material; a node has 1/(MNO) of it     (0, inf)
    double mass_kg = 1;
    double drag_ns_per_m = 0;  ///< c of each node; used by the term Drag     [0, inf)
};

/// The meaning of lambda and omega.
enum class Parameters {
    kResolutionIndependent,  ///< eq. (10): the body is the same at any resolution
    kPerNode                 ///< eta and phi of the original model: a finer grid is softer
};

/// The description of a solid.
struct GridSolid {
    GridShape grid;
    Points rest;  ///< MNO x 3, m; right-handed, so that every volume is positive
    std::vector<SolidMaterial> material;  ///< one, or one per node
    Parameters parameters = Parameters::kResolutionIndependent;
};

/// The isotropic cube: lambda_11 = lambda_22 = lambda_33, and every other component is the mean of two of these, as in eq.
/// (10).
SolidMaterial isotropic_material(double elastic_n_per_m3, double damping_ns_per_m3,
                                 double incompressibility_n_per_m5, double mass_kg,
                                 double drag_ns_per_m);

/// A block, MNO x 3, m. Its corner a = 0 is at the origin of `place`, and its edges follow the axes of `place`.
Points block_rest(const GridShape& grid, const Vec3& size_m,
                  const Rigid& place = Rigid::Identity());

/// Throws Error for fewer than 2 nodes along an axis, wrong sizes, NaN, negative values, an unsymmetric tensor, no mass, or a
/// corner of a cell without positive rest volume. The message names the field by its path, which begins with `place`:
/// "place/material/4/mass_kg", without the number when all nodes have one material.
void check(const GridSolid& solid, const std::string& place);

/// Eq. (10): eta (or phi) of each node from lambda (or omega). eta_ij = lambda_ij (w_i + w_j) / 2 with w_1 = 1/((M-1) N O), and
/// likewise for the other axes. When all lambda are equal, this is the mean of the diagonal components, as in the thesis.
Mat3 per_node_tensor(const Mat3& tensor, const GridShape& grid);

/// The material of a node. `solid` has one material for all nodes or one for each node.
const SolidMaterial& material_of(const GridSolid& solid, int node);

Eigen::VectorXd node_mass(const GridSolid& solid);  ///< of each node, kg
Eigen::VectorXd node_drag(const GridSolid& solid);  ///< c, N s/m; for the term Drag

}  // namespace risorius::tissue
