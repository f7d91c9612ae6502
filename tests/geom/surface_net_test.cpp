// SPDX-License-Identifier: MIT
// Surfaces of fields on a grid: where they lie, which way they face, and that they are closed.
#include "risorius/geom/surface_net.h"

#include <gtest/gtest.h>

#include "risorius/geom/surface_topology.h"

namespace risorius::geom {
namespace {

const Vec3 kCentre(0.01, -0.02, 0.005);
constexpr double kRadius_m = 0.03, kStep_m = 0.002;

GridField sphere() {
    GridField field(kCentre - Vec3::Constant(0.04), kCentre + Vec3::Constant(0.04), kStep_m, 0);
    for (int k = 0; k < field.size[2]; ++k)
        for (int j = 0; j < field.size[1]; ++j)
            for (int i = 0; i < field.size[0]; ++i)
                field.values[field.index(i, j, k)] =
                    static_cast<float>((field.place(i, j, k) - kCentre).norm() - kRadius_m);
    return field;
}

TEST(SurfaceNet, ASphereIsRoundClosedAndFacesOutwards) {
    const NetSurface net = surface_net(sphere());
    ASSERT_GT(net.triangles.rows(), 1000);
    for (long v = 0; v < net.vertices.rows(); ++v)
        EXPECT_NEAR((net.vertices.row(v).transpose() - kCentre).norm(), kRadius_m, 0.1 * kStep_m);
    const SurfaceEdges edges = surface_edges(net.triangles);
    for (int e = 0; e < edges.count(); ++e) EXPECT_EQ(edges.triangle_count(e), 2);
    double volume = 0;
    for (long f = 0; f < net.triangles.rows(); ++f) {
        const Vec3 a = net.vertices.row(net.triangles(f, 0)),
                   b = net.vertices.row(net.triangles(f, 1)),
                   c = net.vertices.row(net.triangles(f, 2));
        EXPECT_GT((b - a).cross(c - a).dot((a + b + c) / 3 - kCentre), 0);
        volume += a.dot(b.cross(c)) / 6;
    }
    EXPECT_NEAR(volume, 4.0 / 3.0 * EIGEN_PI * std::pow(kRadius_m, 3), 0.01 * volume);
}

TEST(SurfaceNet, AFieldIsReadBetweenItsSamples) {
    const GridField field = sphere();
    EXPECT_NEAR(field.at(kCentre + Vec3(0.0203, 0.0011, -0.0077)),
                Vec3(0.0203, 0.0011, -0.0077).norm() - kRadius_m, 0.05 * kStep_m);
    // Beyond the border, the value is that at the border.
    EXPECT_EQ(field.at(kCentre + Vec3(1, 0, 0)),
              field.at({field.place(field.size[0] - 1, 0, 0).x(), kCentre.y(), kCentre.z()}));
}

}  // namespace
}  // namespace risorius::geom
