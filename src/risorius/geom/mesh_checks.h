// SPDX-License-Identifier: MIT
/// \file
/// Checks of a face mesh before a rig is built on it: errors and warnings.
///
/// Messages name vertices and faces counted from 0, as the rows of PolygonMesh are, with the position in metres:
///   head.obj:face 17: expected an area above 1e-13 m2, found 0 m2 (group skin, at (0.01, 0.02, 0.09) m)
#pragma once

#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::geom {

/// In the order in which they are made. Later checks need the earlier ones passed, so an error in the first three ends the checks.
enum class MeshCheck {
    kEmpty,            ///< no vertices or no faces
    kNonFinite,        ///< a position that is not a number
    kIndexRange,       ///< a corner that names no vertex
    kDegenerateFace,   ///< a vertex twice in one face, or hardly any area
    kNonManifoldEdge,  ///< more than two faces at an edge
    kWinding,       ///< neighbours that run along their edge the same way: one of them is flipped
    kInsideOut,     ///< the surface, or a closed piece of it, faces inwards
    kScale,         ///< not the size of a head
    kPieces,        ///< more than one piece
    kUnusedVertex,  ///< a vertex of no face
    kCoincidentVertex,  ///< boundary vertices at one position: a seam to weld
};

enum class Severity { kIgnore, kNote, kWarning, kError };

/// The defaults are for the skin of a head: open at neck, eyes and mouth, possibly split at texture seams.
struct MeshCheckOptions {
    std::vector<int> groups{};      ///< groups whose faces are checked; empty: all
    double metres_per_unit = 1.0;   ///< with which the mesh was read, for advice in a message
    double smallest_size_m = 0.12;  ///< longest side of the bounding box: a face alone
    double max_size_m = 1.0;        ///< a head with shoulders
    double smallest_face_area_m2 = 1e-13;
    double seam_tolerance_m = 1e-7;
    int findings_per_check = 5;  ///< further findings are only counted

    Severity degenerate_face = Severity::kError;
    Severity non_manifold_edge = Severity::kError;
    Severity winding = Severity::kError;
    Severity inside_out = Severity::kError;
    Severity scale = Severity::kError;
    Severity pieces = Severity::kNote;
    Severity unused_vertex = Severity::kWarning;
    Severity coincident_vertex = Severity::kNote;
};

struct MeshFinding {
    MeshCheck check;
    Severity severity;
    std::string place;
    std::string expected;
    std::string found;

    std::string message() const { return place + ": expected " + expected + ", found " + found; }
};

struct MeshReport {
    std::vector<MeshFinding> findings;  ///< in the order of MeshCheck
    std::vector<int> piece_face_count;  ///< faces of each piece, in the order of its first face
    int boundary_loop_count = 0;
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< bounding box of the groups looked at, m
};

/// All findings, including errors. `name` begins every place, usually the file.
MeshReport inspect_mesh(const PolygonMesh& mesh, const std::string& name,
                        const MeshCheckOptions& options = {});

/// The same, but throws the first error as Error.
MeshReport check_mesh(const PolygonMesh& mesh, const std::string& name,
                      const MeshCheckOptions& options = {});

}  // namespace risorius::geom
