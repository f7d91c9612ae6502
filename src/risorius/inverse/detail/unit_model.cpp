// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/unit_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace risorius::inverse {

namespace {

// e, relative to what the source moves that moves the points most
constexpr double kResolution = 1e-3;
constexpr double kNoShare = 1e-4;

}  // namespace

UnitModel::UnitModel(UnitState rest)
    : size_(rest.way.colwise().norm().transpose().array()),
      resolution_(kResolution * std::max(1e-12, size_.maxCoeff())) {
    add(std::move(rest));
}

void UnitModel::add(UnitState state) {
    at_zero_.push_back(state.moved - state.way * state.weight);
    states_.push_back(std::move(state));
}

void UnitModel::add(const Eigen::VectorXd& weight, const Eigen::VectorXd& moved) {
    UnitState made =
        *std::min_element(states_.begin(), states_.end(), [&](const auto& a, const auto& b) {
            return squared_distance(weight, a.weight) < squared_distance(weight, b.weight);
        });
    const Eigen::VectorXd step = weight - made.weight;
    const Eigen::VectorXd scaled = (size_.square() * step.array()).matrix();
    if (const double length = step.dot(scaled); length > resolution_ * resolution_)
        made.way += (moved - made.moved - made.way * step) * scaled.transpose() / length;
    made.weight = weight;
    made.moved = moved;
    add(std::move(made));
}

std::vector<double> UnitModel::shares(const Eigen::VectorXd& weight) const {
    std::vector<double> out;
    double sum = 0;
    for (const UnitState& state : states_) {
        const double apart = squared_distance(weight, state.weight);
        out.push_back(1 / std::pow(apart + resolution_ * resolution_, 2));
        sum += out.back();
    }
    double kept = 0;
    for (double& share : out) kept += share = share < kNoShare * sum ? 0 : share;
    for (double& share : out) share /= kept;
    return out;
}

UnitModel::Tangent UnitModel::tangent(const Eigen::VectorXd& weight,
                                      const std::vector<bool>& active) const {
    const std::vector<double> share = shares(weight);
    Tangent out{Eigen::VectorXd::Zero(states_[0].moved.size()),
                Eigen::MatrixXd::Zero(states_[0].way.rows(), states_[0].way.cols())};
    for (std::size_t k = 0; k < states_.size(); ++k) {
        if (share[k] == 0) continue;
        out.at_zero += share[k] * at_zero_[k];
        for (long s = 0; s < weight.size(); ++s)
            if (active.empty() || active[static_cast<std::size_t>(s)])
                out.way.col(s) += share[k] * states_[k].way.col(s);
    }
    return out;
}

Eigen::VectorXd UnitModel::moved(const Eigen::VectorXd& weight) const {
    const std::vector<double> share = shares(weight);
    Eigen::VectorXd out = Eigen::VectorXd::Zero(states_[0].moved.size());
    for (std::size_t k = 0; k < states_.size(); ++k)
        if (share[k] != 0)
            out += share[k] * (states_[k].moved + states_[k].way * (weight - states_[k].weight));
    return out;
}

}  // namespace risorius::inverse
