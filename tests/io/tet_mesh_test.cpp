// SPDX-License-Identifier: MIT
// Tetrahedral meshes: the same two tetrahedra in every format, and files that are wrong.
#include "risorius/io/tet_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>
#include <utility>

#include "message_of.h"
#include "risorius/io/detail/tet_mesh_builder.h"
#include "risorius/io/vtk_file.h"
#include "temporary_folder.h"

namespace risorius::io {
namespace {

/// Numbers as bytes.
class Bytes {
  public:
    explicit Bytes(bool big = false) : big_(big) {}
    template <class T, class... Values>
    Bytes& put(Values... values) {
        (put_one(static_cast<T>(values)), ...);
        return *this;
    }
    Bytes& text(const std::string& text) {
        out_ += text;
        return *this;
    }
    const std::string& str() const { return out_; }

  private:
    template <class T>
    void put_one(T value) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        if (big_) std::reverse(raw, raw + sizeof(T));
        out_.append(raw, sizeof(T));
    }
    bool big_;
    std::string out_;
};

std::string base64(const std::string& bytes) {
    static const char* const kLetters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t bits = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[at + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= count ? kLetters[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

// Nodes 1 to 5 and one that nothing uses; tetrahedra 1 2 3 4 (tag 7) and 2 3 4 5 (tag 9), beside a triangle.
const double kNodes[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1.5}, {9, 9, 9}};

class TetMeshes : public testing::Test {
  protected:
    TetMesh read(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return read_tet_mesh(folder_ / name);
    }
    std::string complaint(const std::string& name, const std::string& bytes) const {
        std::string text = message_of([&] { read(name, bytes); });
        const std::string here = folder_.path().string() + "/";
        for (std::size_t at; (at = text.find(here)) != std::string::npos;)
            text.erase(at, here.size());
        return text;
    }
    void expect_the_two(const TetMesh& mesh, bool tagged = true) const {
        ASSERT_EQ(mesh.positions.rows(), 5);
        ASSERT_EQ(mesh.tets.rows(), 2);
        for (int i = 0; i < 5; ++i)
            for (int k = 0; k < 3; ++k) EXPECT_EQ(mesh.positions(i, k), kNodes[i][k]);
        Tets expected(2, 4);
        expected << 0, 1, 2, 3, 1, 2, 3, 4;
        EXPECT_EQ(mesh.tets, expected);
        if (tagged) {
            EXPECT_EQ(mesh.tags, (std::vector<int>{7, 9}));
        }
    }
    TemporaryFolder folder_;
};

const std::string kNodeText = "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1.5\n6 9 9 9\n";

std::string msh2_text(const std::string& tets = "2 4 2 7 1 1 2 3 4\n3 4 2 9 2 2 3 4 5\n") {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 3 \"skin of it\"\n3 7 "
           "\"left half\"\n$EndPhysicalNames\n$Comments\nby hand\n$EndComments\n$Nodes\n6\n" +
           kNodeText + "$EndNodes\n$Elements\n3\n1 2 2 3 1 1 2 3\n" + tets + "$EndElements\n";
}

std::string msh2_binary() {
    Bytes out;
    out.text("$MeshFormat\n2.2 1 8\n").put<std::int32_t>(1).text("\n$EndMeshFormat\n$Nodes\n6\n");
    for (int i = 0; i < 6; ++i)
        out.put<std::int32_t>(i + 1).put<double>(kNodes[i][0], kNodes[i][1], kNodes[i][2]);
    out.text("\n$EndNodes\n$Elements\n3\n");
    out.put<std::int32_t>(2, 1, 2).put<std::int32_t>(1, 3, 1, 1, 2, 3);
    out.put<std::int32_t>(4, 2, 2).put<std::int32_t>(2, 7, 1, 1, 2, 3, 4, 3, 9, 2, 2, 3, 4, 5);
    return out.text("\n$EndElements\n").str();
}

std::string msh4_text() {
    return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 1 2\n1 0 0 0 0\n1 0 0 0 1 1 0 1 3 "
           "0\n1 0 0 0 1 1 1 1 7 1 1\n2 0 0 0 1 1 1.5 1 9 1 -1\n$EndEntities\n$Nodes\n2 6 1 6\n"
           "3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 2 0 2\n5\n6\n1 1 1.5\n9 9 "
           "9\n$EndNodes\n$Elements\n3 3 1 3\n2 1 2 1\n1 1 2 3\n3 1 4 1\n2 1 2 3 4\n3 2 4 1\n3 2 3 "
           "4 "
           "5\n$EndElements\n";
}

std::string msh4_binary() {
    using I = std::int32_t;
    using S = std::uint64_t;
    Bytes out;
    out.text("$MeshFormat\n4.1 1 8\n").put<I>(1).text("\n$EndMeshFormat\n$Entities\n");
    out.put<S>(0, 0, 0, 2);
    out.put<I>(1).put<double>(0, 0, 0, 1, 1, 1).put<S>(1).put<I>(7).put<S>(0);
    out.put<I>(2).put<double>(0, 0, 0, 1, 1, 1).put<S>(1).put<I>(9).put<S>(1).put<I>(-1);
    out.text("\n$EndEntities\n$Nodes\n").put<S>(1, 6, 1, 6).put<I>(3, 1, 0).put<S>(6);
    out.put<S>(1, 2, 3, 4, 5, 6);
    for (const auto& node : kNodes) out.put<double>(node[0], node[1], node[2]);
    out.text("\n$EndNodes\n$Elements\n").put<S>(3, 3, 1, 3);
    out.put<I>(2, 1, 2).put<S>(1).put<S>(1, 1, 2, 3);
    out.put<I>(3, 1, 4).put<S>(1).put<S>(2, 1, 2, 3, 4);
    out.put<I>(3, 2, 4).put<S>(1).put<S>(3, 2, 3, 4, 5);
    return out.text("\n$EndElements\n").str();
}

std::string vtk_text() {
    return "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 float\n0 0 "
           "0 "
           "1 0 0 0 1 0\n0 0 1 1 1 1.5 9 9 9\nCELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 1 2 3 "
           "4\nCELL_TYPES "
           "3\n5 10 10\nPOINT_DATA 6\nVECTORS u float\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 "
           "0\nCELL_DATA 3\nSCALARS region int 1\nLOOKUP_TABLE default\n0 7 9\n";
}

std::string vtk_binary() {
    Bytes out(true);
    out.text(
        "# vtk DataFile Version 5.1\ntwo\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n");
    for (const auto& node : kNodes) out.put<double>(node[0], node[1], node[2]);
    out.text("\nCELLS 4 11\nOFFSETS vtktypeint64\n").put<std::int64_t>(0, 3, 7, 11);
    out.text("\nCONNECTIVITY vtktypeint64\n").put<std::int64_t>(0, 1, 2, 0, 1, 2, 3, 1, 2, 3, 4);
    out.text("\nCELL_TYPES 3\n").put<std::int32_t>(5, 10, 10);
    out.text("\nCELL_DATA 3\nFIELD FieldData 2\nheat 2 3 float\n").put<float>(1, 2, 3, 4, 5, 6);
    out.text("\nMETADATA\nINFORMATION 0\n\ntag 1 3 int\n").put<std::int32_t>(0, 7, 9);
    return out.text("\n").str();
}

/// Those arrays packed by zlib in parts of 64 bytes, header and parts each as base64; made by zlib of Python.
const std::vector<std::string> kPackedBlocks{
    "AwAAAEAAAAAQAAAAEgAAABQAAAAQAAAAeJxjYMAHPtjjlQbKAwAqXgJfeJxjYMAHPthjp39AaSUHAGhABSd4nGNgAAElBw"
    "YoDQAE"
    "KADF",
    "AgAAAEAAAAAYAAAAFgAAABAAAAA=eJxjYIAARijNxIAK0MWZ0cQBAWAAC3icY2KAAGYozQKlAQCYAAo=",
    "AQAAAEAAAAAYAAAAEAAAAA==eJxjZoAAdijNDaUBASgAFg==", "AQAAAEAAAAADAAAACwAAAA==eJxj5eICAAAwABo=",
    "AQAAAEAAAAAMAAAAEQAAAA==eJxjYGBgYAdiTiAGAABoABE="};

/// Arrays of the two tetrahedra as one block each: its length, then its numbers.
std::vector<std::string> vtu_blocks() {
    using I = std::int64_t;
    std::vector<std::string> out;
    const auto add = [&](const Bytes& data) {
        out.push_back(Bytes().put<std::uint32_t>(data.str().size()).str() + data.str());
    };
    Bytes points;
    for (const auto& node : kNodes) points.put<double>(node[0], node[1], node[2]);
    add(points);
    add(Bytes().put<I>(0, 1, 2, 0, 1, 2, 3, 1, 2, 3, 4));
    add(Bytes().put<I>(3, 7, 11));
    add(Bytes().put<std::uint8_t>(5, 10, 10));
    add(Bytes().put<std::int32_t>(0, 7, 9));
    return out;
}

enum class Form { kBase64, kAppendedRaw, kAppendedBase64, kPacked, kAppendedPacked };

std::string vtu(Form form, std::string compressor = "") {
    const char* const names[5] = {"Points", "connectivity", "offsets", "types", "material"};
    const char* const types[5] = {"Float64", "Int64", "Int64", "UInt8", "Int32"};
    std::string arrays[5], appended;
    const bool packed = form == Form::kPacked || form == Form::kAppendedPacked;
    const bool inside = form == Form::kBase64 || form == Form::kPacked;
    if (packed && compressor.empty()) compressor = " compressor=\"vtkZLibDataCompressor\"";
    std::vector<std::string> blocks = packed ? kPackedBlocks : vtu_blocks();
    for (std::size_t k = 0; k < 5; ++k) {
        if (!packed && form != Form::kAppendedRaw) blocks[k] = base64(blocks[k]);
        arrays[k] = std::string("<DataArray type=\"") + types[k] + "\" Name=\"" + names[k] + "\" ";
        if (inside) {
            arrays[k] += "format=\"binary\">\n  " + blocks[k] + "\n</DataArray>\n";
            continue;
        }
        arrays[k] += "format=\"appended\" offset=\"" + std::to_string(appended.size()) + "\"/>\n";
        appended += blocks[k];
    }
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
           "byte_order=\"LittleEndian\" header_type=\"UInt32\"" +
           compressor +
           ">\n<!-- by <hand> -->\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"6\" "
           "NumberOfCells=\"3\">\n<Points>\n" +
           arrays[0] + "</Points>\n<Cells>\n" + arrays[1] + arrays[2] + arrays[3] +
           "</Cells>\n<CellData Scalars='material'>\n" + arrays[4] +
           "</CellData>\n</Piece>\n</UnstructuredGrid>\n" +
           (inside ? ""
                   : "<AppendedData encoding=\"" +
                         std::string(form == Form::kAppendedRaw ? "raw" : "base64") + "\">\n_" +
                         appended + "\n</AppendedData>\n") +
           "</VTKFile>\n";
}

const std::string kMedit =
    "MeshVersionFormatted 2\nDimension 3 # of space\nVertices\n6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 "
    "0\n"
    "1 1 1.5 0\n9 9 9 0\nTriangles\n1\n1 2 3 3\nTetrahedra\n2\n1 2 3 4 7\n2 3 4 5 9\nEnd\n";

/// A binary file of Medit: versions differ in the sizes of reals, integers and places.
std::string meditb(int version, bool big = false) {
    Bytes out(big);
    const auto real = [&](double value) {
        version == 1 ? out.put<float>(value) : out.put<double>(value);
    };
    const auto integer = [&](int value) {
        version == 4 ? out.put<std::int64_t>(value) : out.put<std::int32_t>(value);
    };
    const auto section = [&](int number, std::size_t length) {
        out.put<std::int32_t>(number);
        const std::size_t next = out.str().size() + (version >= 3 ? 8 : 4) + length;
        version >= 3 ? out.put<std::int64_t>(next) : out.put<std::int32_t>(next);
    };
    const std::size_t i = version == 4 ? 8 : 4, r = version == 1 ? 4 : 8;
    out.put<std::int32_t>(1, version);
    section(3, 4);
    out.put<std::int32_t>(3);
    section(4, i + 6 * (3 * r + i));
    integer(6);
    for (const auto& node : kNodes) {
        for (const double value : node) real(value);
        integer(0);
    }
    section(6, 5 * i);  // a triangle
    for (const int value : {1, 1, 2, 3, 3}) integer(value);
    section(8, 11 * i);
    for (const int value : {2, 1, 2, 3, 4, 7, 2, 3, 4, 5, 9}) integer(value);
    out.put<std::int32_t>(54);
    version >= 3 ? out.put<std::int64_t>(0) : out.put<std::int32_t>(0);
    return out.str();
}

TEST_F(TetMeshes, AreTheSameInEveryFormat) {
    const TetMesh msh = read("a.msh", msh2_text());
    expect_the_two(msh);
    EXPECT_EQ(msh.names, (std::map<std::string, int>{{"left half", 7}}));
    expect_the_two(read("b.msh", msh2_binary()));
    expect_the_two(read("c.msh", msh4_text()));
    expect_the_two(read("d.msh", msh4_binary()));
    expect_the_two(read("a.vtk", vtk_text()));
    expect_the_two(read("b.vtk", vtk_binary()));
    expect_the_two(read("a.vtu", vtu(Form::kBase64)));
    expect_the_two(read("b.vtu", vtu(Form::kAppendedRaw)));
    expect_the_two(read("c.vtu", vtu(Form::kAppendedBase64)));
    expect_the_two(read("d.vtu", vtu(Form::kPacked)));
    expect_the_two(read("e.vtu", vtu(Form::kAppendedPacked)));
    expect_the_two(read("a.mesh", kMedit));
    for (const int version : {1, 2, 3, 4})
        for (const bool big : {false, true}) expect_the_two(read("a.meshb", meditb(version, big)));
    // TetGen counts from 0 or 1, and turns its corners the other way.
    std::ofstream(folder_ / "t.node")
        << "# by hand\n6 3 1 1\n0 0 0 0 5 1\n1 1 0 0 5 1\n2 0 1 0 5 1\n"
           "3 0 0 1 5 0\n4 1 1 1.5 5 0\n5 9 9 9 5 0\n";
    expect_the_two(read("t.ele", "2 4 1\n1 0 1 3 2 7\n2 1 2 4 3 9\n"));
    expect_the_two(read_tet_mesh(folder_ / "t.node"));
}

TEST_F(TetMeshes, OfOurOwnFilesForParaviewAreRead) {
    VtkMesh own;
    own.points.resize(5, 3);
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k < 3; ++k) own.points(i, k) = kNodes[i][k];
    for (const std::array<int, 4>& tet : {std::array{0, 1, 2, 3}, {1, 2, 3, 4}})
        own.add_cell(VtkCell::kTetra, tet);
    own.cell_data.push_back({"tag", 1, {7, 9}});
    for (const VtkEncoding encoding : {VtkEncoding::kAscii, VtkEncoding::kAppended})
        expect_the_two(read("own.vtu", vtu_bytes(own, encoding, 0)));
}

/// A field of directions behind a legacy file of VTK.
std::string with_field(const std::string& data) { return vtk_text() + data; }

TEST_F(TetMeshes, HaveTheFibresOfTheirFile) {
    EXPECT_EQ(read("a.vtk", vtk_text()).fibres.rows(), 0);
    // The file has three cells, of which the first is no tetrahedron.
    TetMesh mesh = read("b.vtk", with_field("VECTORS fibre double\n9 9 9\n1 2 3\n0 0 -2\n"));
    ASSERT_EQ(mesh.fibres.rows(), 2);
    EXPECT_EQ(mesh.fibres.row(0), Vec3(1, 2, 3).transpose());
    EXPECT_EQ(mesh.fibres.row(1), Vec3(0, 0, -2).transpose());
    mesh = read("c.vtk", with_field("POINT_DATA 6\nFIELD data 1\nfiber 3 6 double\n"
                                    "1 0 0\n-1 0 0\n1 0 0\n1 0 0\n-1 0 0\n5 5 5\n"));
    EXPECT_EQ(mesh.fibres.row(0), Vec3(4, 0, 0).transpose());
    EXPECT_EQ(mesh.fibres.row(1).cwiseAbs(), Vec3(4, 0, 0).transpose());
    EXPECT_EQ(complaint("d.vtk", with_field("POINT_DATA 4\nVECTORS fibre double\n"
                                            "1 0 0\n1 0 0\n1 0 0\n1 0 0\n")),
              "d.vtk: expected a fibre for each of 6 points, found 4");
    std::string text = vtu(Form::kBase64);
    text.insert(text.find("</CellData>"),
                "<DataArray type=\"Float64\" Name=\"fibres\" NumberOfComponents=\"3\" "
                "format=\"ascii\">9 9 9 1 2 3 0 0 -2</DataArray>\n");
    mesh = read("a.vtu", text);
    ASSERT_EQ(mesh.fibres.rows(), 2);
    EXPECT_EQ(mesh.fibres.row(1), Vec3(0, 0, -2).transpose());
}

/// Data of elements behind a file of Gmsh, for elements 3 and 2 and for the triangle 1.
std::string element_data(const std::string& name, const std::string& components = "3") {
    return "$ElementData\n1\n\"" + name + "\"\n1\n0.0\n3\n0\n" + components +
           "\n3\n3 0 0 -2\n1 9 9 9\n2 1 2 3\n$EndElementData\n";
}

TEST_F(TetMeshes, OfGmshHaveTheFibresOfTheirElementData) {
    for (const auto& [text, line] : {std::pair(msh2_text(), "48"), std::pair(msh4_text(), "58")}) {
        EXPECT_EQ(read("a.msh", text + element_data("pressure")).fibres.rows(), 0);
        const TetMesh mesh =
            read("b.msh", text + element_data("stress") + element_data("fibre_direction"));
        ASSERT_EQ(mesh.fibres.rows(), 2);
        EXPECT_EQ(mesh.fibres.row(0), Vec3(1, 2, 3).transpose());
        EXPECT_EQ(mesh.fibres.row(1), Vec3(0, 0, -2).transpose());
        EXPECT_EQ(complaint("c.msh", text + element_data("fibre") + element_data("fibres")),
                  std::string("c.msh:") + line + ": expected one field of fibres, found another");
    }
    for (const std::string& start : {msh2_binary(), msh4_binary()}) {
        Bytes out;
        out.text(start + "$ElementData\n1\n\"fibre\"\n1\n0\n3\n0\n3\n1\n");
        out.put<std::int32_t>(3).put<double>(0, 4, 0).text("\n$EndElementData\n");
        const TetMesh mesh = read("d.msh", out.str());
        ASSERT_EQ(mesh.fibres.rows(), 2);
        EXPECT_EQ(mesh.fibres.row(0), Vec3(0, 0, 0).transpose()) << "no direction in the file";
        EXPECT_EQ(mesh.fibres.row(1), Vec3(0, 4, 0).transpose());
    }
    EXPECT_EQ(complaint("e.msh", msh2_text() + "$ElementData\n1\nfibre\n1\n0\n3\n0\n3\n0\n"
                                               "$EndElementData\n"),
              "e.msh:30: expected a name in quotes, found fibre");
}

using Reader = TetMesh (*)(std::string_view, const std::string&);
struct Sample {
    Reader reader;
    std::string bytes;
};

std::vector<Sample> samples() {
    return {{detail::read_msh, msh2_text() + element_data("fibre")},
            {detail::read_msh, msh2_binary()},
            {detail::read_msh, msh4_text()},
            {detail::read_msh, msh4_binary()},
            {detail::read_legacy_vtk, vtk_text()},
            {detail::read_legacy_vtk, vtk_binary()},
            {detail::read_vtu, vtu(Form::kBase64)},
            {detail::read_vtu, vtu(Form::kAppendedRaw)},
            {detail::read_vtu, vtu(Form::kAppendedBase64)},
            {detail::read_vtu, vtu(Form::kPacked)},
            {detail::read_vtu, vtu(Form::kAppendedPacked)},
            {detail::read_meditb, meditb(2)},
            {detail::read_meditb, meditb(4, true)},
            {detail::read_medit, kMedit}};
}

// A file that ends too early is an error, unless only a part of its last word or nothing of the mesh is missing.
TEST(BrokenTetMeshes, ThatEndTooEarlyAreTold) {
    for (const Sample& sample : samples()) {
        std::size_t first = 0;  // length from which on nothing is missing
        for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
            const std::string text =
                message_of([&] { sample.reader(sample.bytes.substr(0, length), "cut"); });
            if (text == "no error" && first == 0) first = length;
        }
        EXPECT_TRUE(first == 0 || 2 * first > sample.bytes.size()) << sample.bytes.substr(0, first);
    }
}

// Every byte of a small file, replaced by some others: an error or a mesh, and never anything else.
TEST(BrokenTetMeshes, WithAnyByteChangedDoNotCrash) {
    int meshes = 0, errors = 0;
    for (const Sample& sample : samples())
        for (std::size_t at = 0; at < sample.bytes.size(); ++at)
            for (const char other : {'\0', '9', '\xff', '-'}) {
                std::string changed = sample.bytes;
                changed[at] = other;
                (message_of([&] { sample.reader(changed, "changed"); }) == "no error" ? meshes
                                                                                      : errors) +=
                    1;
            }
    EXPECT_GT(errors, 1000);
    EXPECT_GT(meshes, 100);
}

TEST_F(TetMeshes, OfNodesWithNamesAtEqualDistancesTakeNoLongerThanOthers) {
    // A prime number apart: their places in a table of hashes were the same, and the work grew with the square of the number.
    constexpr long long kCount = 600000, kStep = 712697;
    std::string nodes = std::to_string(kCount) + " 3 0 0\n";
    for (long long i = 0; i < kCount; ++i)
        nodes += std::to_string(i * kStep) + " " + std::to_string(i == 1) + " " +
                 std::to_string(i == 2) + " " + std::to_string(i == 3) + "\n";
    std::ofstream(folder_ / "far.node") << nodes;
    std::ofstream(folder_ / "far.ele") << "1 4 0\n1 0 712697 1425394 2138091\n";
    EXPECT_EQ(read_tet_mesh(folder_ / "far.node").positions.row(3), Eigen::RowVector3d(0, 0, 1));
}

TEST_F(TetMeshes, SayWhatIsWrongAndWhere) {
    const std::function<std::string(const std::string&)> msh = [&](const std::string& tets) {
        return complaint("a.msh", msh2_text(tets));
    };
    EXPECT_EQ(msh("2 4 2 7 1 1 2 3 4\n3 4 2 9 2 2 3 4 8\n"),
              "a.msh, tetrahedron 2: expected nodes of the file, found node 8");
    EXPECT_EQ(msh("2 4 2 7 1 1 2 3 4\n3 4 2 9 2 3 2 4 5\n"),
              "a.msh, tetrahedron 2: expected corners in the same order as those of the other "
              "tetrahedra, found an inverted tetrahedron");
    EXPECT_EQ(msh("2 4 2 7 1 1 2 3 4\n3 4 2 9 2 2 3 4 4\n"),
              "a.msh, tetrahedron 2: expected a tetrahedron with a volume, found a flat one");
    EXPECT_EQ(msh("2 4 2 7 1 1 2 3 4\n3 11 2 9 2 2 3 4 5 1 1 1 1 1 1\n"),
              "a.msh:25: expected linear tetrahedra with 4 nodes, found quadratic ones with 10");
    EXPECT_EQ(msh("2 2 2 7 1 1 2 3\n3 2 2 9 2 2 3 4\n"),
              "a.msh: expected tetrahedra with four nodes, found none");
    std::string text = msh2_text();
    EXPECT_EQ(complaint("a.msh", text.replace(text.find("1 1 1.5"), 7, "1 1 nan")),
              "a.msh:18: expected a number, a coordinate, found \"nan\"");
    text = msh2_text();
    EXPECT_EQ(complaint("a.msh", text.replace(text.find("$Nodes\n6"), 8, "$Nodes\n9000000")),
              "a.msh:13: expected as many bytes as 9000000 nodes take, found 138");
    text = msh2_text();
    EXPECT_EQ(complaint("a.msh", text.replace(text.find("2.2"), 3, "4.0")),
              "a.msh:2: expected version 2 or 4.1 of the format, found 4.0");
    EXPECT_EQ(complaint("a.vtu", vtu(Form::kBase64, " compressor=\"vtkLZ4DataCompressor\"")),
              "a.vtu:2: expected a file without compression, or with vtkZLibDataCompressor, found "
              "vtkLZ4DataCompressor");
    text = vtu(Form::kPacked);
    EXPECT_EQ(
        complaint("a.vtu", text.replace(text.find(kPackedBlocks[3]) + 30, 1, "X")),
        "a.vtu:18: expected a block of zlib with 3 bytes, found more bytes than it should hold");
    text = vtu(Form::kPacked);
    EXPECT_EQ(complaint("a.vtu", text.replace(text.find("NumberOfCells=\"") + 15, 1, "900000")),
              "a.vtu:5: expected NumberOfCells, an integer in [0, 521], found \"900000\"");
    text = vtu(Form::kAppendedRaw);
    const std::size_t array = text.find("<DataArray");
    EXPECT_EQ(complaint("a.vtu",
                        text.insert(array, text.substr(array, text.find('>', array) + 1 - array))),
              "a.vtu:7: expected one array of points, found another one");
    text = meditb(2);
    EXPECT_EQ(complaint("a.meshb", text.replace(12, 4, std::string("\2\0\0\0", 4))),
              "a.meshb: expected a next section behind the one before, found place 2");
    EXPECT_EQ(complaint("a.stl", ""),
              "a.stl: expected an ending of .msh, .vtk, .vtu, .mesh, .meshb, .node or .ele, found "
              "\".stl\"");
    std::ofstream(folder_ / "lone.node") << "0 3 0 0\n";
    EXPECT_EQ(message_of([&] { read_tet_mesh(folder_ / "lone.node"); }),
              (folder_ / "lone.ele").string() + ": expected a mesh file, found no such file");
}

}  // namespace
}  // namespace risorius::io
