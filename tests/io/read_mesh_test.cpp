// SPDX-License-Identifier: MIT
#include "risorius/io/read_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <sstream>

#include "paths.h"
#include "risorius/core/error.h"
#include "risorius/geom/mesh_checks.h"
#include "risorius/io/detail/obj_reader.h"

namespace risorius::io {
namespace {

namespace fs = std::filesystem;
const fs::path kHeads = fs::path(RISORIUS_SHARED_DIR) / "data" / "heads";

geom::PolygonMesh read_text(const std::string& text) { return detail::read_obj(text, "text.obj"); }

std::string complaint(const std::string& text) {
    try {
        read_text(text);
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing";
}

/// Reads the "v" lines of an OBJ in the simplest way.
std::vector<std::array<double, 3>> vertex_lines(const fs::path& file) {
    std::ifstream in(file);
    std::vector<std::array<double, 3>> out;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string key;
        words >> key;
        if (key != "v") continue;
        std::array<double, 3> p{};
        words >> p[0] >> p[1] >> p[2];
        out.push_back(p);
    }
    return out;
}

void expect_file_order(const fs::path& file, int vertices, int faces) {
    const geom::PolygonMesh mesh = read_mesh(file, {.metres_per_unit = 1.0});
    const auto lines = vertex_lines(file);
    ASSERT_EQ(mesh.vertex_count(), vertices);
    ASSERT_EQ(static_cast<int>(lines.size()), vertices);
    EXPECT_EQ(mesh.face_count(), faces);
    for (int v = 0; v < vertices; ++v)
        for (int k = 0; k < 3; ++k) ASSERT_EQ(mesh.positions(v, k), lines[v][k]) << "vertex " << v;
}

TEST(ReadMesh, KeepsTheVertexOrderOfTheIctObj) {
    const fs::path file = kHeads / "ict" / "ict_neutral.obj";
    if (!fs::exists(file)) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    expect_file_order(file, 26719, 26384);
}

TEST(ReadMesh, KeepsTheVertexOrderOfTheMakeHumanObj) {
    const fs::path file = kHeads / "makehuman" / "mh_head.obj";
    if (!fs::exists(file)) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    expect_file_order(file, 6082, 5906);
}

TEST(ReadMesh, KeepsTheSeventeenRegionsOfTheIctHead) {
    const fs::path file = kHeads / "ict" / "ict_neutral.obj";
    if (!fs::exists(file)) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const geom::PolygonMesh mesh = read_mesh(file, {.metres_per_unit = 0.01});
    ASSERT_EQ(mesh.group_names.size(), 17u);

    std::ifstream table(kHeads / "ict" / "ict_regions.csv");
    std::string line;
    std::getline(table, line);
    int regions = 0;
    while (std::getline(table, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream words(line);
        std::string name;
        int v_first = 0, v_last = 0, f_first = 0, f_last = 0;
        words >> name >> v_first >> v_last >> f_first >> f_last;
        EXPECT_EQ(mesh.group_names[regions], name);
        // A region may use seam vertices of another one, but it uses every vertex of its own range.
        std::vector<bool> used(mesh.vertex_count(), false);
        for (int f = 0; f < mesh.face_count(); ++f) {
            ASSERT_EQ(mesh.face_group[f] == regions, f >= f_first && f <= f_last) << "face " << f;
            if (mesh.face_group[f] != regions) continue;
            for (int c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
                used[mesh.corner_vertex[c]] = true;
        }
        for (int v = v_first; v <= v_last; ++v) EXPECT_TRUE(used[v]) << name << ", vertex " << v;
        ++regions;
    }
    EXPECT_EQ(regions, 17);
}

TEST(ReadMesh, ReadsTheIctHeadWellUnderASecond) {
    const fs::path file = kHeads / "ict" / "ict_neutral.obj";
    if (!fs::exists(file)) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const auto start = std::chrono::steady_clock::now();
    const geom::PolygonMesh mesh = read_mesh(file);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    RecordProperty("seconds", std::to_string(seconds));
    EXPECT_LT(seconds, 1.0);
    EXPECT_EQ(mesh.corner_texcoord.rows(), static_cast<long>(mesh.corner_vertex.size()));
}

TEST(ReadMesh, TheSkinOfEachHeadPassesTheChecks) {
    if (!fs::exists(kHeads)) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    const auto check = [](const fs::path& file, const std::vector<std::string>& groups) {
        const geom::PolygonMesh mesh = read_mesh(file, {.metres_per_unit = 0.01});
        geom::MeshCheckOptions options{.metres_per_unit = 0.01};
        for (const std::string& group : groups) options.groups.push_back(mesh.group_index(group));
        return geom::check_mesh(mesh, file.string(), options);
    };
    const geom::MeshReport ict =
        check(kHeads / "ict" / "ict_neutral.obj",
              {"face", "head_neck", "mouth_socket", "eye_socket_l", "eye_socket_r"});
    EXPECT_TRUE(ict.findings.empty());
    EXPECT_EQ(ict.piece_face_count, (std::vector<int>{14034}));
    EXPECT_EQ(ict.boundary_loop_count, 1);  // the neck
    const geom::MeshReport makehuman = check(kHeads / "makehuman" / "mh_head.obj", {"skin"});
    EXPECT_TRUE(makehuman.findings.empty());
    EXPECT_EQ(makehuman.boundary_loop_count, 1);
    // The same skin, cut along its texture seams: notes but no errors.
    const geom::MeshReport glb = check(kHeads / "makehuman" / "mh_head.glb", {"skin"});
    EXPECT_EQ(glb.piece_face_count.size(), 5u);
    for (const geom::MeshFinding& finding : glb.findings)
        EXPECT_EQ(finding.severity, geom::Severity::kNote);
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ReadObj, UnderstandsEveryWayToWriteACorner) {
    const std::string texcoords = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n";
    for (const std::string face :
         {"f 1 2 3 4", "f 1/1 2/2 3/3 4/4", "f 1//1 2//1 3//1 4//1", "f 1/1/1 2/2/1 3/3/1 4/4/1",
          "f -4 -3 -2 -1", "f 1 2 \\\n 3 4", "f 1 2 3 4\r"}) {
        const geom::PolygonMesh mesh = read_text(kSquare + texcoords + face + "\n");
        EXPECT_EQ(mesh.corner_vertex, (std::vector<int>{0, 1, 2, 3})) << face;
    }
    const geom::PolygonMesh mesh = read_text(kSquare + texcoords + "f 1/4 2/3 3/2 4/1\n");
    EXPECT_EQ(mesh.corner_texcoord(0, 1), 1.0);
    EXPECT_EQ(mesh.corner_texcoord(3, 0), 0.0);
}

TEST(ReadObj, GroupsAreObjectsOrMaterialsWhereThereAreNoGroups) {
    const std::string face = "f 1 2 3 4\n";
    using Names = std::vector<std::string>;
    EXPECT_EQ(read_text(kSquare + face).group_names, Names{"default"});
    EXPECT_EQ(read_text(kSquare + "o head\nusemtl skin\n" + face).group_names, Names{"head"});
    EXPECT_EQ(read_text(kSquare + "usemtl skin\n" + face + "usemtl lips\n" + face).group_names,
              (Names{"skin", "lips"}));
    const geom::PolygonMesh again =
        read_text(kSquare + "g a b\n" + face + "g c\n" + face + "g a b\n" + face);
    EXPECT_EQ(again.group_names, (Names{"a b", "c"}));
    EXPECT_EQ(again.face_group, (std::vector<int>{0, 1, 0}));
    EXPECT_EQ(read_text(kSquare + "o nothing\ng face\n" + face).group_names, Names{"face"});
}

TEST(ReadObj, AFaceMayComeBeforeItsVertices) {
    EXPECT_EQ(read_text("f 1 2 3 4\n" + kSquare).corner_vertex, (std::vector<int>{0, 1, 2, 3}));
}

TEST(ReadObj, NamesTheLineOfAMistake) {
    EXPECT_EQ(complaint("v 0 0\n"), "text.obj:1: expected three coordinates after \"v\", found 2");
    EXPECT_EQ(complaint(kSquare + "f 1\n"),
              "text.obj:5: expected a face of at least three corners, found 1");
    EXPECT_EQ(complaint("v 0,5 0 0\n"),
              "text.obj:1: expected a number with a point before its decimals, found \"0,5\"");
    EXPECT_EQ(complaint(kSquare + "f 1 2 x\n"),
              "text.obj:5: expected a face corner v, v/vt, v//vn or v/vt/vn, found \"x\"");
    EXPECT_EQ(complaint(kSquare + "f 1 2 -5\n"),
              "text.obj:5: expected the index of a vertex (from 1, or back from -1), found -5");
    EXPECT_EQ(complaint(kSquare + "f 1/1 2/1 3/1\n"),
              "text.obj:5: expected a texture coordinate index of at most 0, found 1");
    EXPECT_EQ(complaint("v 0 0 1e999\n"),
              "text.obj:1: expected a number that a double can hold, found \"1e999\"");
}

TEST(ReadObj, ACommentEndsWithItsLine) {
    // A backslash at its end does not swallow the vertex after it.
    const geom::PolygonMesh mesh =
        read_text("# from C:\\scans\\\n" + kSquare + "f 1 2 3 4 # C:\\\n");
    EXPECT_EQ(mesh.vertex_count(), 4);
    EXPECT_EQ(mesh.corner_vertex, (std::vector<int>{0, 1, 2, 3}));
    EXPECT_EQ(read_text(kSquare + "g a #1\nf 1 2 3\n").group_names[0], "a #1");
}

TEST(ReadObj, LinesMayEndInAnyWay) {
    for (const std::string end : {"\n", "\r", "\r\n"}) {
        std::string text = kSquare + "f 1 2 \\\n3 4\n";
        for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
            text.replace(at, 1, end);
        EXPECT_EQ(read_text(text).corner_vertex, (std::vector<int>{0, 1, 2, 3})) << text;
    }
}

TEST(ReadObj, AFaceOfTwoCornersIsAnEdgeAndIsLeftOutWithANote) {
    const geom::PolygonMesh mesh = read_text(kSquare + "f 1 2\nf 1 2 3\nf 3 4\n");
    EXPECT_EQ(mesh.face_count(), 1);
    EXPECT_EQ(mesh.corner_vertex, (std::vector<int>{0, 1, 2}));
    ASSERT_EQ(mesh.notes.size(), 1u);
    EXPECT_EQ(mesh.notes[0], "text.obj:5: 2 faces of two corners are edges, left out");
}

TEST(ReadObj, SignsOfPlusAreNumbersToo) {
    EXPECT_EQ(read_text("v +0 0 0\nv +1e0 0 0\nv 1 +1 0\nf +1 +2 +3\n").corner_vertex,
              (std::vector<int>{0, 1, 2}));
}

TEST(ReadObj, ALibraryNamedOftenIsReadOnce) {
    std::string text;
    for (int i = 0; i < 50000; ++i) text += "mtllib a.mtl\n";
    detail::ObjMaterials materials;
    detail::read_obj(text + kSquare + "f 1 2 3\n", "text.obj", &materials);
    EXPECT_EQ(materials.libraries, (std::vector<std::string>{"a.mtl"}));
}

}  // namespace
}  // namespace risorius::io
