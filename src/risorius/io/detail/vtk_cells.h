// SPDX-License-Identifier: MIT
/// \file
/// An unstructured grid of VTK as its files hold it, and the tetrahedra in it.
#pragma once

#include <string>
#include <vector>

#include "risorius/io/tet_mesh.h"

namespace risorius::io::detail {

struct VtkCells {
    explicit VtkCells(std::string name) : name_(std::move(name)) {}

    std::vector<double> points;                 ///< three coordinates each
    std::vector<double> connectivity, offsets;  ///< offsets begin with 0: one more than cells
    std::vector<double> types;
    std::vector<double> tags;  ///< of the cells, or empty

    /// Throws Error when the parts do not fit together.
    TetMesh finish();

  private:
    std::string name_;
};

}  // namespace risorius::io::detail
