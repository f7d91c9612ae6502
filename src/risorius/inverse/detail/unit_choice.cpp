// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/unit_choice.h"

#include <algorithm>
#include <set>

#include "risorius/solve/box_quadratic.h"

namespace risorius::inverse {

namespace {

// Of a unit that no expression has together with the others, relative to the cost of a unit. Landmarks tell AU26 from AU27 by little, and
// AU7 and AU43 from AU5 and AU45; expressions know what goes with what. Of pain at 0.8, 0.055 mm RMS are left instead of 0.083, of
// surprise at 0.6, 6 units and 26 keys instead of 8 and 37.
constexpr double kOfStranger = 0.25;

/// The squares of a problem with a list of sources only.
class SmallProblems {
  public:
    SmallProblems(const UnitModel::Tangent& tangent, const Eigen::VectorXd& goal, double ridge,
                  double price)
        : price_(price), size_(std::max(goal.squaredNorm(), 1e-30)) {
        const Eigen::VectorXd miss = tangent.at_zero - goal;
        A_ = tangent.way.transpose() * tangent.way / size_;
        A_.diagonal().array() += ridge;
        b_ = tangent.way.transpose() * miss / size_;
        constant_ = 0.5 * miss.squaredNorm() / size_;
    }
    /// The objective with these sources, and their weights.
    double best(const std::vector<std::size_t>& sources, Eigen::VectorXd* weights = nullptr) const {
        const auto n = static_cast<long>(sources.size());
        solve::BoxQuadratic problem;
        problem.A.resize(n, n);
        problem.b.resize(n);
        for (long i = 0; i < n; ++i) {
            const auto from = static_cast<long>(sources[static_cast<std::size_t>(i)]);
            problem.b[i] = b_[from];
            for (long j = 0; j < n; ++j)
                problem.A(i, j) = A_(from, static_cast<long>(sources[static_cast<std::size_t>(j)]));
        }
        problem.l1_weight = Eigen::VectorXd::Constant(n, price_);
        problem.min = Eigen::VectorXd::Zero(n);
        problem.max = Eigen::VectorXd::Ones(n);
        Eigen::VectorXd w = Eigen::VectorXd::Zero(n);
        solve::minimise(problem, w, 1e-6, 200);
        if (weights) *weights = w;
        return constant_ + 0.5 * w.dot(problem.A * w) + problem.b.dot(w) + price_ * w.sum();
    }

  private:
    double price_, size_, constant_ = 0;
    Eigen::MatrixXd A_;
    Eigen::VectorXd b_;
};

/// A set of candidates that is improved step by step.
class Choice {
  public:
    Choice(const SmallProblems& problems, const UnitSources& sources,
           const UnitChoiceOptions& options)
        : problems_(problems),
          sources_(sources),
          candidates_(sources.candidates()),
          options_(options) {
        value_ = value_of(chosen_);
    }

    void improve() {
        constexpr int kMostRounds = 60;
        for (int round = 0; round < kMostRounds; ++round)
            if (!add_one() && !exchange_one() && !leave_one_out()) break;
    }
    std::vector<std::size_t> sources() const { return sources_of(chosen_); }

  private:
    using Set = std::set<std::size_t>;  ///< of candidates

    std::vector<std::size_t> sources_of(const Set& set) const {
        std::vector<std::size_t> out;
        for (const std::size_t c : set)
            out.insert(out.end(), candidates_[c].sources.begin(), candidates_[c].sources.end());
        return out;
    }
    double value_of(const Set& set) const {
        double cost = kOfStranger * options_.unit_cost * sources_.strangers(set);
        for (const std::size_t c : set) cost += options_.unit_cost * candidates_[c].cost;
        return problems_.best(sources_of(set)) + cost;
    }
    /// The best set that was looked at, and its value.
    struct Best {
        Set set;
        double value;
    };
    void look_at(Set set, Best& best) const {
        const double value = value_of(set);
        if (value < best.value) best = {std::move(set), value};
    }
    /// Takes the better set, if it is better.
    bool take(Best best) {
        constexpr double kGain = 1e-9;
        if (!(best.value < value_ - kGain)) return false;
        chosen_ = std::move(best.set);
        value_ = best.value;
        return true;
    }
    template <class Visit>
    void others(const Visit& visit) const {
        for (std::size_t c = 0; c < candidates_.size(); ++c)
            if (!chosen_.count(c)) visit(c);
    }

    bool add_one() {
        if (static_cast<int>(chosen_.size()) >= options_.most) return false;
        Best best{{}, value_};
        others([&](std::size_t c) {
            Set next = chosen_;
            next.insert(c);
            look_at(std::move(next), best);
        });
        return take(std::move(best));
    }
    bool exchange_one() {
        Best best{{}, value_};
        for (const std::size_t out : chosen_)
            others([&](std::size_t c) {
                Set next = chosen_;
                next.erase(out);
                next.insert(c);
                look_at(std::move(next), best);
            });
        return take(std::move(best));
    }
    bool leave_one_out() {
        Best best{{}, value_};
        for (const std::size_t out : chosen_) {
            Set next = chosen_;
            next.erase(out);
            look_at(std::move(next), best);
        }
        return take(std::move(best));
    }

    const SmallProblems& problems_;
    const UnitSources& sources_;
    const std::vector<UnitCandidate>& candidates_;
    const UnitChoiceOptions& options_;
    Set chosen_;
    double value_ = 0;
};

}  // namespace

Eigen::VectorXd fit_weights(const UnitModel::Tangent& tangent, const Eigen::VectorXd& goal,
                            const std::vector<bool>& active, const Eigen::VectorXd& at,
                            const UnitFit& how) {
    std::vector<long> used;
    for (std::size_t s = 0; s < active.size(); ++s)
        if (active[s]) used.push_back(static_cast<long>(s));
    const Eigen::MatrixXd way = tangent.way(Eigen::all, used);
    solve::BoxQuadratic problem;
    problem.A = way.transpose() * way / how.size;
    problem.A.diagonal().array() += how.ridge + how.keep;
    problem.b = way.transpose() * (tangent.at_zero - goal) / how.size;
    if (how.keep > 0) problem.b -= how.keep * how.expected(used);
    problem.l1_weight = how.price(used);
    problem.min = (at(used).array() - how.step).cwiseMax(0.0);
    problem.max = (at(used).array() + how.step).cwiseMin(1.0);
    Eigen::VectorXd found = at(used);
    solve::minimise(problem, found, 1e-7);
    Eigen::VectorXd out = Eigen::VectorXd::Zero(at.size());
    out(used) = found;
    return out;
}

UnitChoice choose_units(const UnitModel::Tangent& tangent, const Eigen::VectorXd& goal,
                        const UnitSources& sources, const UnitChoiceOptions& options) {
    const SmallProblems problems(tangent, goal, options.ridge, options.price);
    Choice choice(problems, sources, options);
    choice.improve();
    UnitChoice out{std::vector<bool>(static_cast<std::size_t>(sources.count()), false),
                   Eigen::VectorXd::Zero(sources.count()), 0};
    const std::vector<std::size_t> chosen = choice.sources();
    Eigen::VectorXd weights;
    out.objective = problems.best(chosen, &weights);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        out.active[chosen[i]] = true;
        out.weight[static_cast<long>(chosen[i])] = weights[static_cast<long>(i)];
    }
    return out;
}

}  // namespace risorius::inverse
