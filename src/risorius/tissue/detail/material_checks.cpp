// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/material_checks.h"

#include <cmath>
#include <sstream>

#include "risorius/core/error.h"

namespace risorius::tissue {

std::string shown(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

std::string shown(const Vec3& point) {
    return "[" + shown(point[0]) + ", " + shown(point[1]) + ", " + shown(point[2]) + "]";
}

void check_range(double value, bool zero_allowed, const std::string& place) {
    if (std::isfinite(value) && (zero_allowed ? value >= 0 : value > 0)) return;
    throw Error(place, zero_allowed ? "[0, inf)" : "(0, inf)", shown(value));
}

void check_tensor(const Eigen::Ref<const Eigen::MatrixXd>& tensor, const std::string& place) {
    const auto at = [](Eigen::Index i, Eigen::Index j) {
        return std::to_string(i) + "/" + std::to_string(j);
    };
    for (Eigen::Index i = 0; i < tensor.rows(); ++i)
        for (Eigen::Index j = 0; j < tensor.cols(); ++j)
            check_range(tensor(i, j), /*zero_allowed=*/true, place + "/" + at(i, j));
    // G is symmetric, so unsymmetric parameters would rotate the whole body.
    for (Eigen::Index i = 0; i < tensor.rows(); ++i)
        for (Eigen::Index j = 0; j < i; ++j)
            if (tensor(i, j) != tensor(j, i))
                throw Error(place + "/" + at(i, j),
                            "what stands at " + at(j, i) + ", " + shown(tensor(j, i)) +
                                ", since the tensor is symmetric",
                            shown(tensor(i, j)));
}

}  // namespace risorius::tissue
