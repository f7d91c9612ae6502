// SPDX-License-Identifier: MIT
/// \file
/// Soft tissue as tetrahedra: the metric and volume energy of a nearly incompressible solid.
///
///     E = sum V [ mu/4 |F^T F - I|^2 + K/2 ((1 - s) (M - 1)^2 + s (J - 1)^2) + c K/2 min(0, J - J_c)^2 ]
///
/// - F: deformation gradient; J = det F; G: gradients of the shape functions in a tet, 1/m
/// - M: mean of J over the tets of a fan (tet_fans.h), weighted by V K; J itself for a tet that is in no fan. The three tets of a prism
///   keep their volume together. If each kept its own, a layer of prisms would be too stiff (volumetric locking): it has four of these
///   conditions for each of its columns of nodes then, instead of twelve. The mean over patches of elements is that of
///   E. A. de Souza Neto, F. M. Andrade Pires, D. R. J. Owen (2005), F-bar-based linear triangles and tetrahedra for finite strain
///   analysis of nearly incompressible solids, Int. J. Numer. Meth. Engng 62, 353-383
/// - V: rest volume, m^3
/// - mu, K: shear modulus and modulus of the volume term (Lame's first parameter, not the bulk modulus), Pa
/// - s, J_c, c: kOwnVolume, kCrushed and kHardens, without unit. With s = 0, tets would change their volume at the cost of their
///   neighbours, and a held face would tremble
///
/// J is signed, so the energy of an inverted tet is not zero. Below J_c the tissue hardens, so that contact forces are balanced
/// before a tet inverts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/solve/lanes.h"
#include "risorius/solve/metric_builder.h"
#include "risorius/tissue/detail/tet_fans.h"

namespace risorius::solve {
enum class Curvature;
class HessianBuilder;
}  // namespace risorius::solve

namespace risorius::tissue {

/// Energy and forces of soft tissue. An object keeps scratch arrays, so only one thread at a time may use it.
class TetSolid {
  public:
    static constexpr double kOwnVolume = 0.1;  ///< s
    static constexpr double kCrushed = 0.3;    ///< J_c
    static constexpr double kHardens = 4;      ///< c

    /// Moduli are given per tet. Throws std::invalid_argument when a tet has no positive rest volume.
    TetSolid(const Tets& tets, const Points& rest, const Eigen::VectorXd& mu_pa,
             const Eigen::VectorXd& bulk_pa);
    /// The same with given fans instead of those that find_fans() finds: each tet in one fan or alone.
    TetSolid(const Tets& tets, const Points& rest, const Eigen::VectorXd& mu_pa,
             const Eigen::VectorXd& bulk_pa, const TetFans& fans);

    /// Returns E(x), J, and adds dE/dx to `gradient`, n x 3, N. The terms are summed in a fixed order. The energy is computed
    /// from displacements, so that the rest shape is exact in float too. In float, forces have a relative error of about 1e-6.
    double add_energy(const Points& x, Points& gradient,
                      solve::Precision precision = solve::Precision::kDouble) const;

    /// Begins a step at the positions `start`. From then on add_step_energy() adds damping that is proportional to the shear
    /// modulus:
    ///   d/2 sum V mu |F - F_start|^2,   d = `viscosity`: the time constant of damping divided by the length of the step.
    void begin_step(const Points& start, double viscosity, solve::Precision precision);
    double add_step_energy(const Points& x, Points& gradient, solve::Precision precision) const;

