// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/joint_keys.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "risorius/motion/reduce_keys.h"
#include "risorius/solve/box_quadratic.h"
#include "risorius/track/timeline.h"

namespace risorius::inverse {

namespace {

using Keys = std::vector<track::Key>;

constexpr long kEveryFrame = 40;  // longer recordings begin with fewer keys
constexpr double kFineTolerance = 0.004;
constexpr int kRefits = 8, kNear = 2;

Eigen::RowVectorXd smooth_values(const Keys& keys, const std::vector<double>& times_s) {
    const track::Curve curve(keys, track::Interpolation::kSmooth);
    Eigen::RowVectorXd out(static_cast<long>(times_s.size()));
    for (std::size_t t = 0; t < times_s.size(); ++t)
        out[static_cast<long>(t)] = curve.at(times_s[t]);
    return out;
}

class KeySearch {
  public:
    KeySearch(const std::vector<double>& times_s, const std::vector<FrameCost>& frames,
              std::vector<Keys> keys)
        : times_s_(times_s), frames_(frames), keys_(std::move(keys)) {
        values_ = values_of_keys(keys_, times_s_);
    }

    void fit_all(int rounds) {
        std::vector<Unknown> all;
        for (std::size_t c = 0; c < keys_.size(); ++c)
            for (std::size_t k = 0; k < keys_[c].size(); ++k) all.push_back({c, k});
        fit(all, rounds);
    }

    void reduce(double allowed) {
        fit_all(kRefits);
        const double most = cost() + allowed;
        std::vector<std::vector<bool>> stays;
        for (const Keys& keys : keys_) stays.emplace_back(keys.size(), false);
        for (;;) {
            const Unknown next = cheapest(stays);
            if (next.key == kNone) break;
            const std::vector<Keys> keys_before = keys_;
            const Eigen::MatrixXd values_before = values_;
            const std::vector<std::vector<bool>> stays_before = stays;
            Keys& keys = keys_[next.curve];
            keys.erase(keys.begin() + static_cast<long>(next.key));
            stays[next.curve].erase(stays[next.curve].begin() + static_cast<long>(next.key));
            update(next.curve);
            std::vector<Unknown> near;
            for (std::size_t k = next.key > kNear ? next.key - kNear : 0;
                 k < std::min(keys.size(), next.key + kNear); ++k)
                near.push_back({next.curve, k});
            fit(near, 2);
            if (cost() > most) fit_all(2);
            if (cost() > most) {
                keys_ = keys_before;
                values_ = values_before;
                stays = stays_before;
                stays[next.curve][next.key] = true;
            }
        }
        fit_all(kRefits);
    }

    std::vector<Keys> take() { return std::move(keys_); }

  private:
    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    /// The value of a key.
    struct Unknown {
        std::size_t curve, key;
    };

    void update(std::size_t curve) {
        values_.row(static_cast<long>(curve)) = smooth_values(keys_[curve], times_s_);
    }
    double cost() const {
        double sum = 0;
        for (std::size_t t = 0; t < frames_.size(); ++t)
            sum += frames_[t].of(values_.col(static_cast<long>(t)));
        return sum;
    }

    /// The key without which the cost is least, if no other value changes.
    Unknown cheapest(const std::vector<std::vector<bool>>& stays) const {
        Unknown best{0, kNone};
        double least = std::numeric_limits<double>::infinity();
        Eigen::MatrixXd slope(values_.rows(), values_.cols());
        for (std::size_t t = 0; t < frames_.size(); ++t)
            slope.col(static_cast<long>(t)) =
                frames_[t].A * values_.col(static_cast<long>(t)) - frames_[t].b;
        for (std::size_t c = 0; c < keys_.size(); ++c) {
            const auto row = static_cast<long>(c);
            for (std::size_t k = 0; keys_[c].size() > 1 && k < keys_[c].size(); ++k) {
                if (stays[c][k]) continue;
                Keys without = keys_[c];
                without.erase(without.begin() + static_cast<long>(k));
                const Eigen::RowVectorXd change =
                    smooth_values(without, times_s_) - values_.row(row);
                double rise = 0;
                for (long t = 0; t < change.size(); ++t)
                    rise += change[t] *
                            (slope(row, t) +
                             0.5 * change[t] * frames_[static_cast<std::size_t>(t)].A(row, row));
                if (rise < least) {
                    least = rise;
                    best = {c, k};
                }
            }
        }
        return best;
    }

    /// The change of a curve over all frames per change of the value of a key.
    Eigen::RowVectorXd effect(const Unknown& of) const {
        constexpr double kStep = 1e-4;
        Keys keys = keys_[of.curve];
        const double step = keys[of.key].value + kStep <= 1 ? kStep : -kStep;
        keys[of.key].value += step;
        return (smooth_values(keys, times_s_) - values_.row(static_cast<long>(of.curve))) / step;
    }

