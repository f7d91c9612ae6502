// SPDX-License-Identifier: MIT
/// \file
/// What a solid of trilinear cells is made of: a mesh over material coordinates, its shape at rest, and in every cell
/// either the thesis' parameters per material coordinate or moduli in Pa. Any mesh of the same description is the same body.
///
///   W = 1/4 lambda_ij (G_ij - G0_ij)^2 + psi_c (dV - dV0)^2, dV = V_c / (h1 h2 h3)   parameters, per material volume
///   W = (mu/4 dG_ij dG_kl C^ik C^jl + K/2 (J - 1)^2) sqrt(det G0),  C = G0^-1        moduli, at any rest shape
///
/// Rectangular blocks: lambda_ij = mu V0 / (Li^2 Lj^2), psi_c = K / (2 V0), with edges Li and volume V0 of the whole.
#pragma once

#include <functional>
#include <vector>

#include "risorius/tissue/detail/cell_mesh.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

/// Per unit of material volume; lambda and omega as in eq. (10), so they do not depend on the resolution.
struct CellParameters {
    Mat3 elastic_n_per_m3 = Mat3::Zero();   ///< lambda_ij, symmetric
    Mat3 damping_ns_per_m3 = Mat3::Zero();  ///< omega_ij, symmetric
    double incompressibility_n_per_m5 = 0;  ///< psi_c
};

/// Isotropic, whatever the rest shape. Uniaxial stretch has Young's modulus 2 mu when K = 0, 3 mu when K >> mu.
struct CellModuli {
    double mu_pa = 0;           ///< shear
    double bulk_pa = 0;         ///< K
    double viscosity_pa_s = 0;  ///< of strain rate, as mu is of strain
};

/// How a cell's mass comes to lie on its nodes.
enum class MassShares {
    kNodes,  ///< the thesis: every node of a uniform grid has 1/(MNO), so borders are too heavy
    kCells   ///< a cell's mass on its eight corners; what refined meshes need
};

struct CellBody {
    CellMesh mesh;
    Points rest;                             ///< of nodes, m
    std::vector<CellParameters> parameters;  ///< one per cell, or empty:
    std::vector<CellModuli> moduli;          ///< one per cell
    Eigen::VectorXd mass_kg;                 ///< of nodes
    Eigen::VectorXd drag_ns_per_m;           ///< of nodes; for the term Drag
};

/// Position at rest of material coordinates, m.
using RestShape = std::function<Vec3(const Vec3& a)>;

/// The described body on `mesh`. Parameters are read off the description trilinearly at the centres of cells, masses at
/// nodes or cells; the total mass is the description's. A rest shape finer than the description's grid can be given.
/// kNodes needs a uniform mesh: throws std::invalid_argument.
CellBody cell_body(const GridSolid& solid, CellMesh mesh, MassShares fractions,
                   const RestShape& rest = {});
/// On the description's own grid, with the thesis' masses.
CellBody cell_body(const GridSolid& solid);

/// A body of one tissue.
CellBody cell_body(CellMesh mesh, const RestShape& rest, const CellModuli& moduli,
                   double density_kg_per_m3);

/// Volume of a cell with corners `x`, exact for a trilinear map, m^3, signed.
double cell_volume(const CellMesh::Cell& cell, const Points& vertices);

}  // namespace risorius::tissue
