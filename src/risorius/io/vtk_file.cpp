// SPDX-License-Identifier: MIT
#include "risorius/io/vtk_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "risorius/core/json_cursor.h"
#include "risorius/io/xml_writer.h"

namespace risorius::io {

namespace {

static_assert(std::endian::native == std::endian::little, "the blocks are written as they are");

void demand(bool fits, const std::string& what) {
    if (!fits) throw std::invalid_argument("VTK: " + what);
}

std::string number_text(double value) { return format_number(value); }
std::string number_text(std::int64_t value) { return std::to_string(value); }
std::string number_text(std::uint8_t value) { return std::to_string(value); }

template <class Number>
constexpr const char* kVtkType = "";
template <>
constexpr const char* kVtkType<double> = "Float64";
template <>
constexpr const char* kVtkType<std::int64_t> = "Int64";
template <>
constexpr const char* kVtkType<std::uint8_t> = "UInt8";

/// Writes one file: the XML, and the blocks that follow it.
class VtkWriter {
  public:
    VtkWriter(const char* type, VtkEncoding encoding) : type_(type), encoding_(encoding) {
        xml_ = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type_ +
               "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <" +
               type_ + ">\n";
    }

    void line(const std::string& text) { xml_ += "    " + text + "\n"; }

    template <class Number>
    void array(const std::string& name, int components, const std::vector<Number>& values,
               const std::string& more = "") {
        std::string head = std::string("<DataArray type=\"") + kVtkType<Number> + "\" Name=\"" +
                           xml_text(name) + "\" NumberOfComponents=\"" +
                           std::to_string(components) + "\"" + more;
        if (encoding_ == VtkEncoding::kAppended) {
            line("    " + head + " format=\"appended\" offset=\"" + std::to_string(blocks_.size()) +
                 "\"/>");
            const std::uint64_t bytes = values.size() * sizeof(Number);
            append(&bytes, sizeof bytes);
            append(values.data(), bytes);
            return;
        }
        line("    " + head + " format=\"ascii\">");
        for (std::size_t i = 0; i < values.size();) {
            std::string row = "      ";
            // A row for each tuple, or twelve numbers of a long list
            const std::size_t end = std::min(
                values.size(), i + static_cast<std::size_t>(components > 1 ? components : 12));
            for (; i < end; ++i) row += " " + number_text(values[i]);
            line(row);
        }
        line("    </DataArray>");
    }

    std::string finish() {
        xml_ += "  </" + type_ + ">\n";
        if (encoding_ == VtkEncoding::kAppended)
            xml_ += "  <AppendedData encoding=\"raw\">\n_" + blocks_ + "\n  </AppendedData>\n";
        return xml_ + "</VTKFile>\n";
    }

  private:
    void append(const void* bytes, std::size_t count) {
        if (count > 0) blocks_.append(static_cast<const char*>(bytes), count);
    }

    std::string type_, xml_, blocks_;
    VtkEncoding encoding_;
};

void demand_fit(const VtkMesh& mesh) {
    demand(mesh.points.allFinite(), "points must be finite");
    demand(mesh.offsets.size() == mesh.types.size(), "each cell needs an end");
    demand(mesh.offsets.empty() ? mesh.connectivity.empty()
                                : mesh.offsets.back() == static_cast<int>(mesh.connectivity.size()),
           "cells must use all of the connectivity");
    for (const int point : mesh.connectivity)
        demand(point >= 0 && point < mesh.points.rows(), "a cell names a point that is not there");
    const auto demand_data = [](const std::vector<VtkArray>& arrays, long rows) {
        for (const VtkArray& array : arrays) {
            demand(static_cast<long>(array.values.size()) == rows * array.components,
                   array.name + " has not one row for each point or cell");
            demand(std::all_of(array.values.begin(), array.values.end(),
                               [](double value) { return std::isfinite(value); }),
                   array.name + " must be finite");
        }
    };
    demand_data(mesh.point_data, mesh.points.rows());
    demand_data(mesh.cell_data, mesh.cells());
}

void write_vtk_time(VtkWriter& out, double time_s) {
    out.line("<FieldData>");
    out.array<double>("TimeValue", 1, {time_s}, " NumberOfTuples=\"1\"");
    out.line("</FieldData>");
}

void write_vtk_data(VtkWriter& out, const char* element, const std::vector<VtkArray>& arrays) {
    out.line(std::string("<") + element + ">");
    for (const VtkArray& array : arrays) out.array(array.name, array.components, array.values);
    out.line(std::string("</") + element + ">");
}

void write_vtk_points(VtkWriter& out, const VtkMesh& mesh) {
    out.line("<Points>");
    out.array("Points", 3,
              std::vector<double>(mesh.points.data(), mesh.points.data() + mesh.points.size()));
    out.line("</Points>");
}

void write_vtk_cells(VtkWriter& out, const VtkMesh& mesh) {
    const auto wide = [](const std::vector<int>& from) {
        return std::vector<std::int64_t>(from.begin(), from.end());
    };
    out.array("connectivity", 1, wide(mesh.connectivity));
    out.array("offsets", 1, wide(mesh.offsets));
}

}  // namespace

void VtkMesh::add_cell(VtkCell type, std::span<const int> of) {
    connectivity.insert(connectivity.end(), of.begin(), of.end());
    offsets.push_back(static_cast<int>(connectivity.size()));
    types.push_back(type);
}

std::string vtu_bytes(const VtkMesh& mesh, VtkEncoding encoding, double time_s) {
    demand_fit(mesh);
    VtkWriter out("UnstructuredGrid", encoding);
    write_vtk_time(out, time_s);
    out.line("<Piece NumberOfPoints=\"" + std::to_string(mesh.points.rows()) +
             "\" NumberOfCells=\"" + std::to_string(mesh.cells()) + "\">");
    write_vtk_data(out, "PointData", mesh.point_data);
    write_vtk_data(out, "CellData", mesh.cell_data);
    write_vtk_points(out, mesh);
    out.line("<Cells>");
    write_vtk_cells(out, mesh);
    std::vector<std::uint8_t> types;
    for (const VtkCell type : mesh.types) types.push_back(static_cast<std::uint8_t>(type));
    out.array("types", 1, types);
    out.line("</Cells>");
    out.line("</Piece>");
    return out.finish();
}

std::string vtp_bytes(const VtkMesh& mesh, VtkEncoding encoding, double time_s) {
    demand_fit(mesh);
    for (const VtkCell type : mesh.types)
        demand(type == VtkCell::kTriangle, "a surface has triangles only");
    VtkWriter out("PolyData", encoding);
    write_vtk_time(out, time_s);
    out.line("<Piece NumberOfPoints=\"" + std::to_string(mesh.points.rows()) +
             "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
             std::to_string(mesh.cells()) + "\">");
    write_vtk_data(out, "PointData", mesh.point_data);
    write_vtk_data(out, "CellData", mesh.cell_data);
    write_vtk_points(out, mesh);
    out.line("<Polys>");
    write_vtk_cells(out, mesh);
    out.line("</Polys>");
    out.line("</Piece>");
    return out.finish();
}

std::string pvd_bytes(std::span<const VtkStep> steps) {
    std::string out =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
        "byte_order=\"LittleEndian\">\n  <Collection>\n";
    for (const VtkStep& step : steps)
        out += "    <DataSet timestep=\"" + format_number(step.time_s) + "\" group=\"\" part=\"" +
               std::to_string(step.part) + "\" file=\"" + xml_text(step.file) + "\"/>\n";
    return out + "  </Collection>\n</VTKFile>\n";
}

}  // namespace risorius::io
