// SPDX-License-Identifier: MIT
// The skin over the tissue: nothing at rest, even where the tissue is not, folded where it is compressed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "face/adult_face.h"
#include "risorius/face/skin/detail/skin_surface.h"
#include "risorius/face/skin/detail/wrinkle_lines.h"
#include "risorius/face/skin/detail/wrinkles.h"

namespace risorius::face {
namespace {

constexpr int kSide = 41;
int node(int i, int j) { return i * kSide + j; }

// A patch of skin with a curvature of 1 / 50 mm, i along x.
struct Patch {
    Points rest = Points(kSide * kSide, 3);
    Triangles triangles = Triangles(2 * (kSide - 1) * (kSide - 1), 3);

    explicit Patch(double spacing_m, double curvature = 20.0) {
        for (int i = 0; i < kSide; ++i)
            for (int j = 0; j < kSide; ++j) {
                const double x = spacing_m * (i - kSide / 2), y = spacing_m * (j - kSide / 2);
                rest.row(node(i, j)) << x, y, -0.5 * curvature * (x * x + y * y);
            }
        long f = 0;
        for (int i = 0; i + 1 < kSide; ++i)
            for (int j = 0; j + 1 < kSide; ++j) {
                triangles.row(f++) << node(i, j), node(i + 1, j), node(i + 1, j + 1);
                triangles.row(f++) << node(i, j), node(i + 1, j + 1), node(i, j + 1);
            }
    }
    SkinSurface skin() const {
        const auto count = static_cast<std::size_t>(rest.rows());
        return SkinSurface({.triangles = triangles,
                            .rest = rest,
                            .bed_pa_per_m = std::vector<double>(count, 1.5e6),
                            .held = std::vector<char>(count, 0)});
    }
    // Lines along y in the first slot.
    Wrinkles wrinkles(double wavelength_m, double stay = 0, double later = 0) const {
        WrinkleLines lines{Points::Zero(rest.rows(), 3), Points::Zero(rest.rows(), 3),
                           Points::Zero(rest.rows(), 3)};
        lines.phase.col(0) = rest.col(0) / wavelength_m;
        lines.window.col(0).setOnes();
        lines.wavelength.col(0).setConstant(wavelength_m);
        if (stay > 0) lines.at_rest = Points::Constant(rest.rows(), 3, stay);
        if (later > 0) lines.later = Points::Constant(rest.rows(), 3, later);
        return Wrinkles(lines, triangles, rest, {.strength = 1.0, .mean_over_m = 2e-3});
    }
};

Rigid some_motion() {
    Rigid motion = Rigid::Identity();
    motion.translate(Vec3(0.01, -0.02, 0.03));
    motion.rotate(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()));
    return motion;
}
Points moved(const Points& points, const Rigid& motion) {
    return (points * motion.linear().transpose()).rowwise() + motion.translation().transpose();
}
Points stretched(const Points& points, double x, double y) {
    Points out = points;
    out.col(0) *= x;
    out.col(1) *= y;
    return out;
}
struct Folded {
    Points vertices, depth;
};
Folded fold(const Wrinkles& wrinkles, const Points& at) {
    Folded out{at, Points::Zero(at.rows(), 3)};
    wrinkles.fold(out.vertices, out.depth);
    return out;
}

TEST(SkinSurface, LiesStillAtRestAndTurnsWithTheTissue) {
    const Patch patch(2e-3);
    const SkinSurface skin = patch.skin();
    Points at = patch.rest;
    skin.relax(at);
    EXPECT_LT((at - patch.rest).cwiseAbs().maxCoeff(), 1e-12);
    const Points carried = moved(patch.rest, some_motion());
    at = carried;
    skin.relax(at);
    EXPECT_LT((at - carried).cwiseAbs().maxCoeff(), 1e-9) << "m";
}

TEST(SkinSurface, EvensOutLumpsOfTheTissueAndKeepsItsShape) {
    const Patch patch(1e-3);
    Points lumps = patch.rest, swell = patch.rest;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            lumps(node(i, j), 2) +=
                3e-4 * ((i / 2 + j / 2) % 2 ? 1 : -1);  // 4 mm from crest to crest
            swell(node(i, j), 2) += 3e-3 * std::cos(std::numbers::pi * i / (kSide - 1));
        }
    const SkinSurface skin = patch.skin();
    // Of a height over the rest shape, how much is left
    const auto left = [&](Points at) {
        const Eigen::VectorXd before = at.col(2) - patch.rest.col(2);
        skin.relax(at);
        const Eigen::VectorXd after = at.col(2) - patch.rest.col(2);
        return after.dot(before) / before.squaredNorm();
    };
    EXPECT_LT(left(lumps), 0.45);
    EXPECT_GT(left(swell), 0.95);
}

