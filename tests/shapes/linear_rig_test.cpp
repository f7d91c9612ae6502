// Shapes add up by weight, and correctives come in by the rule that files state for them.
#include "shapes/linear_rig.h"

#include <gtest/gtest.h>

namespace risorius::shapes {
namespace {

SparseShape one_vertex(int vertex, const Vec3& delta) {
    SparseShape out;
    out.vertex = {vertex};
    out.delta = delta.transpose();
    return out;
}

LinearRig three_shapes() {
    LinearRig rig;
    for (int k = 0; k < 3; ++k) rig.shapes.push_back(one_vertex(k, Vec3::UnitX()));
    rig.correctives.push_back({"0*1", {0, 1}, one_vertex(3, Vec3::UnitY())});
    rig.correctives.push_back({"2~half", {2}, one_vertex(4, Vec3::UnitZ())});
    return rig;
}

TEST(LinearRig, AddsShapesAndWhatTheirSumLacks) {
    Points vertices = Points::Zero(5, 3);
    three_shapes().add_to(vertices, Eigen::Vector3d(0.5, 0.5, 0.25));
    EXPECT_EQ(vertices(0, 0), 0.5);
    EXPECT_EQ(vertices(2, 0), 0.25);
    EXPECT_EQ(vertices(3, 1), 0.25);  // the product
    EXPECT_EQ(vertices(4, 2), 0.75);  // 4 w (1 - w)
    const Eigen::VectorXd all = three_shapes().all_weights(Eigen::Vector3d(0.5, 0.5, 0.25));
    ASSERT_EQ(all.size(), 5);
    EXPECT_EQ(all[3], 0.25);
    EXPECT_EQ(all[4], 0.75);
}

TEST(LinearRig, AnInBetweenGoesAsOthersCome) {
    LinearRig rig = three_shapes();
    rig.correctives[1].fades_with = {0, 1};
    EXPECT_EQ(rig.correctives[1].weight(Eigen::Vector3d(0, 0, 0.5)), 1.0);
    EXPECT_EQ(rig.correctives[1].weight(Eigen::Vector3d(0.5, 0.25, 0.5)), 0.375);
    EXPECT_EQ(rig.correctives[1].weight(Eigen::Vector3d(1, 0, 0.5)), 0.0);
}

TEST(LinearRig, LeavesWholeShapesAlone) {
    const LinearRig rig = three_shapes();
    for (int s = 0; s < 3; ++s) {
        const Eigen::VectorXd weights = Eigen::VectorXd::Unit(3, s);
        Points vertices = Points::Zero(5, 3);
        rig.add_to(vertices, weights);
        EXPECT_EQ(vertices, rig.shapes[static_cast<std::size_t>(s)].dense(5)) << s;
    }
}

TEST(LinearRig, ErrorsAreWeightedByArea) {
    Points one = Points::Zero(3, 3), other = Points::Zero(3, 3);
    other(0, 0) = 3e-3;
    other(2, 0) = 1;  // where nothing is compared
    const FieldError error = error_between(one, other, Eigen::Vector3d(1, 8, 0));
    EXPECT_NEAR(error.rms_m, 1e-3, 1e-15);
    EXPECT_EQ(error.greatest_m, 3e-3);
}

}  // namespace
}  // namespace risorius::shapes
