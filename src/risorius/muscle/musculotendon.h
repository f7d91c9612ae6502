// SPDX-License-Identifier: MIT
/// \file
/// Zajac's musculotendon in a grid solid of M x N x O nodes, which is the belly of the muscle. Fibres connect successive nodes
/// along a1, and tendons connect the ends of the belly with its anchors. A chain is one row of fibres along a1 with its
/// tendons.
///
///   F0   maximum isometric force, N        l0   optimal fibre length, m      lTs   slack length of both tendons together, m
///   vmax maximum shortening speed, l0/s    alpha  pennation at l0            a   activation, 0..1     b   damping
///   fibre   l = sqrt(s^2 + w^2), s its length along the grid, w = l0 sin alpha: pennation grows at constant thickness
///           T = F0 [ a fl(mean of l/l0 along the chain) fv(l'/(vmax l0)) + fp(l/l0) + b l'/(vmax l0) ] along s: T s/l
///   tendon  T = F0 fT((lT - lTs/2) / (lTs/2)), one at either end of a chain
///
/// T is the tension, N, l' = dl/dt, and lT is the length of one tendon, m. fl and fp are the force-length curves, fv is the
/// force-velocity curve, and fT is the tendon curve (muscle_curves.h). (M-1) N O fibres and 2 N O tendons make up N O chains,
/// and each chain has an equal part of F0. l0 is the mean over the chains. The l0 of a chain is proportional to its rest
/// length, so every fibre has the same stretch in the rest shape.
///
/// The force-length curve is evaluated at the mean length of the whole chain. If it were evaluated for each segment, segments
/// in series would diverge in length where the curve falls. In an implicit step, fl is taken at the start of the step and fv at
/// its end, so the potential is convex. In an equilibrium, the potential contains the integral of fl.
///
/// An end without anchor points is free. Its nodes are then held by the tissue into which the muscle inserts, such as skin. A
/// closed grid (a sphincter) has M N O fibres and no ends; l0 and s are then lengths of one round. With only one anchored end,
/// lTs is the slack length of the tendons at that end.
///
/// An anchor may be a plane. Then lT is the distance of the last node of the belly from the plane, and the tendon pulls only
/// along the normal. So the ends of the belly can become narrower and wider. They could also move and rotate along the plane,
/// so a weak spring of stiffness F0 / l0 prevents this (detail/plane_guide.h). An anchor may also be points of a plate. Then
/// the tendons become oblique when the belly swells, and compress its ends.
///
/// Rigid tendons keep their length and their direction in the frame of their anchor. Their ends at the belly then move with the
/// anchor and are no unknowns: the system must fix these nodes (tied_nodes) and move them (place_tied). The fibre length is
/// that of the path from anchor to anchor minus lTs, and the outermost fibres pull on the anchor itself. So no tendon is stiff,
/// and none limits the length of a step. lTs may be 0, as for short facial muscles that begin on the bone.
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

/// The parameters of a muscle. The field names are the keys of a muscle in a file.
struct MuscleParameters {
    double f0_n = 0;              ///< F0                                        (0, inf)
    double optimal_length_m = 0;  ///< l0                                        (0, inf)
    double tendon_slack_m = 0;    ///< lTs; > 0 with elastic tendons            [0, inf)
    double max_speed_hz = 10;     ///< vmax, optimal lengths per second          (0, inf)
    double pennation_deg = 0;     ///< alpha                                     [0, 90)
    double damping = 0.05;        ///< b: damping force at vmax, divided by F0      [0, inf)
    TendonModel tendon = TendonModel::kElastic;  ///< "elastic", "rigid"
    CurveShape curves = {};                      ///< argument of make_curves()
};

/// Throws Error when a value is outside its range. The message names the field by its path, which begins with `place`.
void check(const MuscleParameters& parameters, const std::string& place);
/// Reads an object whose keys are the field names. The first two are required. Throws Error for wrong or missing values.
MuscleParameters read_muscle_parameters(const JsonCursor& json);

/// The activation at time t, 0..1.
using ActivationAt = std::function<double(double t_s)>;

/// Energy and forces of the fibres and tendons of one muscle.
class Musculotendon final : public solve::EnergyTerm {
  public:
    /// The nodes of the system are those of the grid. The optimal length of a segment is proportional to its length in `rest`.
    /// Throws Error, with a path that begins with `place`, for parameters outside their ranges, an elastic tendon of zero
    /// length, and a rigid tendon at a plane. Throws std::invalid_argument for arrays of wrong size, a segment of zero length,
    /// and a ring with anchors.
    Musculotendon(const MuscleParameters& parameters, MuscleCurves curves,
                  const tissue::GridShape& grid, const Points& rest, Anchors anchors,
                  ActivationAt activation, const std::string& place = "muscle");

    const MuscleParameters& parameters() const { return parameters_; }

    void set_activation(ActivationAt activation) { activation_ = std::move(activation); }

    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    /// Stored energy, J. Its negative gradient is the isometric force, with fv = 1 and no damping.
    double energy(double t_s, const Points& x) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    /// The nodes that move with an anchor because of rigid tendons, ascending; none with elastic tendons.
    std::vector<int> tied_nodes() const;
    /// Moves the tied nodes with their anchors. It can serve as a solve::PrescribedMotion.
    void place_tied(double t_s, Points& x, Points& v) const;

    bool anchored(End end) const { return anchor(end).rest.rows() > 0; }
    Points anchor_points(End end, double t_s) const;  ///< N O x 3, m; no rows for a free end
    /// The points where the tendons meet the anchor, N O x 3, m: the points of the anchor, or the projections of the nodes onto
    /// its plane.
    Points tendon_feet(End end, double t_s, const Points& x) const;
    /// Force of each tendon on its anchor, N O x 3, N. At a plane the forces of the plane guide are included, and the forces
    /// act at the positions of the nodes. With rigid tendons these are the isometric forces of the outermost fibres; the
    /// belly's own stress at tied nodes is not included.
    Points anchor_forces(End end, double t_s, const Points& x) const;
    Vec3 anchor_pull(End end, double t_s, const Points& x) const;  ///< sum of the above, N

    /// Mean of l/l0 along each chain, N O.
    Eigen::VectorXd stretch(const Points& x) const;
    /// The maximum of l/l0 among the segments of a chain minus the minimum. The result is the largest over all chains.
    double segment_spread(const Points& x) const;

  private:
    /// Direction and length of a fibre segment or tendon at x.
    struct Line {
        Vec3 direction = Vec3::Zero();  ///< from its first node to its second
        double span = 0;                ///< s, distance between its nodes
        double length = 0;              ///< l
        double slope = 0;               ///< dl/ds
        double curvature = 0;           ///< d2l/ds2
    };
    struct Segment {
        double optimal_m;    ///< its fraction of l0, m
        double thickness_m;  ///< its fraction of w, m
    };
    /// a fl of a chain, with slope and integral by l/l0. These two are set only in an equilibrium, in which fl varies with x.
    struct Active {
        double force = 0, slope = 0, integral = 0;
    };
    /// The potential U(l) of a segment in a step, J, and dU/dl, N, and d2U/dl2, N/m.
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
    /// The anchor of an end at a time.
    struct Plate {
        Points points;
        Vec3 normal;  ///< zero for anchors of points
    };
    Plate plate(End end, double t_s) const;
    /// The line from the end of the belly to the point of the anchor. At a plane it ends at the projection of the node, and the
    /// span is the distance from the plane, negative beyond it.
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
