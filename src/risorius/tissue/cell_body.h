// SPDX-License-Identifier: MIT
/// \file
/// The description of a solid of trilinear cells: a mesh over material coordinates, its rest shape, and the material of each
/// cell. A material is given by the parameters of the thesis or by moduli in Pa. W is the energy density, J per unit of
/// material volume:
///
///   W = 1/4 lambda_ij (G_ij - G0_ij)^2 + psi_c (dV - dV0)^2, dV = V_c / (h1 h2 h3)   parameters, per material volume
///   W = (mu/4 dG_ij dG_kl C^ik C^jl + K/2 (J - 1)^2) sqrt(det G0),  C = G0^-1        moduli, for any rest shape
///
/// G is the metric r_i . r_j with the tangents r_i = dr/da_i, dG = G - G0, and G0 is G in the rest shape. V_c is the volume of
/// a cell and h1, h2, h3 are its edges in material coordinates. mu is the shear modulus and K is the modulus of the volume term
/// (moduli.h). Neither form depends on the mesh. For a rectangular block with edges Li and volume V0, lambda_ij = mu V0 / (Li^2
/// Lj^2) and psi_c = K / (2 V0).
///
/// Source: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005 ("the thesis").
#pragma once

#include <functional>
#include <vector>

#include "risorius/tissue/detail/cell_mesh.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::tissue {

/// Parameters of the thesis, per unit of material volume. lambda and omega are those of eq. (10), so they do not depend on the
/// resolution.
struct CellParameters {
    Mat3 elastic_n_per_m3 = Mat3::Zero();   ///< lambda_ij, symmetric
    Mat3 damping_ns_per_m3 = Mat3::Zero();  ///< omega_ij, symmetric
    double incompressibility_n_per_m5 = 0;  ///< psi_c
};

/// Isotropic material, for any rest shape. Uniaxial stretch has Young's modulus 2 mu when K = 0 and 3 mu when K >> mu.
struct CellModuli {
    double mu_pa = 0;           ///< shear modulus
    double bulk_pa = 0;         ///< K, Lame's first parameter, not the bulk modulus
    double viscosity_pa_s = 0;  ///< shear viscosity
};

/// How the mass of the cells is distributed to the nodes.
enum class MassFractions {
    kNodes,  ///< as in the thesis: all M N O nodes have the same mass; borders are too heavy
    kCells   ///< each cell distributes its mass to its eight corners; refined meshes need this
};

/// The described body on one mesh, ready for CellSolid.
struct CellBody {
    CellMesh mesh;
    Points rest;                             ///< rest positions of the nodes, n x 3, m
    std::vector<CellParameters> parameters;  ///< one per cell, or empty: then moduli
    std::vector<CellModuli> moduli;          ///< one per cell, or empty: then parameters
    Eigen::VectorXd mass_kg;                 ///< of nodes
    Eigen::VectorXd drag_ns_per_m;           ///< of nodes; the term Drag uses it
};

/// Rest position of material coordinates `a`, m.
using RestShape = std::function<Vec3(const Vec3& a)>;

/// The described body on `mesh`. Parameters are interpolated from the description at the centres of cells, masses at nodes or
/// cells. The total mass is that of the description. `rest` may give a rest shape with more detail than the grid of the
/// description; without it, the rest shape is interpolated in the grid. Throws std::invalid_argument for kNodes on a mesh that
/// is not uniform.
CellBody cell_body(const GridSolid& solid, CellMesh mesh, MassFractions fractions,
                   const RestShape& rest = {});
/// The described body on the description's own grid, with the same mass for each node (kNodes).
CellBody cell_body(const GridSolid& solid);

/// A body of one material. Each cell distributes its mass to its corners.
CellBody cell_body(CellMesh mesh, const RestShape& rest, const CellModuli& moduli,
                   double density_kg_per_m3);

/// Signed volume of a cell, m^3, exact for its trilinear map. `vertices`: positions of all vertices of the mesh, V x 3, m.
double cell_volume(const CellMesh::Cell& cell, const Points& vertices);

}  // namespace risorius::tissue
