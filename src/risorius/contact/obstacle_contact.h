// SPDX-License-Identifier: MIT
/// \file
/// Contact of a soft body's surface with one rigid obstacle, with friction (see contact_law.h for the symbols).
///
///   E = sum over samples of A k w(g(p))     A  area of the sample, m^2     p  its place
///
/// Implicit steps lag friction: the normal force and the tangent plane are those of the step's start, which makes friction a
/// potential mu N f0(|u|) of the slip u against the obstacle's own motion. Explicit steps take the normal force as it is.
/// Damping acts on approach only, so that surfaces do not stick; its strength is lagged in the same way. An equilibrium has
/// neither friction nor damping. A sample that passes through an obstacle thinner than its way in one step is not caught.
#pragma once

#include <memory>
#include <vector>

#include "risorius/contact/contact_law.h"
#include "risorius/contact/obstacle.h"
#include "risorius/contact/surface_samples.h"
#include "risorius/solve/energy_term.h"

namespace risorius::contact {

class ObstacleContact : public solve::EnergyTerm {
  public:
    ObstacleContact(std::vector<ContactSample> samples, std::shared_ptr<const Obstacle> obstacle,
                    const ContactMaterial& material);

    void begin_step(double t_s, double step_s, const Points& x, const Points& v) override;
    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    /// Every sample may touch some day: each gives half its stiffness, touching or not.
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    double min_gap_m(double t_s, const Points& x) const;  ///< negative: penetration
    int touching(double t_s, const Points& x) const;      ///< samples that press
    /// Of the obstacle on the body, friction included, N.
    Vec3 total_force(double t_s, const Points& x, const Points& v) const;

    const std::vector<ContactSample>& samples() const { return samples_; }
    const ContactMaterial& material() const { return material_; }

  private:
    struct Lagged {
        int sample;
        Vec3 start;  // p at the step's start
        Vec3 normal;
        double friction_n;  // mu N
        double damping;     // N s/m
    };
    /// Slip of a lagged sample in the step, and its approach (negative when nearing), against the obstacle's motion.
    struct Slip {
        Vec3 along;
        double apart;
    };
    Slip slip_of(const Lagged& lagged, const Rigid& carried, const Points& x) const;
    Rigid carried(const solve::ImplicitStep& step) const;  // the obstacle's motion in the step
    Vec3 force_on(const PlacedShape& shape, const ContactSample& sample, const Points& x,
                  const Points& v) const;

    std::vector<ContactSample> samples_;
    std::shared_ptr<const Obstacle> obstacle_;
    ContactMaterial material_;
    std::vector<Lagged> lagged_;
};

}  // namespace risorius::contact
