// Zajac's musculotendon in a grid solid: fibres between successive nodes along a1, and tendons from both ends of the belly
// to two planar anchors.
//
//   F0   greatest isometric force, N       l0   optimal fibre length, m      lTs   slack length of both tendons together, m
//   vmax greatest shortening speed, l0/s   alpha  pennation at l0            a   activation, 0..1     b   damping
//   fibre   l = sqrt(s^2 + w^2), s its length along the grid, w = l0 sin alpha: pennation grows at constant thickness
//           T = F0 [ a fl(mean of l/l0 along the chain) fv(l'/(vmax l0)) + fp(l/l0) + b l'/(vmax l0) ] along s: T s/l
//   tendon  T = F0 fT((lT - lTs/2) / (lTs/2)), one at either end of a chain
//
// (M-1) N O fibres and 2 N O tendons share F0 among the N O chains. Force-length is taken of the whole chain's mean
// length: taken segment by segment, segments in series on the falling limb run apart. For an implicit step fl is that of
// the step's start and fv is implicit, which makes the potential convex; in an equilibrium fl has a potential of its own.
//
// Sources: F. E. Zajac, Crit. Rev. Biomed. Eng. 17(4), 1989; M. Dobsik, Computer Animation of Soft Tissues, Brno 2005, 4.2.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/json_cursor.h"
#include "muscle/curve_sets.h"
#include "muscle/muscle_curves.h"
#include "solve/force_term.h"
#include "tissue/solid_material.h"

namespace risorius::muscle {

struct MuscleParameters {
    double f0_n = 0;                ///< F0                                        (0, inf)
    double optimal_length_m = 0;    ///< l0                                        (0, inf)
    double tendon_slack_m = 0;      ///< lTs                                       (0, inf)
    double greatest_speed_hz = 10;  ///< vmax, optimal lengths per second          (0, inf)
    double pennation_deg = 0;       ///< alpha                                     [0, 90)
    double damping = 0.05;          ///< b, ratio of F0 at vmax                    [0, inf)
    CurveShape curves = {};         ///< for make_curves
};

/// Throws Error with the field named below `place`.
void check(const MuscleParameters& parameters, const std::string& place);
/// An object whose keys are the fields; the first three are required.
MuscleParameters read_muscle_parameters(const JsonCursor& json);

enum class End { kOrigin, kInsertion };  ///< beside m = 0 and beside m = M - 1

/// What one end of a muscle is tied to: a point per chain on a rigid plate or bone.
struct Anchor {
    Points rest;  ///< N O x 3, m; chain n O + o
    std::function<Rigid(double t_s)> motion =
        {};  ///< of the plate from rest; empty: it stands still
};

/// Plates across the ends of a belly at rest, half the slack length away along the chains' mean direction.
struct Anchors {
    Anchor origin, insertion;
};
Anchors planar_anchors(const tissue::GridShape& grid, const Points& rest, double tendon_slack_m);

/// Activation at a time.
using ActivationAt = std::function<double(double t_s)>;

class Musculotendon final : public solve::ForceTerm {
  public:
    /// Nodes are those of the grid; `rest` tells how segments share l0, by their lengths. Throws Error for parameters
    /// outside their ranges (named below `place`) and std::invalid_argument for arrays of wrong size or a segment without
    /// length.
    Musculotendon(const MuscleParameters& parameters, MuscleCurves curves,
                  const tissue::GridShape& grid, const Points& rest, Anchors anchors,
                  ActivationAt activation, const std::string& place = "muscle");

    const MuscleParameters& parameters() const { return parameters_; }

    void set_activation(ActivationAt activation) { activation_ = std::move(activation); }

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    /// The isometric force derives from it: fv = 1, no damping.
    double energy(double t_s, const Points& x) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    Points anchor_points(End end, double t_s) const;  ///< N O x 3, m
    /// What each tendon pulls its point of the anchor with, N O x 3, N; and their sum.
    Points anchor_forces(End end, double t_s, const Points& x) const;
    Vec3 anchor_pull(End end, double t_s, const Points& x) const;

    /// Mean of l/l0 along each chain, N O.
    Eigen::VectorXd stretch(const Points& x) const;
    /// Greatest minus least l/l0 among the segments of a chain; the worst chain.
    double segment_spread(const Points& x) const;

  private:
    /// A fibre segment or tendon as it lies.
    struct Line {
        Vec3 direction = Vec3::Zero();  ///< from its first node to its second
        double span = 0;                ///< s, distance of its nodes
        double length = 0;              ///< l
        double slope = 0;               ///< dl/ds
        double curvature = 0;           ///< d2l/ds2
    };
    struct Segment {
        double optimal_m;    ///< its share of l0
        double thickness_m;  ///< its share of w
    };
    /// a fl of a chain; slope and integral by l/l0 in an equilibrium only, in which it varies with x.
    struct Active {
        double force = 0, slope = 0, integral = 0;
    };
    /// U(l) of a segment in a step: J, dU/dl, d2U/dl2.
    struct Pull {
        double energy = 0, tension = 0, slope = 0;
    };

    int chains() const { return grid_.n * grid_.o; }
    int node(int m, int chain) const { return m * chains() + chain; }
    /// Of the belly, where the tendon of that end begins.
    int tendon_node(End end, int chain) const {
        return node(end == End::kOrigin ? 0 : grid_.m - 1, chain);
    }
    const Segment& segment(int m, int chain) const {
        return segments_[static_cast<std::size_t>(node(m, chain))];
    }
    static Line line(const Vec3& from, const Vec3& to, double thickness_m);
    /// From its node of the belly to its point of the anchor.
    Line tendon(const Points& x, const Points& plate, End end, int chain) const;
    Line fibre(const Points& x, int m, int chain) const;
    double mean_stretch(const Points& x, int chain) const;
    Active active(const solve::ImplicitStep& step, const Points& x, int chain) const;
    Pull fibre_pull(const solve::ImplicitStep& step, const Line& now, int m, int chain,
                    double active) const;
    double tendon_energy(double t_s, const Points& x) const;
    void add_tendon_force(double t_s, const Points& x, double sign, Points& force) const;
    void add_chain_block(const Points& x, int chain, double stiffness,
                         solve::HessianBuilder& hessian) const;

    MuscleParameters parameters_;
    MuscleCurves curves_;
    tissue::GridShape grid_;
    Anchors anchors_;
    ActivationAt activation_;
    double chain_force_n_;  ///< F0 / (N O)
    double half_slack_m_;   ///< lTs / 2
    std::vector<Segment> segments_;
};

}  // namespace risorius::muscle
