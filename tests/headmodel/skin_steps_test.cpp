// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/skin_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "risorius/headmodel/detail/head_model.h"
#include "risorius/headmodel/sculpt_head.h"

namespace risorius::headmodel {
namespace {

const HeadModel& eased_head() {
    static const HeadModel head = make_form(read_design_tables(models_folder() / "adult/design"));
    return head;
}

/// The head with a lump: `height_mm` outwards at `at`, falling to 0 over `reach_mm`, on both sides.
geom::PolygonMesh with_lump(const Vec3& at, double height_mm, double reach_mm) {
    geom::PolygonMesh mesh = eased_head().mesh;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.positions.row(v).transpose();
        const double side = p.x() < 0 ? -1 : 1,
                     t = std::min((Vec3(std::abs(p.x()), p.y(), p.z()) - at).norm() / reach_mm,
                                  1.0);
        mesh.positions(v, 0) += side * height_mm * (1 - t) * (1 - t) * (1 + 2 * t);
    }
    return mesh;
}

/// The largest change of the displacement along the skin within 25 mm, mm per mm.
double steepest(const geom::PolygonMesh& mesh, const Vec3& at) {
    const geom::PolygonMesh& usual = eased_head().mesh;
    double most = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face_group[static_cast<std::size_t>(f)] != mesh.group_index("skin")) continue;
        const int begin = mesh.face_begin[static_cast<std::size_t>(f)], n = mesh.corner_count(f);
        for (int k = 0; k < n; ++k) {
            const int a = mesh.corner_vertex[static_cast<std::size_t>(begin + k)],
                      b = mesh.corner_vertex[static_cast<std::size_t>(begin + (k + 1) % n)];
            const Vec3 p = usual.positions.row(a).transpose(),
                       q = usual.positions.row(b).transpose();
            if ((p - at).norm() > 25) continue;
            const Vec3 change = (mesh.positions.row(a) - usual.positions.row(a) -
                                 mesh.positions.row(b) + usual.positions.row(b))
                                    .transpose();
            most = std::max(most, change.norm() / std::max((p - q).norm(), 0.5));
        }
    }
    return most;
}

const Vec3 kJawAngle(55, -62, 12), kMouth(0, -52, 94);

TEST(SkinSteps, AShelfAtTheJawBecomesASlope) {
    geom::PolygonMesh mesh = with_lump(kJawAngle, 8, 14);
    ASSERT_GT(steepest(mesh, kJawAngle), 0.7);
    ease_steps(eased_head().mesh, mesh);
    EXPECT_LT(steepest(mesh, kJawAngle), 0.45);
    EXPECT_GT(steepest(mesh, kJawAngle), 0.05) << "it is not taken away";
}

TEST(SkinSteps, AGentleFormStaysAsItIs) {
    const geom::PolygonMesh before = with_lump(kJawAngle, 6, 60);
    ASSERT_LT(steepest(before, kJawAngle), 0.27);
    geom::PolygonMesh mesh = before;
    ease_steps(eased_head().mesh, mesh);
    EXPECT_LT((mesh.positions - before.positions).cwiseAbs().maxCoeff(), 0.01);
}

/// What is small in lips, nose, lids and ears is meant.
TEST(SkinSteps, LipsKeepTheirForm) {
    const geom::PolygonMesh before = with_lump(kMouth, 3, 6);
    geom::PolygonMesh mesh = before;
    ease_steps(eased_head().mesh, mesh);
    EXPECT_LT((mesh.positions - before.positions).cwiseAbs().maxCoeff(), 0.02);
}

TEST(SkinSteps, OnlySkinMoves) {
    const geom::PolygonMesh before = with_lump(kJawAngle, 8, 14);
    geom::PolygonMesh mesh = before;
    ease_steps(eased_head().mesh, mesh);
    std::vector<bool> skin(static_cast<std::size_t>(mesh.vertex_count()), false);
    for (int f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_group[static_cast<std::size_t>(f)] == mesh.group_index("skin"))
            for (int c = mesh.face_begin[static_cast<std::size_t>(f)];
                 c < mesh.face_begin[static_cast<std::size_t>(f) + 1]; ++c)
                skin[static_cast<std::size_t>(mesh.corner_vertex[static_cast<std::size_t>(c)])] =
                    true;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (!skin[static_cast<std::size_t>(v)])
            EXPECT_EQ(mesh.positions.row(v), before.positions.row(v)) << v;
}

}  // namespace
}  // namespace risorius::headmodel
