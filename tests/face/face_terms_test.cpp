// SPDX-License-Identifier: MIT
// A force that is new to the face: added to its list of energy terms, it acts as its law says. A force on the mandible is one class.
#include "risorius/face/solver/detail/face_terms.h"

#include "face/adult_face.h"
#include "force_term_checks.h"
#include "message_of.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/solve/energy_term.h"

namespace risorius::face {
namespace {

const Quality kCoarse{.name = "coarse", .shell_vertices = 300};

/// E = k/2 |x - p|^2 on one node.
class SpringToPoint : public solve::EnergyTerm {
  public:
    SpringToPoint(int node, const Vec3& p, double k_n_per_m) : node_(node), p_(p), k_(k_n_per_m) {}
    double add_potential(const solve::ImplicitStep&, const Points& x,
                         Points& gradient) const override {
        const Vec3 away = x.row(node_).transpose() - p_;
        gradient.row(node_) += k_ * away.transpose();
        return 0.5 * k_ * away.squaredNorm();
    }
    void add_hessian(const solve::ImplicitStep&, const Points&, solve::Curvature,
                     solve::HessianBuilder& hessian) const override {
        hessian.add_diagonal(node_, k_);
    }
    void add_metric(double, solve::MetricBuilder& metric) const override {
        metric.add_diagonal(node_, k_);
    }

