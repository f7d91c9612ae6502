// SPDX-License-Identifier: MIT
/// \file
/// Forces at any points of a body that depend on time: box, triangle and sine pulses along a fixed direction.
///
///   f(t) = pulse(t) d      d  direction, length 1      E = - f(t) . p      p  the point, m
///
/// Source: M. Dobsik, Computer Animation of Soft Tissues, Brno 2005, section 3.4.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/energy_term.h"
#include "risorius/solve/node_blend.h"

namespace risorius::tissue {

/// The course of a pulse in time.
enum class PulseShape {
    kBox,       ///< is the amplitude during the whole pulse
    kTriangle,  ///< rises to the amplitude at half time and falls again
    kSine       ///< amplitude sin(2 pi frequency (t - start) + phase)
};

/// "box", "triangle", "sine".
const std::vector<std::string_view>& pulse_shape_names();
PulseShape pulse_shape_named(std::string_view name);  ///< throws std::invalid_argument

/// A pulse acts in [start, start + duration).
struct Pulse {
    PulseShape shape = PulseShape::kBox;
    double amplitude_n = 1;
    double start_s = 0;
    double duration_s = std::numeric_limits<double>::infinity();  ///< > 0; finite for a triangle
    double frequency_hz = 1;                                      ///< of the sine      (0, inf)
    double phase_rad = 0;                                         ///< of the sine
};

/// The force of the pulse at a time, N; 0 outside the pulse.
double force_n(const Pulse& pulse, double t_s);
/// Exact integral of the force from `from_s` to `to_s`, N s.
double impulse_ns(const Pulse& pulse, double from_s, double to_s);

/// A pulse that acts at one point of a body.
struct ForceGenerator {
    solve::NodeBlend at;
    Vec3 direction = Vec3::UnitZ();  ///< of any length except zero
    Pulse pulse;
};

/// Throws Error when a value is outside its range. The message names the field by its path, which begins with `place`.
void check(const ForceGenerator& generator, const std::string& place);

/// The forces of a list of generators. Explicit methods use the force at each time at which they evaluate it. An implicit step
/// uses its mean over the step; so the body receives the whole impulse for any step length, and short pulses are not missed. An
/// equilibrium uses the force at the time of the equilibrium.
class ForceGenerators : public solve::EnergyTerm {
  public:
    explicit ForceGenerators(std::vector<ForceGenerator> generators);

    const std::vector<ForceGenerator>& list() const { return generators_; }

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep&, const Points&, solve::Curvature,
                     solve::HessianBuilder&) const override {}
    void add_metric(double, solve::MetricBuilder&) const override {}

  private:
    std::vector<ForceGenerator> generators_;  // directions of length 1
};

}  // namespace risorius::tissue
