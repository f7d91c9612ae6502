// SPDX-License-Identifier: MIT
/// \file
/// An unstructured grid of VTK as its files hold it, and the tetrahedra in it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "risorius/io/tet_mesh.h"

namespace risorius::io::detail {

struct VtkCells {
    explicit VtkCells(std::string name) : name_(std::move(name)) {}

    std::vector<double> points;                 ///< three coordinates each
    std::vector<double> connectivity, offsets;  ///< offsets begin with 0: one more than cells
    std::vector<double> types;
    std::vector<double> tags;                       ///< of the cells, or empty
    std::vector<double> cell_fibres, point_fibres;  ///< three components each, or empty

    /// Throws Error when the parts do not fit together.
    TetMesh finish();

  private:
    void check_counts() const;
    Vec3 fibre(std::size_t cell, const std::array<long long, 4>& nodes) const;

    std::string name_;
};

}  // namespace risorius::io::detail
