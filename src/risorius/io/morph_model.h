// SPDX-License-Identifier: MIT
/// \file
/// Writes and reads a mesh with blend shapes as a binary glTF 2.0 file (.glb), for three.js, Blender, Unity and others.
///
/// Space: metres, y up, the face looks along +z, as glTF asks for. Every part is a primitive of one mesh with a material of
/// its own and only the vertices it needs, in the order of the mesh; the attribute _VERTEX holds each one's number in the
/// mesh. Blend shapes are morph targets of positions and normals, stored where they are not zero (sparse accessors), their names in
/// the mesh's extras.targetNames. Positions of targets are whole numbers of 16 bits that the node's scale makes metres of
/// (KHR_mesh_quantization), not "normalized" ones, which three.js from r145 to r168 misreads in sparse accessors; normals are floats.
/// Sources: glTF 2.0 specification, Khronos 2021, sections 3.6.2.3 and 3.7.2.2; KHR_mesh_quantization, Khronos 2020; three.js pull
/// requests 22874 and 29330.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"

namespace risorius::io {

struct MorphTarget {
    std::string name;
    std::vector<int> vertex;  ///< ascending
    Points delta;             ///< one row per vertex above, m at weight 1
};

/// A part of one material.
struct MorphPart {
    std::string name;
    Triangles triangles;   ///< F x 3, into the model's vertices, counter-clockwise from outside
    TexCoords texcoords;   ///< 3F x 2 per corner, or no rows; v up
    Vec3 colour{1, 1, 1};  ///< sRGB
    Points tint;           ///< V x 3 on the model's vertices, sRGB, times the colour; or no rows
    double roughness = 0.6;
    double opacity = 1;
    bool see_both_sides = false;
};

/// Weights over time, linear between frames.
struct MorphAnimation {
    std::string name;
    double fps = 60;
    Eigen::MatrixXf weights;  ///< frames x targets
};

struct MorphModel {
    std::string name;
    Points vertices;  ///< V x 3, m, head frame
    std::vector<int>
        stands_for;  ///< V, the vertex at the same place whose normal this one shares; empty: itself
    std::vector<MorphPart> parts;
    std::vector<MorphTarget> targets;
    std::vector<MorphAnimation> animations;
    Json extras;  ///< an object; its keys are written next to targetNames
    /// Deltas in 1/32767 of the largest; or as floats, for readers that do not know KHR_mesh_quantization.
    bool whole_numbers = true;
};

/// The bytes of the file; they depend only on the model.
std::string glb_bytes(const MorphModel& model);

/// Reads a file that glb_bytes() wrote: vertices, targets, extras and animations; of the parts only the triangles. Throws Error for other
/// files.
MorphModel read_glb(const std::filesystem::path& file);

}  // namespace risorius::io
