// SPDX-License-Identifier: MIT
#include "risorius/geom/mesh_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "geom/test_surfaces.h"
#include "risorius/core/error.h"

namespace risorius::geom {
namespace {

PolygonMesh polygon_mesh(const testing::Surface& surface) {
    PolygonMesh mesh;
    mesh.positions = surface.positions;
    mesh.group_names = {"skin"};
    for (int t = 0; t < surface.triangles.rows(); ++t) {
        for (int k = 0; k < 3; ++k) mesh.corner_vertex.push_back(surface.triangles(t, k));
        mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
        mesh.face_group.push_back(0);
    }
    return mesh;
}

PolygonMesh ball() { return polygon_mesh(testing::sphere(10, 14, 0.1)); }

/// Adds a second surface beside the first, in its own group.
void append(PolygonMesh& mesh, const PolygonMesh& other, const std::string& group) {
    const int shift = mesh.vertex_count();
    Points positions(mesh.positions.rows() + other.positions.rows(), 3);
    positions << mesh.positions, other.positions;
    mesh.positions = positions;
    mesh.group_names.push_back(group);
    for (int f = 0; f < other.face_count(); ++f) {
        for (int c = other.face_begin[f]; c < other.face_begin[f + 1]; ++c)
            mesh.corner_vertex.push_back(other.corner_vertex[c] + shift);
        mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
        mesh.face_group.push_back(static_cast<int>(mesh.group_names.size()) - 1);
    }
}

std::vector<std::string> messages(const MeshReport& report, MeshCheck check) {
    std::vector<std::string> out;
    for (const MeshFinding& finding : report.findings)
        if (finding.check == check) out.push_back(finding.message());
    return out;
}

TEST(MeshChecks, ASoundBallHasNoFindings) {
    const MeshReport report = check_mesh(ball(), "ball");
    EXPECT_TRUE(report.findings.empty());
    EXPECT_EQ(report.boundary_loop_count, 0);
    EXPECT_EQ(report.piece_face_count, (std::vector<int>{252}));
    EXPECT_NEAR(report.high(2) - report.low(2), 0.2, 1e-15);
}

TEST(MeshChecks, AnOpenHeadIsFine) {
    PolygonMesh mesh = ball();
    // Without the cap at the bottom, as at a neck.
    mesh.face_begin.resize(mesh.face_begin.size() - 14);
    mesh.corner_vertex.resize(static_cast<std::size_t>(mesh.face_begin.back()));
    mesh.face_group.resize(static_cast<std::size_t>(mesh.face_count()));
    const MeshReport report = check_mesh(mesh, "head");
    EXPECT_EQ(report.boundary_loop_count, 1);
    // The only finding is the pole that has lost its faces.
    ASSERT_EQ(report.findings.size(), 1u);
    EXPECT_EQ(report.findings[0].message(),
              "head:vertex 127: expected a face that uses it, found none (at (0, 0, -0.1) m)");
}

TEST(MeshChecks, AnIndexOutsideTheVerticesEndsTheCheck) {
    PolygonMesh mesh = ball();
    mesh.corner_vertex[3 * 7] = -1;
    mesh.corner_vertex[3 * 9 + 1] = 128;
    const auto found = messages(inspect_mesh(mesh, "ball"), MeshCheck::kIndexRange);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0], "ball:face 7: expected vertices in 0 .. 127, found -1; 2 such faces");
    EXPECT_EQ(found[1], "ball:face 9: expected vertices in 0 .. 127, found 128");
    EXPECT_THROW(check_mesh(mesh, "ball"), Error);
}

TEST(MeshChecks, EveryVertexThatIsNotFiniteIsCounted) {
    PolygonMesh mesh = ball();
    for (int v = 20; v < 30; ++v) mesh.positions(v, 1) = std::numeric_limits<double>::quiet_NaN();
    const auto found =
        messages(inspect_mesh(mesh, "ball", {.findings_per_check = 3}), MeshCheck::kNonFinite);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_NE(found[0].find("ball:vertex 20: expected a finite position, found ("),
              std::string::npos);
    EXPECT_NE(found[0].find("; 10 such vertices"), std::string::npos);
}

TEST(MeshChecks, AnEdgeOfManyFacesNamesTheFirstOnes) {
    constexpr int kFaces = 5000;
    PolygonMesh mesh;
    mesh.group_names = {"skin"};
    mesh.positions = Points::Random(kFaces + 2, 3) * 0.1;
    for (int f = 0; f < kFaces; ++f) {
        mesh.corner_vertex.insert(mesh.corner_vertex.end(), {0, 1, f + 2});
        mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
        mesh.face_group.push_back(0);
    }
    const auto found = messages(inspect_mesh(mesh, "fans", {}), MeshCheck::kNonManifoldEdge);
    ASSERT_FALSE(found.empty());
    EXPECT_NE(found[0].find("found 5000, faces 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 ... (group"),
              std::string::npos)
        << found[0];
    EXPECT_LT(found[0].size(), 300u);
}

