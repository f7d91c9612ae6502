// SPDX-License-Identifier: MIT
/// \file
/// Muscle fibres in a solid of tetrahedra: the belly of a muscle whose shape is a mesh. The solid itself is another term
/// (tissue/hyperelastic_tets.h).
///
///   l = |F d|      stretch of the fibres of a tetrahedron; F its deformation gradient, d their direction at rest, a unit vector
///   static         E = sum over tetrahedra V s0 l0 [ a Ifl(l/l0) + Ifp(l/l0) ]         T = s0 [ a fl(l/l0) + fp(l/l0) ]
///   in a step      v = (l - l_n) / (h vmax l0)              T = s0 [ a fl(l_n/l0) fv(v) + fp(l/l0) + b v ]
///
///   V    rest volume, m^3                    s0   specific tension, Pa: the maximum isometric force per area of the section at rest
///   l0   stretch of optimal length           a    activation, 0..1      h   step, s     l_n  stretch at the start of the step
///   vmax maximum shortening speed, l0/s      b    damping               fl, fp, fv  curves, Ifl, Ifp their integrals (muscle_curves.h)
///
/// T is the tension along the fibres per area at rest, Pa. A prism of section A with fibres along it pulls with A T, as the fibres of
/// a Musculotendon with F0 = A s0 do. Two things are not the same: pennation is in the directions d, and fl is taken for each tetrahedron,
/// not for a chain of fibres, unless active_by_mean is set. Where fl falls with length, tetrahedra in series would diverge in an equilibrium;
/// the passive stiffness of fibres and solid has to prevent it.
///
/// Sources: F. E. Zajac, Crit. Rev. Biomed. Eng. 17(4), 1989; Blemker, Pinsky & Delp 2005, J. Biomech. 38, 657-665.
#pragma once

#include <vector>

#include "risorius/core/types.h"
#include "risorius/muscle/curve_sets.h"
#include "risorius/muscle/muscle_curves.h"
#include "risorius/muscle/musculotendon.h"
#include "risorius/solve/energy_term.h"

namespace risorius::muscle {

struct FibreTetsParameters {
    double tension_pa = 0;       ///< s0                                       (0, inf)
    double optimal_stretch = 1;  ///< l0                                       (0, inf)
    double max_speed_hz = 10;    ///< vmax                                     (0, inf)
    double damping = 0.05;       ///< b                                        [0, inf)
    CurveShape curves = {};
    /// fl is taken at the mean of l/l0 over the muscle, as in a chain of fibres: where it falls, tetrahedra in series do not diverge. The
    /// exact second derivative then couples all nodes.
    bool active_by_mean = false;
};

/// Energy and forces of the fibres of one muscle.
class FibreTets final : public solve::EnergyTerm {
  public:
    /// `tets`: the tetrahedra of the muscle, with positive volumes in `rest`; `fibres`: d of each, unit vectors; `density`: factors of s0 for
    /// each, [0, inf), not all 0; empty: 1. Means are weighted by it. Throws
    /// std::invalid_argument for parameters outside their ranges, arrays that do not fit together and a tetrahedron without volume.
    FibreTets(const FibreTetsParameters& parameters, const Points& rest, const Tets& tets,
              const Points& fibres, ActivationAt activation,
              const std::vector<double>& density = {});

    const FibreTetsParameters& parameters() const { return parameters_; }
    void set_activation(ActivationAt activation) { activation_ = std::move(activation); }
    void set_tension_pa(double tension_pa) { parameters_.tension_pa = tension_pa; }  ///< [0, inf)

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    double mean_stretch(const Points& x) const;  ///< mean of l / l0 over the volume

    /// The fibres of one tetrahedron, at rest or moving so slowly that fv is 1.
    struct State {
        double stretch = 1;     ///< l / l0
        double tension_pa = 0;  ///< T
    };
    std::vector<State> states(double t_s, const Points& x) const;  ///< one per tetrahedron

  private:
    /// F d = sum of weight[k] x[node[k]].
    struct Element {
        int node[4];
        double weight[4];  ///< 1/m
        double volume_m3;  ///< V times the density
        double density;
    };
    /// The potential of a tetrahedron by its stretch, with its derivatives, over V s0.
    struct Pull {
        double energy = 0, tension = 0, slope = 0;
    };
    static Vec3 along(const Element& element, const Points& x) {
        Vec3 sum = Vec3::Zero();
        for (int k = 0; k < 4; ++k) sum += element.weight[k] * x.row(element.node[k]).transpose();
        return sum;
    }
    /// `mean`: of l / l0 over the muscle, now in an equilibrium, else at the start of the step.
    Pull pull(const solve::ImplicitStep& step, const Element& element, double stretch,
              double activation, double mean) const;
    double mean_for(const solve::ImplicitStep& step, const Points& x) const;
    void add_mean_hessian(double activation, const Points& x, solve::HessianBuilder& hessian) const;

    FibreTetsParameters parameters_;
    MuscleCurves curves_;
    std::vector<Element> elements_;
    double volume_m3_ = 0;
    ActivationAt activation_;
};

}  // namespace risorius::muscle
