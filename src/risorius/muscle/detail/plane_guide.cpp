// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/plane_guide.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace risorius::muscle {

PlaneGuide::PlaneGuide(const Points& plate, const Vec3& normal, double stiffness_n_per_m)
    : forms_(3, 3 * plate.rows()),
      middle_(plate.colwise().mean().transpose()),
      stiffness_(stiffness_n_per_m) {
    const auto nodes = static_cast<double>(plate.rows());
    const Vec3 first = normal.unitOrthogonal(), second = normal.cross(first);
    for (int c = 0; c < count(); ++c) {
        const Vec3 turn = normal.cross(plate.row(c).transpose() - middle_);
        forms_.block<3, 3>(0, 3 * c) << first.transpose() / nodes, second.transpose() / nodes,
            turn.transpose();
    }
    // p w: n x r divided by sqrt(N sum r^2)
    forms_.row(2) /= std::sqrt(nodes) * forms_.row(2).norm();
}

Eigen::MatrixXd PlaneGuide::forms(const Rigid& plate) const {
    Eigen::MatrixXd turned(3, forms_.cols());
    for (int c = 0; c < count(); ++c)
        turned.middleCols<3>(3 * c) = forms_.middleCols<3>(3 * c) * plate.linear().transpose();
    return turned;
}

Vec3 PlaneGuide::values(const Eigen::MatrixXd& forms, const Rigid& plate, const Points& x,
                        int first) const {
    const Vec3 middle = plate * middle_;
    Vec3 values = Vec3::Zero();
    for (int c = 0; c < count(); ++c)
        values += forms.middleCols<3>(3 * c) * (x.row(first + c).transpose() - middle);
    return values;
}

double PlaneGuide::energy(const Rigid& plate, const Points& x, int first) const {
    return stiffness_ / 2 * values(forms(plate), plate, x, first).squaredNorm();
}

Points PlaneGuide::forces(const Rigid& plate, const Points& x, int first) const {
    const Eigen::MatrixXd now = forms(plate);
    const Vec3 drift = values(now, plate, x, first);
    Points forces(count(), 3);
    for (int c = 0; c < count(); ++c)
        forces.row(c) = -stiffness_ * (now.middleCols<3>(3 * c).transpose() * drift).transpose();
    return forces;
}

void PlaneGuide::add_hessian(const Rigid& plate, int first, solve::HessianBuilder& hessian) const {
    std::vector<int> nodes(static_cast<std::size_t>(count()));
    std::iota(nodes.begin(), nodes.end(), first);
    const Eigen::MatrixXd now = forms(plate);
    const Eigen::MatrixXd block = stiffness_ * now.transpose() * now;
    hessian.add_dense(nodes.data(), count(), block.data());
}

}  // namespace risorius::muscle
