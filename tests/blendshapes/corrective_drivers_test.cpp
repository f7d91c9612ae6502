// SPDX-License-Identifier: MIT
// Terms of correctives: what they add up to in the poses that they were made of.
#include "risorius/blendshapes/detail/corrective_drivers.h"

#include <gtest/gtest.h>

#include <functional>

namespace risorius::blendshapes {
namespace {

constexpr int kVertices = 9;

Points some_field(unsigned seed) {
    std::srand(seed);
    return Points::Random(kVertices, 3);
}

/// Two shapes with sides (0, 1 and 2, 3) and one without (4), on a row of vertices from right to left, that are there in poses as
/// `simulated` says: a sum, and anything at all where both of a pair are there.
struct Face {
    rig::Head head;
    MadeShapes shapes;
    std::vector<Unit> units;
    Eigen::VectorXd area = Eigen::VectorXd::Ones(kVertices);

    Face() {
        head.vertices = Points::Zero(kVertices, 3);
        head.vertices.col(0) = Eigen::VectorXd::LinSpaced(kVertices, -0.04, 0.04);
        const auto add = [&](const std::string& name, int partner, bool left) {
            MadeShape& made = shapes.list.emplace_back();
            made.goal.name = name;
            made.goal.partner = partner;
            made.goal.left = left;
            made.shape = blendshapes::sparse(some_field(static_cast<unsigned>(shapes.list.size())));
        };
        add("smile.l", 1, true);
        add("smile.r", 0, false);
        add("pout.l", 3, true);
        add("pout.r", 2, false);
        add("jaw", -1, false);
        for (const std::vector<int>& parts :
             {std::vector{0, 1}, std::vector{2, 3}, std::vector{4}}) {
            Unit unit{"", parts, {}, Points::Zero(kVertices, 3)};
            for (const int part : parts)
                shapes.list[static_cast<std::size_t>(part)].shape.add_to(unit.field, 1);
            units.push_back(unit);
        }
    }
    Points sum(const Eigen::VectorXd& weights) const {
        Points out = Points::Zero(kVertices, 3);
        for (std::size_t s = 0; s < shapes.list.size(); ++s)
            shapes.list[s].shape.add_to(out, weights[static_cast<long>(s)]);
        return out;
    }
    Points simulated(const Eigen::VectorXd& w) const {
        Points out = sum(w);
        unsigned seed = 100;
        // Every product of one of either, bent, and of the two sides
        for (const int a : {0, 1, 4})
            for (const int b : {2, 3}) {
                out += w[a] * w[b] * (1 + 0.5 * w[a] - 0.3 * w[b] * w[b]) * some_field(++seed);
                for (const int c : {0, 1, 2, 3})
                    out += 0.4 * w[a] * w[b] * w[c] * some_field(++seed);
            }
        return out;
    }
    SolvedPose pose(const Eigen::VectorXd& weights) const {
        SolvedPose out;
        out.moved = simulated(weights);
        out.figures.converged = true;
        return out;
    }
    Eigen::VectorXd weights(const Unit& a, double of_a, const Unit& b, double of_b) const {
        Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<long>(shapes.list.size()));
        for (const int part : a.parts) out[part] = of_a;
        for (const int part : b.parts) out[part] = of_b;
        return out;
    }
};

double farthest(const Face& face, const std::vector<blendshapes::DriverField>& drivers,
                const Eigen::VectorXd& weights) {
    Points at = face.sum(weights);
    for (const blendshapes::DriverField& one : drivers) at += one.driver.value(weights) * one.field;
    return (at - face.simulated(weights)).cwiseAbs().maxCoeff();
}

TEST(DriverMaker, PutsEveryPoseOfAPairRightThatItWasGiven) {
    const Face face;
    for (const std::size_t first : {std::size_t{0}, std::size_t{2}}) {
        const Unit &a = face.units[first], &b = face.units[1];
        std::vector<Eigen::VectorXd> looked_at;
        std::vector<SolvedPose> way, alone;
        for (const PairOnItsWay& at : kPairsOnTheirWay) {
            looked_at.push_back(face.weights(a, at.a, b, at.b));
            way.push_back(face.pose(looked_at.back()));
        }
        const std::vector<OneSidedPair> pairs = one_sided_pairs(a, b);
        EXPECT_EQ(pairs.size(), first == 0 ? 6u : 2u);
        for (const OneSidedPair& at : pairs) {
            Eigen::VectorXd weights = face.weights(a, 1, b, 1);
            if (at.a_alone) weights[a.of_side(1 - at.side)] = 0;
            if (at.b_alone) weights[b.of_side(1 - at.side)] = 0;
            looked_at.push_back(weights);
            alone.push_back(face.pose(weights));
        }
        looked_at.push_back(face.weights(a, 1, b, 1));

        DriverMaker maker(face.head, face.shapes, face.units, face.area);
        maker.shapes_are_done();
        maker.add_pair(a, b, face.simulated(looked_at.back()) - face.sum(looked_at.back()),
                       {way.data(), alone.data()});
        const std::vector<blendshapes::DriverField> drivers = maker.take();
        for (const Eigen::VectorXd& weights : looked_at) {
            EXPECT_GT((face.simulated(weights) - face.sum(weights)).cwiseAbs().maxCoeff(), 0.1);
            EXPECT_LT(farthest(face, drivers, weights), 1e-12) << weights.transpose();
        }
        // Nothing where only one of them is there
        EXPECT_EQ(farthest(face, drivers, face.weights(a, 0.7, b, 0)), 0.0);
        EXPECT_EQ(farthest(face, drivers, face.weights(a, 0, b, 1)), 0.0);
    }
}

TEST(DriverMaker, LeavesOutPosesThatDidNotComeToRest) {
    const Face face;
    const Unit &a = face.units[0], &b = face.units[1];
    SolvedPose lost = face.pose(face.weights(a, 1, b, 0.5));
    lost.figures.converged = false;
    const std::vector<SolvedPose> way(kPairsOnTheirWay.size(), lost), alone(6, lost);
    const Eigen::VectorXd whole = face.weights(a, 1, b, 1);
    DriverMaker maker(face.head, face.shapes, face.units, face.area);
    maker.add_pair(a, b, face.simulated(whole) - face.sum(whole), {way.data(), alone.data()});
    const std::vector<blendshapes::DriverField> drivers = maker.take();
    EXPECT_EQ(drivers.size(), 2u);  // left and right
    EXPECT_LT(farthest(face, drivers, whole), 1e-12);
}

}  // namespace
}  // namespace risorius::blendshapes
