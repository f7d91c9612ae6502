// SPDX-License-Identifier: MIT
/// \file
/// The description of the deformable surface: a grid of M x N nodes over material coordinates a in [0,1]^2, any rest shape in
/// space, open or closed along a2 (a tube), and 14 material parameters for each node: metric tensor, damping tensor, bending
/// tensor, mass and drag.
///
///   lambda_ij  metric, N/m^3     omega_ij  damping, N s/m^3     zeta_ij  bending, N/m     c  drag, N s/m
///   energy  integral over a of 1/4 sum lambda_ij (G_ij - G0_ij)^2 + 1/2 sum zeta_ij |d_ij r|^2
///   G_ij = r_i . r_j     r_i = dr/da_i     d_ij r = d2r/(da_i da_j)     0: in the rest shape
///
/// Sources: Terzopoulos, Platt, Barr & Fleischer 1987, Elastically deformable models; M. Dobsik, Computer Animation of Soft
/// Tissues, Brno 2005 ("the thesis"), section 5.1.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

using Mat2 = Eigen::Matrix2d;

/// Number of nodes along each axis; node [m, n] is row m N + n.
struct SurfaceGrid {
    int m = 2;            ///< >= 2
    int n = 2;            ///< >= 2; closed: >= 3
    bool closed = false;  ///< periodic along a2: node [m, N] is node [m, 0]

    int size() const { return m * n; }
    int index(int i, int j) const { return i * n + j; }
    int along(int axis) const { return axis == 0 ? m : n; }
    /// Number of links between neighbours along an axis, in one row of nodes.
    int links(int axis) const { return axis == 0 ? m - 1 : closed ? n : n - 1; }
    double spacing(int axis) const { return 1.0 / links(axis); }  ///< h_i
    /// The same nodes as a one-layer grid of a solid, for picking nodes. Its spacing(2) has no meaning.
    GridShape shape() const { return {m, n, 1}; }
};

/// The 14 parameters of a node.
struct SurfaceMaterial {
    Mat2 elastic_n_per_m3 = Mat2::Zero();   ///< lambda_ij, symmetric      [0, inf)
    Mat2 damping_ns_per_m3 = Mat2::Zero();  ///< omega_ij, symmetric       [0, inf)
    Mat2 bending_n_per_m = Mat2::Zero();    ///< zeta_ij, symmetric        [0, inf)
    /// Mass of a whole surface of this material; a node has 1/(MN) of it     (0, inf)
    double mass_kg = 1;
    double drag_ns_per_m = 0;  ///< c of each node     [0, inf)
};

/// The description of a surface.
struct GridSurface {
    SurfaceGrid grid;
    Points rest;                            ///< MN x 3, m
    std::vector<SurfaceMaterial> material;  ///< one, or one per node
    /// The meaning of lambda and omega.
    Parameters parameters = Parameters::kResolutionIndependent;
    /// The meaning of zeta. The values of the thesis are per node. If they were independent of the resolution, its "stiff metal
    /// sheet" (13 x 13 nodes, zeta = 0.5 N/m, 4 kg) would hang like cloth: a strip would sag by m g / (8 zeta) = 10 m.
    Parameters bending = Parameters::kResolutionIndependent;
};

/// All four components of lambda, omega and zeta are equal: isotropic on a square.
SurfaceMaterial isotropic_surface(double elastic_n_per_m3, double damping_ns_per_m3,
                                  double bending_n_per_m, double mass_kg, double drag_ns_per_m);

/// A rectangle, MN x 3, m. Its corner a = 0 is at the origin of `place`; a1 follows x and a2 follows y.
Points sheet_rest(const SurfaceGrid& grid, const Vec2& size_m,
                  const Rigid& place = Rigid::Identity());

/// A tube, MN x 3, m. Its axis starts at the origin of `place` and follows x and a1; a2 runs around the axis, from y towards z.
/// The grid must be closed.
Points tube_rest(const SurfaceGrid& grid, double radius_m, double length_m,
                 const Rigid& place = Rigid::Identity());

/// Two triangles per cell. Those of a tube are counter-clockwise from outside.
Triangles surface_triangles(const SurfaceGrid& grid);
/// Every pair of neighbouring nodes.
std::vector<std::array<int, 2>> grid_lines(const SurfaceGrid& grid);

/// Throws Error for too few nodes, wrong sizes, NaN, negative or unsymmetric values, no mass, or a rest shape that is
/// degenerate or folded. The message names the field by its path, which begins with `place`.
void check(const GridSurface& surface, const std::string& place);
void check(const SurfaceMaterial& material, const std::string& place);

/// The material of a node. `surface` has one material for all nodes or one for each node.
const SurfaceMaterial& material_of(const GridSurface& surface, int node);
Eigen::VectorXd node_mass(const GridSurface& surface);  ///< of each node, kg
Eigen::VectorXd node_drag(const GridSurface& surface);  ///< c of each node, N s/m

/// Factors of lambda and omega of one node, eq. (10) of the thesis (solid_material.h) in two dimensions: w_ij = (w_i + w_j) / 2
/// with w_1 = 1/((M-1) N) and w_2 = 1/(M (N-1)), the inverse of the number of links along the axis. All are 1 for kPerNode.
Mat2 metric_weights(const SurfaceGrid& grid, Parameters parameters);

/// Factors of zeta of one node: w_11 and w_22 are those of metric_weights(); w_12 is the inverse of the number of cells.
///
/// |D_11 r|^2 exists at the M - 2 inner nodes of each of N rows. Summed with h_1 = 1/(M-1) along a row, it is the trapezoidal
/// rule, whose end values are zero because no moment acts at a free or pinned end; its error is of order h^2. Each row has 1/N
/// of the width, as in eq. (10). So zeta_ij means the same at any resolution. Values per node (kPerNode: factors of one) equal
/// zeta_ij w_ij.
///
/// Two clamped rows end the bending part half a spacing further in: a cantilever of M nodes is as stiff as one that is shorter
/// by h_1 / 2.
Mat2 bending_weights(const SurfaceGrid& grid, Parameters parameters);

/// Physical constants of a plate or membrane, in the directions of a1 and a2.
struct SheetConstants {
    /// k_ij of the energy per area W = 1/4 sum k_ij (C_ij - delta_ij)^2, C = F^T F.
    Mat2 membrane_n_per_m = Mat2::Zero();
    Mat2 bending_n_m = Mat2::Zero();  ///< D_ij of W = 1/2 sum D_ij curvature_ij^2
};

/// Isotropic sheet of thickness t with Poisson's ratio 0: k = mu t, N/m; D = mu t^3 / 6 = k t^2 / 6, N m.
SheetConstants sheet_of(double shear_pa, double thickness_m);

/// lambda_ij = k_ij L1 L2 / (Li^2 Lj^2) and zeta_ij = D_ij L1 L2 / (Li^2 Lj^2) for a sheet with edges L1 and L2 (`size_m`), and
/// the inverse. For a tube, L1 is the length and L2 is the circumference. Neither function uses the resolution.
SurfaceMaterial surface_material(const SheetConstants& sheet, const Vec2& size_m);
SheetConstants sheet_constants(const SurfaceMaterial& material, const Vec2& size_m);

/// The hinge constant k_B of SkinSheet for which a sheet resists rolling as a plate with the bending stiffness D does: D / 3, N
/// m. It is exact for hinges of equilateral triangles and for right-angled ones with edges along and across the roll. Other
/// deformations differ: right-angled triangles twist twice as stiffly as the plate, and equilateral ones resist a bowl with two
/// thirds of the plate's stiffness.
double hinge_bending(double bending_n_m);

}  // namespace risorius::tissue
