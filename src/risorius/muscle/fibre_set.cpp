// SPDX-License-Identifier: MIT
#include "risorius/muscle/fibre_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "risorius/muscle/muscle_curves.h"
#include "risorius/solve/point_sums.h"

namespace risorius::muscle {

using solve::Lanes;

namespace {

// Fraction of a fully active fibre's resistance to a change of length that the metric contains. Most fibres are hardly active.
// With all of it, a step of the face takes half as many iterations again; with none, it ends before it has converged.
constexpr double kFastFraction = 0.1;

// Tables for steps. The kink of the velocity curve, at zero speed, is at the end of a cell. Errors of force are at most 1e-5.
constexpr double kMaxSpeed = 1.5, kMaxLength = 3;
constexpr int kCells = 768;

}  // namespace

FibreSet::FibreSet(std::vector<FibrePoint> points, std::vector<Fibre> fibres, const Points& rest,
                   const HillShape& shape)
    : points_(std::move(points)),
      fibres_(std::move(fibres)),
      curves_(shape),
      velocity_(zajac_curves().velocity),
      velocity_table_(velocity_, -kMaxSpeed, kMaxSpeed, kCells),
      passive_table_(passive_curve(shape), 1.0, kMaxLength, kCells),
      optimal_length_m_(points_.size(), 0.0),
      tendon_m_(points_.size() + kTogether, 0.0),
      thickness_m_(points_.size() + kTogether, 0.0) {
    const auto count = static_cast<int>(points_.size());
    body_place_.set_zero(count);
    for (int p = 0; p < count; ++p) {
        const FibrePoint& point = points_[static_cast<std::size_t>(p)];
        Embedding at;
        at.count = point.count;
        for (int i = 0; i < point.count; ++i) {
            at.nodes[i] = point.nodes[i];
            at.weights[i] = point.weights[i];
        }
        embedding_.push_back(at);
        if (point.count == 0)
            body_place_[p] =
                Lanes{point.body_rest.x(), point.body_rest.y(), point.body_rest.z(), 0};
    }
    position_.set_zero(count + kTogether);  // so that the last segments can be read together
    force_.set_zero(count);

    place_points(rest);
    std::vector<char> taken(points_.size(), 0);
    for (std::size_t f = 0; f < fibres_.size(); ++f) {
        const Fibre& fibre = fibres_[f];
        if (fibre.point_count < 2 || fibre.first_point < 0 ||
            fibre.first_point + fibre.point_count > count)
            throw std::invalid_argument("FibreSet: fibre " + std::to_string(f) +
                                        " needs two or more of the points given");
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count; ++p) {
            if (taken[static_cast<std::size_t>(p)])
                throw std::invalid_argument("FibreSet: fibre " + std::to_string(f) +
                                            " has a point of another");
            taken[static_cast<std::size_t>(p)] = 1;
        }
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            if (!(length(p) > 0))
                throw std::invalid_argument("FibreSet: fibre " + std::to_string(f) +
                                            " has a segment without length");
            const auto segment = static_cast<std::size_t>(p);
            optimal_length_m_[segment] = length(p) / fibre.rest_stretch;
            if (fibre.plain()) continue;
            const double sine = std::sin(fibre.pennation_rad), r = fibre.rest_stretch;
            if (!(fibre.tendon_fraction >= 0 && fibre.tendon_fraction < 1 && r > sine))
                throw std::invalid_argument("FibreSet: fibre " + std::to_string(f) +
                                            " has a tendon or pennation outside its range");
            tendon_m_[segment] = fibre.tendon_fraction * length(p);
            optimal_length_m_[segment] =
                (length(p) - tendon_m_[segment]) / std::sqrt(r * r - sine * sine);
            thickness_m_[segment] = optimal_length_m_[segment] * sine;
        }
    }
}

void FibreSet::set_body_positions(std::span<const Rigid> bodies) {
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const FibrePoint& point = points_[p];
        if (point.count > 0) continue;
        assert(point.body >= 0 && static_cast<std::size_t>(point.body) < bodies.size());
        const Vec3 at = bodies[static_cast<std::size_t>(point.body)] * point.body_rest;
        body_place_[static_cast<int>(p)] = Lanes{at.x(), at.y(), at.z(), 0};
    }
}

void FibreSet::place_points(const Points& x) const {
    x_.copy(x);
    for (std::size_t p = 0; p < points_.size(); ++p) position_[static_cast<int>(p)] = place(p);
}

