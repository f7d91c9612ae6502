// SPDX-License-Identifier: MIT
/// \file
/// A point that is a weighted sum of nodes, or the difference of two such points: p = sum of w_i x_i. A force on p is
/// distributed to the nodes with the same weights, so that work and net force are preserved.
#pragma once

#include <array>
#include <cassert>
#include <initializer_list>

#include "risorius/core/types.h"
#include "risorius/solve/hessian_builder.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {

/// The nodes and weights of a point.
class NodeBlend {
  public:
    /// Maximum number of nodes. A point of a cell has 8 and a point of a triangle has 3.
    static constexpr int kMax = 12;

    NodeBlend() = default;
    explicit NodeBlend(int node) { add(node, 1.0); }
    NodeBlend(std::initializer_list<int> nodes, std::initializer_list<double> weights) {
        assert(nodes.size() == weights.size());
        const double* w = weights.begin();
        for (const int node : nodes) add(node, *w++);
    }

    /// A node that is added again gets the sum of its weights. A weight of zero is ignored.
    void add(int node, double weight) {
        if (weight == 0) return;
        for (int i = 0; i < count_; ++i)
            if (nodes_[i] == node) {
                weights_[i] += weight;
                return;
            }
        assert(count_ < kMax);
        nodes_[count_] = node;
        weights_[count_++] = weight;
    }

    int count() const { return count_; }
    int node(int i) const { return nodes_[i]; }
    double weight(int i) const { return weights_[i]; }
    double weight_sum() const {
        double sum = 0;
        for (int i = 0; i < count_; ++i) sum += weights_[i];
        return sum;
    }

    /// The position of the point, or its velocity when `x` are velocities.
    Vec3 of(const Points& x) const {
        Vec3 p = Vec3::Zero();
        for (int i = 0; i < count_; ++i) p += weights_[i] * x.row(nodes_[i]).transpose();
        return p;
    }

    /// Adds a force (or gradient) on the point to its nodes in `out`, n x 3.
    void scatter(const Vec3& force, Points& out) const {
        for (int i = 0; i < count_; ++i) out.row(nodes_[i]) += weights_[i] * force.transpose();
    }

    /// Adds the second derivative by the point, a symmetric matrix, N/m, to the blocks of its nodes.
    void scatter(const Mat3& block, HessianBuilder& out) const {
        for (int i = 0; i < count_; ++i)
            for (int j = 0; j <= i; ++j)
                out.add(nodes_[i], nodes_[j], weights_[i] * weights_[j] * block);
    }

    /// Adds the metric of a stiffness of the point, N/m.
    void scatter(double stiffness, MetricBuilder& out) const {
        out.add_outer(nodes_.data(), weights_.data(), count_, stiffness);
    }

  private:
    int count_ = 0;
    std::array<int, kMax> nodes_{};
    std::array<double, kMax> weights_{};
};

}  // namespace risorius::solve
