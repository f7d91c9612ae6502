// A soft object as an experiment file describes it: its kind, grid, rest shape, material, what holds it and what acts on
// it. Field names are the keys; read_body checks every one.
//
//   {"kind": "solid", "discretisation": "differences", "grid": [7, 7, 7],
//    "rest": {"block_m": [3, 3, 3]},
//    "material": {"mass_kg": 4, "elastic_n_per_m3": 1.5, "damping_ns_per_m3": 0.1, "incompressibility_n_per_m5": 10},
//    "regions": [{"nodes": {"a1": "first"}, "factors": {"elastic": {"22": 0.1}}}],
//    "fixed": [{"a3": "last"}], "gravity_m_per_s2": [0, 0, -9.81]}
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "body/material_region.h"
#include "body/node_selection.h"
#include "core/json_cursor.h"
#include "tissue/solid_material.h"

namespace risorius::body {

enum class Kind {
    kSolid  ///< a grid over three material axes
};

enum class Discretisation {
    kDifferences,  ///< A, the thesis' finite differences
    kCells         ///< B, trilinear cells with exact volume
};

/// The undeformed shape; exactly one of the forms.
struct RestDescription {
    enum class Form {
        kBlock,  ///< "block_m": edges along x, y, z, which are a1, a2, a3
        kCylinder,  ///< "cylinder": solid, its axis is a1 and x; a square of a2 and a3 pressed into the disc
        kPoints  ///< "points_m": every node, [m, n, o] in row (m N + n) O + o; holds for one grid only
    };
    Form form = Form::kBlock;
    Vec3 block_m{1, 1, 1};
    double radius_m = 1, length_m = 1;
    Points points_m;
    Vec3 at_m{0, 0, 0};       ///< added to every node
    Vec3 turn_axis{0, 0, 1};  ///< about the rest shape's own origin, before at_m
    double turn_deg = 0;
};

/// A material by the moduli of engineering, isotropic; turned into lambda, omega and psi for the block it fills.
struct ModuliDescription {
    double shear_pa = 0;              ///< mu; or "young_pa", from which mu follows  (0, inf)
    double bulk_pa = 0;               ///< K                                     [0, inf)
    double density_kg_per_m3 = 1000;  ///< (0, inf)
    double viscosity_pa_s = 0;        ///< of shear, as mu is to strain           [0, inf)
    double drag_ns_per_m = 0;         ///< c, of each node                       [0, inf)
};

struct BodyDescription {
    std::string place;  ///< where it was written, for errors found on building
    Kind kind = Kind::kSolid;
    Discretisation discretisation = Discretisation::kDifferences;
    tissue::GridShape grid;
    RestDescription rest;

    tissue::SolidMaterial material;           ///< before the regions change it
    std::optional<ModuliDescription> moduli;  ///< takes the place of `material`
    tissue::Parameters parameters = tissue::Parameters::kResolutionIndependent;
    std::vector<MaterialRegion> regions;  ///< applied in the order written

    std::vector<NodeSelection> fixed;
    Vec3 gravity_m_per_s2{0, 0, -9.81};
};

/// Throws Error with file and JSON pointer for whatever is not as described.
BodyDescription read_body(const JsonCursor& json);

/// The checked solid: rest shape placed, material per node. Throws Error below description.place (folded rest shape, an
/// index the grid does not have).
tissue::GridSolid grid_solid(const BodyDescription& description);

/// Logarithm of the mean elastic parameter of each node, for colour; empty where no region changes the material.
std::vector<double> relative_stiffness(const BodyDescription& description);

/// Selected by any of `fixed`, one flag per node.
std::vector<char> fixed_flags(const BodyDescription& description);

}  // namespace risorius::body
