// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/hinge_angle.h"

#include <cmath>

#include "risorius/core/cross_matrix.h"

namespace risorius::tissue {

namespace {

struct Hinge {
    Vec3 e, a, b;   ///< the edge; from x0 to xa and to xb
    double length;  ///< |e|
    Vec3 n1, n2;
    Vec3 ga, gb;    ///< dtheta/dxa, dtheta/dxb
    double ta, tb;  ///< position of xa and xb along the edge: 0 at x0, 1 at x1

    explicit Hinge(const HingeCorners& x)
        : e(x[1] - x[0]),
          a(x[2] - x[0]),
          b(x[3] - x[0]),
          length(e.norm()),
          n1(e.cross(a)),
          n2(b.cross(e)),
          ga(-length / n1.squaredNorm() * n1),
          gb(-length / n2.squaredNorm() * n2),
          ta(a.dot(e) / e.squaredNorm()),
          tb(b.dot(e) / e.squaredNorm()) {}
};

}  // namespace

double hinge_angle(const HingeCorners& x) {
    const Hinge hinge(x);
    return std::atan2(hinge.n1.cross(hinge.n2).dot(hinge.e) / hinge.length, hinge.n1.dot(hinge.n2));
}

std::array<Vec3, 4> hinge_angle_gradient(const HingeCorners& x) {
    const Hinge hinge(x);
    const Vec3 g1 = -hinge.ta * hinge.ga - hinge.tb * hinge.gb;
    return {-(g1 + hinge.ga + hinge.gb), g1, hinge.ga, hinge.gb};
}

std::array<std::array<Mat3, 4>, 4> hinge_angle_hessian(const HingeCorners& x) {
    // First the derivatives by e, a and b. Moving x0 changes all three.
    const Hinge h(x);
    const Vec3 along = h.e / h.length;
    const Mat3 E = cross_matrix(h.e);
    const auto mirror = [](const Vec3& n) -> Mat3 {
        return (Mat3::Identity() - 2 * n * n.transpose() / n.squaredNorm()) / n.squaredNorm();
    };
    const Mat3 m1 = h.length * mirror(h.n1), m2 = h.length * mirror(h.n2);
    const Mat3 ga_by_a = -m1 * E;
    const Mat3 ga_by_e = -h.n1 * along.transpose() / h.n1.squaredNorm() + m1 * cross_matrix(h.a);
    const Mat3 gb_by_b = m2 * E;
    const Mat3 gb_by_e = -h.n2 * along.transpose() / h.n2.squaredNorm() - m2 * cross_matrix(h.b);
    const double squared = h.length * h.length;
    const Vec3 ta_by_e = (h.a - 2 * h.ta * h.e) / squared;
    const Vec3 tb_by_e = (h.b - 2 * h.tb * h.e) / squared;
    const Mat3 e_by_e =
        -h.ga * ta_by_e.transpose() - h.ta * ga_by_e - h.gb * tb_by_e.transpose() - h.tb * gb_by_e;

    // Corners x1, xa and xb move e, a and b.
    std::array<std::array<Mat3, 4>, 4> block;
    block[1] = {Mat3::Zero(), e_by_e, ga_by_e.transpose(), gb_by_e.transpose()};
    block[2] = {Mat3::Zero(), ga_by_e, ga_by_a, Mat3::Zero()};
    block[3] = {Mat3::Zero(), gb_by_e, Mat3::Zero(), gb_by_b};
    for (std::size_t i = 1; i < 4; ++i) block[i][0] = -(block[i][1] + block[i][2] + block[i][3]);
    for (std::size_t j = 1; j < 4; ++j) block[0][j] = block[j][0].transpose();
    block[0][0] = -(block[0][1] + block[0][2] + block[0][3]);
    return block;
}

}  // namespace risorius::tissue
