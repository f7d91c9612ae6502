#include "muscle/fibre_set.h"

#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace risorius::muscle {

using solve::Lanes;

FibreSet::FibreSet(std::vector<FibrePoint> points, std::vector<Fibre> fibres, const Points& rest,
                   const HillShape& shape)
    : points_(std::move(points)),
      fibres_(std::move(fibres)),
      curves_(shape),
      optimal_length_m_(points_.size(), 0.0) {
    const auto count = static_cast<Eigen::Index>(points_.size());
    body_position_.setZero(count, 3);
    for (Eigen::Index p = 0; p < count; ++p)
        body_position_.row(p) = points_[static_cast<std::size_t>(p)].body_rest.transpose();

    place_points(rest);
    for (std::size_t f = 0; f < fibres_.size(); ++f) {
        const Fibre& fibre = fibres_[f];
        if (fibre.point_count < 2 || fibre.first_point < 0 ||
            fibre.first_point + fibre.point_count > count)
            throw std::invalid_argument("FibreSet: fibre " + std::to_string(f) +
                                        " needs two or more of the points given");
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            if (!(length(p) > 0))
                throw std::invalid_argument("FibreSet: fibre " + std::to_string(f) +
                                            " has a segment without length");
            optimal_length_m_[static_cast<std::size_t>(p)] = length(p) / fibre.rest_stretch;
        }
    }
}

void FibreSet::set_body_positions(std::span<const Rigid> bodies) {
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const FibrePoint& point = points_[p];
        if (point.count > 0) continue;
        assert(point.body >= 0 && static_cast<std::size_t>(point.body) < bodies.size());
        body_position_.row(static_cast<Eigen::Index>(p)) =
            (bodies[static_cast<std::size_t>(point.body)] * point.body_rest).transpose();
    }
}

void FibreSet::place_points(const Points& x) const {
    x_.copy(x);
    position_.copy(body_position_);
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const FibrePoint& point = points_[p];
        if (point.count == 0) continue;
        Lanes sum = point.weights[0] * x_[point.nodes[0]];
        for (int i = 1; i < point.count; ++i) sum += point.weights[i] * x_[point.nodes[i]];
        position_[static_cast<int>(p)] = sum;
    }
}

double FibreSet::length(int segment) const {
    const Lanes d = position_[segment + 1] - position_[segment];
    return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

double FibreSet::add_energy(const Points& x, const Eigen::VectorXd& activation,
                            Points& gradient) const {
    assert(gradient.rows() == x.rows());
    place_points(x);
    force_.set_zero(static_cast<long>(points_.size()));
    gradient_.set_zero(x.rows());
    double energy = 0;
    for (const Fibre& fibre : fibres_) {
        const double a = activation[fibre.column];
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            const double l0 = optimal_length_m_[static_cast<std::size_t>(p)];
            const double l = length(p);
            const double lam = l / l0;
            // A relaxed, slack segment does nothing; most segments of most frames are that.
            if (a == 0.0 && lam <= 1.0) continue;
            const LengthCurves::Value passive = curves_.passive(lam);
            const LengthCurves::Value active =
                a == 0.0 ? LengthCurves::Value{0.0, 0.0} : curves_.active(lam);
            energy += fibre.f0_n * l0 * (a * active.integral + passive.integral);
            if (!(l > 0)) continue;  // no direction to pull along
            const double tension = fibre.f0_n * (a * active.force + passive.force);
            const Lanes pull = (tension / l) * (position_[p + 1] - position_[p]);
            force_[p] -= pull;
            force_[p + 1] += pull;
        }
    }
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const FibrePoint& point = points_[p];
        const Lanes force = force_[static_cast<int>(p)];
        for (int i = 0; i < point.count; ++i) gradient_[point.nodes[i]] += point.weights[i] * force;
    }
    gradient_.add_to(gradient);
    return energy;
}

void FibreSet::add_metric(solve::MetricBuilder& builder) const {
    for (const Fibre& fibre : fibres_) {
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
            builder.add_outer(nodes, c, count,
                              0.5 * fibre.f0_n / optimal_length_m_[static_cast<std::size_t>(p)]);
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
            current += length(p);
            optimal += optimal_length_m_[static_cast<std::size_t>(p)];
        }
        stretch[static_cast<Eigen::Index>(f)] = current / optimal;
    }
    return stretch;
}

Points FibreSet::positions(const Points& x) const {
    place_points(x);
    Points positions = Points::Zero(body_position_.rows(), 3);
    position_.add_to(positions);
    return positions;
}

}  // namespace risorius::muscle
