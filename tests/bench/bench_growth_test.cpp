// SPDX-License-Identifier: MIT
// How cost grows with work.
#include "tools/bench/bench_growth.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "risorius/core/error.h"
#include "scene/adult_of_bundles.h"
#include "temporary_folder.h"

namespace risorius::bench {
namespace {

/// The sum of the areas of all polygons, as fans.
double area_of(const geom::PolygonMesh& mesh) {
    double area = 0;
    const Triangles triangles = geom::triangulate(mesh);
    for (long t = 0; t < triangles.rows(); ++t) {
        const auto at = [&](int k) -> Vec3 {
            return mesh.positions.row(triangles(t, k)).transpose();
        };
        area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
    }
    return area;
}

/// A square and a triangle that share an edge, in two groups.
geom::PolygonMesh house() {
    geom::PolygonMesh mesh;
    mesh.positions.resize(5, 3);
    mesh.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 2, 0;
    mesh.face_begin = {0, 4, 7};
    mesh.corner_vertex = {0, 1, 2, 3, 3, 2, 4};
    mesh.corner_texcoord.resize(7, 2);
    mesh.corner_texcoord << 0, 0, 1, 0, 1, 1, 0, 1, 0, 1, 1, 1, 0.5, 0.75;
    mesh.face_group = {0, 1};
    mesh.group_names = {"wall", "roof"};
    return mesh;
}

TEST(FinerMesh, DividesEachPolygonAndKeepsTheSurface) {
    const geom::PolygonMesh mesh = house(), finer = finer_mesh(mesh);
    // Euler: each vertex, edge and face is a vertex now; an edge that two faces share has one middle.
    EXPECT_EQ(finer.vertex_count(), 5 + 6 + 2);
    EXPECT_EQ(finer.face_count(), 4 + 3);
    EXPECT_TRUE(finer.positions.topRows(5).isApprox(mesh.positions, 0));
    EXPECT_NEAR(area_of(finer), area_of(mesh), 1e-12);
    EXPECT_EQ(finer.face_group, (std::vector<int>{0, 0, 0, 0, 1, 1, 1}));
    // Texture coordinates are linear in the place here, and stay so.
    for (int face = 0; face < 4; ++face)
        for (int k = 0; k < 4; ++k) {
            const int corner = 4 * face + k;
            EXPECT_TRUE(finer.corner_texcoord.row(corner).isApprox(
                finer.positions.row(finer.corner_vertex[static_cast<std::size_t>(corner)])
                    .leftCols<2>(),
                1e-12));
        }
}

TEST(CostApart, TellsTheMemoryOfItsWorkAlone) {
    constexpr std::size_t kBytes = 200'000'000;
    const Cost small = cost_apart([] { return Measured{0.25, 7}; });
    const Cost large = cost_apart([] {
        std::vector<char> memory(kBytes, 1);
        return Measured{memory[kBytes / 2] == 1 ? 0.5 : 0.0, 0};
    });
    EXPECT_EQ(small.measured.seconds, 0.25);
    EXPECT_EQ(small.measured.size, 7);
    EXPECT_EQ(large.measured.seconds, 0.5);
    EXPECT_NEAR(large.megabytes - small.megabytes, kBytes / 1048576.0, 20);
}

TEST(CostApart, HandsOnWhatWentWrong) {
    const auto says = [](const std::function<Measured()>& work) -> std::string {
        try {
            cost_apart(work);
        } catch (const RunError& error) {
            return error.what();
        }
        return "nothing";
    };
    EXPECT_EQ(says([]() -> Measured { throw Error("bench", "a face", "none"); }),
              "bench: expected a face, found none");
    EXPECT_EQ(says([]() -> Measured { ::_exit(3); }), "the process that measures ended by itself");
}

TEST(BenchGrowth, HasACaseForEachSizeAndTheExponentsBetweenThem) {
    const TemporaryFolder folder;
    const Json growth = bench_growth(scene::adult_of_bundles(), folder.path(),
                                     {.skin_vertices = {400},
                                      .refinements = {},
                                      .frames = {},
                                      .planned_clips = {10, 400},
                                      .rendered_clips = {},
                                      .threads = {1, 2}});
    ASSERT_EQ(growth.size(), 4U);
    EXPECT_EQ(growth[0]["series"], "a time step");
    EXPECT_TRUE(growth[0]["exponents"].empty());
    EXPECT_NEAR(growth[0]["cases"][0]["size"].get<double>(), 1200, 60);  // three nodes a vertex
    const Json& planning = growth[2];
    EXPECT_EQ(planning["series"], "planning a set");
    ASSERT_EQ(planning["cases"].size(), 2U);
    EXPECT_EQ(planning["cases"][1]["size"], 400);
    EXPECT_GT(planning["cases"][0]["megabytes"], 1);
    const double ratio = planning["cases"][1]["seconds"].get<double>() /
                         planning["cases"][0]["seconds"].get<double>();
    EXPECT_NEAR(std::pow(40, planning["exponents"][0].get<double>()), ratio, 1e-9 * ratio);
    draw_growth(growth, folder.path());
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "growth.svg"));
}

}  // namespace
}  // namespace risorius::bench
