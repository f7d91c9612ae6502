// SPDX-License-Identifier: MIT
#include "risorius/perform/detail/corrected_readout.h"

#include "risorius/core/dense_algebra.h"

namespace risorius::perform {

Eigen::MatrixXd corrected_readout(const Eigen::MatrixXd& w, const Eigen::MatrixXd& x,
                                  const Eigen::MatrixXd& wanted) {
    if (x.cols() == 0) return w;
    return w + (wanted - w * x) * inverse_of_positive(x.transpose() * x) * x.transpose();
}

}  // namespace risorius::perform
