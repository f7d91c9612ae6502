// SPDX-License-Identifier: MIT
// Fields of a face: they are those of its energy, its muscles and its pose.
#include "risorius/face/fields.h"

#include "face/adult_face.h"
#include "risorius/face/statics.h"

namespace risorius::face {
namespace {

const Quality kFieldsCoarse{.name = "coarse", .shell_vertices = 300};

TEST(Fields, VonMisesOfSimpleStresses) {
    Eigen::Matrix<double, 1, 6> stress;
    stress << 7, 0, 0, 0, 0, 0;  // tension
    EXPECT_NEAR(von_mises(stress), 7, 1e-12);
    stress << 5, 5, 5, 0, 0, 0;  // pressure
    EXPECT_NEAR(von_mises(stress), 0, 1e-12);
    stress << 0, 0, 0, 0, 2, 0;  // shear
    EXPECT_NEAR(von_mises(stress), 2 * std::sqrt(3.0), 1e-12);
}

TEST(Fields, RestHasNoStressAndASmileHas) {
    Face face = adult_face(kFieldsCoarse);
    face.solve_equilibrium(neutral().excitation, neutral());
    const FaceFields rest = face.fields().now();
    EXPECT_LT((rest.tissue.volume_ratio.array() - 1).abs().maxCoeff(), 1e-3);
    double at_rest = 0, smiling = 0;
    for (long t = 0; t < rest.tissue.stress_pa.rows(); ++t)
        at_rest = std::max(at_rest, von_mises(rest.tissue.stress_pa.row(t)));
    const track::Drive smile = with_muscle("zygomaticus_major", 0.5);
    face.solve_equilibrium(smile.excitation, smile);
    const FaceFields fields = face.fields().now();
    for (long t = 0; t < fields.tissue.stress_pa.rows(); ++t)
        smiling = std::max(smiling, von_mises(fields.tissue.stress_pa.row(t)));
    EXPECT_GT(smiling, 20 * at_rest);
    EXPECT_EQ(fields.tissue.nodes, face.statics().nodes().topRows(fields.tissue.nodes.rows()));
    EXPECT_EQ(fields.solids.nodes, face.statics().nodes().bottomRows(fields.solids.nodes.rows()));
}

TEST(Fields, SegmentsAndCellsOfMusclesAreTheirStates) {
    Face face = adult_face(kFieldsCoarse);
    track::Drive drive = with_muscle("zygomaticus_major", 0.5, Side::kLeft);
    drive = with_muscle("risorius", 0.6, Side::kLeft, drive);
    face.solve_equilibrium(drive.excitation, drive);
    const FaceFields fields = face.fields().now();
    const auto check = [&](const char* muscle, const std::vector<FibreState>& states) {
        const int column = channels().column(muscle, Side::kLeft);
        double stretch = 0;
        int count = 0;
        for (const FibreState& state : states) {
            if (state.column != column) continue;
            ++count;
            stretch += state.stretch;
            EXPECT_NEAR(state.activation, drive.excitation[column], 1e-9);
            EXPECT_NEAR(state.direction.norm(), 1, 1e-9);
        }
        ASSERT_GT(count, 0) << muscle;
        const MuscleState known = face.diagnostics().muscle_state(muscle, Side::kLeft).value();
        EXPECT_NEAR(stretch / count, known.stretch, 0.05) << muscle;
    };
    check("zygomaticus_major", fields.solids.state);
    check("risorius", fields.fibres.state);
    for (long c = 0; c < fields.solids.cells.rows(); ++c)
        EXPECT_GT(fields.solids.volume_ratio[c], 0.8);
}

TEST(Fields, FollowTheHeadWithoutStrain) {
    Face face = adult_face(kFieldsCoarse);
    const track::Drive still = neutral();
    const track::Drive turned = with_kinematic(track::Kinematic::kHeadYaw, 20);
    face.solve_equilibrium(still.excitation, still);
    const FaceFields straight = face.fields().now();
    face.set_gravity(std::nullopt);
    face.solve_equilibrium(turned.excitation, turned);
    const FaceFields aside = face.fields().now();
    EXPECT_GT((aside.tissue.nodes - straight.tissue.nodes).rowwise().norm().maxCoeff(), 0.02);
    EXPECT_LT((aside.tissue.volume_ratio - straight.tissue.volume_ratio).cwiseAbs().maxCoeff(),
              0.01);
    // The skin of the pose turns with it
    const Points skin = face.pose().vertices;
    const int vertex = rig::adult().vertex("prn");
    double nearest = 1;
    for (long n = 0; n < aside.tissue.nodes.rows(); ++n)
        nearest = std::min(nearest, (aside.tissue.nodes.row(n) - skin.row(vertex)).norm());
    EXPECT_LT(nearest, 0.01);
}

TEST(Fields, ContactPressureIsWhereLipsPress) {
    Face face = adult_face(kFieldsCoarse);
    const track::Drive press = with_unit("AU24");
    face.solve_equilibrium(press.excitation, press);
    const TissueFields fields = face.fields().now().tissue;
    EXPECT_GE(fields.contact_pa.minCoeff(), 0);
    int where = 0;
    EXPECT_GT(fields.contact_pa.maxCoeff(&where), 100);
    const Vec3 mouth = face.head().landmark("sto");
    EXPECT_LT((fields.rest.row(where).transpose() - mouth).norm(), 0.06);
}

}  // namespace
}  // namespace risorius::face