TEST(MeshChecks, AFlippedFaceIsFoundAtEachOfItsSides) {
    PolygonMesh mesh = ball();
    std::swap(mesh.corner_vertex[3 * 100], mesh.corner_vertex[3 * 100 + 1]);
    const auto found = messages(inspect_mesh(mesh, "ball"), MeshCheck::kWinding);
    ASSERT_EQ(found.size(), 3u);
    for (const std::string& message : found)
        EXPECT_NE(message.find("100"), std::string::npos) << message;
}

TEST(MeshChecks, ABallTurnedInsideOutIsFoundWhereverItStands) {
    PolygonMesh mesh = ball();
    mesh.positions.rowwise() += Eigen::RowVector3d(3, -5, 2);
    EXPECT_TRUE(inspect_mesh(mesh, "ball").findings.empty());
    for (int f = 0; f < mesh.face_count(); ++f)
        std::swap(mesh.corner_vertex[mesh.face_begin[f]],
                  mesh.corner_vertex[mesh.face_begin[f] + 1]);
    EXPECT_EQ(messages(inspect_mesh(mesh, "ball"), MeshCheck::kInsideOut).size(), 1u);
}

TEST(MeshChecks, AnEyeballInsideOutIsFoundWithinASoundHead) {
    PolygonMesh mesh = ball();
    PolygonMesh eye = polygon_mesh(testing::sphere(6, 8, 0.012));
    for (int f = 0; f < eye.face_count(); ++f)
        std::swap(eye.corner_vertex[eye.face_begin[f]], eye.corner_vertex[eye.face_begin[f] + 1]);
    append(mesh, eye, "eye");
    const MeshReport report = inspect_mesh(mesh, "head");
    const auto found = messages(report, MeshCheck::kInsideOut);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].substr(0, 57), "head:face 252: expected a closed piece facing outwards, f");
    EXPECT_NE(found[0].find("group eye"), std::string::npos);
    EXPECT_EQ(
        messages(report, MeshCheck::kPieces),
        (std::vector<std::string>{"head: expected one piece, found 2 pieces of 252, 80 faces"}));
    // Only the skin is checked, so the eye is ignored.
    EXPECT_TRUE(inspect_mesh(mesh, "head", {.groups = {0}}).findings.empty());
}

TEST(MeshChecks, TheScaleMessageAdvisesAUnit) {
    PolygonMesh mesh = ball();
    mesh.positions *= 100;
    EXPECT_EQ(messages(inspect_mesh(mesh, "head"), MeshCheck::kScale)[0],
              "head: expected a longest side of 0.12 to 1 m, found 20 m; metres_per_unit 0.01 "
              "instead of 1 would make "
              "it 0.2 m");
    // Read as millimetres although it is in centimetres.
    mesh.positions *= 0.001;
    EXPECT_EQ(
        messages(inspect_mesh(mesh, "head", {.metres_per_unit = 0.001}), MeshCheck::kScale)[0],
        "head: expected a longest side of 0.12 to 1 m, found 0.02 m; metres_per_unit 0.01 instead "
        "of 0.001 would "
        "make it 0.2 m");
}

TEST(MeshChecks, WhatIsAnErrorIsForTheCallerToSay) {
    PolygonMesh mesh = ball();
    mesh.positions *= 100;
    EXPECT_THROW(check_mesh(mesh, "head"), Error);
    EXPECT_EQ(check_mesh(mesh, "head", {.scale = Severity::kWarning}).findings[0].severity,
              Severity::kWarning);
    EXPECT_TRUE(check_mesh(mesh, "head", {.scale = Severity::kIgnore}).findings.empty());
}

TEST(MeshChecks, ASliverIsNamedWithItsArea) {
    PolygonMesh mesh = ball();
    const int v = mesh.corner_vertex[0], w = mesh.corner_vertex[1], u = mesh.corner_vertex[2];
    mesh.positions.row(v) = 0.5 * (mesh.positions.row(w) + mesh.positions.row(u));
    const auto found = messages(inspect_mesh(mesh, "ball"), MeshCheck::kDegenerateFace);
    ASSERT_EQ(found.size(), 1u);
    // Rounding of a zero area leaves about 1e-19 m2.
    EXPECT_EQ(found[0].substr(0, 52), "ball:face 0: expected an area above 1e-13 m2, found ");
    EXPECT_NE(found[0].find("m2 (group skin, at ("), std::string::npos);
}

}  // namespace
}  // namespace risorius::geom
