// A symmetric n x n matrix over the nodes whose rows add up to zero, applied to points: what resists differences between
// neighbours. It is kept in float; sums over a row run in one fixed order.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "core/types.h"
#include "solve/lanes.h"

namespace risorius::solve {

class Laplacian {
  public:
    Laplacian() = default;
    /// Only the entries below the diagonal of `lower` are read.
    explicit Laplacian(const Eigen::SparseMatrix<double>& lower);

    /// gradient = scale L (x - y), n x 3. Returns scale/2 (x - y) . L (x - y).
    double pull(double scale, const Points& x, const Points& y, Points& gradient) const;

  private:
    struct Neighbour {
        std::int32_t row;
        float value;  ///< L_ij < 0 as a rule
    };
    std::vector<std::int32_t> begin_{0};  ///< of the neighbours of a row, one more than rows
    std::vector<Neighbour> neighbours_;
    mutable PaddedRows<float> moved_;
};

}  // namespace risorius::solve
