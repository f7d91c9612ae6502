// SPDX-License-Identifier: MIT
// The parts of the search for action units: few keys for several curves, and a model through equilibria.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "paths.h"
#include "risorius/inverse/detail/joint_keys.h"
#include "risorius/inverse/detail/unit_choice.h"
#include "risorius/inverse/detail/unit_model.h"
#include "risorius/inverse/detail/unit_sources.h"
#include "risorius/scene/rig_files.h"

namespace risorius::inverse {
namespace {

constexpr long kFrames = 30;

std::vector<double> times() {
    std::vector<double> out;
    for (long t = 0; t < kFrames; ++t) out.push_back(static_cast<double>(t) / 30.0);
    return out;
}

/// Two curves: a bump, and one that follows it. The face sees their sum by `sum` and each of them by `each`.
std::vector<FrameCost> costs(const Eigen::MatrixXd& wanted, double sum, double each) {
    std::vector<FrameCost> out;
    for (long t = 0; t < wanted.cols(); ++t) {
        FrameCost cost{Eigen::MatrixXd::Constant(2, 2, sum), {}};
        cost.A.diagonal().array() += each;
        cost.b = cost.A * wanted.col(t);
        out.push_back(cost);
    }
    return out;
}

Eigen::MatrixXd bumps() {
    Eigen::MatrixXd out(2, kFrames);
    for (long t = 0; t < kFrames; ++t) {
        out(0, t) =
            0.8 * std::pow(std::sin(3.14159265 * static_cast<double>(t) / (kFrames - 1)), 2);
        out(1, t) = 0.1 + 0.02 * std::sin(static_cast<double>(t));  // a tremor
    }
    return out;
}

double cost_of(const std::vector<FrameCost>& costs, const Eigen::MatrixXd& values) {
    double out = 0;
    for (std::size_t t = 0; t < costs.size(); ++t)
        out += costs[t].of(values.col(static_cast<long>(t)));
    return out;
}

TEST(JointKeys, CostAtMostWhatIsAllowed) {
    const std::vector<double> at = times();
    const std::vector<FrameCost> frames = costs(bumps(), 1, 0.1);
    std::size_t last = 1000;
    for (const double allowed : {1e-4, 1e-3, 1e-2}) {
        const auto keys = joint_keys(at, frames, bumps(), allowed);
        EXPECT_LE(cost_of(frames, values_of_keys(keys, at)),
                  cost_of(frames, bumps()) + 1.01 * allowed);
        const std::size_t count = keys[0].size() + keys[1].size();
        EXPECT_LE(count, last);
        last = count;
    }
    EXPECT_LE(last, 7u);
}

TEST(JointKeys, ACurveThatMovesTheFaceLittleHasFewKeys) {
    const std::vector<double> at = times();
    std::vector<FrameCost> frames = costs(bumps(), 0, 1);
    for (FrameCost& cost : frames) {  // the face hardly sees the tremor
        cost.A(1, 1) *= 1e-4;
        cost.b[1] *= 1e-4;
    }
    const auto keys = joint_keys(at, frames, bumps(), 1e-4);
    EXPECT_EQ(keys[1].size(), 1u);
    EXPECT_GE(keys[0].size(), 3u);
}

TEST(JointKeys, TellWhatACurveIsWorth) {
    // Of two curves that the face hardly tells apart, one makes up for the other.
    const std::vector<FrameCost> frames = costs(bumps(), 1, 1e-3), apart = costs(bumps(), 0, 1);
    const Eigen::Vector2d second(0, 1), difference(1, -1);
    double alone = 0;
    for (long t = 0; t < kFrames; ++t) alone += 0.5 * std::pow(bumps()(1, t), 2);
    EXPECT_NEAR(cost_of_zero(apart, bumps(), second), alone, 1e-9);
    EXPECT_LT(cost_of_zero(frames, bumps(), second), 3e-3 * alone);
    // As much as a search without the curve finds
    double without = -cost_of(frames, bumps());
    for (const FrameCost& cost : frames) without -= 0.5 * cost.b[0] * cost.b[0] / cost.A(0, 0);
    EXPECT_NEAR(cost_of_zero(frames, bumps(), second), without, 1e-9);
    EXPECT_GT(cost_of_zero(frames, bumps(), difference), 0);
}

TEST(JointKeys, StayWithinTheirRange) {
    const std::vector<double> at = times();
    Eigen::MatrixXd beyond = bumps();
    beyond.row(0) = (1.5 * beyond.row(0)).array() - 0.1;
    for (const auto& keys : joint_keys(at, costs(beyond, 1, 0.1), beyond, 1e-3))
        for (const track::Key& key : keys) {
            EXPECT_GE(key.value, 0);
            EXPECT_LE(key.value, 1);
        }
}

TEST(UnitModel, PassesThroughEveryEquilibrium) {
    const auto face = [](const Eigen::VectorXd& w) {
        return Eigen::VectorXd(
            Eigen::Vector3d(w[0] - 0.3 * w[0] * w[0], w[1] + 0.2 * w[0] * w[1], 0.1 * w[0]));
    };
    Eigen::MatrixXd shapes(3, 2);
    shapes << 1, 0, 0, 1, 0.1, 0;
    UnitModel model({Eigen::Vector2d::Zero(), Eigen::Vector3d::Zero(), shapes});
    const std::vector<Eigen::VectorXd> seen{Eigen::Vector2d(0.5, 0.2), Eigen::Vector2d(0.9, 0.8)};
    // Between them it is better than the sum of shapes.
    const Eigen::Vector2d between(0.7, 0.5);
    const double before = (model.moved(between) - face(between)).norm();
    for (const Eigen::VectorXd& w : seen) model.add(w, face(w));
    for (const Eigen::VectorXd& w : seen) EXPECT_LT((model.moved(w) - face(w)).norm(), 1e-3);
    EXPECT_LT((model.moved(between) - face(between)).norm(), 0.3 * before);
    const UnitModel::Tangent tangent = model.tangent(between);
    EXPECT_LT((tangent.at_zero + tangent.way * between - model.moved(between)).norm(), 1e-12);
    const UnitModel::Tangent second = model.tangent(between, {false, true});
    EXPECT_EQ(second.at_zero, tangent.at_zero);
    EXPECT_EQ(second.way.col(1), tangent.way.col(1));
    EXPECT_TRUE(second.way.col(0).isZero(0.0));
}

/// What goes with what on the adult.
class UnitChoices : public testing::Test {
  protected:
    std::size_t candidate(const std::string& name) const {
        const std::vector<UnitCandidate>& all = sources_.candidates();
        return static_cast<std::size_t>(
            std::find_if(all.begin(), all.end(),
                         [&](const auto& one) { return one.name == name; }) -
            all.begin());
    }
    scene::RigFiles files_ =
        scene::read_rig_files(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    UnitSources sources_{files_, false, false};
};

TEST_F(UnitChoices, StrangersAreUnitsThatNoExpressionHasWithTheOthers) {
    const auto strangers = [&](const std::vector<std::string>& names) {
        std::set<std::size_t> set;
        for (const std::string& name : names) set.insert(candidate(name));
        return sources_.strangers(set);
    };
    EXPECT_EQ(strangers({}), 0);
    EXPECT_EQ(strangers({"AU6", "AU7", "AU12", "AU26"}), 0);
    EXPECT_EQ(strangers({"AU6", "AU7", "AU12", "AU27"}), 1);
    EXPECT_EQ(strangers({"AU6", "AU7", "AU12", "AU26", "zygomaticus_major"}), 0);
    // Happy surprise, with drawn corners of the mouth
    EXPECT_EQ(strangers({"AU1", "AU2", "AU5", "AU12", "AU25", "AU26"}), 0);
    EXPECT_EQ(strangers({"AU1", "AU2", "AU5", "AU12", "AU25", "AU26", "AU15"}), 1);
}

// A little better is not enough for a unit that does not go with the others; much better is.
TEST_F(UnitChoices, OfTwoUnitsThatDoEquallyWellTheOneThatGoesWithTheOthersIsChosen) {
    const auto chosen = [&](double better) {
        UnitModel::Tangent tangent{Eigen::VectorXd::Zero(60),
                                   Eigen::MatrixXd::Zero(60, sources_.count())};
        long row = 0;
        const auto column = [&](const std::string& name) {
            return tangent.way.col(
                static_cast<long>(sources_.candidates()[candidate(name)].sources[0]));
        };
        for (const char* name : {"AU6", "AU7", "AU12"}) column(name)[row++] = 1;
        column("AU26")[row] = 1;
        column("AU27")[row] = 1;
        Eigen::VectorXd goal = Eigen::VectorXd::Zero(60);
        goal.head(row + 1).setConstant(0.5);
        goal[row + 1] = column("AU27")[row + 1] = better;  // which AU26 lacks
        const UnitChoice choice = choose_units(tangent, goal, sources_, {.unit_cost = 0.01});
        std::set<std::string> out;
        for (const UnitCandidate& one : sources_.candidates())
            if (choice.active[one.sources[0]]) out.insert(one.name);
        return out;
    };
    EXPECT_EQ(chosen(0.02), (std::set<std::string>{"AU12", "AU26", "AU6", "AU7"}));
    EXPECT_EQ(chosen(0.3), (std::set<std::string>{"AU12", "AU27", "AU6", "AU7"}));
}

}  // namespace
}  // namespace risorius::inverse
