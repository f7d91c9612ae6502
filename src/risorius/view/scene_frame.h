// SPDX-License-Identifier: MIT
/// \file
/// What the page draws, as bytes: surfaces, texture coordinates and the shape at rest, sent once.
///
/// A message begins with its kind (uint32: 2 scene, 3 picture, 4 muscles, 5 mesh, 6 skull, 7 file) and the length of a JSON text (uint32); the text follows,
/// filled up with spaces to a multiple of 4 bytes, then arrays of numbers, each at the `at` that the text gives, from the end of
/// the text. All numbers are little-endian.
#pragma once

#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"
#include "risorius/face/surfaces.h"
#include "risorius/face/view/skull.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/render/scene.h"

namespace risorius::view {

/// The vertices of the mesh that are drawn. Poses hold these, in this order.
struct DrawnVertices {
    std::vector<int> vertex;  ///< of the mesh
    Points of(const Points& all) const;
};
DrawnVertices drawn_vertices(const render::Scene& scene);

/// The scene. `soft`: one flag per vertex of the mesh, whether a hand can pull it.
std::string encode_scene(const render::Scene& scene, const DrawnVertices& drawn,
                         const std::vector<char>& soft, double unit_m);
/// The picture of a material, "skin" or "eye", or of the mesh by its number, "0"; 8 bits a channel.
std::string encode_picture(const std::string& material, const Image& picture);
std::string encode_muscles(const face::MuscleSurfaces& surfaces);
/// The bones under the skin, at rest: {"cranium": {"vertices", "triangles"}, "mandible": the same}. A pose has the motion of the mandible.
std::string encode_skull(const face::Skull& skull);
/// What is said of a mesh that landmarks are put on.
struct MeshLabels {
    std::string file, rig;             ///< names below the project; where its rig is written
    std::vector<std::string> roles{};  ///< that a group may have (rig::part_roles())
    std::vector<std::string> role_of_group{};  ///< as their names say; "" where a name says nothing
};
/// A mesh that landmarks are put on: {"file", "rig", "roles", "vertices", "triangles", "groups": [{"name", "from", "count", "role"}]},
/// where a group is a range of triangles.
std::string encode_mesh(const geom::PolygonMesh& mesh, const MeshLabels& labels);

/// A file that has been made, as it is. `type`: "video/mp4".
std::string encode_file(const std::string& name, const std::string& type, const std::string& bytes);

}  // namespace risorius::view
