// SPDX-License-Identifier: MIT
// Each muscle pulls the skin where anatomy says it does.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

#include "face/adult_face.h"
#include "risorius/geom/mirror.h"

namespace risorius::face {
namespace {

/// One face for all these tests; every pose is found from rest.
class Muscles : public testing::Test {
  protected:
    /// Lips that press on each other may go on circling by so much an iteration, RMS: little beside the millimetres that
    /// are measured here.
    static constexpr double kCircles_m = 1e-9;
    static Face& face() {
        static Face one = adult_face();
        return one;
    }
    static Points moved(const track::Drive& drive) {
        StepStats figures;
        const FacePose pose = equilibrium_pose(face(), drive, &figures, kNearRest);
        EXPECT_LT(figures.converged ? 0.0 : figures.last_step_rms_m, kCircles_m);
        return moved_mm(face(), pose);
    }
    struct Contraction {
        Points moved;         ///< mm
        double mean_stretch;  ///< of the muscle's fibres
    };
    /// A full one, found once for all tests of a process.
    static const Contraction& contraction(const std::string& muscle, std::optional<Side> side) {
        static std::map<std::pair<std::string, std::optional<Side>>, Contraction> known;
        const auto key = std::pair(muscle, side);
        if (!known.contains(key)) {
            Points u = moved_mm(face(), equilibrium_pose(face(), with_muscle(muscle, 1.0, side),
                                                         nullptr, kWithinATenth));
            known[key] = {std::move(u), face().diagnostics().mean_stretch(muscle)};
        }
        return known[key];
    }
    static const Points& moved(const std::string& muscle, std::optional<Side> side = std::nullopt) {
        return contraction(muscle, side).moved;
    }
    /// The skin vertex that moves most.
    static long furthest(const Points& u) {
        long best = 0;
        for (long v = 0; v < u.rows(); ++v)
            if (face().head().carrier[v] == rig::Carrier::kSkin &&
                u.row(v).norm() > u.row(best).norm())
                best = v;
        return best;
    }
    /// RMS displacement of the skin of one side, further than 12 mm from the midline, mm.
    static double of_side(const Points& u, Side side) {
        double squares = 0;
        int count = 0;
        for (long v = 0; v < u.rows(); ++v) {
            const double x = face().head().vertices(v, 0) * (side == Side::kLeft ? 1 : -1);
            if (face().head().carrier[v] != rig::Carrier::kSkin || x < face().head().mm(12))
                continue;
            squares += u.row(v).squaredNorm();
            ++count;
        }
        return std::sqrt(squares / count);
    }
    static std::vector<rig::Muscle> mimetic() {
        std::vector<rig::Muscle> out;
        for (const rig::Muscle& muscle : rig::adult().rig.muscles.muscles)
            if (muscle.group == "mimetic") out.push_back(muscle);
        return out;
    }
};

TEST_F(Muscles, EachOfTheTwentyEightMovesTheSkin) {
    ASSERT_EQ(mimetic().size(), 28u);
    for (const rig::Muscle& muscle : mimetic()) {
        const auto& [u, mean_stretch] = contraction(muscle.id, std::nullopt);
        EXPECT_TRUE(u.allFinite()) << muscle.id;
        const double max = u.row(furthest(u)).norm();
        EXPECT_GT(max, 0.5) << muscle.id;
        EXPECT_LT(max, 25) << muscle.id;
        EXPECT_LT(mean_stretch, 0.97) << muscle.id << " does not shorten";
    }
}

TEST_F(Muscles, ALeftMuscleMovesTheLeftSide) {
    const std::set<std::string> ending_in_the_midline{"procerus", "nasalis_transverse",
                                                      "depressor_septi_nasi", "mentalis",
                                                      "depressor_labii_inferioris"};
    // Every one at rest takes its time: every second muscle, and those that end in the midline
    int turn = 0;
    for (const rig::Muscle& muscle : mimetic()) {
        if (!muscle.paired || (turn++ % 2 && !ending_in_the_midline.count(muscle.id))) continue;
        const Points u = moved(muscle.id, Side::kLeft);
        const double left = of_side(u, Side::kLeft), right = of_side(u, Side::kRight);
        // Muscles that end in the skin of the midline draw it along with its other side, all the more on the columella,
        // which is narrower than a tetrahedron.
        double min_ratio = 4;
        if (ending_in_the_midline.count(muscle.id)) min_ratio = 1.4;
        if (muscle.id == "depressor_septi_nasi") min_ratio = 1.05;
        EXPECT_GT(left, min_ratio * right) << muscle.id << " left " << left << " right " << right;
    }
}

TEST_F(Muscles, LeftAndRightAreMirrorImages) {
    for (const char* muscle :
         {"zygomaticus_major", "frontalis_lateral", "depressor_anguli_oris", "platysma"}) {
        const Points left = moved(muscle, Side::kLeft), right = moved(muscle, Side::kRight);
        for (const char* id : {"ch", "bp", "mc", "mar", "nl2"}) {
            const Vec3 l = at(left, std::string(id) + "_l"), r = at(right, std::string(id) + "_r");
            EXPECT_LT((Vec3(-l.x(), l.y(), l.z()) - r).norm(), 0.3 + 0.1 * l.norm())
                << muscle << " at " << id;
        }
    }
}

TEST_F(Muscles, BothSidesTogetherMoveAsMirrorImages) {
    // The skin of both sides, by pairs of vertices of the simulated surface
    const Face& one = face();
    const geom::MirrorPairs mirror = geom::find_mirror_pairs(
        one.surfaces().simulated_skin(), one.head().vertices, Vec3::UnitX(), 0.0);
    ASSERT_TRUE(mirror.found());
    for (const char* unit : {"AU9", "AU12", "AU45"}) {
        const Points u = moved_mm(one, equilibrium_pose(face(), with_unit(unit)));
        double worst = 0, squares = 0;
        long count = 0;
        for (std::size_t v = 0; v < mirror.partner.size(); ++v) {
            if (mirror.partner[v] < 0) continue;
            const Vec3 here = u.row(static_cast<long>(v)).transpose(),
                       there = u.row(mirror.partner[v]).transpose();
            const double off = (here - mirror.reflect(there)).norm();
            worst = std::max(worst, off);
            squares += off * off;
            ++count;
        }
        EXPECT_LT(std::sqrt(squares / static_cast<double>(count)), 0.03) << unit;
        EXPECT_LT(worst, 0.2) << unit;
    }
}

TEST_F(Muscles, MoreActivationMovesMore) {
    for (const char* muscle : {"zygomaticus_major", "frontalis_medial", "depressor_anguli_oris"}) {
        double before = 0;
        for (double a : {0.3, 0.6, 1.0}) {
            const Points u = a < 1 ? moved(with_muscle(muscle, a)) : moved(muscle);
            const double max = u.row(furthest(u)).norm();
            EXPECT_GT(max, before) << muscle << " at " << a;
            before = max;
        }
    }
}

TEST_F(Muscles, ZygomaticusMajorDrawsTheCornerUpAndOutwards) {
    const Vec3 corner = at(moved("zygomaticus_major"), "ch_l");
    EXPECT_GT(corner.y(), 3);
    EXPECT_GT(corner.x(), 2);
    EXPECT_LT(corner.z(), 0) << "the corner goes back over the teeth";
}

TEST_F(Muscles, FrontalisRaisesTheBrow) {
    const Points medial = moved("frontalis_medial"), lateral = moved("frontalis_lateral");
    EXPECT_GT(at(medial, "bm_l").y(), 3);
    EXPECT_GT(at(medial, "bm_l").y(), 2 * at(medial, "bp_l").y());
    EXPECT_GT(at(lateral, "bp_l").y(), 3);
    EXPECT_GT(at(lateral, "bp_l").y(), 2 * at(lateral, "bm_l").y());
}

TEST_F(Muscles, CorrugatorDrawsTheBrowsTogetherAndDown) {
    const Points u = moved("corrugator_supercilii");
    for (const char* id : {"bm_l", "bp_l"}) {
        EXPECT_LT(at(u, id).x(), -1) << id;
        EXPECT_LT(at(u, id).y(), -1) << id;
    }
}

TEST_F(Muscles, DepressorAnguliOrisDrawsTheCornerDown) {
    EXPECT_LT(at(moved("depressor_anguli_oris"), "ch_l").y(), -3);
}

TEST_F(Muscles, DepressorLabiiInferiorisDrawsTheLowerLipDown) {
    const Points u = moved("depressor_labii_inferioris");
    EXPECT_LT(at(u, "llc_l").y(), -3);
    EXPECT_LT(at(u, "llc_l").y(), at(u, "ulc_l").y() - 2);
}

TEST_F(Muscles, LevatorLabiiRaisesTheUpperLip) {
    const Points u = moved("levator_labii_superioris");
    EXPECT_GT(at(u, "ulc_l").y(), 3);
    EXPECT_GT(at(u, "ls").y(), 2);
    EXPECT_LT(at(u, "stoi").y(), 0.5 * at(u, "stos").y()) << "the lips do not part";
}

TEST_F(Muscles, MentalisRaisesTheChinPadAndTheLowerLip) {
    const Points u = moved("mentalis");
    EXPECT_GT(at(u, "pg").y(), 1);
    EXPECT_GT(at(u, "li").y(), 1);
    EXPECT_GT(at(u, "pg").z(), 0);
}

TEST_F(Muscles, OrbicularisOrisNarrowsTheMouthAndPushesItForward) {
    for (const char* muscle :
         {"orbicularis_oris_upper_peripheral", "orbicularis_oris_lower_peripheral"}) {
        const Points u = moved(muscle);
        EXPECT_LT(at(u, "ch_l").x(), -0.2) << muscle;
        EXPECT_GT(at(u, "ch_r").x(), 0.2) << muscle;
        EXPECT_GT(at(u, "ch_l").z(), 0.5) << muscle;
    }
}

TEST_F(Muscles, MarginalFibresTurnTheRedLipIn) {
    EXPECT_LT(at(moved("orbicularis_oris_upper_marginal"), "ls").z(), -0.5);
    EXPECT_LT(at(moved("orbicularis_oris_lower_marginal"), "li").z(), -0.5);
}

TEST_F(Muscles, TightenedLipsGetNarrowWithoutAKiss) {
    const Points u = moved(with_unit("AU23"));
    EXPECT_GT(at(u, "li").y() - at(u, "ls").y(), 1.0) << "the red of the lips";
    for (const char* corner : {"ch_l", "ch_r"}) {
        EXPECT_LT(std::abs(at(u, corner).x()), 3.5) << corner;
        EXPECT_LT(at(u, corner).z(), 2.5) << corner;
    }
}

TEST_F(Muscles, RisoriusWidensTheMouth) {
    const Points u = moved("risorius");
    EXPECT_GT(at(u, "ch_l").x(), 2);
    EXPECT_LT(std::abs(at(u, "ch_l").y()), 4);
}

TEST_F(Muscles, OrbicularisOculiRaisesTheCheek) {
    EXPECT_GT(at(moved("orbicularis_oculi_orbital"), "nl1_l").y(), 1);
}

TEST_F(Muscles, ASmileKeepsTheVolumeOfTheTissue) {
    face().start(always(neutral()));
    const double rest = face().diagnostics().tissue_volume_m3();
    EXPECT_GT(rest, 1e-4);
    EXPECT_LT(rest, 1e-3);
    equilibrium_pose(face(), with_unit("AU12"));
    EXPECT_NEAR(face().diagnostics().tissue_volume_m3() / rest, 1.0, 0.03);
}

TEST_F(Muscles, AStrongerMuscleMovesMore) {
    Face other = adult_face();
    const double before =
        at(moved_mm(other, equilibrium_pose(other, with_muscle("risorius", 0.5))), "ch_l").norm();
    other.calibration().set_strength("risorius", 2.0);
    EXPECT_GT(
        at(moved_mm(other, equilibrium_pose(other, with_muscle("risorius", 0.5))), "ch_l").norm(),
        1.2 * before);
}

}  // namespace
}  // namespace risorius::face
