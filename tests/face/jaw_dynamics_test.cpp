// SPDX-License-Identifier: MIT
// The forward-dynamic jaw by itself: its equations, its ranges, its bite. Ranges are those of skull.json's sources (Travers 2000,
// Ferrario 2005, clinical norms): opening 46.6 (women) to 56 mm (men), to the side 8-12 mm, forwards 7-10 mm.
#include "risorius/face/anatomy/detail/jaw_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "rig/heads.h"

namespace risorius::face {
namespace {

constexpr double kH = 1.0 / 60.0;
using Drive = std::map<std::string, double>;

const JawDynamics& jaw() {
    static const JawDynamics one(rig::adult_placed(), rig::adult().rig);
    return one;
}
Eigen::VectorXd activation(const Drive& drive) {
    const track::ChannelTable channels = rig::adult().rig.channels();
    Eigen::VectorXd out = Eigen::VectorXd::Zero(channels.column_count());
    for (const auto& [name, value] : drive) {
        const auto [id, only] = track::split_side(name);
        for (const Side side : {Side::kLeft, Side::kRight})
            if (!only || *only == side) out[channels.column(id, side)] = value;
    }
    return out;
}
JawDynamics::State after(double seconds, const Drive& drive, JawDynamics::State state = {},
                         const JawDynamics& moved = jaw()) {
    const Eigen::VectorXd a = activation(drive);
    for (int i = 0; i < std::lround(seconds / kH); ++i)
        EXPECT_TRUE(moved.advance(kH, a, state).converged);
    return state;
}
Drive openers(double value) {
    return {{"pterygoid_lateral_inferior", value}, {"digastric_anterior", value},
            {"digastric_posterior", value},        {"geniohyoid", value},
            {"mylohyoid_anterior", value},         {"mylohyoid_posterior", value}};
}
Drive closers(double value) {
    return {{"masseter_superficial", value}, {"masseter_deep", value},
            {"temporalis_anterior", value},  {"temporalis_middle", value},
            {"temporalis_posterior", value}, {"pterygoid_medial", value}};
}
JawPlace place(const JawDynamics::State& state) { return jaw().joint().place(state.q); }
Vec3 incisors(const JawDynamics::State& state) {
    const JawJoint& joint = jaw().joint();
    return joint.pose(state.q).motion * joint.incisor() - joint.incisor();
}
const JawVector& somewhere() {
    static const JawVector q =
        (JawVector() << 0.02, 0.004, 0.006, 5e-4, 1e-3, -3e-3, -2e-3).finished();
    return q;
}

TEST(JawJoint, MovesEveryPointAsItsRatesSay) {
    const Vec3 chin(4e-3, -80e-3, 70e-3);
    const JawPose pose = jaw().joint().pose(somewhere());
    for (int k = 0; k < kMandibleCoordinates; ++k) {
        const double d = 1e-6;
        const Vec3 difference =
            (jaw().joint().pose(somewhere() + d * JawVector::Unit(k)).motion * chin -
             jaw().joint().pose(somewhere() - d * JawVector::Unit(k)).motion * chin) /
            (2 * d);
        EXPECT_LT((pose.velocity(k, pose.motion * chin) - difference).norm(), 1e-8) << k;
    }
}

TEST(JawJoint, CondylesFollowTheEminence) {
    // 12 mm forward and 5 mm down, from -40 to -10 degrees, without a kink
    const JawJoint& joint = jaw().joint();
    const double end = 12e-3 * joint.size();
    EXPECT_NEAR(joint.eminence(end).value, -5e-3 * joint.size(), 1e-12);
    EXPECT_NEAR(joint.eminence(0).slope, std::tan(-40 * M_PI / 180), 1e-12);
    EXPECT_NEAR(joint.eminence(end).slope, std::tan(-10 * M_PI / 180), 1e-12);
    for (double s = -2e-3; s < 16e-3; s += 0.5e-3) {
        const double difference =
            (joint.eminence(s + 1e-7).value - joint.eminence(s - 1e-7).value) / 2e-7;
        EXPECT_NEAR(joint.eminence(s).slope, difference, 1e-4) << s;
    }
    JawVector q = JawVector::Zero();
    q << 0.03, 6e-3, 6e-3, 0, 0, 0, 0;
    const Vec3 condyle = joint.hinge() + Vec3(50e-3 * joint.size(), 0, 0);
    const Vec3 moved = joint.pose(q).motion * condyle - condyle;
    EXPECT_LT((moved - Vec3(0, joint.eminence(6e-3).value, 6e-3)).norm(), 1e-12);
}

TEST(JawDynamics, GradientIsTheSlopeOfTheEnergy) {
    JawDynamics::State state;
    state.q = 0.7 * somewhere();
    state.velocity.fill(Vec3(0, -0.1, 0.05));
    const auto step = jaw().begin(kH, state, activation(openers(0.3)));
    // Also where teeth, ligaments and stops carry load
    JawVector pressed = JawVector::Zero(), wide = somewhere();
    pressed << -1e-4, 2e-3, -9e-4, 3e-4, 0, 0, 0;
    wide << 0.055, 13e-3, 13.2e-3, -4e-4, 0, -8e-3, -12e-3;
    JawVector gradient, unused;
    JawMatrix hessian;
    for (const JawVector& q : {somewhere(), pressed, wide}) {
        jaw().energy(step, q, gradient, hessian);
        EXPECT_GT(hessian.ldlt().vectorD().minCoeff(), 0);
        for (int k = 0; k < kJawCoordinates; ++k) {
            const double d = 1e-7;
            const JawVector up = q + d * JawVector::Unit(k), down = q - d * JawVector::Unit(k);
            JawMatrix other;
            const double difference =
                (jaw().energy(step, up, unused, other) - jaw().energy(step, down, unused, other)) /
                (2 * d);
            jaw().energy(step, q, gradient, hessian);
            EXPECT_NEAR(gradient[k], difference, 1e-3 + 1e-6 * std::abs(difference)) << k;
        }
    }
}

TEST(JawDynamics, RestStaysAtRest) {
    EXPECT_LT(after(0.5, {}).q.norm(), 1e-9);  // m
}

TEST(JawDynamics, OpensByMostOfItsRange) {
    const JawPlace open = place(after(1.0, openers(1.0)));
    EXPECT_GT(open.open_m, 0.7 * 46.6e-3 * jaw().joint().size());
    EXPECT_GT(open.open_m, 0.7 * 56e-3 * jaw().joint().size());
    EXPECT_LT(open.open_rad, 34 * M_PI / 180);
    EXPECT_GT(open.forward_m, 11e-3);  // condyles come forward
    EXPECT_LT(open.forward_m, 14e-3);
    EXPECT_LT(std::abs(open.side_m), 1e-9);  // both sides alike
}

TEST(JawDynamics, ClosesWhenClosersPullAndWhenItIsLetGo) {
    const auto open = after(0.5, openers(1.0));
    const auto shut = after(0.5, closers(1.0), open);
    EXPECT_LT(std::abs(place(shut).open_m), 0.3e-3);
    EXPECT_GT(jaw().joint().tooth_force_n(shut.q), 300);
    EXPECT_LT(std::abs(place(after(1.5, {}, open)).open_m), 0.1e-3);
}

TEST(JawDynamics, ProtrudesByMostOfItsRange) {
    const Vec3 moved = incisors(after(1.0, {{"pterygoid_lateral_inferior", 1.0},
                                            {"pterygoid_lateral_superior", 0.5},
                                            {"masseter_superficial", 0.1},
                                            {"pterygoid_medial", 0.1}}));
    EXPECT_GT(moved.z(), 0.7 * 10e-3);
    EXPECT_LT(moved.z(), 11e-3);
    EXPECT_LT(moved.y(), -1.6e-3);  // lower incisors pass below the upper ones: overbite 1.7 mm
}

TEST(JawDynamics, LateralPterygoidShiftsToTheOtherSide) {
    const auto left = after(1.0, {{"pterygoid_lateral_inferior.r", 1.0}});
    const auto right = after(1.0, {{"pterygoid_lateral_inferior.l", 1.0}});
    EXPECT_GT(place(left).side_m, 0.7 * 12e-3);
    EXPECT_LT(place(left).side_m, 12e-3);
    EXPECT_NEAR(place(right).side_m, -place(left).side_m, 0.2e-3);  // as alike as the two sides are
    // The condyle it goes to turns on the spot and the other one comes forward.
    EXPECT_LT(std::abs(left.q[kSlideLeft]), 1e-3);
    EXPECT_GT(left.q[kSlideRight], 7e-3);
}

TEST(JawDynamics, BitesWithTheForceOfIncisors) {
    // 150-400 N between the incisors, on a block that holds them apart
    for (const double block : {5e-3, 10e-3, 15e-3}) {
        JawDynamics biting = jaw();
        const auto open = after(0.4, openers(1.0));
        biting.joint().set_bite_block(block);
        const auto bite = after(0.4, closers(1.0), open, biting);
        const double force = biting.joint().incisor_force_n(bite.q);
        EXPECT_GT(force, 150) << block;
        EXPECT_LT(force, 400) << block;
        EXPECT_DOUBLE_EQ(force, biting.joint().tooth_force_n(bite.q));  // molars are clear
        EXPECT_GT(bite.q[kSlideLeft], -1e-3);  // condyles are pressed back by less than 1 mm
        RecordProperty("force_n", std::to_string(force));
    }
}

TEST(JawDynamics, EnergyFallsWhenNothingIsActive) {
    auto state = after(0.5, openers(0.5));
    double before = jaw().kinetic_energy_j(state) + jaw().potential_energy_j(state.q);
    const double first = before;
    for (int i = 0; i < 60; ++i) {
        jaw().advance(kH, activation({}), state);
        const double now = jaw().kinetic_energy_j(state) + jaw().potential_energy_j(state.q);
        EXPECT_LT(now, before + 1e-6) << i;  // J; fibres' lagged force-length leaves this much
        before = now;
    }
    EXPECT_LT(before, first - 0.02);
}

TEST(JawDynamics, AMuscleThatIsASolidLeavesItsToneAlone) {
    const JawDynamics shared(rig::adult_placed(), rig::adult().rig,
                             {"masseter_superficial", "temporalis_anterior"});
    JawDynamics::State resting, told;
    for (int i = 0; i < 30; ++i) {
        shared.advance(1.0 / 60, activation({}), resting);
        shared.advance(1.0 / 60, activation({{"masseter_superficial", 1.0}}), told);
    }
    EXPECT_LT(resting.q.norm(), 1e-9);
    EXPECT_EQ(told.q, resting.q);
    EXPECT_GT(shared.joint().tooth_force_n(resting.q), 3);
}

TEST(JawDynamics, ALoadGivesItTheEnergyOfItsWork) {
    // Without muscles, 1 N on the incisors for 10 ms
    rig::RigDescription rig = rig::adult().rig;
    for (rig::Muscle& muscle : rig.muscles.muscles) muscle.group = "mimetic";
    const JawDynamics bare(rig::adult_placed(), rig);
    EXPECT_TRUE(bare.muscles().list().empty());
    EXPECT_NEAR(bare.mass_kg(), 0.2, 2e-3);
    JawLoad load;
    load.gradient[kOpen] = -1.0;
    JawDynamics::State state;
    for (int i = 0; i < 100; ++i) {
        const auto step = bare.begin(1e-4, state, activation({}));
        JawVector q = state.q;
        EXPECT_TRUE(bare.minimise(step, q, &load).converged);
        state = bare.end(step, q);
    }
    const double work = state.q[kOpen] * 1.0;
    EXPECT_GT(work, 0.2e-3);
    EXPECT_LT(bare.kinetic_energy_j(state), work);
    EXPECT_GT(bare.kinetic_energy_j(state), 0.7 * work);  // the rest is damped away
}

TEST(JawDynamics, StepLengthChangesLittle) {
    // Rising to 0.3 in 0.2 s, as activation does
    const auto run = [](double h) {
        JawDynamics::State state;
        std::vector<double> open;
        for (int i = 0; i * h < 0.6 - 1e-9; ++i) {
            const double t = (i + 1) * h;
            jaw().advance(h, activation(openers(0.3 * std::min(1.0, t / 0.2))), state);
            if (std::abs(std::remainder(t, 0.1)) < 1e-9) open.push_back(place(state).open_m);
        }
        return open;
    };
    const auto coarse = run(1.0 / 30), usual = run(kH), fine = run(1.0 / 240);
    ASSERT_EQ(usual.size(), 6u);
    for (std::size_t i = 0; i < usual.size(); ++i) {
        EXPECT_NEAR(usual[i], fine[i], 2e-3) << i;
        EXPECT_NEAR(coarse[i], fine[i], 4e-3) << i;
    }
    EXPECT_NEAR(coarse.back(), fine.back(), 0.1e-3);
}

TEST(JawDynamics, SameDriveGivesSameBytes) {
    EXPECT_EQ(after(0.3, openers(0.4)).q, after(0.3, openers(0.4)).q);
}

}  // namespace
}  // namespace risorius::face
