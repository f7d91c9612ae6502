// SPDX-License-Identifier: MIT
/// \file
/// Zajac's musculotendon in a grid solid: fibres between successive nodes along a1, and tendons from the ends of the belly to
/// its anchors.
///
///   F0   maximum isometric force, N        l0   optimal fibre length, m      lTs   slack length of both tendons together, m
///   vmax maximum shortening speed, l0/s    alpha  pennation at l0            a   activation, 0..1     b   damping
///   fibre   l = sqrt(s^2 + w^2), s its length along the grid, w = l0 sin alpha: pennation grows at constant thickness
///           T = F0 [ a fl(mean of l/l0 along the chain) fv(l'/(vmax l0)) + fp(l/l0) + b l'/(vmax l0) ] along s: T s/l
///   tendon  T = F0 fT((lT - lTs/2) / (lTs/2)), one at either end of a chain
///
/// (M-1) N O fibres and 2 N O tendons make up N O chains, and each chain has an equal part of F0. l0 is the mean over the
/// chains. They divide it in proportion to their rest lengths, so that every fibre has the same stretch in the rest shape.
///
/// The force-length curve is evaluated at the mean length of the whole chain. Evaluated segment by segment, segments in series
/// on the falling limb would diverge in length. In an implicit step, fl is that of the step's start and fv is implicit, which
/// makes the potential convex. In an equilibrium fl has a potential of its own.
///
/// An end without anchor points is free; its nodes are held by what the muscle runs into, such as skin. A closed grid (a
/// sphincter) has M N O fibres and no ends; l0 and s are then lengths of one round. With only one anchored end, lTs belongs to
/// that end alone.
///
/// At a plane, lT is the distance of the tendon's node from the plane, and the tendon pulls only along the normal. So a belly
/// may narrow and swell up to its ends. This leaves drift and rotation along the plane free, so a weak spring of stiffness
/// F0 / l0 holds them (detail/plane_guide.h). At points of a plate, tendons become oblique when the belly swells, and squeeze its
/// ends together.
///
/// Rigid tendons keep their length and their direction in the frame of their anchor. Their ends at the belly are then points of
/// the anchor and no unknowns: the system must fix those nodes (tied_nodes) and move them (place_tied). The fibre length is
/// that of the path from anchor to anchor minus lTs, and the outermost fibres pull on the anchor itself. Nothing is stiff and
/// no step is limited. lTs may be 0, as for short facial muscles that begin on the bone.
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

/// Whether tendons stretch.
enum class TendonModel { kElastic, kRigid };

/// The parameters of a muscle. Field names are keys of a muscle in a file.
struct MuscleParameters {
    double f0_n = 0;              ///< F0                                        (0, inf)
    double optimal_length_m = 0;  ///< l0                                        (0, inf)
    double tendon_slack_m = 0;    ///< lTs; > 0 with elastic tendons            [0, inf)
    double max_speed_hz = 10;     ///< vmax, optimal lengths per second          (0, inf)
    double pennation_deg = 0;     ///< alpha                                     [0, 90)
    double damping = 0.05;        ///< b, damping force at vmax / F0             [0, inf)
    TendonModel tendon = TendonModel::kElastic;  ///< "elastic", "rigid"
    CurveShape curves = {};                      ///< for make_curves
};

/// Throws Error that names the field below `place`.
void check(const MuscleParameters& parameters, const std::string& place);
/// Reads an object whose keys are the fields; the first two are required. Throws Error.
MuscleParameters read_muscle_parameters(const JsonCursor& json);

/// Activation at a time.
using ActivationAt = std::function<double(double t_s)>;

/// Energy and forces of the fibres and tendons of one muscle.
class Musculotendon final : public solve::EnergyTerm {
  public:
    /// The nodes are those of the grid. Segments divide l0 in proportion to their lengths in `rest`. Throws Error, with a name
    /// below `place`, for parameters outside their ranges, an elastic tendon of zero length, and a rigid tendon at a plane.
    /// Throws std::invalid_argument for arrays of wrong size, a segment of zero length, and a ring with anchors.
    Musculotendon(const MuscleParameters& parameters, MuscleCurves curves,
                  const tissue::GridShape& grid, const Points& rest, Anchors anchors,
                  ActivationAt activation, const std::string& place = "muscle");

    const MuscleParameters& parameters() const { return parameters_; }

    void set_activation(ActivationAt activation) { activation_ = std::move(activation); }

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    /// J; its negative gradient is the isometric force: fv = 1, no damping.
    double energy(double t_s, const Points& x) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    /// Nodes that rigid tendons make part of an anchor, ascending; none with elastic tendons.
    std::vector<int> tied_nodes() const;
    /// Puts the tied nodes at the places of their anchors. It can serve as a solve::PrescribedMotion.
    void place_tied(double t_s, Points& x, Points& v) const;

    bool anchored(End end) const { return anchor(end).rest.rows() > 0; }
    Points anchor_points(End end, double t_s) const;  ///< N O x 3, m; no rows for a free end
    /// Where the tendons meet the anchor: its points, or the projections of the nodes onto its plane. N O x 3, m.
    Points tendon_feet(End end, double t_s, const Points& x) const;
    /// Force of each tendon on its anchor, N O x 3, N, and their sum. At a plane the forces of the plane guide are included,
    /// and torques are those of forces that act at the nodes. With rigid tendons these are the isometric forces of the
    /// outermost fibres; the belly's own stress at tied nodes is not included.
    Points anchor_forces(End end, double t_s, const Points& x) const;
    Vec3 anchor_pull(End end, double t_s, const Points& x) const;

    /// Mean of l/l0 along each chain, N O.
    Eigen::VectorXd stretch(const Points& x) const;
    /// Maximum minus minimum l/l0 among the segments of a chain, for the worst chain.
    double segment_spread(const Points& x) const;

  private:
    /// The present geometry of a fibre segment or tendon.
    struct Line {
        Vec3 direction = Vec3::Zero();  ///< from its first node to its second
        double span = 0;                ///< s, distance between its nodes
        double length = 0;              ///< l
        double slope = 0;               ///< dl/ds
        double curvature = 0;           ///< d2l/ds2
    };
    struct Segment {
        double optimal_m;    ///< its part of l0
        double thickness_m;  ///< its part of w
    };
    /// a fl of a chain. Slope and integral by l/l0 are set only in an equilibrium, in which fl varies with x.
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
    /// The node of the belly where the tendon of that end begins.
    int tendon_node(End end, int chain) const {
        return node(end == End::kOrigin ? 0 : grid_.m - 1, chain);
    }
    const Segment& segment(int m, int chain) const {
        return segments_[static_cast<std::size_t>(node(m, chain))];
    }
    static Line line(const Vec3& from, const Vec3& to, double thickness_m);
    /// The anchor of an end in its present place.
    struct Plate {
        Points points;
        Vec3 normal;  ///< zero for anchors of points
    };
    Plate plate(End end, double t_s) const;
    /// From the tendon's node of the belly to its point of the anchor. At a plane it goes to the projection of the node, and
    /// the span is the distance, negative beyond the plane.
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
    Eigen::VectorXd slack_m_[2];      ///< of the tendons at either end, for each chain
    Eigen::VectorXd optimal_m_;       ///< l0 of each chain
    PlaneGuide guide_[2];             ///< for ends at planes
    std::vector<Vec3> tied_rest_[2];  ///< nodes of the belly at either end
    std::vector<Segment> segments_;
};

}  // namespace risorius::muscle
