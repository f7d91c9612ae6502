// SPDX-License-Identifier: MIT
/// \file
/// Checks the mesh of a head before a rig is built on it. The findings are errors, warnings and notes. In this file, a face is a
/// polygon of the mesh.
///
/// Messages count vertices and faces from 0, as the rows of PolygonMesh, and give the position in metres:
///   head.obj:face 17: expected an area above 1e-13 m2, found 0 m2 (group skin, at (0.01, 0.02, 0.09) m)
#pragma once

#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"

namespace risorius::geom {

/// The checks, in the order in which they are made. Later checks need the first three to pass, so an error in one of these ends
/// the checks.
enum class MeshCheck {
    kEmpty,            ///< no vertices or no faces
    kNonFinite,        ///< a position that is not finite
    kIndexRange,       ///< a corner whose index is not that of a vertex
    kDegenerateFace,   ///< a face with a repeated vertex, or with almost no area
    kNonManifoldEdge,  ///< more than two faces at an edge
    /// Two neighbours that run along their common edge in the same direction, so one of them is flipped.
    kWinding,
    kInsideOut,         ///< the surface, or a closed piece of it, faces inwards
    kScale,             ///< not the size of a head
    kPieces,            ///< more than one piece
    kUnusedVertex,      ///< a vertex of no face
    kCoincidentVertex,  ///< boundary vertices at one position: a seam to weld
};

/// Whether repair_mesh() (repair_mesh.h) mends such a finding.
inline bool can_be_repaired(MeshCheck check) {
    return check == MeshCheck::kDegenerateFace || check == MeshCheck::kNonManifoldEdge ||
           check == MeshCheck::kWinding || check == MeshCheck::kInsideOut;
}

/// How a finding is treated. check_mesh() throws the first kError.
enum class Severity { kIgnore, kNote, kWarning, kError };

/// The defaults are for the skin of a head: open at neck, eyes and mouth, possibly split at texture seams.
struct MeshCheckOptions {
    std::vector<int> groups{};  ///< groups whose faces are checked; empty: all
    /// The factor with which the mesh was read, for advice in messages.
    double metres_per_unit = 1.0;
    double smallest_size_m = 0.12;  ///< lower limit of the longest side of the bounding box
    double max_size_m = 1.0;        ///< upper limit of the same side: a head with shoulders
    double smallest_face_area_m2 = 1e-13;
    double seam_tolerance_m = 1e-7;
    int findings_per_check = 5;  ///< further findings are counted only

    Severity degenerate_face = Severity::kError;
    Severity non_manifold_edge = Severity::kError;
    Severity winding = Severity::kError;
    Severity inside_out = Severity::kError;
    Severity scale = Severity::kError;
    Severity pieces = Severity::kNote;
    Severity unused_vertex = Severity::kWarning;
    Severity coincident_vertex = Severity::kNote;
};

/// One finding: where it is, what was expected and what was found.
struct MeshFinding {
    MeshCheck check;
    Severity severity;
    std::string place;
    std::string expected;
    std::string found;

    std::string message() const { return place + ": expected " + expected + ", found " + found; }
};

/// All findings, and the extent of the mesh.
struct MeshReport {
    std::vector<MeshFinding> findings;  ///< in the order of MeshCheck
    std::vector<int> piece_face_count;  ///< faces of each piece, sorted by its first face
    int boundary_loop_count = 0;
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< bounding box of the checked groups, m
};

/// Makes the checks and returns all findings, errors included. MeshFinding::place begins with `name`, usually the file.
MeshReport inspect_mesh(const PolygonMesh& mesh, const std::string& name,
                        const MeshCheckOptions& options = {});

/// Does the same, but throws the first finding of severity kError as Error.
MeshReport check_mesh(const PolygonMesh& mesh, const std::string& name,
                      const MeshCheckOptions& options = {});

}  // namespace risorius::geom
