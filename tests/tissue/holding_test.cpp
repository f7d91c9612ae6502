// SPDX-License-Identifier: MIT
// Zero-length springs, contacts and dead loads: what holds and pushes the tissue from outside.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "risorius/tissue/contacts.h"
#include "risorius/tissue/dead_loads.h"
#include "risorius/tissue/zero_length_springs.h"
#include "tissue/layered_block.h"

namespace risorius::tissue {
namespace {

const LayeredBlock kHeldBlock(3, 3, 2);

ZeroLengthSprings some_springs() {
    std::vector<ZeroLengthSprings::Spring> list;
    for (int node = 0; node < 9; ++node)
        list.push_back({node, kHeldBlock.rest.row(node).transpose(),
                        Vec3(0.1 * node, 0.5, 1.0).normalized(), 200.0, 3.0 * node});
    return ZeroLengthSprings(list);
}

TEST(ZeroLengthSprings, HoldNothingAtTheirTargets) {
    Points gradient = Points::Zero(kHeldBlock.nodes(), 3);
    EXPECT_EQ(some_springs().add_energy(kHeldBlock.rest, gradient), 0.0);
    EXPECT_EQ(gradient.cwiseAbs().maxCoeff(), 0.0);
}

TEST(ZeroLengthSprings, ForcesAreTheSlopeOfTheEnergy) {
    expect_gradient_is_exact(some_springs(), shaken(kHeldBlock.rest, 1e-3, 1));
}

TEST(ZeroLengthSprings, PullFirmlyAlongTheNormalAndLooselyAcross) {
    const ZeroLengthSprings springs({{0, Vec3::Zero(), Vec3::UnitY(), 500.0, 20.0}});
    Points x(1, 3);
    x << 1e-3, 2e-3, -3e-3;
    const Points gradient = gradient_of(springs, x);
    EXPECT_NEAR(gradient(0, 0), 0.02, 1e-15);
    EXPECT_NEAR(gradient(0, 1), 1.0, 1e-15);
    EXPECT_NEAR(gradient(0, 2), -0.06, 1e-15);
}

TEST(ZeroLengthSprings, CanBeMovedWithTheJaw) {
    ZeroLengthSprings springs = some_springs();
    const Rigid jaw = some_motion();
    for (ZeroLengthSprings::Spring& spring : springs.list()) {
        spring.target = jaw * spring.target;
        spring.normal = jaw.linear() * spring.normal;
    }
    Points gradient = Points::Zero(kHeldBlock.nodes(), 3);
    EXPECT_LT(springs.add_energy(moved(kHeldBlock.rest, jaw), gradient), 1e-28);
}

TEST(ZeroLengthSprings, TheMetricBoundsBothDirections) {
    const ZeroLengthSprings springs({{1, Vec3::Zero(), Vec3::UnitY(), 5.0, 20.0}});
    solve::MetricBuilder builder(3);
    springs.add_metric(builder);
    const Eigen::MatrixXd metric = builder.build({});
    EXPECT_EQ(metric(1, 1), 20.0);
    EXPECT_EQ(metric.sum(), 20.0);
}

/// Node 17 above the triangle 0 1 3, and node 10 above a fixed plane.
Contacts some_contacts() {
    Contacts::Contact carried;
    carried.node = 17;
    carried.count = 3;
    const int others[3] = {0, 1, 3};
    const double weights[3] = {0.2, 0.5, 0.3};
    for (int i = 0; i < 3; ++i) {
        carried.others[i] = others[i];
        carried.weights[i] = weights[i];
    }
    carried.normal = Vec3(0.2, -0.1, 1).normalized();
    carried.stiffness_n_per_m = 30;
    Contacts::Contact fixed;
    fixed.node = 10;
    // 0.4 mm inside in the rest pose.
    fixed.point = kHeldBlock.rest.row(10).transpose() + Vec3(0, 0, 4e-4);
    fixed.normal = Vec3::UnitZ();
    fixed.stiffness_n_per_m = 50;
    Contacts contacts;
    std::vector<Contacts::Contact> list{carried, fixed};
    for (Contacts::Contact& contact : list)
        contact.rest_gap_m = std::min(0.0, Contacts::gap(contact, kHeldBlock.rest));
    contacts.set(list);
    return contacts;
}

TEST(Contacts, RestIsFreeOfForceEvenWhereItOverlaps) {
    const Contacts contacts = some_contacts();
    EXPECT_NEAR(contacts.list()[1].rest_gap_m, -4e-4, 1e-18);
    Points gradient = Points::Zero(kHeldBlock.nodes(), 3);
    EXPECT_EQ(contacts.add_energy(kHeldBlock.rest, gradient), 0.0);
    EXPECT_EQ(gradient.cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(contacts.max_penetration(kHeldBlock.rest), 0.0);
}

TEST(Contacts, ForcesAreTheSlopeOfTheEnergyWhilePressed) {
    Points x = kHeldBlock.rest;
    x.row(17) -= Eigen::RowVector3d(0, 0, 8e-3);
    x.row(10) -= Eigen::RowVector3d(1e-3, 0, 2e-3);
    const Contacts contacts = some_contacts();
    EXPECT_LT(Contacts::gap(contacts.list()[0], x), 0.0);
    expect_gradient_is_exact(contacts, x);
    EXPECT_GE(contacts.max_penetration(x), 2e-3 - 1e-12);
}

// However long a node has been pressed, once it is free it is released as fast as one that has just been touched.
TEST(Contacts, WhatHasBeenPressedForLongIsLetGoAtOnce) {
    Contacts::Contact contact;
    contact.stiffness_n_per_m = 50;
    contact.slot = 3;
    const auto shift = [&](Contacts& contacts, double z) {
        Points x = Points::Zero(1, 3);
        x(0, 2) = z;
        contacts.set({contact});
        contacts.remember(x);
        return contacts.list()[0].shift_m;
    };
    Contacts contacts;
    double pressed = 0;
    for (int step = 0; step < 60; ++step) pressed = shift(contacts, -1e-3);
    EXPECT_GT(pressed, 5e-3);
    EXPECT_NEAR(shift(contacts, 4e-3), pressed - 1e-3, 1e-12);
}

// One node is held down by a spring k above a plane at 0 and pulled by a force f. Steps of "solve, remember" press it out.
TEST(Contacts, WhatIsLeftOfAPenetrationIsPushedOutStepByStep) {
    Contacts::Contact contact;
    contact.stiffness_n_per_m = 50;
    contact.slot = 3;
    const double k = 40, f = -0.02;
    Points x = Points::Zero(1, 3);
    Contacts contacts;
    std::vector<double> depth;
    for (int step = 0; step < 8; ++step) {
        contacts.set({contact});
        // k z + kc (z - s) = f while it presses.
        const double s = contacts.list()[0].shift_m;
        x(0, 2) = (f + contact.stiffness_n_per_m * s) / (k + contact.stiffness_n_per_m);
        depth.push_back(contacts.max_penetration(x));
        contacts.remember(x);
    }
    EXPECT_NEAR(depth[0], 0.02 / 90, 1e-12);
    // Half of the remaining penetration goes into the shift, and kc/(k + kc) of that reduces the penetration.
    for (std::size_t i = 1; i < depth.size(); ++i)
        EXPECT_NEAR(depth[i] / depth[i - 1], 1 - 0.5 * 50 / 90, 0.01);
    contacts.forget();
    contacts.set({contact});
    EXPECT_EQ(contacts.list()[0].shift_m, 0.0);
}

/// A node above a plane with adhesion, from one solve to the next.
struct StickyNode {
    Contacts::Contact contact;
    Points x = Points::Zero(1, 3);
    Contacts contacts;

    StickyNode() {
        contact.stiffness_n_per_m = 50;
        contact.slot = 0;
        contact.stick_n = 1e-3;
        contact.stick_m = 6e-4;
    }
    /// Pull after a solve that ended at this height, N.
    double pull_at(double height_m) {
        x(0, 2) = height_m;
        contacts.set({contact});
        const double pull = Contacts::pull_n(contacts.list()[0], x);
        contacts.remember(x);
        return pull;
    }
};

TEST(Contacts, WhatWasPressedSticksALittleAndThenLetsGo) {
    StickyNode node;
    EXPECT_EQ(node.pull_at(2e-4), 0.0);   // never pressed
    EXPECT_LT(node.pull_at(-1e-4), 0.0);  // pressed
    node.contacts.set({node.contact});
    node.x(0, 2) = 1.5e-4;
    expect_gradient_is_exact(node.contacts, node.x);
    EXPECT_NEAR(node.pull_at(1e-4), 1e-3, 1e-9);  // at a third of dc beyond the release
    EXPECT_GT(node.pull_at(3e-4), 0.0);
    EXPECT_EQ(node.pull_at(6e-4), 0.0);  // torn off
    EXPECT_EQ(node.pull_at(1e-4), 0.0);
}

TEST(Contacts, WhatSticksIsFreeOfPullWhenHeldOpenForLong) {
    StickyNode node;
    node.pull_at(-1e-4);
    const double first = node.pull_at(1e-4);
    EXPECT_GT(first, 0.5e-3);
    for (int i = 0; i < 100; ++i) node.pull_at(1e-4);
    EXPECT_LT(node.pull_at(1e-4), 0.02 * first);
}

TEST(Contacts, ThoseThatHardenStartWithoutAKinkAndHandOverTheirForceToSteps) {
    Contacts::Contact contact;
    contact.stiffness_n_per_m = 100;
    contact.slot = 1;
    Points x = Points::Zero(1, 3);
    Contacts firm;
    firm.set_firm({contact}, 1e-4);
    const auto push_at = [&](double depth_m) {
        x(0, 2) = -depth_m;
        return -Contacts::pull_n(firm.list()[0], x);
    };
    EXPECT_NEAR(push_at(1e-4), 0.01, 1e-12) << "there as firm as the linear law";
    EXPECT_LT(push_at(1e-6), 0.02 * 100 * 1e-6);
    const double push = push_at(3e-4);
    EXPECT_NEAR(push, 9 * 0.01, 1e-9);
    firm.remember_firm(x);
    firm.set({contact});
    EXPECT_NEAR(-Contacts::pull_n(firm.list()[0], x), push, 1e-9);
}

TEST(Contacts, BetweenTissueAndTissuePushBothAlike) {
    Points x = kHeldBlock.rest;
    x.row(17) -= Eigen::RowVector3d(0, 0, 8e-3);
    const Points gradient = gradient_of(some_contacts(), x);
    EXPECT_GT(gradient.cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT(gradient.colwise().sum().norm(), 1e-14);
}

TEST(Contacts, DoNotPullWhenApart) {
    Points x = kHeldBlock.rest;
    x.row(17) += Eigen::RowVector3d(0, 0, 5e-3);
    x.row(10) += Eigen::RowVector3d(0, 0, 5e-3);
    Points gradient = Points::Zero(kHeldBlock.nodes(), 3);
    EXPECT_EQ(some_contacts().add_energy(x, gradient), 0.0);
    EXPECT_EQ(gradient.cwiseAbs().maxCoeff(), 0.0);
}

TEST(DeadLoads, ForcesAreTheSlopeOfTheEnergy) {
    DeadLoads loads;
    loads.set({{2, Vec3(0.1, 0, -0.2)}, {5, Vec3(0, 0.05, 0)}});
    expect_gradient_is_exact(loads, kHeldBlock.rest);
    const Points gradient = gradient_of(loads, kHeldBlock.rest);
    EXPECT_EQ(gradient(2, 2), 0.2);
}

}  // namespace
}  // namespace risorius::tissue