  private:
    int node_;
    Vec3 p_;
    double k_;
};

/// The skin node at the middle of the lower lip, which the extra iterations of the mouth move too.
int lip_node(const Face& face) {
    const Vec3 lip = face.head().landmark("li");
    const Points skin = face.diagnostics().rest_skin_nodes();
    int nearest = 0;
    (skin.rowwise() - lip.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    return node_of(nearest, kSkin);
}

TEST(FaceTerms, ANewForceKeepsTheDefaultsOfEnergyTerm) {
    const SpringToPoint spring(1, Vec3(0.01, 0, 0), 30);
    const Points x = testing_of::random_points(3, 0.02, 7);
    const solve::ImplicitStep step{0, 0.01, x};
    testing_of::expect_gradient_of_potential(spring, step, x, 1e-5, 1e-6);
    testing_of::expect_force_is_minus_slope_of_energy(spring, 0, x, 1e-5, 1e-6);
    testing_of::expect_hessian_of_potential(spring, step, x, 1e-5, 1e-6);
    testing_of::expect_projection(spring, step, x);
}

TEST(FaceTerms, ASpringAddedToTheFacePullsAsItsLawSays) {
    Face plain = adult_face(kCoarse), sprung = adult_face(kCoarse);
    const int node = lip_node(plain);
    const Vec3 rest = plain.statics().nodes().row(node).transpose();
    const Vec3 p = rest + Vec3(0, 0, 5e-3);
    const double k = 20;
    sprung.add_force(std::make_shared<SpringToPoint>(node, p, k));

    EXPECT_TRUE(sprung.solve_equilibrium(neutral().excitation, neutral()).converged);
    plain.solve_equilibrium(neutral().excitation, neutral());
    const Vec3 x = sprung.statics().nodes().row(node).transpose();
    EXPECT_GT(x.z() - rest.z(), 0.1e-3);
    EXPECT_LT((x - p).norm(), (rest - p).norm());

    // Tissue balances the spring: its own gradient there is - k (x - p)
    const Points own =
        plain.statics().gradient(sprung.statics().nodes(), neutral().excitation, neutral());
    const Points whole =
        sprung.statics().gradient(sprung.statics().nodes(), neutral().excitation, neutral());
    EXPECT_LT((Vec3((whole - own).row(node).transpose()) - k * (x - p)).norm(), 1e-9);
    EXPECT_LT(whole.row(node).norm(), 0.02 * k * (x - p).norm());
}

TEST(FaceTerms, ASpringActsInStepsOfMotionAndInTheIterationsOfTheMouth) {
    Quality quality = kCoarse;
    quality.mouth_passes = 6;
    quality.iterations = 12;
    Face face = adult_face(quality);
    const int node = lip_node(face);
    const Vec3 rest = face.statics().nodes().row(node).transpose();
    face.add_force(std::make_shared<SpringToPoint>(node, rest + Vec3(0, 0, 5e-3), 20));
    face.start(always(neutral()));
    for (int i = 0; i < 60; ++i) face.step(always(neutral()));
    const double moved = face.statics().nodes().row(node).z() - rest.z();
    face.solve_equilibrium(neutral().excitation, neutral());
    EXPECT_NEAR(moved, face.statics().nodes().row(node).z() - rest.z(), 0.2e-3);
}

TEST(FaceTerms, ADriveAsConstructedMeansThatNothingIsActive) {
    Face face = adult_face(kCoarse);
    const track::Drive nothing{};
    face.start(always(nothing));
    face.step(always(nothing));
    const FacePose pose = face.pose_at(0.1, always(nothing));
    Face other = adult_face(kCoarse);
    other.start(always(neutral()));
    other.step(always(neutral()));
    EXPECT_EQ(pose.vertices, other.pose_at(0.1, always(neutral())).vertices);
    face.solve_equilibrium(nothing.excitation, nothing);
    other.solve_equilibrium(neutral().excitation, neutral());
    EXPECT_EQ(face.pose().vertices, other.pose().vertices);
    EXPECT_EQ(face.diagnostics().driven(nothing).excitation,
              other.diagnostics().driven(neutral()).excitation);
}

TEST(FaceTerms, TheEnergyAndTheTetrahedraOfAFaceCanBeAskedFor) {
    Face face = adult_face(kCoarse);
    EXPECT_EQ(face.diagnostics().tets().rows(), face.diagnostics().tet_count());
    EXPECT_LT(face.diagnostics().tets().maxCoeff(), face.diagnostics().node_count());
    const double rest = face.diagnostics().energy_j();
    const track::Drive smile = with_muscle("zygomaticus_major", 0.5);
    face.solve_equilibrium(smile.excitation, smile);
    EXPECT_LT(face.diagnostics().energy_j(), rest - 1e-6);  // muscles have given their work
    face.solve_equilibrium({}, {});
    EXPECT_NEAR(face.diagnostics().energy_j(), rest, 1e-6);
}

/// The cross-section of a muscle on this head.
double area_m2(const Face& face, const std::string& muscle) {
    const double size = face.head().size;
    for (const rig::Muscle& one : rig::adult().rig.muscles.muscles)
        if (one.id == muscle) return one.area_m2 * size * size;
    return 0;
}

TEST(FaceTerms, AMuscleThatActsIsShorterAndPullsAndItsLandmarkMoves) {
    Face face = adult_face(kCoarse);
    const std::string muscle = "risorius";
    const MuscleState rest = face.diagnostics().muscle_state(muscle, Side::kLeft).value();
    const Vec3 corner = face.diagnostics().landmark("nl3_l");
    EXPECT_LT((corner - face.head().landmark("nl3_l")).norm(), 1e-9);
    const track::Drive smile = with_muscle(muscle, 0.5, Side::kLeft);
    face.solve_equilibrium(smile.excitation, smile);
    const MuscleState now = face.diagnostics().muscle_state(muscle, Side::kLeft).value();
    EXPECT_GT(rest.length_m, 0.02);
    EXPECT_LT(now.length_m, rest.length_m);
    EXPECT_GT(now.force_n, rest.force_n + 0.05);
    EXPECT_NEAR(now.stretch / rest.stretch, now.length_m / rest.length_m, 0.05);
    EXPECT_GT((face.diagnostics().landmark("nl3_l") - corner).norm(), 0.3e-3);
    // Stress is force over the cross-section of the table, on a head of this size
    EXPECT_NEAR(now.stress_pa.value(), now.force_n / area_m2(face, muscle), 1e-6);
}

TEST(FaceTerms, AVolumeMuscleTellsLengthForceAndStressToo) {
    Face face = adult_face(kCoarse);
    const std::string muscle = "zygomaticus_major";
    const MuscleState rest = face.diagnostics().muscle_state(muscle, Side::kLeft).value();
    const track::Drive smile = with_muscle(muscle, 0.5, Side::kLeft);
    face.solve_equilibrium(smile.excitation, smile);
    const MuscleState left = face.diagnostics().muscle_state(muscle, Side::kLeft).value(),
                      right = face.diagnostics().muscle_state(muscle, Side::kRight).value();
    EXPECT_NEAR(rest.length_m, 0.05, 0.02);
    EXPECT_LT(left.length_m, 0.95 * rest.length_m);
    EXPECT_GT(right.length_m, 0.97 * rest.length_m);
    EXPECT_GT(left.force_n, right.force_n + 0.5);
    EXPECT_NEAR(left.stress_pa.value(), left.force_n / area_m2(face, muscle), 1e-6);
}

TEST(FaceTerms, AMuscleOfTheJawIsKnownWhileMusclesMoveIt) {
    Face face = adult_face(kCoarse);
    const std::string muscle = "digastric_anterior";
    EXPECT_FALSE(face.diagnostics().muscle_state(muscle, Side::kLeft)) << "channels place the jaw";
    face.drive_jaw_by(track::JawDrive::kMuscles);
    const track::Drive pull = with_muscle(muscle, 0.3);
    face.start([&](double) { return pull; });
    const MuscleState now = face.diagnostics().muscle_state(muscle, Side::kLeft).value();
    EXPECT_GT(now.force_n, 1);
    EXPECT_GT(now.length_m, 0.01);
    EXPECT_NEAR(now.stress_pa.value(), now.force_n / area_m2(face, muscle), 1e-6);
}

TEST(FaceTerms, WrongNamesAndDrivesAreRefused) {
    Face face = adult_face(kCoarse);
    EXPECT_EQ(
        message_of([&] { face.diagnostics().muscle_state("zygomaticus_mayor", Side::kLeft); }),
        "muscle: expected one of the rig's muscles (did you mean \"zygomaticus_major\"?), "
        "found \"zygomaticus_mayor\"");
    EXPECT_EQ(message_of([&] { face.diagnostics().landmark("ch_ll"); }),
              "landmark: expected one of the head's landmarks (did you mean \"ch_l\"?), found "
              "\"ch_ll\"");
    track::Drive wrong;
    wrong.excitation = Eigen::VectorXd::Zero(3);
    EXPECT_EQ(message_of([&] { face.start([&](double) { return wrong; }); }),
              "drive: excitation: expected 84 values, one for each column of the rig's channels, "
              "found 3");
    wrong = with_muscle("risorius", std::nan(""));
    EXPECT_EQ(message_of([&] { face.start([&](double) { return wrong; }); }),
              "drive: excitation: expected finite numbers, found NaN or infinity");
}

constexpr double kStiffness_n_per_m = 40;

// A spring between node 0 and a point of the mandible.
class Rope : public FaceTerm {
  public:
    explicit Rope(const Vec3& rest) : rest_(rest), end_(rest) {}
    double add_potential(const solve::ImplicitStep&, const Points& x,
                         Points& gradient) const override {
        const Vec3 off = x.row(0).transpose() - end_;
        gradient.row(0) += kStiffness_n_per_m * off.transpose();
        return 0.5 * kStiffness_n_per_m * off.squaredNorm();
    }
    void add_hessian(const solve::ImplicitStep&, const Points&, solve::Curvature,
                     solve::HessianBuilder&) const override {}
    void add_metric(double, solve::MetricBuilder&) const override {}
    void set_boundary_conditions(const BoundaryState& boundary) override {
        move_mandible(boundary.mandible);
    }
    void move_mandible(const Rigid& mandible) override { end_ = mandible * rest_; }
    void add_mandible_gradient(const Rigid&, const Points& x, const Points&,
                               Wrench& sum) const override {
        sum.add(-kStiffness_n_per_m * (x.row(0).transpose() - end_), end_);
    }

  private:
    Vec3 rest_, end_;
};

// An energy that knows nothing of the mandible.
class Weight : public solve::EnergyTerm {
  public:
    double add_potential(const solve::ImplicitStep&, const Points& x,
                         Points& gradient) const override {
        gradient(0, 1) += 0.3;
        return 0.3 * x(0, 1);
    }
    void add_hessian(const solve::ImplicitStep&, const Points&, solve::Curvature,
                     solve::HessianBuilder&) const override {}
    void add_metric(double, solve::MetricBuilder&) const override {}
};

TEST(MandibleTerms, ForceOnTheMandibleIsTheSlopeOfTheEnergyByItsMotion) {
    FaceTerms terms;
    terms.add(std::make_shared<Weight>());
    terms.add(std::make_shared<Rope>(Vec3(0.01, -0.05, 0.04)), {.last_on_mandible = true});
    terms.add(std::make_shared<Rope>(Vec3(-0.02, -0.03, 0.06)));
    const Points x = Points::Constant(1, 3, 0.02);
    const auto energy_at = [&](const Rigid& mandible) {
        terms.move_mandible(mandible);
        Points gradient = Points::Zero(1, 3);
        return terms.add_potential({0.0, 0.01, x}, x, gradient).sum();
    };

    Rigid opened = Rigid::Identity();
    opened.rotate(Eigen::AngleAxisd(0.2, Vec3::UnitX()));
    BoundaryState boundary;
    boundary.mandible = opened;
    terms.set_boundary_conditions(boundary);
    const Wrench wrench = terms.mandible_gradient(opened, x, Points::Zero(1, 3));
    constexpr double kStep = 1e-5;  // m and rad; the energy is quadratic, so only rounding is left
    for (int k = 0; k < 3; ++k) {
        const auto shifted = [&](double by) {
            return energy_at(Rigid(Eigen::Translation3d(by * Vec3::Unit(k))) * opened);
        };
        const auto rotated = [&](double by) {
            return energy_at(Rigid(Eigen::AngleAxisd(by, Vec3::Unit(k))) * opened);
        };
        EXPECT_NEAR(wrench.force_n[k], (shifted(kStep) - shifted(-kStep)) / (2 * kStep), 1e-8);
        EXPECT_NEAR(wrench.torque_nm[k], (rotated(kStep) - rotated(-kStep)) / (2 * kStep), 1e-8);
    }
}

TEST(MandibleTerms, MatricesGetTermsWithChangingPairsLast) {
    FaceTerms terms;
    terms.add(std::make_shared<Weight>(), {.changing_pairs = true});
    terms.add(std::make_shared<Weight>());
    EXPECT_EQ(terms.order_of_matrices(), (std::vector<std::size_t>{1, 0}));
    EXPECT_EQ(terms.list()[0].face_term, nullptr) << "it does not depend on the mandible";
}

}  // namespace
}  // namespace risorius::face
