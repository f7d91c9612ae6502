// SPDX-License-Identifier: MIT
/// \file
/// Muscle fibres as polylines with a tension along their segments. Their points are embedded in the tissue or fixed to a rigid
/// body (a bone).
///
///   l   segment length, l0 its optimal length, m     lam = l / l0     a   activation, 0..1     F0   maximum force, N
///   static      E = sum over segments F0 l0 [ a Ifl(lam) + Ifp(lam) ]                  T = F0 [ a fl(lam) + fp(lam) ]
///   in a step   E = sum over segments F0 [ a fl(lam_e) h vmax l0 Ifv(v) + l0 Ifp(lam) ] T = F0 [ a fl(lam_e) fv(v) + fp(lam) ]
///               v = (l - l_n) / (h vmax l0), l_n the length at the start of a step of h seconds, lam_e the expected stretch at its
///               end, vmax in optimal lengths per second
///
/// Fibres with a tendon or pennation are shorter than their segment: with s the length of the segment and s0 that at rest
///
///   l = sqrt( (s - t s0)^2 + (l0 sin alpha)^2 )      t     tendon_fraction, rigid, spread evenly over the fibre
///                                                    alpha pennation at l0
///
/// and T acts along the segment, multiplied by dl/ds. Without either, l = s.
///
/// T is the tension, N. fl and fp are the active and passive force-length curves of muscle/detail/hill_shape.h, fv is the
/// force-velocity curve of muscle/muscle_curves.h, and Ifl, Ifp and Ifv are their integrals. E of a step is convex in l. When a
/// motion in steps has come to rest (l = l_n, fv = 1), it has reached a static equilibrium. fl is evaluated for each segment,
/// not for the whole fibre. Where fl falls with length, segments in series would diverge in length, but the tissue around them
/// prevents it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/muscle/detail/curve.h"
#include "risorius/muscle/detail/curve_table.h"
#include "risorius/muscle/detail/hill_shape.h"
#include "risorius/solve/lanes.h"
#include "risorius/solve/metric_builder.h"

namespace risorius::solve {
enum class Curvature;
class HessianBuilder;
}  // namespace risorius::solve

namespace risorius::muscle {

/// A point of a fibre, embedded in the tissue or fixed to a rigid body.
struct FibrePoint {
    int nodes[4] = {0, 0, 0, 0};
    double weights[4] = {0, 0, 0, 0};  ///< sum 1
    int count = 0;                     ///< number of nodes, 1..4; 0: the point is fixed to a body
    int body = 0;                      ///< index of the body when count is 0
    Vec3 body_rest = Vec3::Zero();     ///< position in the rest pose of the body, m
};

/// A polyline through consecutive points.
struct Fibre {
    int first_point = 0;
    int point_count = 0;         ///< number of points, 2 or more
    int column = 0;              ///< index in the activation vector
    double f0_n = 0;             ///< F0                                       [0, inf)
    double rest_stretch = 1;     ///< lam in the rest pose        (sin alpha, inf)
    double max_speed_hz = 10;    ///< vmax                               (0, inf)
    double tendon_fraction = 0;  ///< t                                 [0, 1)
    double pennation_rad = 0;    ///< alpha                             [0, pi/2)

    bool plain() const { return tendon_fraction == 0 && pennation_rad == 0; }
};

/// Energy and forces of a set of fibres. An object keeps scratch arrays, so only one thread at a time may use it.
class FibreSet {
  public:
    /// `rest`: nodes in the rest pose, n x 3, m; bodies are in their rest pose too. Throws std::invalid_argument for a fibre
    /// with fewer than two points, a segment of zero length, or a point that belongs to two fibres.
    FibreSet(std::vector<FibrePoint> points, std::vector<Fibre> fibres, const Points& rest,
             const HillShape& shape = {});

    const std::vector<FibrePoint>& points() const { return points_; }
    const std::vector<Fibre>& fibres() const { return fibres_; }
    void set_f0(int fibre, double f0_n) { fibres_[static_cast<std::size_t>(fibre)].f0_n = f0_n; }

    /// Moves the points that are fixed to bodies. `bodies` are the motions of the bodies from their rest poses, indexed by
    /// FibrePoint::body.
    void set_body_positions(std::span<const Rigid> bodies);

    /// Begins a step. Until end_step(), E is that of a step of h seconds from x, with the bodies in their present places. fl is
    /// taken at the lengths at `expected`, the expected positions at the end of the step.
    void begin_step(const Points& x, const Points& expected, double h);
    void begin_step(const Points& x, double h) { begin_step(x, x, h); }
    /// Begins the step that the set `whole` is in. This set is a part of `whole`. `fibres` and `points` are the numbers of its
    /// fibres and points in `whole`.
    void go_on(const FibreSet& whole, std::span<const int> fibres, std::span<const int> points);
    /// Ends the step. From here on E is the static one.
    void end_step() { step_s_ = 0; }

    /// Returns E, J, and adds dE/dx to `gradient`, n x 3, N. `activation` is indexed by Fibre::column.
    double add_energy(const Points& x, const Eigen::VectorXd& activation, Points& gradient) const;

