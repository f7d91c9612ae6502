// SPDX-License-Identifier: MIT
// Lips of scans are told from lips that part, and cut into two with a mouth behind.
#include "risorius/rig/cut_lips.h"

#include <gtest/gtest.h>

#include <array>

#include "rig/head_variants.h"
#include "risorius/geom/surface_topology.h"

namespace risorius::rig {
namespace {

struct Scan {
    geom::PolygonMesh mesh;
    RigDescription rig;
    Head head;
    Scan(int rows, int columns)
        : mesh(scan_of(adult_placed(), adult().mesh, rows, columns)),
          rig(rig_of_scan(adult().rig, adult_placed(), required_landmarks())),
          head(place_head(rig, mesh, "scan")) {}
};
const Scan& scan() {
    static const Scan one(90, 120);
    return one;
}
const CutLips& lips() {
    static const CutLips cut = cut_lips(scan().mesh, scan().head, {0}, "scan");
    return cut;
}
/// Of the cut mesh, in the frame of the scan's head.
Vec3 place_of(int vertex) {
    return scan().head.frame.to_head(Vec3(lips().mesh.positions.row(vertex).transpose()));
}

TEST(CutLips, TellsLipsThatPartFromLipsThatAreGrownTogether) {
    EXPECT_FALSE(lips_are_closed(adult_placed()));
    EXPECT_TRUE(lips_are_closed(scan().head));
    for (const auto& head : {ict_head(), makehuman_head()})
        if (head) {
            EXPECT_FALSE(lips_are_closed(place_head(head->rig, head->mesh, "head")));
        }
    RigDescription rig = scan().rig;
    rig.parts["mouth"] = {kLiningGroup};
    EXPECT_FALSE(lips_are_closed(place_head(rig, lips().mesh, "cut")));
}

TEST(CutLips, RunsFromCornerToCornerBetweenTheLips) {
    const Head& head = scan().head;
    EXPECT_LT((lips().seam.front() - head.landmark("ch_r")).norm(), head.mm(5));
    EXPECT_LT((lips().seam.back() - head.landmark("ch_l")).norm(), head.mm(5));
    for (std::size_t i = 0; i + 1 < lips().seam.size(); ++i)
        EXPECT_GT(lips().seam[i + 1].x(), lips().seam[i].x());
    // As deep as the furrow is: the lips stand out above and below
    const Vec3 middle = place_of(lips().upper[static_cast<std::size_t>(lips().middle)]);
    EXPECT_LT((middle - head.landmark("sto")).norm(), head.mm(3));
    EXPECT_LT(middle.z(), head.landmark("ls").z());
    EXPECT_LT(middle.z(), head.landmark("li").z());
}

TEST(CutLips, KeepsEveryVertexAndTheSurfaceSoundButForTheGap) {
    const geom::PolygonMesh& mesh = lips().mesh;
    ASSERT_GT(mesh.vertex_count(), scan().mesh.vertex_count());
    EXPECT_LT((mesh.positions.topRows(scan().mesh.vertex_count()) - scan().mesh.positions)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9);
    // Skin alone has one hole more; with the lining it has none more, and every edge two faces that agree
    const auto holes = [](const Triangles& triangles) {
        const geom::SurfaceEdges edges = geom::surface_edges(triangles);
        for (int e = 0; e < edges.count(); ++e) EXPECT_LE(edges.triangle_count(e), 2);
        return geom::boundary_loops(triangles, edges).size();
    };
    const std::size_t before = holes(geom::triangulate(scan().mesh));
    EXPECT_EQ(holes(geom::triangulate(mesh, {0})), before + 1);
    const Triangles whole = geom::triangulate(mesh);
    EXPECT_EQ(holes(whole), before);
    std::set<std::pair<int, int>> directed;
    for (long f = 0; f < whole.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            EXPECT_TRUE(directed.insert({whole(f, k), whole(f, (k + 1) % 3)}).second)
                << "two faces run along one edge the same way";
}

TEST(CutLips, LeavesPicturesWhereTheyWere) {
    geom::PolygonMesh painted = scan().mesh;
    // Coordinates that tell the place of a corner, and another picture on each side of the face
    const auto coordinates_of = [&](int vertex) {
        const Vec3 p = painted.positions.row(vertex).transpose();
        return Vec2(p.x() + 0.1 * p.z(), p.y() - 0.3 * p.z());
    };
    painted.corner_texcoord.resize(static_cast<long>(painted.corner_vertex.size()), 2);
    for (std::size_t c = 0; c < painted.corner_vertex.size(); ++c)
        painted.corner_texcoord.row(static_cast<long>(c)) =
            coordinates_of(painted.corner_vertex[c]).transpose();
    painted.textures = {{"left.png", "here", {}}, {"right.png", "here", {}}};
    for (int f = 0; f < painted.face_count(); ++f)
        painted.face_texture.push_back(
            painted.positions(painted.corner_vertex[static_cast<std::size_t>(
                                  painted.face_begin[static_cast<std::size_t>(f)])],
                              0) > 0
                ? 0
                : 1);
    const geom::PolygonMesh before = painted;
    painted = cut_lips(before, scan().head, {0}, "scan").mesh;
    ASSERT_EQ(painted.textures.size(), 2U);
    EXPECT_EQ(painted.textures[1].file, "right.png");
    ASSERT_EQ(painted.face_texture.size(), static_cast<std::size_t>(painted.face_count()));
    double farthest = 0;
    std::array<int, 2> skin_faces{};
    for (int f = 0; f < painted.face_count(); ++f) {
        const int texture = painted.face_texture[static_cast<std::size_t>(f)];
        if (painted.face_group[static_cast<std::size_t>(f)] != 0) {
            EXPECT_EQ(texture, -1) << "the lining has no picture";
            continue;
        }
        ASSERT_TRUE(texture == 0 || texture == 1);
        ++skin_faces[static_cast<std::size_t>(texture)];
        for (int c = painted.face_begin[static_cast<std::size_t>(f)];
             c < painted.face_begin[static_cast<std::size_t>(f) + 1]; ++c)
            farthest = std::max(farthest,
                                (Vec2(painted.corner_texcoord.row(c).transpose()) -
                                 coordinates_of(painted.corner_vertex[static_cast<std::size_t>(c)]))
                                    .norm());
    }
    EXPECT_LT(farthest, 1e-9);
    EXPECT_GT(skin_faces[0], 1000);
    EXPECT_GT(skin_faces[1], 1000);
}

TEST(CutLips, UpperAndLowerLipMeetAndTheLiningLiesBehind) {
    ASSERT_EQ(lips().upper.size(), lips().lower.size());
    for (std::size_t i = 0; i < lips().upper.size(); ++i) {
        EXPECT_NE(lips().upper[i], lips().lower[i]);
        EXPECT_EQ((place_of(lips().upper[i]) - place_of(lips().lower[i])).norm(), 0);
    }
    const Triangles lining = geom::triangulate(lips().mesh, {1});
    double deepest = 1e9;
    for (long f = 0; f < lining.rows(); ++f)
        for (int k = 0; k < 3; ++k) deepest = std::min(deepest, place_of(lining(f, k)).z());
    EXPECT_LT(deepest, scan().head.landmark("sto").z() - scan().head.mm(25));
}

TEST(CutLips, CutsCoarseScansToo) {
    const Scan coarse(28, 36);
    EXPECT_TRUE(lips_are_closed(coarse.head));
    const CutLips cut = cut_lips(coarse.mesh, coarse.head, {0}, "scan");
    EXPECT_GE(cut.upper.size(), 4u);
    EXPECT_LT((cut.seam.front() - coarse.head.landmark("ch_r")).norm(), coarse.head.mm(12));
}

TEST(CutLips, WhatAScannerSawBetweenTheLipsIsLaidBackOntoThem) {
    geom::PolygonMesh mesh = scan().mesh;
    const Head& head = scan().head;
    int between = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if ((head.vertices.row(v).transpose() - head.landmark("sto")).norm() <
            (head.vertices.row(between).transpose() - head.landmark("sto")).norm())
            between = v;
    mesh.positions(between, 2) -= head.mm(60);
    const Head spiked = place_head(scan().rig, mesh, "scan");
    const CutLips cut = cut_lips(mesh, spiked, {0}, "scan");
    EXPECT_EQ(cut.laid_back, 1);
    EXPECT_GT(cut.mesh.positions(between, 2), scan().mesh.positions(between, 2) - head.mm(3));
    EXPECT_EQ(lips().laid_back, 0);
}

TEST(CutLips, RefusesAHeadWithoutSkinBetweenTheCorners) {
    try {
        cut_lips(adult().mesh, adult_placed(), {}, "head.obj");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "head.obj: expected skin between the corners of the mouth that can be cut "
                     "along the lips, found a "
                     "cut over 0 of 51 mm");
    }
}

}  // namespace
}  // namespace risorius::rig