double FibreSet::length(int segment) const {
    const Lanes d = position_[segment + 1] - position_[segment];
    return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

FibreSet::FibreLength FibreSet::fibre_length(const Fibre& fibre, int segment, double s) const {
    if (fibre.plain()) return {s, 1};
    const auto at = static_cast<std::size_t>(segment);
    const double span = std::max(s - tendon_m_[at], 0.0);
    const double l = std::hypot(span, thickness_m_[at]);
    return {l, l > 0 ? span / l : 0};
}

void FibreSet::shorten(int first, Lanes& l, Lanes& slope) const {
    const Lanes span = l - solve::load_lanes(tendon_m_.data() + first),
                thickness = solve::load_lanes(thickness_m_.data() + first);
    const Lanes pulled = span > 0.0 ? span : Lanes{};
    l = solve::sqrt_lanes(pulled * pulled + thickness * thickness);
    slope = l > 0.0 ? pulled / l : Lanes{};
}

void FibreSet::begin_step(const Points& x, const Points& expected, double h) {
    assert(h > 0);
    step_s_ = h;
    in_step_.resize(points_.size() + kTogether);
    const auto each_segment = [&](const auto& visit) {
        for (const Fibre& fibre : fibres_)
            for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p)
                visit(fibre, p, static_cast<std::size_t>(p));
    };
    place_points(x);
    each_segment([&](const Fibre& fibre, int p, std::size_t segment) {
        const double l0 = optimal_length_m_[segment];
        const double way = h * fibre.max_speed_hz * l0;
        in_step_.inverse_optimal[segment] = 1 / l0;
        in_step_.start_m[segment] = fibre_length(fibre, p, length(p)).length_m;
        in_step_.inverse_way[segment] = 1 / way;
        in_step_.stiffness[segment] = fibre.f0_n * l0;
    });
    if (&expected != &x) place_points(expected);
    each_segment([&](const Fibre& fibre, int p, std::size_t segment) {
        in_step_.force[segment] =
            fibre.f0_n * curves_
                             .active(fibre_length(fibre, p, length(p)).length_m *
                                     in_step_.inverse_optimal[segment])
                             .force;
        in_step_.work[segment] = in_step_.force[segment] / in_step_.inverse_way[segment];
    });
}

void FibreSet::go_on(const FibreSet& whole, std::span<const int> fibres,
                     std::span<const int> points) {
    assert(fibres.size() == fibres_.size() && points.size() == points_.size());
    step_s_ = whole.step_s_;
    in_step_.resize(points_.size() + kTogether);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const auto from = static_cast<std::size_t>(points[p]);
        if (step_s_ > 0)
            for (const auto column : StepSegments::kColumns)
                (in_step_.*column)[p] = (whole.in_step_.*column)[from];
        body_place_[static_cast<int>(p)] = whole.body_place_[points[p]];
    }
    for (std::size_t f = 0; f < fibres.size(); ++f)
        fibres_[f].f0_n = whole.fibres_[static_cast<std::size_t>(fibres[f])].f0_n;
}

inline FibreSet::Pulls FibreSet::at_rest(const Fibre& fibre, double a, int first, int last,
                                         const Lanes& l) const {
    Pulls pulls{};
    for (int k = 0; k < std::min(kTogether, last - first); ++k) {
        const double l0 = optimal_length_m_[static_cast<std::size_t>(first + k)];
        const LengthCurves::Value passive = curves_.passive(l[k] / l0);
        const LengthCurves::Value active =
            a == 0.0 ? LengthCurves::Value{0.0, 0.0} : curves_.active(l[k] / l0);
        pulls.tension_n[k] = fibre.f0_n * (a * active.force + passive.force);
        pulls.energy_j[k] = fibre.f0_n * l0 * (a * active.integral + passive.integral);
    }
    return pulls;
}

inline FibreSet::Pulls FibreSet::in_step(const Fibre& fibre, double a, int first,
                                         const Lanes& l) const {
    const auto lanes = [first](const std::vector<double>& column) {
        return solve::load_lanes(column.data() + first);
    };
    const Lanes stretch = l * lanes(in_step_.inverse_optimal);
    const Lanes speed = (l - lanes(in_step_.start_m)) * lanes(in_step_.inverse_way);
    // Slack segments use the start of the passive curve, where it is zero.
    const CurveTable::Values passive = passive_table_.at(stretch > 1.0 ? stretch : Lanes{} + 1.0);
    Pulls pulls{fibre.f0_n * passive.value, lanes(in_step_.stiffness) * passive.integral};
    if (a != 0.0) {
        const CurveTable::Values velocity = velocity_table_.at(speed);
        pulls.tension_n += a * lanes(in_step_.force) * velocity.value;
        pulls.energy_j += a * lanes(in_step_.work) * velocity.integral;
    }
    return pulls;
}

