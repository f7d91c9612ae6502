// SPDX-License-Identifier: MIT
// Mouth shapes of speech on the adult: lips as far apart, as wide and as far forward as in conversation.
#include <gtest/gtest.h>

#include "risorius/blendshapes/detail/shape_goals.h"
#include "risorius/blendshapes/detail/shape_solver.h"
#include "risorius/scene/rig_files.h"

namespace risorius::blendshapes {
namespace {

/// Of conversational speech, mm: between the inner borders of the lips; against rest the width of the mouth and how far the upper lip is
/// forward. Estimates, ordered like published lip measurements (Greta's table of visemes), 30 percent.
struct Lips {
    const char* viseme;
    double gap_mm, wider_mm, forward_mm;
};
constexpr Lips kSpeech[] = {{"viseme_PP", 0, -1, 0.5},
                            {"viseme_SS", 2.8, 2, 0},
                            {"viseme_aa", 14.2, 0, 0},
                            {"viseme_oh", 8, -10, 4.6},
                            {"viseme_ou", 5.5, -12, 5.2}};

TEST(Visemes, LipsAreWhereSpeechHasThem) {
    const scene::RigFiles files =
        scene::read_rig_files(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    const ShapeSolver solver(files, face::quality_named("preview"), 2);
    const ShapeSet set = shape_set(files.rig, "visemes", {}, "rig");
    std::vector<track::Drive> drives;
    for (const Lips& lips : kSpeech)
        drives.push_back(set.goals[static_cast<std::size_t>(set.index(lips.viseme).value())].drive);
    const std::vector<SolvedPose> poses = solver.solve(drives, {});
    const rig::Head& head = solver.face().head();
    const auto moved_mm = [&](const SolvedPose& pose, const char* landmark) {
        long nearest = 0;
        (head.vertices.rowwise() - head.landmark(landmark).transpose())
            .rowwise()
            .squaredNorm()
            .minCoeff(&nearest);
        return Vec3(1e3 * pose.moved.row(nearest).transpose());
    };
    const double gap_at_rest_mm = 1e3 * (head.landmark("stos") - head.landmark("stoi")).y();
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const Lips& lips = kSpeech[i];
        SCOPED_TRACE(lips.viseme);
        EXPECT_TRUE(poses[i].figures.converged);
        const auto within = [&](double wanted, double min_mm) {
            return std::max(min_mm, 0.3 * std::abs(wanted));
        };
        EXPECT_NEAR(
            gap_at_rest_mm + moved_mm(poses[i], "stos").y() - moved_mm(poses[i], "stoi").y(),
            lips.gap_mm, within(lips.gap_mm, 1.6));
        EXPECT_NEAR(moved_mm(poses[i], "ch_l").x() - moved_mm(poses[i], "ch_r").x(), lips.wider_mm,
                    within(lips.wider_mm, 1.6));
        if (lips.forward_mm > 1) {
            EXPECT_GT(moved_mm(poses[i], "ls").z(), 1.5);
        }
    }
}

}  // namespace
}  // namespace risorius::blendshapes
