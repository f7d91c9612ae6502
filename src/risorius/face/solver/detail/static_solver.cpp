// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/static_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "risorius/core/dense_algebra.h"
#include "risorius/solve/energy_term.h"
#include "risorius/solve/point_sums.h"
#include "risorius/solve/supernodal_cholesky.h"

namespace risorius::face {

namespace {

// Holds nodes that nothing else holds, N/m; soft tissue holds its nodes with several N/m.
constexpr double kLoose_n_per_m = 1e-6;
// Farther from equilibrium the exact H is hardly ever positive definite.
constexpr double kFar_m = 0.5e-3;
// |B g| up to which a search that begins in another equilibrium does without approach(), which would lead away from it first: its
// contacts are soft. With 0.5 mm, 7 of 12 equilibria of a search for action units take twice as long.
constexpr double kNearAnother_m = 2e-3;
constexpr double kEnoughGain =
    0.5;  // H is factored again after a round that leaves more than this fraction of |B g|
constexpr double kStale =
    5;  // or that starts with this multiple of what the last round left: contacts have changed
// Contact planes are valid nearby only: the maximum move of a node per iteration is halved after rounds that do not come nearer, and
// doubled after rounds that do.
constexpr double kFirstStep_m = 1e-3, kShortestStep_m = 0.1e-3;
constexpr double kNearer = 0.7, kForgetting = 1.1;
constexpr int kFarRound = 6;          // iterations per round while x is far from equilibrium
constexpr double kRoughStep_s = 0.5;  // long enough to seek an equilibrium, see kSettling_s
constexpr int kRoughRound = 20, kRoughRounds = 6;
constexpr int kMixed = 5;  // number of rounds in Anderson mixing
// Few poses need more iterations. In those a node is about to snap between two places, and the planes found at either place send it to
// the other, with or without mixing. A spring to its last position lets it move like viscous tissue. Planes that turn against the node
// act stiffer than fixed planes; the spring reaches that stiffness where the node keeps moving.
constexpr int kPatience = 300;  // iterations before springs are added
constexpr double kHold_n_per_m = 5;
constexpr double kStiffer = 2;  // factor for springs whose node moves as far as before

/// Anderson mixing for the fixed point z = x(z): the affine combination of the moves x - z of the last rounds with minimum norm (Walker &
/// Ni 2011, "Anderson acceleration for fixed-point iterations", SIAM J. Numer. Anal. 49(4)).
class FixedPoint {
  public:
    void forget() { rounds_.clear(); }

    Points next(const Points& z, const Points& x) {
        const double length = (x - z).norm();
        if (!rounds_.empty() && !(length < kWorse * rounds_.back().length)) forget();
        rounds_.push_back({x - z, x, length});
        if (rounds_.size() > kMixed + 1) rounds_.erase(rounds_.begin());
        const auto count = static_cast<int>(rounds_.size()) - 1;
        if (count == 0) return x;
        Eigen::MatrixXd products(count, count);
        Eigen::VectorXd right(count);
        const Round& last = rounds_.back();
        std::vector<Points> change;
        for (int i = 0; i < count; ++i)
            change.push_back(last.move - rounds_[static_cast<std::size_t>(i)].move);
        for (int i = 0; i < count; ++i) {
            const auto at = static_cast<std::size_t>(i);
            right[i] = solve::dot(change[at], last.move);
            for (int j = 0; j <= i; ++j)
                products(i, j) = products(j, i) =
                    solve::dot(change[at], change[static_cast<std::size_t>(j)]);
        }
        constexpr double kRidge = 1e-12;
        products.diagonal() += kRidge * products.diagonal();
        const Eigen::VectorXd gamma = solved_symmetric(products, right);
        Points out = x;
        for (int i = 0; i < count; ++i)
            if (std::isfinite(gamma[i]))
                out -= gamma[i] * (last.to - rounds_[static_cast<std::size_t>(i)].to);
        return out;
    }