    /// Adds the second derivative of the static E (not of a step), N/m. Segments without tension are added too. kPositive:
    /// without the negative part of each segment.
    void add_hessian(const Points& x, const Eigen::VectorXd& activation, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const;

    /// dE/d(position of a point) in the last call of add_energy, N. Its negative is the force on the point, which acts on the
    /// body to which the point is fixed.
    Vec3 point_gradient(int point) const {
        const solve::Lanes force = force_[point];
        return {force[0], force[1], force[2]};
    }

    /// Adds the stiffness F0/(2 l0), N/m, of each segment on the difference of its ends. In a step of h seconds, the stiffness
    /// is larger by a tenth of F0 fv'(0) / (l0 vmax h).
    void add_metric(solve::MetricBuilder& builder, double h = 0) const;

    /// lam of each fibre: its length divided by the sum of its optimal lengths.
    Eigen::VectorXd mean_stretch(const Points& x) const;

    struct State {
        double length_m = 0;  ///< of all segments
        double stretch = 1;   ///< length divided by the sum of the optimal lengths
        /// Isometric tension F0 [a fl + fp], mean over the segments weighted by optimal length.
        double force_n = 0;
    };
    /// One state per fibre. `activation` is indexed by Fibre::column.
    std::vector<State> states(const Points& x, const Eigen::VectorXd& activation) const;

    /// One state per segment, fibre by fibre.
    std::vector<State> segment_states(const Points& x, const Eigen::VectorXd& activation) const;

    /// Positions of the points, P x 3, m, for drawing and measuring.
    Points positions(const Points& x) const;

  private:
    /// A point in the form that inner loops read. Entries beyond `count` have weight zero.
    struct Embedding {
        std::int32_t nodes[4]{};
        std::int32_t count = 0;
        double weights[4]{};
    };
    solve::Lanes place(std::size_t point) const {
        const Embedding& at = embedding_[point];
        const solve::Lanes& own = body_place_[static_cast<int>(point)];
        if (at.count == 0) return own;
        const auto term = [&](int i, const solve::Lanes& sum) {
            return solve::fused(solve::Lanes{} + at.weights[i], x_[at.nodes[i]], sum);
        };
        return term(1, term(0, own)) + term(3, term(2, solve::Lanes{}));
    }
    void place_points(const Points& x) const;
    double length(int segment) const;
    /// Length of the fibres of a segment with its derivative by the length of the segment.
    struct FibreLength {
        double length_m, slope;
    };
    FibreLength fibre_length(const Fibre& fibre, int segment, double s) const;
    /// The same for kTogether segments from `first` on.
    void shorten(int first, solve::Lanes& l, solve::Lanes& slope) const;
    /// Segments computed together.
    static constexpr int kTogether = solve::LanesOf<double>::kWidth;
    /// Tension and energy of segments.
    struct Pulls {
        solve::Lanes tension_n, energy_j;
    };
    /// Tension and energy of the kTogether segments from `first` on, with lengths l. at_rest() computes only those before
    /// `last`.
    Pulls at_rest(const Fibre& fibre, double a, int first, int last, const solve::Lanes& l) const;
    Pulls in_step(const Fibre& fibre, double a, int first, const solve::Lanes& l) const;

    std::vector<FibrePoint> points_;
    std::vector<Fibre> fibres_;
    LengthCurves curves_;
    Curve velocity_;
    CurveTable velocity_table_, passive_table_;   ///< for steps
    std::vector<double> optimal_length_m_;        ///< l0 of the segment that begins at each point
    std::vector<double> tendon_m_, thickness_m_;  ///< t s0 and l0 sin alpha of each segment
    double step_s_ = 0;                           ///< h; 0 outside of steps
    /// Arrays with one number per point. It belongs to the segment that begins at the point. They have kTogether extra entries,
    /// so that kTogether numbers can be read from any point on.
    struct StepSegments {
        std::vector<double> inverse_optimal;  ///< 1 / l0
        std::vector<double> start_m;          ///< l_n
        std::vector<double> inverse_way;      ///< 1 / (h vmax l0)
        std::vector<double> force;            ///< F0 fl(lam_n)
        std::vector<double> work;             ///< force times h vmax l0
        std::vector<double> stiffness;        ///< F0 l0
        static constexpr std::vector<double> StepSegments::*kColumns[] = {
            &StepSegments::inverse_optimal, &StepSegments::start_m, &StepSegments::inverse_way,
            &StepSegments::force,           &StepSegments::work,    &StepSegments::stiffness};
        void resize(std::size_t count) {
            for (const auto column : kColumns) (this->*column).resize(count);
        }
    };
    StepSegments in_step_;
    std::vector<Embedding> embedding_;
    solve::PaddedPoints body_place_;  ///< of points that are fixed to bodies; zero for the others
    mutable solve::PaddedPoints x_, gradient_;      ///< nodes
    mutable solve::PaddedPoints position_, force_;  ///< points
};

}  // namespace risorius::muscle
