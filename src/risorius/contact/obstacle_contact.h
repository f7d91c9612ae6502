// SPDX-License-Identifier: MIT
/// \file
/// Contact of a soft body's surface with one rigid obstacle, with friction. contact_law.h explains the symbols.
///
///   E = sum over samples of A k w(g(p))     A  area of the sample, m^2     p  its position
///
/// In implicit steps friction is lagged: the normal force and the tangent plane are those at the start of the step. So friction
/// has the potential mu N f0(|u|), where u is the slip relative to the moving obstacle. Explicit steps use the normal force at
/// the present positions. Damping acts only while surfaces approach each other, so that they do not stick; its coefficient is
/// lagged in the same way. An equilibrium has neither friction nor damping.
///
/// A sample is a point of the surface with its area (surface_samples.h). A sample that passes through a thin obstacle within
/// one step is not detected.
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
    /// Adds half of the stiffness of every sample, whether it touches or not, because every sample may touch at some time.
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
    /// Motion of a sample in the step relative to the obstacle, m: its slip, and the change of its distance (negative on
    /// approach).
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