double FibreSet::add_energy(const Points& x, const Eigen::VectorXd& activation,
                            Points& gradient) const {
    assert(gradient.rows() == x.rows());
    x_.copy(x);
    gradient_.set_zero(x.rows());
    double energy = 0;
    for (const Fibre& fibre : fibres_) {
        const double a = activation[fibre.column];
        const int begin = fibre.first_point, last = begin + fibre.point_count - 1;
        for (int p = begin; p <= last; ++p) position_[p] = place(static_cast<std::size_t>(p));
        bool pulls = false;
        Lanes before{};  // force of the segment before a point on that point
        for (int p = begin; p < last; p += kTogether) {
            Lanes d[kTogether], dx, dy, dz;
            for (int k = 0; k < kTogether; ++k) d[k] = position_[p + k + 1] - position_[p + k];
            solve::rows_to_lanes(d, dx, dy, dz);
            const Lanes squared = dx * dx + dy * dy + dz * dz;
            const int count = std::min(kTogether, last - p);
            // A relaxed, slack segment does nothing. Most segments of most frames are like that.
            bool acts = a != 0.0 || !fibre.plain();
            for (int k = 0; k < count && !acts; ++k) {
                const double l0 = optimal_length_m_[static_cast<std::size_t>(p + k)];
                acts = squared[k] > l0 * l0;
            }
            Lanes fraction{};  // tension / length, N/m; zero for a segment without direction
            if (acts) {
                const Lanes l = solve::sqrt_lanes(squared);
                Lanes fibre_m = l, slope{};
                if (!fibre.plain()) shorten(p, fibre_m, slope);
                Pulls pull = step_s_ > 0 ? in_step(fibre, a, p, fibre_m)
                                         : at_rest(fibre, a, p, last, fibre_m);
                if (!fibre.plain()) pull.tension_n *= slope;
                for (int k = 0; k < count; ++k) energy += pull.energy_j[k];
                fraction = l > 0.0 ? pull.tension_n / l : Lanes{};
                pulls = true;
            }
            for (int k = 0; k < count; ++k) {
                const Lanes along = fraction[k] * d[k];
                force_[p + k] = before - along;
                before = along;
            }
        }
        force_[last] = before;
        if (!pulls) continue;
        for (int p = begin; p <= last; ++p) {
            const Embedding& at = embedding_[static_cast<std::size_t>(p)];
            const auto add = [&](int i) { gradient_[at.nodes[i]] += at.weights[i] * force_[p]; };
            if (at.count == 4) {
                for (int i = 0; i < 4; ++i) add(i);
            } else {
                for (int i = 0; i < at.count; ++i) add(i);
            }
        }
    }
    gradient_.add_to(gradient);
    return energy;
}

void FibreSet::add_metric(solve::MetricBuilder& builder, double h) const {
    for (const Fibre& fibre : fibres_) {
        const double fast =
            h > 0 ? kFastFraction * velocity_.at(0).slope / (fibre.max_speed_hz * h) : 0;
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            int nodes[8];
            double c[8];
            int count = 0;
            for (int end = 0; end < 2; ++end) {
                const FibrePoint& point = points_[static_cast<std::size_t>(p + end)];
                for (int i = 0; i < point.count; ++i) {
                    nodes[count] = point.nodes[i];
                    c[count++] = end == 0 ? -point.weights[i] : point.weights[i];
                }
            }
            builder.add_outer(
                nodes, c, count,
                (0.5 + fast) * fibre.f0_n / optimal_length_m_[static_cast<std::size_t>(p)]);
        }
    }
}

Eigen::VectorXd FibreSet::mean_stretch(const Points& x) const {
    place_points(x);
    Eigen::VectorXd stretch(static_cast<Eigen::Index>(fibres_.size()));
    for (std::size_t f = 0; f < fibres_.size(); ++f) {
        const Fibre& fibre = fibres_[f];
        double current = 0, optimal = 0;
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            current += fibre_length(fibre, p, length(p)).length_m;
            optimal += optimal_length_m_[static_cast<std::size_t>(p)];
        }
        stretch[static_cast<Eigen::Index>(f)] = current / optimal;
    }
    return stretch;
}

std::vector<FibreSet::State> FibreSet::states(const Points& x,
                                              const Eigen::VectorXd& activation) const {
    place_points(x);
    std::vector<State> states;
    for (const Fibre& fibre : fibres_) {
        State state;
        double optimal = 0, fibre_m = 0;
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            const double segment = length(p);
            const double l0 = optimal_length_m_[static_cast<std::size_t>(p)];
            const FibreLength now = fibre_length(fibre, p, segment);
            state.length_m += segment;
            fibre_m += now.length_m;
            optimal += l0;
            state.force_n += l0 * fibre.f0_n * now.slope *
                             (activation[fibre.column] * curves_.active(now.length_m / l0).force +
                              curves_.passive(now.length_m / l0).force);
        }
        state.stretch = fibre_m / optimal;
        state.force_n /= optimal;
        states.push_back(state);
    }
    return states;
}

std::vector<FibreSet::State> FibreSet::segment_states(const Points& x,
                                                      const Eigen::VectorXd& activation) const {
    place_points(x);
    std::vector<State> states;
    for (const Fibre& fibre : fibres_)
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            State state{.length_m = length(p)};
            const FibreLength now = fibre_length(fibre, p, state.length_m);
            state.stretch = now.length_m / optimal_length_m_[static_cast<std::size_t>(p)];
            state.force_n = fibre.f0_n * now.slope *
                            (activation[fibre.column] * curves_.active(state.stretch).force +
                             curves_.passive(state.stretch).force);
            states.push_back(state);
        }
    return states;
}

Points FibreSet::positions(const Points& x) const {
    place_points(x);
    Points positions(static_cast<Eigen::Index>(points_.size()), 3);
    for (int p = 0; p < static_cast<int>(points_.size()); ++p)
        for (int c = 0; c < 3; ++c) positions(p, c) = position_[p][c];
    return positions;
}

}  // namespace risorius::muscle
