// SPDX-License-Identifier: MIT
/// \file
/// Converts the result of assimp to one polygon mesh in metres. See risorius/io/read_mesh.h for order, groups and units.
#pragma once

#include <exception>
#include <filesystem>

#include "risorius/geom/polygon_mesh.h"
#include "risorius/io/mesh_message.h"

namespace risorius::import_mesh {

/// The file is no mesh.
struct NoMesh : std::exception {
    explicit NoMesh(io::MeshProblem what) : problem(std::move(what)) {}
    io::MeshProblem problem;
};

/// Throws NoMesh when assimp cannot read the file or finds no faces in it.
geom::PolygonMesh read_scene(const std::filesystem::path& file);

}  // namespace risorius::import_mesh
