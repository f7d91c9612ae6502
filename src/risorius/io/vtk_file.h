// SPDX-License-Identifier: MIT
/// \file
/// Files of VTK in XML, for ParaView and others: unstructured grids (.vtu), surfaces (.vtp), and series of files over time (.pvd).
///
/// Numbers are 64-bit: floating point for points and data, integers for cells. They are text, or binary blocks at the end of the file
/// ("appended", "raw"), each after its length in bytes, a 64-bit integer. Binary numbers are little-endian.
///
/// Source: VTK File Formats, in The VTK User's Guide, Kitware, 11th edition, 2010; format version 1.0.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::io {

enum class VtkEncoding { kAscii, kAppended };

/// Types of cells, with the numbers of VTK.
enum class VtkCell : unsigned char { kLine = 3, kTriangle = 5, kTetra = 10, kHexahedron = 12 };

/// A field: so many components for each point or cell.
struct VtkArray {
    std::string name;
    int components = 1;
    std::vector<double> values;
};

/// A mesh with its fields.
struct VtkMesh {
    Points points;                  ///< m
    std::vector<int> connectivity;  ///< the points of all cells, cell by cell
    std::vector<int> offsets;       ///< where each cell ends in `connectivity`
    std::vector<VtkCell> types;     ///< of each cell
    std::vector<VtkArray> point_data, cell_data;

    void add_cell(VtkCell type, std::span<const int> points);
    int cells() const { return static_cast<int>(types.size()); }
};

/// Returns the bytes of a file .vtu. `time_s` is stored as TimeValue. Throws std::invalid_argument when an array or a cell does not fit the
/// mesh, or when a value is not finite.
std::string vtu_bytes(const VtkMesh& mesh, VtkEncoding encoding, double time_s);
/// Returns the bytes of a file .vtp. All cells must be triangles.
std::string vtp_bytes(const VtkMesh& mesh, VtkEncoding encoding, double time_s);

/// A file of a series.
struct VtkStep {
    double time_s = 0;
    int part = 0;
    std::string file;  ///< relative to the .pvd
};
/// Returns the bytes of a file .pvd.
std::string pvd_bytes(std::span<const VtkStep> steps);

}  // namespace risorius::io
