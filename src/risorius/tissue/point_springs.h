// SPDX-License-Identifier: MIT
/// \file
/// Hookean springs with dampers from any points of a body to fixed points in space, and a spring that a user pulls
/// interactively.
///
///   p  the point, m    o  the fixed end, m    l = |p - o|    l0  rest length, m    k  stiffness, N/m    c  damping, N s/m
///   E = k/2 (l - l0)^2      R = c/2 (dl/dt)^2, and c/2 |dp/dt|^2 for l0 = 0, which damps all directions
///
/// Source: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005, section 3.4.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/energy_term.h"
#include "risorius/solve/node_blend.h"

namespace risorius::tissue {

/// A spring with its damper.
struct PointSpring {
    solve::NodeBlend at;           ///< p
    Vec3 tied_to = Vec3::Zero();   ///< o, m
    double stiffness_n_per_m = 1;  ///< [0, inf)
    double rest_length_m = 0;      ///< [0, inf)
    double damping_ns_per_m = 0;   ///< [0, inf)
};

/// Throws Error when a value is outside its range. The message names the field by its path, which begins with `place`.
void check(const PointSpring& spring, const std::string& place);

/// The forces of a list of springs.
class PointSprings : public solve::EnergyTerm {
  public:
    explicit PointSprings(std::vector<PointSpring> springs);

    /// The springs may be changed between steps.
    std::vector<PointSpring>& list() { return springs_; }
    const std::vector<PointSpring>& list() const { return springs_; }

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override;

  private:
    std::vector<PointSpring> springs_;
};

/// A spring of rest length zero whose free end a caller moves while the simulation runs.
///
/// attach(), move() and release() may be called from any thread at any time. They take effect at the next begin_step(). So
/// nothing changes within a step, and the same calls between the same steps give the same motion. All other members belong to
/// the thread that steps the system.
class InteractiveSpring : public solve::EnergyTerm {
  public:
    /// Throws std::invalid_argument unless both values are finite and not negative.
    explicit InteractiveSpring(double stiffness_n_per_m, double damping_ns_per_m = 0);

    void attach(const solve::NodeBlend& at, const Vec3& free_end);
    /// With a stiffness and a damping of its own, until it is released.
    void attach(const solve::NodeBlend& at, const Vec3& free_end, double stiffness_n_per_m,
                double damping_ns_per_m);
    void move(const Vec3& free_end);  ///< without effect while released
    void release();

    bool attached() const { return !now_.list().empty(); }  ///< in the current step
    Vec3 free_end() const;  ///< of the current step, m; zero while released

    void begin_step(double t_s, double step_s, const Points& x, const Points& v) override;
    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override {
        now_.add_force(t_s, x, v, force);
    }
    double energy(double t_s, const Points& x) const override { return now_.energy(t_s, x); }
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override {
        return now_.add_potential(step, x, gradient);
    }
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override {
        now_.add_hessian(step, x, curvature, hessian);
    }
    /// Metric of the spring that is attached at the time of the call. A metric that was built before attaching does not contain
    /// the spring.
    void add_metric(double step_s, solve::MetricBuilder& metric) const override {
        now_.add_metric(step_s, metric);
    }
    void add_secant(double t_s, const Points& x, const Points& v, bool lag_rate,
                    solve::MetricBuilder& K, solve::MetricBuilder& damping,
                    Points& force) const override {
        now_.add_secant(t_s, x, v, lag_rate, K, damping, force);
    }

  private:
    double stiffness_n_per_m_, damping_ns_per_m_;
    std::mutex mutex_;                 // guards wanted_
    std::vector<PointSpring> wanted_;  // none or one
    PointSprings now_;
};

}  // namespace risorius::tissue
