// SPDX-License-Identifier: MIT
// The muscles as surfaces to look at: all of them, closed, below the skin, and moving as the muscles do.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

class MuscleSurface : public testing::Test {
  protected:
    static void SetUpTestSuite() { face = std::make_unique<Face>(adult_face()); }
    static void TearDownTestSuite() { face.reset(); }

    static Points at_rest() {
        face->start(always(neutral()));
        return face->surfaces().muscle_vertices_at(0);
    }
    static const risorius::face::MuscleSurface& of(const std::string& muscle,
                                                   std::optional<Side> side) {
        for (const auto& surface : face->surfaces().muscles().muscles)
            if (surface.muscle == muscle && surface.side == side) return surface;
        throw std::runtime_error("no surface of " + muscle);
    }
    static double volume(const Triangles& triangles, const Points& x) {
        double six = 0;
        for (long f = 0; f < triangles.rows(); ++f) {
            const Vec3 a = x.row(triangles(f, 0)), b = x.row(triangles(f, 1)),
                       c = x.row(triangles(f, 2));
            six += a.dot(b.cross(c));
        }
        return six / 6;
    }
    static Vec3 middle(const Triangles& triangles, const Points& x) {
        Vec3 sum = Vec3::Zero();
        for (long i = 0; i < triangles.size(); ++i) sum += x.row(triangles.data()[i]).transpose();
        return sum / static_cast<double>(triangles.size());
    }

    static std::unique_ptr<Face> face;
};
std::unique_ptr<Face> MuscleSurface::face;

TEST_F(MuscleSurface, EveryMuscleOfTheTableHasOneOnEverySideWithItsColumn) {
    for (const rig::Muscle& muscle : rig::adult().rig.muscles.muscles)
        for (const Side side : {Side::kLeft, Side::kRight}) {
            const auto of_side = muscle.paired ? std::optional(side) : std::nullopt;
            EXPECT_EQ(of(muscle.id, of_side).column, channels().column(muscle.id, side))
                << muscle.id;
        }
}

TEST_F(MuscleSurface, EachIsClosedAndEnclosesSomeFlesh) {
    const Points x = at_rest();
    for (const auto& surface : face->surfaces().muscles().muscles) {
        // Closed: each edge is run through once in each direction
        std::map<std::pair<int, int>, int> edges;
        for (long f = 0; f < surface.triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k)
                ++edges[{surface.triangles(f, k), surface.triangles(f, (k + 1) % 3)}];
        for (const auto& [edge, count] : edges) {
            ASSERT_EQ(count, 1) << surface.muscle;
            ASSERT_TRUE(edges.contains({edge.second, edge.first})) << surface.muscle;
        }
        EXPECT_GT(volume(surface.triangles, x), 1e-8) << surface.muscle;  // 10 mm^3
    }
}

TEST_F(MuscleSurface, AtRestTheyAreMirrorImages) {
    const Points x = at_rest();
    for (const auto& left : face->surfaces().muscles().muscles) {
        if (left.side != Side::kLeft) continue;
        const auto& right = of(left.muscle, Side::kRight);
        const Vec3 a = middle(left.triangles, x), b = middle(right.triangles, x);
        // The head itself is symmetric to some millimetres.
        EXPECT_LT((a - Vec3(-b.x(), b.y(), b.z())).norm(), 0.004) << left.muscle;
        // Short bundles of two fibres, cut where the tissue ends, differ most.
        const double ratio = volume(left.triangles, x) / volume(right.triangles, x);
        EXPECT_NEAR(std::log(ratio), 0, std::log(1.5)) << left.muscle;
    }
}

TEST_F(MuscleSurface, AContractedMuscleIsShorterAndThickerAndKeepsItsVolume) {
    const Points rest = at_rest();
    const auto& zygomaticus = of("zygomaticus_major", Side::kLeft);
    const track::Drive drive = with_muscle("zygomaticus_major", 1.0);
    equilibrium_pose(*face, drive);
    const Points x = face->surfaces().muscle_vertices_at(0);
    const auto extent = [&](const Points& p) {  // between the ends of the fibres
        const MuscleSurfaces& all = face->surfaces().muscles();
        Vec3 low = Vec3::Zero(), high = Vec3::Zero();
        double min = 1e9, max = -1e9;
        for (long i = 0; i < zygomaticus.triangles.size(); ++i) {
            const int v = zygomaticus.triangles.data()[i];
            if (all.fibre(v, 0) < min) {
                min = all.fibre(v, 0);
                low = p.row(v).transpose();
            }
            if (all.fibre(v, 0) > max) {
                max = all.fibre(v, 0);
                high = p.row(v).transpose();
            }
        }
        return (high - low).norm();
    };
    const double shorter = extent(x) / extent(rest);
    EXPECT_LT(shorter, 0.9);
    EXPECT_NEAR(volume(zygomaticus.triangles, x) / volume(zygomaticus.triangles, rest), 1, 0.05);
}

TEST_F(MuscleSurface, JawMusclesRideOnTheJawAndOthersOfTheHeadTurnWithIt) {
    const Points rest = at_rest();
    const auto& deep = of("masseter_deep", Side::kRight);
    const auto& upper = of("temporalis_posterior", Side::kRight);
    track::Drive drive = with_kinematic(track::Kinematic::kJawOpen, 1.0);
    face->start(always(drive));
    Points x = face->surfaces().muscle_vertices_at(0);
    EXPECT_LT(middle(deep.triangles, x).y(), middle(deep.triangles, rest).y() - 0.002);
    const auto highest = [&](const Points& p) {
        double y = -1;
        for (long i = 0; i < upper.triangles.size(); ++i)
            y = std::max(y, p(upper.triangles.data()[i], 1));
        return y;
    };
    // Its origin stays; its belly narrows by less than a millimetre as it is stretched.
    EXPECT_NEAR(highest(x), highest(rest), 1e-3);

    drive = with_kinematic(track::Kinematic::kHeadYaw, 20.0);
    face->start(always(drive));
    x = face->surfaces().muscle_vertices_at(0);
    const Rigid turn = face->pose().head;
    for (long i = 0; i < upper.triangles.size(); i += 7) {
        const int v = upper.triangles.data()[i];
        EXPECT_LT((x.row(v).transpose() - turn * Vec3(rest.row(v).transpose())).norm(), 1e-9);
    }
}

}  // namespace
}  // namespace risorius::face
