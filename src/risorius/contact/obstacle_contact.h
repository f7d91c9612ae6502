// SPDX-License-Identifier: MIT
/// \file
/// Contact of a soft body's surface with one rigid obstacle, with friction. contact_law.h explains the symbols.
///
///   E = sum over samples of A k w(g(p))     A  area of the sample, m^2     p  its position
///
/// In implicit steps friction is lagged: the normal force and the tangent plane are those of the step's start. This makes
/// friction a potential mu N f0(|u|) of the slip u relative to the obstacle's own motion. Explicit steps use the present normal
/// force. Damping acts only on approach, so that surfaces do not stick; its strength is lagged in the same way. An equilibrium
/// has neither friction nor damping.
///
/// A sample that crosses a thin obstacle completely within one step is not detected.
#pragma once

#include <memory>
#include <vector>

#include "risorius/contact/contact_law.h"
#include "risorius/contact/obstacle.h"
#include "risorius/contact/surface_samples.h"
#include "risorius/solve/energy_term.h"

namespace risorius::contact {

/// The contact forces between one body and one obstacle.
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
    /// Every sample may touch at some time, so each contributes half its stiffness, whether it touches or not.
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    double min_gap_m(double t_s, const Points& x) const;  ///< negative: penetration
    int touching(double t_s, const Points& x) const;      ///< number of samples in contact
    /// Force of the obstacle on the body, with friction, N.
    Vec3 total_force(double t_s, const Points& x, const Points& v) const;

    const std::vector<ContactSample>& samples() const { return samples_; }
    const ContactMaterial& material() const { return material_; }

  private:
    struct Lagged {
        int sample;
        Vec3 start;  // p at the start of the step
        Vec3 normal;
        double friction_n;  // mu N
        double damping;     // N s/m
    };
    /// Motion of a lagged sample in the step relative to the obstacle: its slip, and its separation (negative on approach), m.
    struct Slip {
        Vec3 along;
        double apart;
    };
    Slip slip_of(const Lagged& lagged, const Rigid& carried, const Points& x) const;
    Rigid carried(const solve::ImplicitStep& step) const;  // motion of the obstacle in the step
    Vec3 force_on(const PlacedShape& shape, const ContactSample& sample, const Points& x,
                  const Points& v) const;

    std::vector<ContactSample> samples_;
    std::shared_ptr<const Obstacle> obstacle_;
    ContactMaterial material_;
    std::vector<Lagged> lagged_;
};

}  // namespace risorius::contact
