// SPDX-License-Identifier: MIT
// Files of VTK: their text, their blocks, and what is refused. tests/vtk reads whole exports with VTK itself.
#include "risorius/io/vtk_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace risorius::io {
namespace {

VtkMesh tetrahedron() {
    VtkMesh mesh;
    mesh.points.resize(4, 3);
    mesh.points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1;
    mesh.add_cell(VtkCell::kTetra, std::vector<int>{0, 1, 2, 3});
    mesh.point_data.push_back({.name = "pressure_pa", .values = {1, 2, 3, 4.5}});
    mesh.cell_data.push_back({.name = "a<b", .components = 3, .values = {1, 0, -1e-20}});
    return mesh;
}

TEST(VtkFile, TextHasEveryNumberInFull) {
    const std::string text = vtu_bytes(tetrahedron(), VtkEncoding::kAscii, 0.25);
    for (const char* part :
         {"<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">",
          "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">", "Name=\"TimeValue\"", " 0.25\n",
          "Name=\"pressure_pa\" NumberOfComponents=\"1\" format=\"ascii\">", " 1 2 3 4.5\n",
          "Name=\"a&lt;b\" NumberOfComponents=\"3\"", " 1 0 -1e-20\n", " 0 0 0.1\n",
          "Name=\"types\"", " 10\n", " 0 1 2 3\n"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
    EXPECT_EQ(text.find("AppendedData"), std::string::npos);
}

TEST(VtkFile, BlocksFollowEachOtherAfterTheirLengths) {
    const std::string bytes = vtu_bytes(tetrahedron(), VtkEncoding::kAppended, 0.25);
    const std::string begin = "<AppendedData encoding=\"raw\">\n_";
    const std::size_t at = bytes.find(begin) + begin.size();
    // Time, pressure, vector, points, connectivity, offsets, types
    std::size_t offset = 0;
    for (const std::uint64_t length : {8, 32, 24, 96, 32, 8, 1}) {
        EXPECT_NE(bytes.find("offset=\"" + std::to_string(offset) + "\""), std::string::npos);
        std::uint64_t said = 0;
        std::memcpy(&said, bytes.data() + at + offset, sizeof said);
        EXPECT_EQ(said, length);
        offset += sizeof said + length;
    }
    double time_s = 0;
    std::memcpy(&time_s, bytes.data() + at + 8, sizeof time_s);
    EXPECT_EQ(time_s, 0.25);
    EXPECT_EQ(bytes.substr(at + offset), "\n  </AppendedData>\n</VTKFile>\n");
}

TEST(VtkFile, ASurfaceHasTriangles) {
    VtkMesh mesh = tetrahedron();
    EXPECT_THROW(vtp_bytes(mesh, VtkEncoding::kAscii, 0), std::invalid_argument);
    mesh = {};
    mesh.points = Points::Identity(3, 3);
    mesh.add_cell(VtkCell::kTriangle, std::vector<int>{0, 1, 2});
    const std::string text = vtp_bytes(mesh, VtkEncoding::kAscii, 0);
    EXPECT_NE(text.find("NumberOfPolys=\"1\""), std::string::npos);
    EXPECT_EQ(text.find("types"), std::string::npos);
}

TEST(VtkFile, WhatDoesNotFitIsRefused) {
    const auto refused = [](auto&& change) {
        VtkMesh mesh = tetrahedron();
        change(mesh);
        EXPECT_THROW(vtu_bytes(mesh, VtkEncoding::kAppended, 0), std::invalid_argument);
    };
    refused([](VtkMesh& mesh) { mesh.connectivity[2] = 4; });
    refused([](VtkMesh& mesh) { mesh.connectivity.push_back(0); });
    refused([](VtkMesh& mesh) { mesh.point_data[0].values.pop_back(); });
    refused([](VtkMesh& mesh) { mesh.cell_data[0].values[1] = NAN; });
    refused([](VtkMesh& mesh) { mesh.points(0, 0) = INFINITY; });
}

TEST(VtkFile, ASeriesNamesTimesAndFiles) {
    const std::vector<VtkStep> steps{{0, 0, "a_0000.vtu"}, {0.04, 1, "b&c.vtp"}};
    EXPECT_EQ(pvd_bytes(steps),
              "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
              "byte_order=\"LittleEndian\">\n  <Collection>\n"
              "    <DataSet timestep=\"0\" group=\"\" part=\"0\" file=\"a_0000.vtu\"/>\n"
              "    <DataSet timestep=\"0.04\" group=\"\" part=\"1\" file=\"b&amp;c.vtp\"/>\n"
              "  </Collection>\n</VTKFile>\n");
}

}  // namespace
}  // namespace risorius::io
