// SPDX-License-Identifier: MIT
// The equilibrium of a face, and how it answers to its drive. A coarse shell: the laws hold on any.
#include <random>

#include "face/adult_face.h"

namespace risorius::face {
namespace {

const Quality kCoarse{.name = "coarse", .shell_vertices = 300};

int column(const std::string& muscle, Side side) { return channels().column(muscle, side); }

/// A pose with muscles, jaw and lids away from their limits.
track::Drive some_drive() {
    track::Drive drive = with_muscle("zygomaticus_major", 0.5);
    drive = with_muscle("frontalis_medial", 0.4, {}, drive);
    drive = with_muscle("levator_palpebrae_superioris", -0.3, {}, drive);
    return with_kinematic(track::Kinematic::kJawOpen, 0.2, drive);
}

/// One face for all tests, in that pose.
Face& posed() {
    static Face face = adult_face(kCoarse);
    face.solve_equilibrium(some_drive().excitation, some_drive());
    return face;
}

Points noise(long rows, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Points out(rows, 3);
    for (long i = 0; i < out.size(); ++i) out.data()[i] = uniform(random);
    return out;
}

TEST(FaceStatics, SettlesToForcesThatBalance) {
    Face face = adult_face(kCoarse);
    const StepStats figures = face.solve_equilibrium(some_drive().excitation, some_drive());
    EXPECT_TRUE(figures.converged);
    const Points equilibrium_pose =
        face.statics().gradient(face.statics().nodes(), face.activation(), some_drive());
    const Points pulled =
        face.statics().gradient(face.statics().nodes(), 1.1 * face.activation(), some_drive());
    // A tenth more of the muscles pulls with some 0.1 N; what is left moves nothing by some micrometres, though pressed teeth
    // and lips are so stiff there
    EXPECT_LT(equilibrium_pose.norm(), 1e-2 * pulled.norm());
    EXPECT_LT(face.statics().solve(equilibrium_pose).rowwise().norm().maxCoeff(), 5e-6);
}

// Fits and blend shapes give poses to whichever face is free.
TEST(FaceStatics, AnEquilibriumFromRestHasTheSameBitsWhateverTheFaceDidBefore) {
    const track::Drive purse = with_unit("AU24"), pull = some_drive();
    Face fresh = adult_face(kCoarse), used = adult_face(kCoarse);
    const auto from_rest = [](Face& face, const track::Drive& drive) {
        face.start(always(neutral()));
        face.solve_equilibrium(drive.excitation, drive);
        return face.statics().nodes();
    };
    from_rest(used, purse);
    EXPECT_EQ(from_rest(used, pull), from_rest(fresh, pull));
    EXPECT_EQ(from_rest(fresh, purse), from_rest(used, purse));
}

// A search begins at what another face found.
TEST(FaceStatics, AFaceGoesBackToAnEquilibriumThatWasKeptAndIsAsIfItHadDoneNothingElse) {
    const track::Drive purse = with_unit("AU24"), pull = some_drive();
    track::Drive more = pull;
    more.excitation *= 1.1;
    Face finder = adult_face(kCoarse), other = adult_face(kCoarse);
    finder.solve_equilibrium(pull.excitation, pull);
    const KeptEquilibrium kept = finder.statics().keep();
    const Points vertices = finder.pose().vertices;
    other.solve_equilibrium(purse.excitation, purse);
    other.statics().go_back_to(kept);
    EXPECT_EQ(other.statics().nodes(), kept.nodes);
    EXPECT_EQ(other.pose().vertices, vertices);
    const auto onwards = [&](Face& face) {
        face.statics().go_back_to(kept);
        const StepStats figures = face.solve_equilibrium(more.excitation, more);
        EXPECT_TRUE(figures.converged);
        return figures.evaluations;
    };
    const int near = onwards(other);
    onwards(finder);
    EXPECT_EQ(other.statics().nodes(), finder.statics().nodes());
    // It is nearer than the rest.
    other.start(always(neutral()));
    EXPECT_LT(2 * near, other.solve_equilibrium(more.excitation, more).evaluations);
    EXPECT_LT((other.pose().vertices - finder.pose().vertices).rowwise().norm().maxCoeff(), 0.1e-3);
    other.drive_jaw_by(track::JawDrive::kMuscles);
    EXPECT_THROW(other.statics().go_back_to(kept), std::logic_error);
}

TEST(FaceStatics, SaysThatItHasNotConverged) {
    Face face = adult_face(kCoarse);
    EXPECT_FALSE(
        face.solve_equilibrium(some_drive().excitation, some_drive(), {.iterations = 3}).converged);
}

TEST(FaceStatics, SensitivitiesForetellSettledPoses) {
    struct Parameter {
        std::string name;
        int column;
        std::optional<track::Kinematic> channel;
        double step;
    };
    const std::vector<Parameter> parameters{
        {"smile", column("zygomaticus_major", Side::kLeft), {}, 0.02},
        {"brow", column("frontalis_medial", Side::kRight), {}, 0.05},
        {"lid", column("levator_palpebrae_superioris", Side::kLeft), {}, 0.05},
        {"jaw", -1, track::Kinematic::kJawOpen, 0.02}};
    Face& face = posed();
    std::vector<int> columns;
    std::vector<track::Kinematic> kinematic;
    for (const Parameter& p : parameters) {
        if (p.channel)
            kinematic.push_back(*p.channel);
        else
            columns.push_back(p.column);
    }
    const std::vector<Points> slopes = face.statics().sensitivities(columns, kinematic);
    ASSERT_EQ(slopes.size(), parameters.size());
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const auto pose_at = [&](double amount) {
            track::Drive drive = some_drive();
            if (parameters[i].channel)
                drive.kinematic[static_cast<std::size_t>(*parameters[i].channel)] += amount;
            else
                drive.excitation[parameters[i].column] += amount;
            EXPECT_TRUE(face.solve_equilibrium(drive.excitation, drive).converged)
                << parameters[i].name;
            return face.pose().vertices;
        };
        const double step = parameters[i].step;
        const Points above = pose_at(step), below = pose_at(-step);
        const Points found = (above - below) / (2 * step);
        EXPECT_LT((found - slopes[i]).norm(), 0.1 * found.norm()) << parameters[i].name;
    }
}

TEST(FaceStatics, TheAdjointGivesTheSameSlopesOfANumber) {
    Face& face = posed();
    const Points by_vertex = noise(face.pose().vertices.rows(), 5);
    const Points by_node = face.statics().pull_back(by_vertex);
    // A muscle far from what touches: slopes by the adjoint take contact planes as they are
    const int brow = column("frontalis_medial", Side::kLeft);
    const std::vector<Points> slope = face.statics().sensitivities(std::vector<int>{brow}, {});
    const double forward = by_vertex.cwiseProduct(slope[0]).sum();

    Eigen::VectorXd more = face.activation();
    more[brow] += 1e-3;
    const Points dg =
        (face.statics().gradient(face.statics().nodes(), more, some_drive()) -
         face.statics().gradient(face.statics().nodes(), face.activation(), some_drive())) /
        1e-3;
    const double backward = -face.statics().solve(by_node).cwiseProduct(dg).sum();
    // Forward with the folds of the skin, backward without
    EXPECT_NEAR(backward, forward, 0.1 * std::abs(forward));

    // H^-1 is symmetric
    const Points a = noise(face.statics().nodes().rows(), 6),
                 b = noise(face.statics().nodes().rows(), 7);
    const double ab = face.statics().solve(a).cwiseProduct(b).sum();
    const double ba = face.statics().solve(b).cwiseProduct(a).sum();
    EXPECT_NEAR(ab, ba, 1e-8 * std::abs(ab));
}

TEST(FaceStatics, SlopesAreRefusedWhileMusclesMoveTheJaw) {
    Face face = adult_face(kCoarse);
    face.drive_jaw_by(track::JawDrive::kMuscles);
    EXPECT_THROW(face.statics().solve(face.statics().nodes()), std::logic_error);
}

}  // namespace
}  // namespace risorius::face
