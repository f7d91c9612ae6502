// SPDX-License-Identifier: MIT
/// \file
/// Zajac's musculotendon in a grid solid: fibres between successive nodes along a1, and tendons from the ends of the belly
/// to its anchors.
///
///   F0   greatest isometric force, N       l0   optimal fibre length, m      lTs   slack length of both tendons together, m
///   vmax greatest shortening speed, l0/s   alpha  pennation at l0            a   activation, 0..1     b   damping
///   fibre   l = sqrt(s^2 + w^2), s its length along the grid, w = l0 sin alpha: pennation grows at constant thickness
///           T = F0 [ a fl(mean of l/l0 along the chain) fv(l'/(vmax l0)) + fp(l/l0) + b l'/(vmax l0) ] along s: T s/l
///   tendon  T = F0 fT((lT - lTs/2) / (lTs/2)), one at either end of a chain
///
/// (M-1) N O fibres and 2 N O tendons share F0 among the N O chains; l0 is the mean of the chains', which share it as they
/// share length at rest, so that every fibre is stretched alike there. Force-length is taken of the whole chain's mean length: taken segment by segment, segments in series on the falling limb run apart. For an implicit step fl is that of
/// the step's start and fv is implicit, which makes the potential convex; in an equilibrium fl has a potential of its own.
///
/// Ends: an end without anchor points is free: what the muscle runs into, such as skin, holds its nodes. A closed grid, a
/// sphincter, has M N O fibres and no ends; l0 and s are then once round. Of one anchored end lTs is that end's alone.
///
/// At a plane lT is the distance of the tendon's node from it, and the tendon pulls along its normal alone: a belly may
/// narrow and swell up to its ends. Drift and turn along the plane, which that leaves free, F0 / l0 holds weakly
/// (detail/plane_guide.h). At points of a plate tendons incline as the belly swells, and press its ends together.
///
/// Rigid tendons keep their length and their direction in the frame of their anchor. Their ends at the belly are then
/// points of the anchor, no unknowns: the system has to hold those nodes (tied_nodes) and move them (place_tied), the
/// fibre length is that of the path from anchor to anchor less lTs, and the outermost fibres pull on the anchor itself.
/// Nothing is stiff, no step is limited; lTs may be 0, as of short facial muscles that begin on the bone.
///
/// Sources: F. E. Zajac, Crit. Rev. Biomed. Eng. 17(4), 1989; M. Dobsik, Computer Animation of Soft Tissues, Brno 2005, 4.2.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/muscle/curve_sets.h"
#include "risorius/muscle/detail/anchors.h"
#include "risorius/muscle/detail/plane_guide.h"
#include "risorius/muscle/muscle_curves.h"
#include "risorius/solve/energy_term.h"
#include "risorius/tissue/solid_material.h"

namespace risorius::muscle {

enum class TendonModel { kElastic, kRigid };

struct MuscleParameters {
    double f0_n = 0;              ///< F0                                        (0, inf)
    double optimal_length_m = 0;  ///< l0                                        (0, inf)
    double tendon_slack_m = 0;    ///< lTs; above 0 where elastic tendons are    [0, inf)
    double max_speed_hz = 10;     ///< vmax, optimal lengths per second          (0, inf)
    double pennation_deg = 0;     ///< alpha                                     [0, 90)
    double damping = 0.05;        ///< b, ratio of F0 at vmax                    [0, inf)
    TendonModel tendon = TendonModel::kElastic;  ///< "elastic", "rigid"
    CurveShape curves = {};                      ///< for make_curves
};

/// Throws Error with the field named below `place`.
void check(const MuscleParameters& parameters, const std::string& place);
/// An object whose keys are the fields; the first two are required.
MuscleParameters read_muscle_parameters(const JsonCursor& json);

/// Activation at a time.
using ActivationAt = std::function<double(double t_s)>;

class Musculotendon final : public solve::EnergyTerm {
  public:
    /// Nodes are those of the grid; `rest` tells how segments share l0, by their lengths. Throws Error for parameters
    /// outside their ranges (named below `place`), an elastic tendon without length and a rigid one on a plane among them, and std::invalid_argument
    /// for arrays of wrong size, a segment without length or a ring with anchors.
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

