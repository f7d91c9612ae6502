// SPDX-License-Identifier: MIT
/// \file
/// Writes and reads a mesh with blend shapes as a binary glTF 2.0 file (.glb), for three.js, Blender, Unity and others.
///
/// Coordinates are metres, y is up and the face looks along +z, as glTF requires. Every node with parts has a mesh of its own,
/// and every part is a primitive of it, with a material and only the vertices it needs, in the order of the mesh; the attribute
/// _VERTEX has their indices in the mesh. Vertices lie around the place of their node. What is worn on the head, such as hair, has meshes
/// of its own without that attribute.
///
/// Blend shapes are morph targets of positions and, on what they turn, of normals: a part whose normals rest in places is two primitives
/// with one material. Targets are stored where they are not zero (sparse accessors), and their names are in the meshes' extras.targetNames. The first mesh has all of them, the others those that move them. On
/// request, positions are 16-bit integers, which the scale of the node converts to metres (KHR_mesh_quantization). They are not
/// "normalized" integers, because three.js from r145 to r168 reads those wrongly in sparse accessors. Normals are floats.
///
/// Sources: glTF 2.0 specification, Khronos 2021, sections 3.6.2.3 and 3.7.2.2; KHR_mesh_quantization, Khronos 2020; three.js
/// pull requests 22874 and 29330.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"

namespace risorius::io {

/// A blend shape: displacements of some vertices.
struct MorphTarget {
    std::string name;
    std::vector<int> vertex;  ///< ascending
    Points delta;             ///< one row per entry of `vertex`; displacement at weight 1, m
    double usual_weight = 1;  ///< weights above are rare, so that smaller normals count for less
};

/// A picture file of a format that glTF knows.
struct MorphPicture {
    std::string name;
    std::string mime_type;  ///< "image/png" or "image/jpeg"
    std::string bytes;
};

/// A part with one material.
struct MorphPart {
    std::string name;  ///< of its material
    int node = 0;      ///< index in MorphModel::nodes
    /// F x 3, indices of the model's vertices, counter-clockwise from outside.
    Triangles triangles;
    TexCoords texcoords;   ///< 3F x 2, one row per corner, or no rows; v is up
    Vec3 colour{1, 1, 1};  ///< sRGB
    Points tint;  ///< V x 3 at the model's vertices, sRGB; multiplied by the colour; or no rows
    double roughness = 0.6;
    double opacity = 1;
    bool see_both_sides = false;
    int picture = -1;           ///< index in MorphModel::pictures: multiplies the colour; -1: none
    bool picture_cuts = false;  ///< the alpha of the picture is the opacity
    double cut_at =
        0;  ///< of picture_cuts: what has less alpha is left out, all else is opaque; 0: it blends
    bool normals_turn = true;  ///< false: targets have no normals, since nobody sees them
};

/// A node of the hierarchy. It is a joint when the skin names it.
struct MorphNode {
    std::string name;
    int parent = -1;             ///< index of a node before it; -1: the root of the file
    Vec3 place = Vec3::Zero();   ///< of its origin at rest, head frame, m
    Json extras = {};            ///< null or an object
    bool animate_shapes = true;  ///< false: animations leave the weights of its mesh at 0
    bool has_shapes = true;      ///< false: its mesh has no targets
};

/// The vertices of one node, carried by joints: the mean of the places to which the joints carry a vertex.
struct MorphSkin {
    int node = -1;  ///< its parent is -1, so that nothing else moves it; -1: there is no skin
    std::vector<int> joints;  ///< indices of nodes, at most four
    Eigen::MatrixXd weights;  ///< V x joints, at the model's vertices; rows sum to 1
};

/// The turn of a node and its shift from its place at rest, linear between frames.
struct NodeMotion {
    int node = 0;
    std::vector<Eigen::Quaterniond> turn;  ///< one per frame
    std::vector<Vec3> shift;               ///< one per frame, m; or none
};

/// Weights over time, linear between frames.
struct MorphAnimation {
    std::string name;
    double fps = 60;
    Eigen::MatrixXf weights;  ///< frames x targets
    std::vector<NodeMotion> motions = {};
};

/// A mesh with parts, blend shapes and animations.
struct MorphModel {
    std::string name;
    Points vertices;  ///< V x 3, m, head frame
    /// W x 3, unit length: the last W vertices are of what is worn. They have these normals, and no vertices in the mesh.
    Points worn_normals;
    /// V; for each vertex, the vertex at the same position with which it shares its normal; empty: no vertices share normals.
    std::vector<int> stands_for;
    /// Index of the first vertex that is worn.
    long first_worn() const { return vertices.rows() - worn_normals.rows(); }
    std::vector<MorphNode> nodes;  ///< empty: one node at the origin with the name of the model
    std::vector<MorphPart> parts;
    std::vector<MorphPicture> pictures;
    MorphSkin skin;
    std::vector<MorphTarget> targets;
    std::vector<MorphAnimation> animations;
    Json extras;  ///< an object; its keys are written next to targetNames of the first mesh
    /// true: positions and displacements are integer multiples of 1/32767 of the largest of them, other attributes and animated weights
    /// have 16 bits, normals and shares of joints 8, normals of targets stand where they turn by more than four and a half degrees at the
    /// usual weight (six, of correctives) instead of four, and no zeros lie under sparse accessors. false: floats, for
    /// readers that do not know KHR_mesh_quantization.
    bool whole_numbers = false;
};

/// Returns the bytes of the file. They depend only on the model.
std::string glb_bytes(const MorphModel& model);

/// Reads a file that glb_bytes() wrote: vertices, targets, extras and animated weights, but of the parts only the name and the
/// triangles, no nodes, and nothing that is worn. Throws Error for other files.
MorphModel read_glb(const std::filesystem::path& file);

}  // namespace risorius::io
