// SPDX-License-Identifier: MIT
/// \file
/// The mesh of a rig in the head frame, with the role of every vertex: skin, eye, tooth, lash, ...
///
/// Head frame (head_frame.h), m. Vertices have the order of the mesh file.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/rig/detail/head_frame.h"
#include "risorius/rig/rig_description.h"

namespace risorius::rig {

/// The body that a vertex moves with.
enum class Carrier : char {
    kNone,      ///< the vertex has no role; it moves with the skull and is not drawn
    kSkin,      ///< skin, mouth lining, eye sockets: moves with the tissue
    kSkull,     ///< upper teeth and gums
    kMandible,  ///< lower teeth and gums
    kTongue,
    kEyeLeft,
    kEyeRight,
    kLashes,  ///< moves with the skin at its root
};

/// The shape of an eyeball.
struct EyeGeometry {
    bool present = false;
    Vec3 centre = Vec3::Zero();
    double radius_m = 0.0;  ///< radius of the globe without the bulge of the cornea
    Vec3 forward = Vec3::UnitZ();
    /// Largest distance of the eye's surface from its centre, m, for each degree from the optical axis, 0..90.
    std::vector<double> profile_m;
    double profile_at(double angle_rad) const;
    /// Signed distance of p from the surface of an eye that looks along `looks` (unit vector), m; negative inside.
    double distance(const Vec3& p, const Vec3& looks) const;
};

/// A mesh in the head frame, and everything that is measured on it.
struct Head {
    HeadFrame frame;
    double size = 1.0;             ///< length on this head over the same length on the atlas head
    Points vertices;               ///< V x 3
    std::vector<Carrier> carrier;  ///< V
    /// V, for vertices of teeth, gums and tongue: fraction of the mandible's motion that they follow
    std::vector<double> jaw_fraction;
    std::vector<std::string> role_of_group;  ///< one per mesh group, "" when unused
    Triangles skin;                          ///< outer skin, welded vertex indices
    Triangles lining;  ///< mouth lining and eye sockets, welded vertex indices
    /// V; the vertex that stands for this one in the welded surface (geom/weld.h)
    std::vector<int> welded;
    /// All landmarks of the atlas; missing ones are estimated by warping the atlas and projecting onto the skin
    std::map<std::string, Vec3> landmarks;
    std::vector<std::string> warped_landmarks;  ///< the landmarks that were estimated
    std::array<EyeGeometry, 2> eyes;
    double teeth_front_m = 0.0;  ///< z of the foremost upper tooth, or an estimate behind the lips
    bool has_teeth = false;

    const Vec3& landmark(const std::string& id) const { return landmarks.at(id); }
    /// Converts a length in mm of the atlas head to m of this head.
    double mm(double atlas_mm) const { return atlas_mm * 1e-3 * size; }
};

/// Places a mesh in the head frame. Throws Error when the mesh lacks a group that the rig names, a landmark lies off the mesh, or
/// the size is not that of a head.
Head place_head(const RigDescription& rig, const geom::PolygonMesh& mesh, const std::string& place);

/// Returns the ids of the landmarks that are needed to place a head.
const std::vector<std::string>& required_landmarks();

}  // namespace risorius::rig