TEST(SkinSurface, LeavesWhatIsHeldAndItsBorder) {
    const Patch patch(2e-3);
    SkinSheetOnBed sheet{.triangles = patch.triangles,
                         .rest = patch.rest,
                         .bed_pa_per_m = std::vector<double>(kSide * kSide, 1e6),
                         .held = std::vector<char>(kSide * kSide, 0)};
    const int held = node(20, 20);
    sheet.held[held] = 1;
    Points carried = patch.rest;
    for (long v = 0; v < carried.rows(); ++v) carried(v, 2) += v % 7 ? 0.0 : 1e-3;
    Points at = carried;
    SkinSurface(sheet).relax(at);
    EXPECT_EQ(at.row(held), carried.row(held));
    EXPECT_EQ(at.row(node(0, 7)), carried.row(node(0, 7)));
    EXPECT_GT((at - carried).rowwise().norm().maxCoeff(), 1e-4);
}

TEST(Wrinkles, LinesThatBeginLaterFoldAsMuchLess) {
    const Patch patch(1e-3);
    const auto deepest = [&](double shortening, double later) {
        const Points at = stretched(patch.rest, 1 - shortening, 1);
        return fold(patch.wrinkles(2e-3, 0, later), at).depth.col(0).maxCoeff();
    };
    EXPECT_GT(deepest(0.1, 0), 0);
    EXPECT_EQ(deepest(0.1, 0.1), 0);
    EXPECT_GT(deepest(0.2, 0.1), 0);
    EXPECT_LT(deepest(0.2, 0.1), deepest(0.2, 0));
}

TEST(Wrinkles, NeitherMotionNorStretchNorPullAlongTheLinesFoldsSkin) {
    const Patch patch(0.5e-3);
    const Wrinkles wrinkles = patch.wrinkles(6e-3);
    for (const Points& at : {patch.rest, moved(patch.rest, some_motion()), Points(1.2 * patch.rest),
                             stretched(patch.rest, 1, 0.75), stretched(patch.rest, 1.3, 0.8)}) {
        const Folded folded = fold(wrinkles, at);
        EXPECT_EQ(folded.vertices, at);
        EXPECT_EQ(folded.depth.cwiseAbs().maxCoeff(), 0.0);
    }
}

TEST(Wrinkles, OfALifetimeAreShownAtRestAndGoAsSkinIsStretched) {
    for (const double edge_m :
         {0.5e-3, 2e-3}) {  // of a mesh that carries folds, and of one that does not
        const Patch patch(edge_m);
        const auto deepest = [&](double stay, double stretch) {
            const Points at = stretched(patch.rest, stretch, 1);
            const Folded folded = fold(patch.wrinkles(6e-3, stay), at);
            if (stretch >= 1) {
                EXPECT_EQ(folded.vertices, at);
            }
            return folded.depth.col(0).maxCoeff();
        };
        EXPECT_EQ(deepest(0.1, 1), 0.0);
        EXPECT_GT(deepest(0.7, 1), 1e-4);
        EXPECT_GT(deepest(1, 1), 1.5 * deepest(0.7, 1));
        EXPECT_EQ(deepest(1, 1.2), 0.0);
        if (edge_m > 1e-3) {
            EXPECT_GT(deepest(1, 0.9), deepest(1, 1));
        }
    }
}

TEST(Wrinkles, KeepTheLengthOfCompressedSkin) {
    const Patch patch(0.5e-3, 0.0);
    const Wrinkles wrinkles = patch.wrinkles(6e-3);
    for (const double compression : {0.10, 0.18, 0.25}) {
        const Folded folded = fold(wrinkles, stretched(patch.rest, 1 - compression, 1));
        // Away from the border, over whole waves: 24 edges of 0.5 mm are two
        double length = 0, along = 0;
        const int j = kSide / 2, from = 8, to = 32;
        for (int i = from; i < to; ++i) {
            length +=
                (folded.vertices.row(node(i + 1, j)) - folded.vertices.row(node(i, j))).norm();
            along += (folded.vertices.row(node(j, i + 1)) - folded.vertices.row(node(j, i))).norm();
        }
        const double at_rest = (to - from) * 0.5e-3;
        const double kept = at_rest * (1 - compression + folded_fraction(compression));
        // Lines differ in depth, and twelve edges cut the corners of a wave.
        EXPECT_NEAR(length / kept, 1.0, 0.03) << compression;
        EXPECT_NEAR(along / at_rest, 1.0, 0.01) << "smooth along the lines";
        EXPECT_EQ(folded.depth.cwiseAbs().maxCoeff(), 0.0) << "the mesh shows all of it";
    }
}

