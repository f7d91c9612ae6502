// SPDX-License-Identifier: MIT
/// \file
/// The volume-preserving soft object as described: a grid of M x N x O nodes over material coordinates a in [0,1]^3, any
/// rest shape, and 21 numbers in every node, so that it may be inhomogeneous and anisotropic.
///
///   lambda_ij  elastic, N/m^3     omega_ij  damping, N s/m^3     psi  incompressibility, N/m^5     c  drag, N s/m
///   energy  1/4 sum lambda_ij (G_ij - G0_ij)^2 + psi (dV - dV0)^2,   G_ij = r_i . r_j,   r_i = dr/da_i
///
/// Source: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005, sections 3.1-3.5, eq. (2)-(10).
#pragma once

#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::tissue {

/// Nodes per axis of material coordinates; node [m, n, o] is row (m N + n) O + o.
struct GridShape {
    int m = 2, n = 2, o = 2;  ///< each >= 2
    /// a1 runs round: cells join the last nodes along it with the first, m >= 3. Only cells know it, differences do not.
    bool closed = false;

    int size() const { return m * n * o; }
    int index(int i, int j, int k) const { return (i * n + j) * o + k; }
    int along(int axis) const { return axis == 0 ? m : axis == 1 ? n : o; }
    int cells(int axis) const { return along(axis) - (closed && axis == 0 ? 0 : 1); }
    int next(int i) const { return i + 1 == m && closed ? 0 : i + 1; }  ///< along a1
    double spacing(int axis) const { return 1.0 / cells(axis); }        ///< h_i
};

struct SolidMaterial {
    Mat3 elastic_n_per_m3 = Mat3::Zero();   ///< lambda_ij              [0, inf)
    Mat3 damping_ns_per_m3 = Mat3::Zero();  ///< omega_ij               [0, inf)
    double incompressibility_n_per_m5 = 0;  ///< psi                    [0, inf)
    double mass_kg = 1;        ///< of a whole body of this; a node has 1/(MNO) of it     (0, inf)
    double drag_ns_per_m = 0;  ///< c, of each node; a force of its own, the term Drag [0, inf)
};

/// How lambda and omega are meant.
enum class Parameters {
    kResolutionIndependent,  ///< eq. (10): the same body at any resolution
    kPerNode  ///< eta and phi as they stand, the original model; softer the finer the grid
};

struct GridSolid {
    GridShape grid;
    Points rest;  ///< MNO x 3, m; right-handed, so that every volume is positive
    std::vector<SolidMaterial> material;  ///< one, or one per node
    Parameters parameters = Parameters::kResolutionIndependent;
};

/// lambda_11 = lambda_22 = lambda_33 and eq. (10)'s mean for the rest: the isotropic cube.
SolidMaterial isotropic_material(double elastic_n_per_m3, double damping_ns_per_m3,
                                 double incompressibility_n_per_m5, double mass_kg,
                                 double drag_ns_per_m);

/// A block with its corner a = 0 at the origin of `place` and edges along its axes.
Points block_rest(const GridShape& grid, const Vec3& size_m,
                  const Rigid& place = Rigid::Identity());

/// Throws Error with the field named below `place` ("place/material/4/mass_kg"; without the number when all nodes share
/// one material): fewer than 2 nodes, wrong sizes, NaN, negative values, a tensor that is not symmetric, no mass, a
/// corner of a cell without positive rest volume.
void check(const GridSolid& solid, const std::string& place);

/// Eq. (10): per-node eta (or phi) of lambda (or omega): eta_ij = lambda_ij (w_i + w_j) / 2 with w_1 = 1/((M-1) N O) and
/// so on, which is the thesis' mean of the diagonals when all lambda are equal.
Mat3 per_node_tensor(const Mat3& tensor, const GridShape& grid);

/// The material of a node, whether there is one for all or one for each.
const SolidMaterial& material_of(const GridSolid& solid, int node);

Eigen::VectorXd node_mass(const GridSolid& solid);  ///< kg; what a MotionSystem and Gravity take
Eigen::VectorXd node_drag(const GridSolid& solid);  ///< c, N s/m; what the term Drag takes

}  // namespace risorius::tissue