    /// Adds the second derivative at x. All pairs of nodes are always added, in the same order. kPositive: the negative part of
    /// each tet is removed.
    void add_hessian(const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const;

    /// Adds sum V (2 mu + K) G G^T, N/m, the stiffness of one coordinate at the rest shape. It is a good enough bound for a
    /// preconditioner.
    void add_metric(solve::MetricBuilder& builder) const;

    /// Adds scale * sum V mu G G^T, the second derivative of the damping.
    void add_laplacian(solve::MetricBuilder& builder, double scale) const;

    const Tets& tets() const { return tets_; }
    const Eigen::VectorXd& mu_pa() const { return mu_; }      ///< mu, per tet
    const Eigen::VectorXd& bulk_pa() const { return bulk_; }  ///< K, per tet
    TetFans fans() const;  ///< whose tets keep their volume together
    int size() const { return static_cast<int>(tets_.rows()); }
    Mat3 deformation_gradient(const Points& x, int tet) const;  ///< F
    /// Returns the Cauchy stress of a tet, Pa, without damping: the derivative of E by F, times F^T / J. Zero when J is 0.
    Mat3 cauchy_stress_pa(const Points& x, int tet) const;
    int inverted_count(const Points& x) const;          ///< tets with J <= 0
    double volume(const Points& x) const;               ///< signed, m^3
    double min_relative_volume(const Points& x) const;  ///< minimum J; 1 without tets
    Eigen::VectorXd lumped_mass(double density_kg_per_m3, int nodes) const;  ///< kg per node

  private:
    /// As many fans of tets (tet_fans.h) as there are lanes. kTets is the number of tets in a fan; it is 1 for single tets.
    template <class Real, int kTets>
    struct alignas(64) Group {
        using Lane = typename solve::LanesOf<Real>::Lane;
        static constexpr int kWidth = solve::LanesOf<Real>::kWidth;
        struct Tet {
            Lane b[9];   ///< inverse of the matrix of rest edges a-b, a-r_i, a-r_i+1; a row each
            Lane shear;  ///< V mu
            Lane bulk;   ///< V K
            Lane share;  ///< V K / its sum over the fan
        };
        Tet tet[kTets];
        std::int32_t node[kTets + 3][kWidth];  ///< a, b, r_0 .. ; [corner][lane]
    };
    /// Displacement gradient at the start of a step, for each tet of a group.
    template <class Real, int kTets>
    using Gradients = std::array<std::array<typename solve::LanesOf<Real>::Lane, 9>, kTets>;
    template <class Real, int kTets>
    struct Groups {
        std::vector<Group<Real, kTets>> list;
        std::vector<Gradients<Real, kTets>> start;
    };
    template <class Real>
    struct Work {
        Groups<Real, kFanTets> fans;
        Groups<Real, 1> alone;
        solve::PaddedRows<Real> displacement, gradient;
    };
    template <class Real>
    void fill(Work<Real>& work, const TetFans& found) const;
    void place(const TetFans& found);
    template <class Real, int kTets>
    void fill(Groups<Real, kTets>& groups, const std::vector<TetFan>& fans) const;
    template <class Real>
    void begin_step_in(Work<Real>& work, const Points& start) const;
    template <class Real, bool kInStep>
    double add_energy_in(Work<Real>& work, const Points& x, Points& gradient) const;
    double signed_volume(const Points& x, int tet) const;
    double mean_volume_ratio(const Points& x, int tet) const;  ///< M
    void add_gradients(solve::MetricBuilder& builder, const Eigen::VectorXd& weight) const;

    Tets tets_;
    Points rest_;
    Eigen::VectorXd rest_volume_, mu_, bulk_;
    /// A fan, or a tet that is in none.
    struct Fan {
        int nodes = 0;  ///< 6 or 4; there are three fewer tets
        std::array<int, kFanTets> tets{};
        std::array<int, kFanTets + 3> node{};  ///< a, b, r_0 ..
        double bulk = 0;                       ///< sum of V K
    };
    /// Where a tet is in its fan.
    struct Place {
        int fan = 0;
        double share = 0;             ///< V K / its sum over the fan
        std::array<int, 4> corner{};  ///< 6 fan + the number of the corner's node in the fan
    };
    std::vector<Fan> fans_;
    std::vector<Place> place_;   ///< per tet
    std::vector<Mat3> inverse_;  ///< of the matrix of rest edges x_k+1 - x_0; rows
    double viscosity_ = 0;       ///< of the current step, from begin_step()
    mutable Work<double> double_;
    mutable Work<float> single_;
};

}  // namespace risorius::tissue