TEST(Wrinkles, AreLeftToTheRendererWhereTheMeshIsCoarse) {
    const Patch fine(0.5e-3, 0.0), coarse(2.5e-3, 0.0);
    const Points fine_at = stretched(fine.rest, 0.8, 1), coarse_at = stretched(coarse.rest, 0.8, 1);
    const Folded shown = fold(fine.wrinkles(6e-3), fine_at),
                 told = fold(coarse.wrinkles(6e-3), coarse_at);
    EXPECT_EQ(told.vertices, coarse_at);
    const double height = fold_profile(0.5) - fold_profile(0.0);
    double deepest = 0;
    for (int i = 8; i < 32; ++i)
        deepest =
            std::max(deepest, shown.vertices(node(i, 20), 2) - shown.vertices.col(2).minCoeff());
    const double deepest_line = 1 + 0.4 * std::sin(2.4);
    EXPECT_NEAR(told.depth(node(20, 20), 0) * height * deepest_line / deepest, 1.0, 0.04);
}

TEST(Wrinkles, BeginSmoothly) {
    EXPECT_EQ(fold_depth_ratio(0.0), 0.0);
    for (const FoldOnset& onset : {kSmoothSkin, kCreasedSkin}) {
        EXPECT_EQ(folded_fraction(0.0, onset), 0.0);
        // Onset over half the way, onset at twice the pace
        const double smoothest = 1.5e-3 * kSmoothSkin.softness / onset.softness;
        double last = 0, last_step = 0;
        for (double c = 0; c < 0.4; c += 1e-3) {
            const double depth = fold_depth_ratio(folded_fraction(c, onset) / (1 - c)),
                         step = depth - last;
            EXPECT_GE(step, -1e-12) << c;
            EXPECT_LT(std::abs(step - last_step), smoothest) << "a jump of the speed at " << c;
            EXPECT_LT(step, 8e-3) << c;
            last = depth;
            last_step = step;
        }
    }
    // A line that is there at rest folds where smooth skin only thickens.
    EXPECT_GT(folded_fraction(0.04, kCreasedSkin), 3 * folded_fraction(0.04));
    for (double ratio = 0.02; ratio < 0.6; ratio += 0.02)
        EXPECT_NEAR(fold_depth_ratio(fold_excess(ratio)), ratio, 0.01 * ratio);
}

TEST(WrinkleLines, LieAcrossTheForeheadAndFanOutFromTheEyes) {
    const rig::Head& head = rig::adult_placed();
    const WrinkleLines lines = lay_wrinkle_lines(head, rig::adult().rig, head.skin);
    const auto gradient_at = [&](const Vec3& place, int slot) {
        Vec3 sum = Vec3::Zero();
        for (long f = 0; f < head.skin.rows(); ++f) {
            const auto at = [&](int k) {
                return Vec3(head.vertices.row(head.skin(f, k)).transpose());
            };
            if ((at(0) - place).norm() > head.mm(6)) continue;
            const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
            for (int k = 0; k < 3; ++k)
                sum += lines.phase(head.skin(f, k), slot) *
                       normal.normalized().cross(at((k + 2) % 3) - at((k + 1) % 3));
        }
        return Vec3(sum.normalized());
    };
    EXPECT_GT(std::abs(gradient_at(head.landmark("mef"), 0).y()), 0.9) << "level lines";
    EXPECT_GT(std::abs(gradient_at(head.landmark("bm_l") - Vec3(head.mm(5), 0, 0), 1).x()), 0.75)
        << "upright";
    for (const char* side : {"_l", "_r"}) {
        // From the canthus outwards the phase hardly changes: lines run out from it.
        const Vec3 canthus = head.landmark(std::string("ex") + side);
        const double out = canthus.x() > 0 ? 1 : -1;
        const Vec3 across = gradient_at(canthus + head.mm(10) * Vec3(out, 0.1, -0.6), 0);
        EXPECT_GT(std::abs(across.y()), 0.8) << side;
    }
    EXPECT_GE(lines.window.minCoeff(), 0.0);
    EXPECT_LE(lines.window.maxCoeff(), 1.3);
}

