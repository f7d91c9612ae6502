#include "io/read_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <sstream>

#include "core/error.h"

namespace risorius::io {
namespace {

namespace fs = std::filesystem;
const fs::path kHeads = fs::path(RISORIUS_SHARED_DIR) / "data" / "heads";

fs::path scratch(const std::string& name) {
    const fs::path folder = fs::path(testing::TempDir()) / "risorius_io";
    fs::create_directories(folder);
    return folder / name;
}

/// The "v" lines of an OBJ, read in the plainest way there is.
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
    if (!fs::exists(file)) GTEST_SKIP();
    expect_file_order(file, 26719, 26384);
}

TEST(ReadMesh, KeepsTheVertexOrderOfTheMakeHumanObj) {
    const fs::path file = kHeads / "makehuman" / "mh_head.obj";
    if (!fs::exists(file)) GTEST_SKIP();
    expect_file_order(file, 6082, 5906);
}

TEST(ReadMesh, KeepsTheSeventeenRegionsOfTheIctHead) {
    const fs::path file = kHeads / "ict" / "ict_neutral.obj";
    if (!fs::exists(file)) GTEST_SKIP();
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
        // A region may use seam vertices of another, but every vertex of its own range is used by
        // it.
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
    if (!fs::exists(file)) GTEST_SKIP();
    const auto start = std::chrono::steady_clock::now();
    const geom::PolygonMesh mesh = read_mesh(file);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    RecordProperty("seconds", std::to_string(seconds));
    EXPECT_LT(seconds, 1.0);
    EXPECT_EQ(mesh.corner_texcoord.rows(), static_cast<long>(mesh.corner_vertex.size()));
}

}  // namespace
}  // namespace risorius::io
