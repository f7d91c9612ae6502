// SPDX-License-Identifier: MIT
/// \file
/// A soft solid whose shape is a tetrahedral mesh from a file, with a hyperelastic material for each region.
///
///   {"kind": "mesh", "mesh": {"file": "tongue.msh", "metres_per_unit": 0.001},
///    "materials": [
///      {"names": ["muscle"], "law": "fibres", "c10_pa": 500, "bulk_pa": 50000, "density_kg_per_m3": 1040,
///       "c3_pa": 150, "c4": 6.6, "c5_pa": 15000, "straight": 1.4, "along": [0, 0, 1]},
///      {"law": "mooney-rivlin", "c10_pa": 300, "c01_pa": 100, "bulk_pa": 40000, "density_kg_per_m3": 1000}],
///    "fixed": [{"low_m": [-1, -1, -1], "high_m": [1, 1, 0]}], "gravity_m_per_s2": [0, 0, -9.81]}
///
/// - "mesh" may have {"surface": "ball.obj", "spacing_m": 0.005} in place of the file of tetrahedra: a closed surface, which is filled with
///   tetrahedra (geom/filled_surface.h). All have the tag 0.
/// - "tags" (numbers) and "names" say which tetrahedra have the material. One material without both is that of all others.
/// - Laws and their constants are those of tissue/hyperelastic.h: "neo-hookean" (c10_pa), "mooney-rivlin" (c10_pa, c01_pa), "ogden"
///   ("terms": [[modulus_pa, exponent], ...]), "fibres" (c10_pa, c01_pa, c3_pa, c4, c5_pa, straight, along).
/// - "muscle" makes a material contract along fibres (detail/mesh_muscle.h). "activation" of the body, 0..1, is a number for all muscles, or a list
///   of one for each material with "muscle".
/// - "fixed": nodes in any of the boxes do not move; with "axes": "x", "xy" or the like, they keep only these coordinates and slide.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/softbody/detail/mesh_muscle.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/tissue/hyperelastic.h"

namespace risorius::softbody {

/// The material of some tetrahedra.
struct MeshRegion {
    std::vector<int> tags;
    std::vector<std::string> names;
    tissue::Hyperelastic material;
    double density_kg_per_m3 = 1000;  ///< (0, inf)
    Vec3 along = Vec3::UnitX();  ///< of the fibres at rest, a unit vector; not used for muscles
    std::optional<MeshMuscle> muscle = {};
    std::string place;

    bool is_rest() const { return tags.empty() && names.empty(); }
};

/// Nodes that do not move, or keep some coordinates.
struct FixedBox {
    Box box;
    std::array<bool, 3> axes{true, true, true};
    bool whole() const { return axes[0] && axes[1] && axes[2]; }
};

struct MeshBodyDescription {
    std::string place;
    std::filesystem::path file;
    double metres_per_unit = 1;
    double spacing_m = 0;  ///< of the tetrahedra that fill a surface; 0: the file has tetrahedra
    std::vector<MeshRegion> regions;
    std::vector<FixedBox> fixed;
    std::vector<double> activation;  ///< of each region that is a muscle
    Vec3 gravity_m_per_s2{0, 0, -9.81};
};

/// Whether the JSON of a body is one of this kind.
bool is_mesh_body(const JsonCursor& json);

/// Reads a body, without its mesh. Throws Error.
MeshBodyDescription read_mesh_body(const JsonCursor& json);

/// Reads the mesh and builds the body. Throws Error for a mesh that cannot be used, for a tag without a material or with two, for a name
/// that the mesh does not have, and when a box of "fixed" holds no node.
SoftBody build_mesh_body(const MeshBodyDescription& description);

}  // namespace risorius::softbody
