// SPDX-License-Identifier: MIT
/// \file
/// The mesh of a rig placed in the head frame. The role of every vertex is known: skin, eye, tooth, lash, ...
///
/// Frame: the head frame (see head_frame.h), metres. Vertex order: the mesh file's own.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/detail/head_frame.h"
#include "risorius/rig/rig_description.h"

namespace risorius::rig {

/// The body that carries a vertex.
enum class Carrier : char {
    kNone,      ///< part of no role: stays with the skull and is not drawn
    kSkin,      ///< skin, mouth lining, eye sockets: follows the tissue
    kSkull,     ///< upper teeth and gums
    kMandible,  ///< lower teeth and gums
    kTongue,
    kEyeLeft,
    kEyeRight,
    kLashes,  ///< follows the skin at its root
};

struct EyeGeometry {
    bool present = false;
    Vec3 centre = Vec3::Zero();
    double radius_m = 0.0;  ///< of the globe, without the corneal bulge
    Vec3 forward = Vec3::UnitZ();
    /// Largest distance of the eye's surface from its centre, m, for each degree from the optical axis, 0..90.
    std::vector<double> profile_m;
    double profile_at(double angle_rad) const;
    /// Signed distance of p from the surface of the eye when the eye looks along `looks` (unit), m; negative inside.
    double distance(const Vec3& p, const Vec3& looks) const;
};

struct Head {
    HeadFrame frame;
    double size = 1.0;             ///< this head / the atlas head
    Points vertices;               ///< V x 3
    std::vector<Carrier> carrier;  ///< V
    std::vector<double>
        jaw_fraction;  ///< V, fraction of the mandible's motion that a vertex of teeth, gums or tongue follows
    std::vector<std::string> role_of_group;  ///< per mesh group, "" when unused
    Triangles skin;                          ///< outer skin, welded vertex indices
    Triangles lining;         ///< mouth lining and eye sockets, welded vertex indices
    std::vector<int> welded;  ///< V, the vertex of the welded surface that this vertex belongs to
    std::map<std::string, Vec3>
        landmarks;  ///< all landmarks of the atlas; those not given are warped and projected onto the skin
    std::vector<std::string> warped_landmarks;  ///< which were not given
    std::array<EyeGeometry, 2> eyes;
    double teeth_front_m = 0.0;  ///< z of the foremost upper tooth, or estimated behind the lips
    bool has_teeth = false;

    const Vec3& landmark(const std::string& id) const { return landmarks.at(id); }
    /// A length in mm of the atlas head, scaled to this head, in m.
    double mm(double atlas_mm) const { return atlas_mm * 1e-3 * size; }
};

/// Throws Error when the mesh lacks a group that the rig names, a landmark lies off the mesh, or the size is not that of a head.
Head place_head(const RigDescription& rig, const geom::PolygonMesh& mesh, const std::string& place);

/// The landmarks without which a head cannot be placed.
const std::vector<std::string>& required_landmarks();

}  // namespace risorius::rig
