// Fibres of a volume muscle with their tendons: chains of nodes that pull along themselves with one tension each.
//
//   S    length of a chain's fibres, S0 at rest, m      r    l/l0 at rest      alpha   pennation at l0
//   lam = sqrt( (S/S0)^2 (r^2 - sin^2 alpha) + sin^2 alpha )        fibre length / optimal length, thickness constant
//   E  = F0 l0 [ a Ifl(lam) + Ifp(lam) ] + F0 lTs IfT(tendon strain) for each tendon,   l0 = S0 / sqrt(r^2 - sin^2 alpha)
//
// The length is that of the whole chain, so segments in series cannot run apart. An elastic tendon is the first and the
// last segment of a chain and is just slack at rest; a rigid one is a constant part of the length.
#pragma once

#include <vector>

#include "core/types.h"
#include "muscle/muscle_curves.h"
#include "solve/hessian_builder.h"

namespace risorius::muscle {

struct ChainProperties {
    double f0_n = 0;            ///< F0 of one chain                                [0, inf)
    double rest_stretch = 1;    ///< r                                              (sin alpha, inf)
    double pennation_rad = 0;   ///< alpha                                          [0, pi/2)
    double rigid_tendon_m = 0;  ///< part of a chain's length that does not change  [0, rest length)
    bool elastic_tendons = false;  ///< the first and the last segment are tendons
};

class ChainSet {
  public:
    /// Each chain is a list of rows of `rest`, three or more with elastic tendons, otherwise two or more. Throws
    /// std::invalid_argument for a segment without length.
    ChainSet(std::vector<std::vector<int>> chains, const Points& rest, ChainProperties properties,
             MuscleCurves curves);

    void set_f0(double f0_n) { properties_.f0_n = f0_n; }
    const ChainProperties& properties() const { return properties_; }

    /// Returns E, J, and adds dE/dx to `gradient`, N.
    double add_energy(const Points& x, double activation, Points& gradient) const;

    /// A positive second derivative, segment by segment: a chain's stiffness is given to its segments in series.
    /// Node i is row `row[i]` of the builder.
    void add_stiffness(const Points& x, double activation, const std::vector<int>& row,
                       solve::HessianBuilder& hessian) const;

    double mean_stretch(const Points& x) const;  ///< of lam / r over the chains

  private:
    struct Chain {
        std::vector<int> node;
        double rest_m = 0;            ///< S0
        double tendon_m[2] = {0, 0};  ///< slack lengths
    };
    struct Pull {
        double tension = 0, slope = 0, energy = 0;
    };
    int first_fibre() const { return properties_.elastic_tendons ? 1 : 0; }
    int end_fibre(const Chain& chain) const {
        return static_cast<int>(chain.node.size()) - 1 - first_fibre();
    }
    double fibre_length(const Chain& chain, const Points& x) const;
    double stretch(const Chain& chain, double length_m) const;
    Pull fibre_pull(const Chain& chain, double length_m, double activation) const;
    Pull tendon_pull(double slack_m, double length_m) const;

    std::vector<Chain> chains_;
    ChainProperties properties_;
    MuscleCurves curves_;
};

}  // namespace risorius::muscle
