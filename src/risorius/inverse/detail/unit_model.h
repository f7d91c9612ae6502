// SPDX-License-Identifier: MIT
/// \file
/// The displacement of points under weights of units, between equilibria that were simulated. It takes microseconds.
///
///   u(w) = sum_k a_k (u_k + J_k (w - w_k)) / sum_k a_k,   a_k = 1 / (d_k^2 + e^2)^2,   d_k = |s (w - w_k)|
///
///   w_k, u_k   weights and displacements of an equilibrium
///   J_k        displacements of the unit shapes at rest; elsewhere those of the nearest equilibrium, changed least so that they lead from
///              one to the other (Broyden 1965, Math. Comput. 19, 577-593)
///   s          size of what each weight moves, so that d_k is a displacement       e   its resolution
///
/// With the rest alone it is the sum of unit shapes. Every equilibrium corrects it around its weights, and it passes through all of them.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace risorius::inverse {

/// A face in equilibrium, and how it changes with the weights.
struct UnitState {
    Eigen::VectorXd weight;  ///< w_k, one per source
    Eigen::VectorXd moved;   ///< u_k, weighted displacement of the points
    Eigen::MatrixXd way;     ///< J_k, one column per source
};

class UnitModel {
  public:
    /// u is about at_zero + way w near some weights.
    struct Tangent {
        Eigen::VectorXd at_zero;
        Eigen::MatrixXd way;
    };

    /// `rest`: with the unit shapes.
    explicit UnitModel(UnitState rest);
    void add(const Eigen::VectorXd& weight, const Eigen::VectorXd& moved);
    /// With derivatives.
    void add(UnitState state);

    /// `active`: the sources whose columns are wanted; those of the others are 0. Empty: all.
    Tangent tangent(const Eigen::VectorXd& weight, const std::vector<bool>& active = {}) const;
    Eigen::VectorXd moved(const Eigen::VectorXd& weight) const;

  private:
    /// a_k over their sum
    std::vector<double> shares(const Eigen::VectorXd& weight) const;
    double squared_distance(const Eigen::VectorXd& one, const Eigen::VectorXd& other) const {
        return (size_ * (one - other).array()).square().sum();
    }

    std::vector<UnitState> states_;
    std::vector<Eigen::VectorXd> at_zero_;  ///< u_k - J_k w_k
    Eigen::ArrayXd size_;                   ///< s
    double resolution_;                     ///< e
};

}  // namespace risorius::inverse
