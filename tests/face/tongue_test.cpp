// SPDX-License-Identifier: MIT
// The body of the tongue rises to the palate and not through it, keeps its volume, leaves its tip alone, and stays between the teeth.
// The tip rises to the ridge behind the upper teeth.
#include "risorius/face/skin/detail/tongue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "face/adult_face.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/skin/detail/palate.h"

namespace risorius::face {
namespace {

using track::Kinematic;

// Where speech has the body in i, at rest, in k and in u
constexpr double kFrontArch = -0.43, kMiddleArch = 0, kVelarArch = 0.57, kBackArch = 1;
constexpr double kArches[] = {kFrontArch, kMiddleArch, kVelarArch, kBackArch};

const rig::Head& oral_head() { return rig::adult_placed(); }

Triangles triangles_of_group(const char* group) {
    const geom::PolygonMesh& mesh = rig::adult().mesh;
    return geom::triangulate(mesh, {mesh.group_index(group)});
}

/// The adult's mouth with a jaw that is open by a fraction; the skin is at rest.
Points oral_mouth(const TongueDrive& drive) {
    static const Tongue tongue(oral_head(), 1e-3 * rig::adult().rig.facs.ranges.tongue_out_mm);
    Points out = oral_head().vertices;
    for (long v = 0; v < out.rows(); ++v)
        if (oral_head().carrier[static_cast<std::size_t>(v)] == rig::Carrier::kMandible)
            out.row(v) = (drive.mandible * Vec3(out.row(v).transpose())).transpose();
    tongue.place(drive, out);
    return out;
}

Rigid jaw_opened(double fraction) {
    static const Jaw jaw(oral_head(), rig::adult().rig.jaw);
    return jaw.motion(fraction, 0, 0);
}

TongueDrive with_body(double up, double back, double jaw_open = 0) {
    return {.body_up = up, .body_back = back, .mandible = jaw_opened(jaw_open)};
}

/// Height of the first surface above a point, m.
double room_above(const Triangles& roof, const Points& at, const Vec3& p) {
    double best = 1e300;
    for (long f = 0; f < roof.rows(); ++f) {
        const Vec3 a = at.row(roof(f, 0)), b = at.row(roof(f, 1)), c = at.row(roof(f, 2));
        const auto cross = [](const Vec3& u, const Vec3& v) {
            return u.x() * v.z() - u.z() * v.x();
        };
        const Vec3 part(cross(b - p, c - p), cross(c - p, a - p), cross(a - p, b - p));
        const double area = part.sum();
        if (area == 0 || (part / area).minCoeff() < 0) continue;
        const double y = (part[0] * a.y() + part[1] * b.y() + part[2] * c.y()) / area;
        // The upper half of the lining; the lower half lies below the tongue
        if (y > oral_head().landmark("sto").y() + 5e-3) best = std::min(best, y - p.y());
    }
    return best;
}

/// The least distance from the tongue up to the palate, mm; below 0 a point is in it.
double palate_gap_mm(const Points& at) {
    static const Triangles roof = triangles_of_group("mouth");
    double gap = 1e300;
    for (long v = 0; v < at.rows(); ++v)
        if (oral_head().carrier[static_cast<std::size_t>(v)] == rig::Carrier::kTongue)
            gap = std::min(gap, room_above(roof, at, at.row(v).transpose()));
    return 1e3 * gap;
}

/// Where the tongue has risen, along the head, m: a mean weighted by the rise.
double middle_of_rise(const Points& raised, const Points& flat) {
    double sum = 0, weight = 0;
    for (long v = 0; v < flat.rows(); ++v) {
        if (oral_head().carrier[static_cast<std::size_t>(v)] != rig::Carrier::kTongue) continue;
        const double rise = std::max(0.0, raised(v, 1) - flat(v, 1));
        sum += rise * flat(v, 2);
        weight += rise;
    }
    return sum / weight;
}

double tongue_volume(const Points& at) {
    static const Triangles surface = triangles_of_group("tongue");
    double sum = 0;
    for (long f = 0; f < surface.rows(); ++f)
        sum += Vec3(at.row(surface(f, 0)))
                   .dot(Vec3(at.row(surface(f, 1))).cross(Vec3(at.row(surface(f, 2))))) /
               6;
    return sum;
}

/// How far points of the tongue are inside of the teeth of a group, mm: the depth of the deepest one.
double depth_in_teeth_mm(const Points& at, const char* group) {
    const Triangles teeth = triangles_of_group(group);
    double deepest = 0;
    for (long v = 0; v < at.rows(); ++v) {
        if (oral_head().carrier[static_cast<std::size_t>(v)] != rig::Carrier::kTongue) continue;
        const Vec3 p = at.row(v);
        double turns = 0, nearest = 1e300;
        for (long f = 0; f < teeth.rows(); ++f) {
            const Vec3 a = Vec3(at.row(teeth(f, 0))) - p, b = Vec3(at.row(teeth(f, 1))) - p,
                       c = Vec3(at.row(teeth(f, 2))) - p;
            // Solid angle of the triangle (van Oosterom & Strackee 1983)
            turns += 2 * std::atan2(a.dot(b.cross(c)),
                                    a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                        b.dot(c) * a.norm() + c.dot(a) * b.norm());
            nearest = std::min({nearest, a.norm(), b.norm(), c.norm()});
        }
        if (std::abs(turns) > 2 * M_PI) deepest = std::max(deepest, 1e3 * nearest);
    }
    return deepest;
}

TEST(TongueBody, AtOneItTouchesThePalateHoweverFarTheJawIsOpen) {
    for (const double jaw : {0.0, 0.12, 0.3, 0.5})
        for (const double place : kArches) {
            const double gap = palate_gap_mm(oral_mouth(with_body(1, place, jaw)));
            EXPECT_LT(gap, 0.5) << "jaw " << jaw << ", place " << place;
            EXPECT_GT(gap, 0) << "jaw " << jaw << ", place " << place;
        }
    EXPECT_GT(palate_gap_mm(oral_mouth(with_body(0, 0))), 12);
}

TEST(TongueBody, RisesWithItsChannelWithoutJumps) {
    for (const double place : kArches) {
        double before = palate_gap_mm(oral_mouth(with_body(-1, place, 0.12))), step_before = 0;
        for (int i = -19; i <= 20; ++i) {
            const double gap = palate_gap_mm(oral_mouth(with_body(0.05 * i, place, 0.12)));
            EXPECT_LT(gap, before + 0.01) << i << " at " << place;
            EXPECT_LT(before - gap, 2) << i << " at " << place;
            if (i > -19) {
                EXPECT_LT(std::abs(before - gap - step_before), 0.7) << i << " at " << place;
            }
            step_before = before - gap;
            before = gap;
        }
    }
}

TEST(TongueBody, AVowelLeavesAPassageAndTheBackMovesItsTop) {
    const Points flat = oral_mouth(with_body(0, 0, 0.1));
    std::vector<double> middle;
    for (const double place : kArches) {
        const Points close = oral_mouth(with_body(0.74, place, 0.1));
        EXPECT_GT(palate_gap_mm(close), 1.5) << place;
        EXPECT_LT(palate_gap_mm(close), 4.5) << place;
        middle.push_back(middle_of_rise(close, flat));
    }
    for (std::size_t i = 1; i < middle.size(); ++i) EXPECT_LT(middle[i], middle[i - 1] - 3e-3) << i;
    EXPECT_GT(middle.front() - middle.back(), 12e-3);
    // Small changes make small ones
    for (double place = -1; place < 0.99; place += 0.05) {
        const Points one = oral_mouth(with_body(0.8, place, 0.1)),
                     two = oral_mouth(with_body(0.8, place + 0.05, 0.1));
        EXPECT_LT((one - two).rowwise().norm().maxCoeff(), 2.5e-3) << place;
    }
}

TEST(TongueBody, LeavesTheTipToItsOwnChannels) {
    for (const TongueDrive& tip : {TongueDrive{.mandible = jaw_opened(0.2)},
                                   TongueDrive{.up = 0.8, .mandible = jaw_opened(0.1)},
                                   TongueDrive{.out = 0.5, .mandible = jaw_opened(0.5)}}) {
        const Points before = oral_mouth(tip);
        TongueDrive with = tip;
        with.body_up = 0.8;
        with.body_back = kFrontArch;
        const Points after = oral_mouth(with);
        double foremost = -1;
        for (long v = 0; v < before.rows(); ++v)
            if (oral_head().carrier[static_cast<std::size_t>(v)] == rig::Carrier::kTongue)
                foremost = std::max(foremost, oral_head().vertices(v, 2));
        int tips = 0;
        for (long v = 0; v < before.rows(); ++v)
            if (oral_head().carrier[static_cast<std::size_t>(v)] == rig::Carrier::kTongue &&
                oral_head().vertices(v, 2) > foremost - 1.2e-3) {
                ++tips;
                EXPECT_LT((before.row(v) - after.row(v)).norm(), 1e-5);
            }
        EXPECT_GT(tips, 0);
    }
}

TEST(TongueBody, KeepsItsVolume) {
    for (const double jaw : {0.0, 0.12, 0.3})
        for (const double place : kArches)
            for (const double up : {-1.0, -0.4, 0.4, 0.74, 1.0})
                EXPECT_NEAR(tongue_volume(oral_mouth(with_body(up, place, jaw))) /
                                tongue_volume(oral_mouth(with_body(0, 0, jaw))),
                            1, jaw < 0.2 ? 0.06 : 0.12)
                    << up << " at " << place << ", jaw " << jaw;
}

TEST(TongueBody, StaysBetweenTheTeeth) {
    for (const double jaw : {0.0, 0.12, 0.3}) {
        const Points flat = oral_mouth(with_body(0, 0, jaw));
        for (const char* teeth : {"teeth_upper", "teeth_lower"}) {
            const double before = depth_in_teeth_mm(flat, teeth);
            for (const double place : kArches)
                for (const double up : {-1.0, -0.4, 0.74, 1.0})
                    EXPECT_LT(depth_in_teeth_mm(oral_mouth(with_body(up, place, jaw)), teeth),
                              before + 0.2)
                        << teeth << ", " << up << " at " << place << ", jaw " << jaw;
        }
    }
}

/// The least distance from the tip of the tongue to the upper gums, mm.
double ridge_gap_mm(const Points& at) {
    static const Triangles gums = triangles_of_group("gums_upper");
    double foremost = -1, best = 1e300;
    for (long v = 0; v < at.rows(); ++v)
        if (oral_head().carrier[static_cast<std::size_t>(v)] == rig::Carrier::kTongue)
            foremost = std::max(foremost, oral_head().vertices(v, 2));
    for (long v = 0; v < at.rows(); ++v) {
        if (oral_head().carrier[static_cast<std::size_t>(v)] != rig::Carrier::kTongue ||
            oral_head().vertices(v, 2) < foremost - 1e-3)
            continue;
        for (long f = 0; f < gums.rows(); ++f)
            for (int k = 0; k < 3; ++k)
                best = std::min(best, (at.row(v) - at.row(gums(f, k))).norm());
    }
    return 1e3 * best;
}

TongueDrive with_tip(double up, double jaw_open) {
    return {.up = up, .mandible = jaw_opened(jaw_open)};
}

// The jaw is open by 10 mm at 0.25. Gums have a point every 0.8 mm.
TEST(TongueTip, TouchesTheRidgeHoweverFarTheJawIsOpen) {
    for (const double jaw : {0.0, 0.05, 0.12, 0.2, 0.3}) {
        EXPECT_LT(ridge_gap_mm(oral_mouth(with_tip(kTipAtRidge, jaw))), 0.8) << jaw;
        EXPECT_GT(ridge_gap_mm(oral_mouth(with_tip(0, jaw))), 8) << jaw;
        double before = ridge_gap_mm(oral_mouth(with_tip(0, jaw)));
        for (double up = 0.05; up < kTipAtRidge; up += 0.05) {
            const double gap = ridge_gap_mm(oral_mouth(with_tip(up, jaw)));
            EXPECT_LT(gap, before + 0.01) << up << ", jaw " << jaw;
            EXPECT_LT(before - gap, 3) << up << ", jaw " << jaw;
            before = gap;
        }
    }
}

TEST(TongueTip, StaysBetweenTheTeethAndKeepsItsVolume) {
    for (const double jaw : {0.05, 0.12, 0.3}) {
        const Points flat = oral_mouth(with_tip(0, jaw));
        for (const double up : {0.4, kTipAtRidge, 1.0}) {
            const Points raised = oral_mouth(with_tip(up, jaw));
            EXPECT_NEAR(tongue_volume(raised) / tongue_volume(flat), 1, 0.08) << up << " " << jaw;
            for (const char* teeth : {"teeth_upper", "teeth_lower", "gums_upper"})
                EXPECT_LT(depth_in_teeth_mm(raised, teeth), depth_in_teeth_mm(flat, teeth) + 0.5)
                    << teeth << ", " << up << ", jaw " << jaw;
        }
    }
}

// A tongue that is out licks the lip instead.
TEST(TongueTip, LeavesATongueThatIsOut) {
    const TongueDrive out{.out = 0.6, .up = 0.5, .mandible = jaw_opened(0.5)};
    TongueDrive level = out;
    level.up = 0;
    EXPECT_GT(ridge_gap_mm(oral_mouth(out)), 10);
    EXPECT_GT((oral_mouth(out) - oral_mouth(level)).rowwise().norm().maxCoeff(), 2e-3);
}

TEST(TongueBody, OfASimulatedFaceTouchesItsPalate) {
    Face face = adult_face();
    track::Drive k = with_kinematic(Kinematic::kJawOpen, 0.12);
    const double flat = palate_gap_mm(equilibrium_pose(face, k, nullptr, kWithinATenth).vertices);
    k = with_kinematic(Kinematic::kTongueBodyBack, kVelarArch, k);
    k = with_kinematic(Kinematic::kTongueBodyUp, 1, k);
    const Points vertices = equilibrium_pose(face, k, nullptr, kWithinATenth).vertices;
    EXPECT_GT(flat, 12);
    EXPECT_LT(palate_gap_mm(vertices), 0.5);
    EXPECT_GT(palate_gap_mm(vertices), 0);
}

TEST(TongueBody, AHeadWithoutAPalateHasAnEstimate) {
    rig::Head bare = oral_head();
    bare.lining.resize(0, 3);
    bare.skin.resize(0, 3);
    for (rig::Carrier& carrier : bare.carrier)
        if (carrier == rig::Carrier::kSkull) carrier = rig::Carrier::kNone;
    const Palate none(bare, 0.03, 0.08, {-0.046, -0.046}),
        adult(oral_head(), 0.04, 0.06, {-0.046, -0.046});
    EXPECT_FALSE(none.found());
    EXPECT_TRUE(adult.found());
    EXPECT_NEAR(none.heights(bare.vertices).at(0, 0.05), -0.046 + bare.mm(15.5), 1e-9);
    EXPECT_NEAR(none.heights(bare.vertices).at(0, 0.05),
                adult.heights(oral_head().vertices).at(0, 0.05), 2e-3);
}

}  // namespace
}  // namespace risorius::face
