// SPDX-License-Identifier: MIT
// Semi-implicit step of Terzopoulos, Platt, Barr & Fleischer 1987, "Elastically deformable models", section 6:
//
//   (M/h^2 + C/2h + K(r_t)) r_{t+h} = f + (M/h^2 + C/2h) r_t + (M/h - C/2) v_t,    v_t = (r_t - r_{t-h}) / h
//
// It is solved for the move r_{t+h} - r_t, because the cancelling rows of K would lose digits otherwise. v_t belongs to the
// middle of the previous step. After a step of another length, or at the start, the time between the middles of the two steps
// replaces one h in h^2 and the h in M/h; so the start uses v at its own time.
#include <algorithm>

#include "risorius/solve/detail/methods.h"
#include "risorius/solve/detail/stepper.h"
#include "risorius/solve/symmetric_factor.h"

namespace risorius::solve::detail {

namespace {

/// b -= w A x, with A given by its lower triangle.
void subtract_product(const Eigen::SparseMatrix<double>& A, double w, const Points& x, Points& b) {
    for (int j = 0; j < A.outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it) {
            const long i = it.row();
            b.row(i) -= w * it.value() * x.row(j);
            if (i != j) b.row(j) -= w * it.value() * x.row(i);
        }
}

class Terzopoulos final : public Stepper {
  public:
    using Stepper::Stepper;

  protected:
    void step(const MotionSystem& system, Points& x, Points& v, double t, double h,
              IntegratorReport& report) override {
        const int n = system.size();
        const double between = 0.5 * (before_s_ + h);
        before_s_ = h;

        MetricBuilder stiffness(n), drag(n);
        right_.setZero(n, 3);
        for (const auto& term : system.terms())
            term->add_secant(t, x, v, options_.lag_rate, stiffness, drag, right_);
        ++report.evaluations;
        K_ = stiffness.build({});
        C_ = drag.build({});
        A_ = K_ + C_ * (0.5 / h);  // still without M, but for every node

        // Right side for the move. The moves of fixed nodes are known and are subtracted.
        subtract_product(K_, 1, x, right_);
        subtract_product(C_, 0.5, v, right_);
        for (int i = 0; i < n; ++i)
            if (!is_fixed(system, i)) right_.row(i) += system.mass_kg()[i] / between * v.row(i);
        end_ = x;
        system.place_fixed(t + h, end_, v);
        move_ = end_ - x;
        subtract_product(A_, 1, move_, right_);
        for (int i = 0; i < n; ++i)
            if (is_fixed(system, i)) right_.row(i) = move_.row(i);
        eliminate_fixed(system, 1 / (h * between));

        ++report.linear_solves;
        if (factor_.factorise(A_, 1) == Definiteness::kSingular) {
            report.diverged = true;
            return;
        }
        move_.resize(n, 3);
        factor_.solve(right_.data(), move_.data(), 3);
        x += move_;
        v = move_ / h;
    }
    void forget() override { before_s_ = 0; }

  private:
    static bool is_fixed(const MotionSystem& system, int node) {
        return system.fixed()[static_cast<std::size_t>(node)] != 0;
    }

    /// Rows and columns of fixed nodes become those of the identity. The diagonal of all others gets their mass; every diagonal
    /// entry must exist.
    void eliminate_fixed(const MotionSystem& system, double mass_weight) {
        Eigen::SparseMatrix<double> diagonal(system.size(), system.size());
        diagonal.reserve(Eigen::VectorXi::Ones(system.size()));
        for (int i = 0; i < system.size(); ++i)
            diagonal.insert(i, i) = is_fixed(system, i) ? 1.0 : mass_weight * system.mass_kg()[i];
        for (int j = 0; j < A_.outerSize(); ++j)
            for (Eigen::SparseMatrix<double>::InnerIterator it(A_, j); it; ++it)
                if (is_fixed(system, j) || is_fixed(system, static_cast<int>(it.row())))
                    it.valueRef() = 0;
        sum_ = A_ + diagonal;
        A_.swap(sum_);
        A_.makeCompressed();
    }

    double before_s_ = 0;
    SymmetricFactor factor_;
    Eigen::SparseMatrix<double> K_, C_, A_, sum_;
    Points right_, move_, end_;
};

}  // namespace

std::unique_ptr<Integrator> make_terzopoulos(const IntegratorOptions& options) {
    return std::make_unique<Terzopoulos>(options);
}

}  // namespace risorius::solve::detail
