// SPDX-License-Identifier: MIT
/// \file
/// A point carried by nodes, or the difference of two such points: p = sum of w_i x_i. Forces on p act on the nodes with the
/// same weights, so that work and net force are preserved.
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
    /// Enough for a point of a cell and one of a triangle, with one to spare.
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

    /// Distributes a force (or gradient) on the point to its nodes.
    void scatter(const Vec3& force, Points& out) const {
        for (int i = 0; i < count_; ++i) out.row(nodes_[i]) += weights_[i] * force.transpose();
    }

    /// Distributes the second derivative by the point, a symmetric matrix, to its nodes.
    void scatter(const Mat3& block, HessianBuilder& out) const {
        for (int i = 0; i < count_; ++i)
            for (int j = 0; j <= i; ++j)
                out.add(nodes_[i], nodes_[j], weights_[i] * weights_[j] * block);
    }

    void scatter(double stiffness, MetricBuilder& out) const {
        out.add_outer(nodes_.data(), weights_.data(), count_, stiffness);
    }

  private:
    int count_ = 0;
    std::array<int, kMax> nodes_{};
    std::array<double, kMax> weights_{};
};

}  // namespace risorius::solve