    /// Nodes that rigid tendons make part of an anchor, ascending; none for elastic ones.
    std::vector<int> tied_nodes() const;
    /// Puts them where the anchors are: a solve::PrescribedMotion.
    void place_tied(double t_s, Points& x, Points& v) const;

    bool anchored(End end) const { return anchor(end).rest.rows() > 0; }
    Points anchor_points(End end, double t_s) const;  ///< N O x 3, m; no rows of a free end
    /// Where the tendons meet the anchor: its points, or the feet of the nodes on its plane. N O x 3, m.
    Points tendon_feet(End end, double t_s, const Points& x) const;
    /// What each tendon pulls its anchor with, N O x 3, N; and their sum. Of a plane with what holds the end before it:
    /// torques are those of forces in the nodes. Of rigid tendons: the outermost fibres at rest; the belly's own stress in
    /// tied nodes comes on top.
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
    const Anchor& anchor(End end) const {
        return end == End::kOrigin ? anchors_.origin : anchors_.insertion;
    }
    bool elastic(End end) const {
        return parameters_.tendon == TendonModel::kElastic && anchored(end);
    }
    static std::size_t side(End end) { return end == End::kOrigin ? 0 : 1; }
    double slack_m(End end, int chain) const { return slack_m_[side(end)][chain]; }
    int segments_along() const { return grid_.cells(0); }
    int node(int m, int chain) const { return m * chains() + chain; }
    int next_node(int m, int chain) const { return node(grid_.next(m), chain); }
    /// Of the belly, where the tendon of that end begins.
    int tendon_node(End end, int chain) const {
        return node(end == End::kOrigin ? 0 : grid_.m - 1, chain);
    }
    const Segment& segment(int m, int chain) const {
        return segments_[static_cast<std::size_t>(node(m, chain))];
    }
    static Line line(const Vec3& from, const Vec3& to, double thickness_m);
    /// Of an end as its anchor lies.
    struct Plate {
        Points points;
        Vec3 normal;  ///< zero of points
    };
    Plate plate(End end, double t_s) const;
    /// From its node of the belly to its point of the anchor or its foot on the plane, whose distance is its span, negative
    /// beyond the plane.
    Line tendon(const Points& x, const Plate& plate, End end, int chain) const;
    Line fibre(const Points& x, int m, int chain) const;
    double mean_stretch(const Points& x, int chain) const;
    Active active(const solve::ImplicitStep& step, const Points& x, int chain) const;
    Pull fibre_pull(const solve::ImplicitStep& step, const Line& now, int m, int chain,
                    double active) const;
    void set_slack();
    double isometric_tension(double t_s, const Points& x, int m, int chain) const;
    double tendon_energy(double t_s, const Points& x) const;
    void add_tendon_force(double t_s, const Points& x, double sign, Points& force) const;
    void add_chain_block(const Points& x, int chain, double stiffness,
                         solve::HessianBuilder& hessian) const;

    MuscleParameters parameters_;
    MuscleCurves curves_;
    tissue::GridShape grid_;
    Anchors anchors_;
    ActivationAt activation_;
    double chain_force_n_;            ///< F0 / (N O)
    Eigen::VectorXd slack_m_[2];      ///< of the tendons at either end, per chain
    Eigen::VectorXd optimal_m_;       ///< l0 of each chain
    PlaneGuide guide_[2];             ///< of the ends at planes
    std::vector<Vec3> tied_rest_[2];  ///< nodes of the belly at either end
    std::vector<Segment> segments_;
};

}  // namespace risorius::muscle