TEST(Wrinkles, ACreaseFoldsAsAWholeByWhatItIsCompressedOnTheWhole) {
    const Patch patch(1e-3, 0.0);
    WrinkleLines lines{Points::Zero(patch.rest.rows(), 3), Points::Zero(patch.rest.rows(), 3),
                       Points::Zero(patch.rest.rows(), 3)};
    lines.phase.col(0) = patch.rest.col(0) / 18e-3;
    lines.wavelength.col(0).setConstant(18e-3);
    Crease crease;
    for (int v = 0; v < patch.rest.rows(); ++v)
        if (std::abs(patch.rest(v, 0)) < 6e-3) {
            lines.window(v, 0) = 1;
            crease.vertex.push_back(v);
            crease.place_m.push_back(patch.rest(v, 1) + 20e-3);
        }
    const WrinkleOptions options{.strength = 1.0, .mean_over_m = 2e-3, .mean_along_crease_m = 9e-3};
    const Wrinkles line(lines, patch.triangles, patch.rest, options);
    lines.creases.push_back(crease);
    const Wrinkles whole(lines, patch.triangles, patch.rest, options);
    const auto at = [&](const Wrinkles& wrinkles, const Points& vertices, int j) {
        const Points& c = wrinkles.compression(vertices);
        for (std::size_t i = 0; i < wrinkles.vertex_indices().size(); ++i)
            if (wrinkles.vertex_indices()[i] == node(kSide / 2, j))
                return c(static_cast<long>(i), 0);
        return -1.0;
    };
    // A dent in the middle
    Points dent = patch.rest;
    for (long v = 0; v < dent.rows(); ++v)
        dent(v, 0) *= 1 - 0.4 * std::exp(-std::pow(dent(v, 1) / 4e-3, 2));
    EXPECT_LT(at(whole, dent, kSide / 2), 0.65 * at(line, dent, kSide / 2));
    EXPECT_GT(at(whole, dent, kSide / 2 + 12), 3 * at(line, dent, kSide / 2 + 12));
    EXPECT_GT(at(whole, dent, kSide / 2 + 12), 0.05);
    // An even one is what it is
    const Points even = stretched(patch.rest, 0.8, 1.0);
    EXPECT_NEAR(at(whole, even, kSide / 2 + 12), at(line, even, kSide / 2 + 12), 0.02);
}

TEST(SkinLayer, FoldsTheForeheadOfARaisedBrowAndNothingAtRest) {
    Face face = adult_face();
    const FacePose rest = equilibrium_pose(face, neutral());
    EXPECT_EQ(rest.fold_depth.cwiseAbs().maxCoeff(), 0.0);
    EXPECT_LT((rest.vertices - face.head().vertices).cwiseAbs().maxCoeff(), 1e-9);

    track::Drive raised = with_unit("AU1");
    raised.excitation += with_unit("AU2").excitation;
    raised.excitation = raised.excitation.cwiseMin(1.0);
    const FacePose pose = equilibrium_pose(face, raised);
    const Vec3 forehead = 0.5 * (face.head().landmark("mef") + face.head().landmark("g"));
    double deepest = 0, elsewhere = 0;
    for (long v = 0; v < pose.vertices.rows(); ++v) {
        const Vec3 p = face.head().vertices.row(v).transpose();
        const double depth = pose.fold_depth.row(v).maxCoeff();
        if ((p - forehead).norm() < face.head().mm(12)) deepest = std::max(deepest, depth);
        if (p.y() < face.head().landmark("sn").y()) elsewhere = std::max(elsewhere, depth);
        if (p.z() < 0) {
            EXPECT_EQ(pose.vertices.row(v), face.head().vertices.row(v)) << v;
        }
    }
    EXPECT_GT(1e3 * deepest, 0.3) << "mm";
    EXPECT_LT(1e3 * elsewhere, 0.05) << "mm, around a mouth at rest";
    const FacePose again = face.pose();
    EXPECT_EQ(again.vertices, pose.vertices);
    EXPECT_EQ(again.fold_depth, pose.fold_depth);
}

TEST(SkinLayer, OfAnOldFaceHasLinesAtRestThatMoveNoVertex) {
    rig::RigDescription old = rig::adult().rig;
    old.appearance.age = 1;
    Face face(old, rig::adult().mesh, preview(), "adult");
    const FacePose pose = equilibrium_pose(face, neutral());
    EXPECT_LT((pose.vertices - face.head().vertices).rowwise().norm().maxCoeff(), 1e-6);
    const auto deepest_near = [&](const char* landmark, double reach_m) {
        double out = 0;
        for (long v = 0; v < pose.vertices.rows(); ++v)
            if ((face.head().vertices.row(v).transpose() - face.head().landmark(landmark)).norm() <
                reach_m)
                out = std::max(out, pose.fold_depth.row(v).maxCoeff());
        return 1e3 * out;
    };
    EXPECT_GT(deepest_near("mef", 15e-3), 0.15) << "mm, forehead";
    EXPECT_GT(deepest_near("nl2_l", 8e-3), 0.3) << "mm, beside the mouth";
    EXPECT_EQ(deepest_near("prn", 5e-3), 0.0) << "tip of the nose";
}

TEST(SkinLayer, WithoutWrinklesHasNone) {
    rig::RigDescription smooth = rig::adult().rig;
    smooth.skin.wrinkles = 0;
    Face face(smooth, rig::adult().mesh, preview(), "adult");
    EXPECT_EQ(equilibrium_pose(face, with_unit("AU1")).fold_depth.rows(), 0);
    EXPECT_EQ(face.surfaces().wrinkle_lines().phase.rows(), 0);
}

}  // namespace
}  // namespace risorius::face
