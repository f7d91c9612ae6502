// SPDX-License-Identifier: MIT
/// \file
/// Finds few keys for several curves at once: as few as a cost of all of them together allows, such as the error of a face that they
/// move.
///
///   minimise the number of keys   subject to   sum_t ( 1/2 v_t^T A_t v_t - b_t^T v_t ) <= least + allowed,   0 <= v <= 1
///
///   v_t   values of the curves in frame t, smooth between keys
///
/// From keys in every frame, the key goes whose loss costs least, and the values of its neighbours are fitted again; now and then those of
/// all keys are. A curve that moves the face little, or what others make up for, so has fewer keys.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "risorius/track/script.h"

namespace risorius::inverse {

/// The cost of the values of the curves in a frame.
struct FrameCost {
    Eigen::MatrixXd A;  ///< C x C, positive definite
    Eigen::VectorXd b;
    double of(const Eigen::VectorXd& v) const { return 0.5 * v.dot(A * v) - b.dot(v); }
};

/// How much the least cost of all frames rises when a sum of the curves, each times a number, has to be 0: (s . v)^2 / (2 s . A^-1 s).
/// `values`: those of the least cost, C x frames.
double cost_of_zero(const std::vector<FrameCost>& frames, const Eigen::MatrixXd& values,
                    const Eigen::VectorXd& sum);

/// The keys of each of C curves. `values`: where the search begins, C x frames; `allowed`: how much the cost may rise above its least.
std::vector<std::vector<track::Key>> joint_keys(const std::vector<double>& times_s,
                                                const std::vector<FrameCost>& frames,
                                                const Eigen::MatrixXd& values, double allowed);

/// Fits the values of given keys again, whose times stay; the costs have changed.
void fit_keys(const std::vector<double>& times_s, const std::vector<FrameCost>& frames,
              std::vector<std::vector<track::Key>>& keys);

/// The values of smooth curves at the times, C x frames.
Eigen::MatrixXd values_of_keys(const std::vector<std::vector<track::Key>>& keys,
                               const std::vector<double>& times_s);

}  // namespace risorius::inverse