  private:
    static constexpr double kWorse = 2;
    struct Round {
        Points move, to;
        double length;
    };
    std::vector<Round> rounds_;
};

}  // namespace

struct StaticSolver::Linear {
    solve::HessianBuilder hessian;
    solve::SupernodalCholesky factor;
    /// H with the pattern of lips that touch at rest: every search that forgot starts with it.
    std::optional<solve::HessianBuilder> first;
    std::vector<std::pair<int, int>> near;  ///< nodes of lips that are near at rest, sorted
    explicit Linear(const FaceTissue& tissue)
        : hessian(static_cast<int>(tissue.rest().rows()), tissue.fixed()) {
        for (const auto& [a, b] : tissue.neighbours_across_lips())
            near.emplace_back(std::min(a, b), std::max(a, b));
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
    }
};

StaticSolver::StaticSolver(FaceTissue& tissue)
    : tissue_(tissue), linear_(std::make_unique<Linear>(tissue)), touched_(linear_->near) {}
StaticSolver::~StaticSolver() = default;

void StaticSolver::forget(bool near) {
    known_ = false;
    near_ = near;
    // The pattern, and with it the last bits, depends on former contacts
    touched_ = linear_->near;
    if (linear_->first) linear_->hessian = *linear_->first;
}

double StaticSolver::energy(const Points& x, const Eigen::VectorXd& activation, Points& gradient) {
    double energy = tissue_.static_energy(x, activation, gradient);
    for (const Spring& spring : springs_) {
        const Eigen::RowVector3d away = x.row(spring.node) - sought_.row(spring.node);
        energy += 0.5 * spring.n_per_m * away.squaredNorm();
        gradient.row(spring.node) += spring.n_per_m * away;
    }
    return energy;
}

void StaticSolver::order(const Points& x, const Eigen::VectorXd& activation) {
    const auto found = tissue_.exchange_contacts({});
    linear_->hessian.clear();
    tissue_.add_static_hessian(x, activation, solve::Curvature::kPositive, linear_->hessian);
    for (const auto& [a, b] : linear_->near) linear_->hessian.add(a, b, Mat3::Zero());
    linear_->factor.order_like(linear_->hessian.build(), 3);
    linear_->first = linear_->hessian;
    tissue_.exchange_contacts(found);
}

void StaticSolver::factorise(const Points& x, const Eigen::VectorXd& activation,
                             solve::Curvature first, solve::Precision precision) {
    tissue_.begin_rest(x);
    // Pairs of lips come and go. The pattern keeps all of them, so that the matrix is rarely reordered
    for (const tissue::Contacts::Contact& contact : tissue_.contacts().list())
        for (int i = 0; i < contact.count; ++i)
            for (int j = -1; j < i; ++j) {
                const int a = j < 0 ? contact.node : contact.others[j], b = contact.others[i];
                const std::pair<int, int> pair{std::min(a, b), std::max(a, b)};
                const auto at = std::lower_bound(touched_.begin(), touched_.end(), pair);
                if (at == touched_.end() || *at != pair) touched_.insert(at, pair);
            }
    if (!linear_->first) order(x, activation);
    for (solve::Curvature curvature = first;; curvature = solve::Curvature::kPositive) {
        linear_->hessian.clear();
        tissue_.add_static_hessian(x, activation, curvature, linear_->hessian);
        for (int i = 0; i < static_cast<int>(x.rows()); ++i)
            linear_->hessian.add_diagonal(i, kLoose_n_per_m);
        for (const Spring& spring : springs_)
            linear_->hessian.add_diagonal(spring.node, spring.n_per_m);
        for (const auto& [a, b] : touched_) linear_->hessian.add(a, b, Mat3::Zero());
        ++factors_;
        const Eigen::SparseMatrix<double>& H = linear_->hessian.build();
        if (linear_->factor.factorise(H, 3, precision)) break;
        if (curvature == solve::Curvature::kExact) continue;
        linear_->factor.factorise(H, 3);
        break;
    }
    known_ = true;
}

void StaticSolver::solve(const Points& b, Points& y) const {
    y = b;
    for (long i = 0; i < y.rows(); ++i)
        if (tissue_.fixed()[static_cast<std::size_t>(i)]) y.row(i).setZero();
    linear_->factor.solve(y.data(), y.data());
}

// Far from equilibrium, iterations with the constant scalar metric of long steps gain as much as those with a factor of H, at a
// hundredth of the cost.
void StaticSolver::approach(const Eigen::VectorXd& activation, const StaticOptions& options,
                            Points& x, StepStats& figures) {
    const double enough_m = near_ ? kNearAnother_m : kFar_m;
    if (known_ || near_) {
        tissue_.begin_rest(x);
        tissue_.find_rest_contacts(x);
        if (!known_) factorise(x, activation, solve::Curvature::kPositive);
        near_ = false;
        energy(x, activation, gradient_);
        solve(gradient_, move_);
        if (solve::longest_row(move_) < enough_m) return;
    }
    for (int round = 0; round < kRoughRounds && figures.iterations < options.iterations; ++round) {
        tissue_.find_soft_contacts(x);
        const Points start = x;
        const StepStats part = tissue_.implicit_step(
            kRoughStep_s, start, start, activation,
            {.iterations = std::min(kRoughRound, options.iterations - figures.iterations),
             .memory = options.memory,
             .step_cap_m = options.step_cap_m,
             .tolerance_rms_m = 1e-6},
            x);
        figures.iterations += std::max(1, part.iterations);
        figures.evaluations += part.evaluations;
        move_ = x - start;
        if (solve::longest_row(move_) < kFar_m) break;
    }
    known_ = false;
}

bool StaticSolver::hold_what_moved(const Points& x, double more_than_m) {
    bool changed = false;
    for (int i = 0; i < static_cast<int>(x.rows()); ++i) {
        const double away = (x.row(i) - sought_.row(i)).norm();
        auto at =
            std::lower_bound(springs_.begin(), springs_.end(), i,
                             [](const Spring& spring, int node) { return spring.node < node; });
        const bool held = at != springs_.end() && at->node == i;
        if (away > more_than_m) {
            if (!held)
                at = springs_.insert(at, {i, kHold_n_per_m, away});
            else if (away > kNearer * at->away_m)
                at->n_per_m *= kStiffer;
            changed = changed || !held || away > kNearer * at->away_m;
        }
        if (held) at->away_m = away;
    }
    return changed;
}

StepStats StaticSolver::solve_equilibrium(const Eigen::VectorXd& activation,
                                          const StaticOptions& options, Points& x) {
    StepStats figures;
    approach(activation, options, x, figures);
    tissue_.begin_rest(x);
    const auto energy_at = [&](const Points& at, Points& gradient) {
        return energy(at, activation, gradient);
    };
    const auto metric = [&](const Points& b, Points& y) { solve(b, y); };
    // Contact planes depend on where they are searched. If they are searched at the equilibrium on the last planes, two sets of planes
    // may alternate for ever. So the fixed point sought = x(sought) is found by Anderson mixing.
    sought_ = x;
    FixedPoint fixed_point;
    solve::Curvature curvature = solve::Curvature::kPositive;
    bool solved = true;  // whether the last round converged on its planes
    double last_left = std::numeric_limits<double>::infinity(), nearest = last_left;
    double longest_step = kFirstStep_m;
    const auto left_at = [&] {
        energy(x, activation, gradient_);
        ++figures.evaluations;
        solve(gradient_, move_);
        return solve::longest_row(move_);
    };
    while (true) {
        tissue_.find_rest_contacts(sought_);
        if (!known_ || !solved) factorise(x, activation, curvature);
        double left = left_at();
        if (left > options.tolerance_m && left > kStale * last_left) {
            factorise(x, activation, curvature);
            left = left_at();
        }
        figures.last_step_rms_m =
            std::sqrt(solve::dot(move_, move_) / static_cast<double>(x.rows()));
        move_ = x - sought_;
        figures.converged =
            left <= options.tolerance_m && solve::longest_row(move_) <= options.planes_m;
        if (figures.converged || figures.iterations >= options.iterations ||
            (options.stopped && options.stopped()))
            break;
        const bool nearer = left < kNearer * nearest;
        nearest = nearer ? left : kForgetting * nearest;
        longest_step = nearer ? std::min(2 * longest_step, options.step_cap_m)
                              : std::max(0.5 * longest_step, kShortestStep_m);
        const solve::StepReport report =
            search_.minimise(energy_at, metric, x,
                             {.iterations = std::min(left > kFar_m ? kFarRound : options.round,
                                                     options.iterations - figures.iterations),
                              .memory = options.memory,
                              .step_cap_m = longest_step,
                              .tolerance_rms_m = 1e-3 * options.tolerance_m});
        figures.iterations += std::max(1, report.iterations);
        figures.evaluations += report.evaluations;
        const double still = last_left = left_at();
        solved = still <= std::max(kEnoughGain * left, 0.5 * options.tolerance_m);
        curvature = still > kFar_m ? solve::Curvature::kPositive : solve::Curvature::kExact;
        if (!solved) fixed_point.forget();
        if (figures.iterations < kPatience) {
            sought_ = fixed_point.next(sought_, x);
            continue;
        }
        if (hold_what_moved(x, options.planes_m)) solved = false;
        sought_ = x;
    }
    if (!springs_.empty()) known_ = false;
    springs_.clear();
    const StepStats last = tissue_.end_rest(x);
    figures.contact_depth_m = last.contact_depth_m;
    figures.lip_depth_m = last.lip_depth_m;
    figures.bone_depth_m = last.bone_depth_m;
    figures.muscle_volume_error = last.muscle_volume_error;
    return figures;
}

}  // namespace risorius::face
