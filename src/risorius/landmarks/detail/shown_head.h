// SPDX-License-Identifier: MIT
/// \file
/// A mesh as the face network is shown it: skin in one plain colour, white eyes with a dark iris, teeth, and the inside of the
/// mouth. Hair, lashes, corneas and clothes are left out.
///
/// Positions are in the units of the mesh: its size and its orientation are not known yet.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "risorius/geom/closest_point.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/landmarks/detail/layers.h"

namespace risorius::landmarks {

enum class ShownPart : char { kSkin, kEye, kTeeth, kMouth };

struct ShownHead {
    Points positions;               ///< V x 3, mesh units
    Points normals;                 ///< V x 3, of all that is shown
    Triangles triangles;            ///< F x 3
    std::vector<ShownPart> part;    ///< F
    std::vector<int> eye;           ///< F, index into eye_centres or -1
    std::vector<Vec3> eye_centres;  ///< of each eyeball
    Triangles skin;                 ///< those of ShownPart::kSkin
    geom::SurfaceTree tree, skin_tree;
};

/// `parts`: role -> groups, for groups whose names do not show it. Throws Error that names `place` when nothing can be skin.
ShownHead shown_head(const geom::PolygonMesh& mesh, const std::string& place,
                     const std::map<std::string, std::vector<std::string>>& parts = {});

/// Where a picture is taken from, in parallel to the axes of a frame.
struct ViewFrame {
    Vec3 centre = Vec3::Zero();    ///< mesh units
    Mat3 axes = Mat3::Identity();  ///< columns: to the right of the picture, up, towards the viewer
    double width = 1;              ///< of the picture at the centre, mesh units

    Vec3 viewer() const;  ///< where the camera is
    Eigen::Matrix4d clip_from_world() const;
    Vec3 on_plane(const Vec2& px)
        const;  ///< the point of the plane through the centre at a place of the picture
    Vec2 in_picture(const Vec3& p) const;  ///< px, of a picture of kFacePicture_px
};

/// Draws the head for the network: kFacePicture_px square. `samples`: along each side of a pixel.
Picture face_picture(const ShownHead& head, const ViewFrame& frame, int samples);

}  // namespace risorius::landmarks