    /// Gauss-Newton steps for the values of some keys.
    void fit(const std::vector<Unknown>& unknowns, int rounds) {
        const auto n = static_cast<long>(unknowns.size());
        for (int round = 0; round < rounds; ++round) {
            const double before = cost();
            solve::BoxQuadratic problem;
            problem.A = Eigen::MatrixXd::Zero(n, n);
            problem.b = Eigen::VectorXd::Zero(n);
            problem.l1_weight = Eigen::VectorXd::Zero(n);
            problem.min.resize(n);
            problem.max.resize(n);
            Eigen::MatrixXd effects(n, values_.cols());
            for (long i = 0; i < n; ++i) {
                const Unknown& one = unknowns[static_cast<std::size_t>(i)];
                effects.row(i) = effect(one);
                problem.min[i] = -keys_[one.curve][one.key].value;
                problem.max[i] = 1 - keys_[one.curve][one.key].value;
            }
            for (std::size_t t = 0; t < frames_.size(); ++t)
                add_frame(t, unknowns, effects, problem);
            problem.A.diagonal().array() += 1e-12;
            Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
            solve::minimise(problem, step, 1e-6, 100);
            if (!take_step(unknowns, step, before)) return;
            constexpr double kEnough = 1e-4;
            if (before - cost() < kEnough * std::abs(before)) return;
        }
    }

    void add_frame(std::size_t t, const std::vector<Unknown>& unknowns,
                   const Eigen::MatrixXd& effects, solve::BoxQuadratic& problem) const {
        const auto column = static_cast<long>(t);
        const Eigen::VectorXd slope = frames_[t].A * values_.col(column) - frames_[t].b;
        std::vector<long> here;
        for (long i = 0; i < effects.rows(); ++i)
            if (effects(i, column) != 0) here.push_back(i);
        for (const long i : here) {
            const auto c = static_cast<long>(unknowns[static_cast<std::size_t>(i)].curve);
            problem.b[i] += effects(i, column) * slope[c];
            for (const long j : here)
                problem.A(i, j) +=
                    effects(i, column) * effects(j, column) *
                    frames_[t].A(c, static_cast<long>(unknowns[static_cast<std::size_t>(j)].curve));
        }
    }

    /// Takes as much of a step as lowers the cost; false: none of it does.
    bool take_step(const std::vector<Unknown>& unknowns, const Eigen::VectorXd& step,
                   double before) {
        const std::vector<Keys> from = keys_;
        constexpr double kLeast = 0.1;
        for (double share = 1; share > kLeast; share *= 0.5) {
            for (std::size_t i = 0; i < unknowns.size(); ++i) {
                const Unknown& one = unknowns[i];
                keys_[one.curve][one.key].value = std::clamp(
                    from[one.curve][one.key].value + share * step[static_cast<long>(i)], 0.0, 1.0);
            }
            values_ = values_of_keys(keys_, times_s_);
            if (cost() < before) return true;
        }
        keys_ = from;
        values_ = values_of_keys(keys_, times_s_);
        return false;
    }

    const std::vector<double>& times_s_;
    const std::vector<FrameCost>& frames_;
    std::vector<Keys> keys_;
    Eigen::MatrixXd values_;  ///< curves x frames
};

}  // namespace

Eigen::MatrixXd values_of_keys(const std::vector<Keys>& keys, const std::vector<double>& times_s) {
    Eigen::MatrixXd out(static_cast<long>(keys.size()), static_cast<long>(times_s.size()));
    for (std::size_t c = 0; c < keys.size(); ++c)
        out.row(static_cast<long>(c)) = smooth_values(keys[c], times_s);
    return out;
}

double cost_of_zero(const std::vector<FrameCost>& frames, const Eigen::MatrixXd& values,
                    const Eigen::VectorXd& sum) {
    double out = 0;
    for (std::size_t t = 0; t < frames.size(); ++t)
        out += 0.5 * std::pow(sum.dot(values.col(static_cast<long>(t))), 2) /
               sum.dot(frames[t].A.llt().solve(sum));
    return out;
}

std::vector<Keys> joint_keys(const std::vector<double>& times_s,
                             const std::vector<FrameCost>& frames, const Eigen::MatrixXd& values,
                             double allowed) {
    std::vector<Keys> keys;
    for (long c = 0; c < values.rows(); ++c) {
        std::vector<double> list(times_s.size());
        for (long t = 0; t < values.cols(); ++t)
            list[static_cast<std::size_t>(t)] = std::clamp(values(c, t), 0.0, 1.0);
        Keys all;
        for (std::size_t t = 0; t < times_s.size(); ++t) all.push_back({times_s[t], list[t]});
        keys.push_back(values.cols() > kEveryFrame
                           ? motion::reduce_keys(times_s, list, kFineTolerance)
                           : std::move(all));
    }
    KeySearch search(times_s, frames, std::move(keys));
    search.reduce(allowed);
    return search.take();
}

void fit_keys(const std::vector<double>& times_s, const std::vector<FrameCost>& frames,
              std::vector<Keys>& keys) {
    KeySearch search(times_s, frames, std::move(keys));
    search.fit_all(kRefits);
    keys = search.take();
}

}  // namespace risorius::inverse
