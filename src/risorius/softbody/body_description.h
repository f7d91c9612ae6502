// SPDX-License-Identifier: MIT
/// \file
/// A soft object as an experiment file describes it: its kind, grid, rest shape, material, fixed nodes and loads. The field
/// names are the keys; read_body() checks every key.
///
///   {"kind": "solid", "discretisation": "differences", "grid": [7, 7, 7],
///    "rest": {"block_m": [3, 3, 3]},
///    "material": {"mass_kg": 4, "elastic_n_per_m3": 1.5, "damping_ns_per_m3": 0.1, "incompressibility_n_per_m5": 10},
///    "regions": [{"nodes": {"a1": "first"}, "factors": {"elastic": {"22": 0.1}}}],
///    "fixed": [{"a3": "last"}], "gravity_m_per_s2": [0, 0, -9.81]}
///
/// - Surfaces ("kind": "surface") and tubes ("cylinder") have a grid of two numbers of nodes, and "bending_n_per_m" instead of
///   the incompressibility. Their discretisations are "differences" and "triangles". "irregular": {"share": 0.35, "seed": 1}
///   moves the nodes of triangles away from the grid points by up to that fraction of the spacing.
/// - Curves ("curve") have one number of nodes, numbers instead of tensors, and no discretisation.
/// - Solid blocks may have {"shear_pa", "bulk_pa", "density_kg_per_m3"} or {"young_pa", "poisson_ratio", ..} as material.
/// - With "parameters": "per-node", lambda and omega are the values of each node, without eq. (10) of the thesis (M. Dobsik,
///   Computer Animation of Soft Tissues, Brno 2005). "bending_parameters" has the same meaning for the bending of surfaces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/softbody/action_description.h"
#include "risorius/softbody/detail/material_region.h"
#include "risorius/softbody/detail/node_selection.h"
#include "risorius/softbody/detail/rest_description.h"
#include "risorius/tissue/grid_curve.h"
#include "risorius/tissue/moduli.h"
#include "risorius/tissue/solid_material.h"
#include "risorius/tissue/surface_material.h"
#include "risorius/tissue/triangle_surface.h"

namespace risorius::softbody {

/// How a body is discretised.
enum class Discretisation {
    kDifferences,   ///< A: finite differences, as in the thesis
    kCells,         ///< B: trilinear cells with exact volume
    kBendingCells,  ///< the same, for blocks that bend (tissue/bending_cells.h); material by moduli
    kTriangles      ///< triangles, for surfaces
};

/// An isotropic material given by its moduli. It is converted to lambda, omega and psi for the size of the block.
struct ModuliDescription {
    tissue::IsotropicModuli elastic;
    double density_kg_per_m3 = 1000;  ///< (0, inf)
    /// Shear viscosity: multiplies the strain rate as mu multiplies the strain           [0, inf)
    double viscosity_pa_s = 0;
    double drag_ns_per_m = 0;  ///< c of each node                       [0, inf)
};

/// Triangles whose nodes are moved away from the grid points; see tissue::irregularly_triangulated().
struct IrregularDescription {
    double fraction = 0;  ///< maximum move / spacing      [0, 0.45]
    unsigned seed = 1;    ///< of the random positions
};

/// The fields of a body in a file.
struct BodyDescription {
    std::string place;  ///< the place in the file, for errors found when the body is built
    Kind kind = Kind::kSolid;
    Discretisation discretisation = Discretisation::kDifferences;
    std::optional<IrregularDescription> irregular;
    tissue::GridShape grid;  ///< one layer for surfaces, one line of nodes for curves
    RestDescription rest;

    /// Material of a solid before regions change it. `surface` is the material of a surface, `curve` that of a curve.
    tissue::SolidMaterial material;
    std::optional<ModuliDescription> moduli;  ///< replaces `material`
    tissue::SurfaceMaterial surface;
    tissue::CurveMaterial curve;
    tissue::Parameters parameters = tissue::Parameters::kResolutionIndependent;
    tissue::Parameters bending_parameters = tissue::Parameters::kResolutionIndependent;
    std::vector<MaterialRegion> regions;  ///< applied in the order of the file

    std::vector<NodeSelection> fixed;
    Vec3 gravity_m_per_s2{0, 0, -9.81};
    std::vector<SpringDescription> springs;
    std::vector<PulseDescription> pulses;
    std::vector<ObstacleDescription> obstacles;
};

/// Reads a body. Throws Error for everything that does not agree with the description above; the message names the file and the
/// JSON pointer.
BodyDescription read_body(const JsonCursor& json);

/// Return the solid, surface or curve with its rest shape at its place and a material per node. They check it and throw Error,
/// with a path that begins with description.place, for instance for a folded rest shape or an index outside the grid.
tissue::GridSolid grid_solid(const BodyDescription& description);
tissue::GridSurface grid_surface(const BodyDescription& description);
tissue::TriangleSurface triangle_surface(const BodyDescription& description);
tissue::GridCurve grid_curve(const BodyDescription& description);

/// Logarithm of the mean stiffness of each node, to colour the body. It is the bending stiffness when regions change the
/// bending. Empty for curves, and when no region changes the material.
std::vector<double> relative_stiffness(const BodyDescription& description);

/// One flag per node; true when any entry of `fixed` selects it.
std::vector<char> fixed_flags(const BodyDescription& description);

}  // namespace risorius::softbody
