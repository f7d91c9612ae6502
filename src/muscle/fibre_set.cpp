#include "muscle/fibre_set.h"

#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace risorius::muscle {

FibreSet::FibreSet(std::vector<FibrePoint> points, std::vector<Fibre> fibres, const Points& rest,
                   const HillShape& shape)
    : points_(std::move(points)),
      fibres_(std::move(fibres)),
      shape_(shape),
      optimal_length_m_(points_.size(), 0.0) {
    const auto count = static_cast<Eigen::Index>(points_.size());
    body_position_.setZero(count, 3);
    position_.setZero(count, 3);
    force_.setZero(count, 3);
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
            const double length = (position_.row(p + 1) - position_.row(p)).norm();
            if (!(length > 0))
                throw std::invalid_argument("FibreSet: fibre " + std::to_string(f) +
                                            " has a segment without length");
            optimal_length_m_[static_cast<std::size_t>(p)] = length / fibre.rest_stretch;
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
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const FibrePoint& point = points_[p];
        const auto row = static_cast<Eigen::Index>(p);
        if (point.count == 0) {
            position_.row(row) = body_position_.row(row);
            continue;
        }
        Vec3 sum = Vec3::Zero();
        for (int i = 0; i < point.count; ++i)
            sum += point.weights[i] * x.row(point.nodes[i]).transpose();
        position_.row(row) = sum.transpose();
    }
}

double FibreSet::add_energy(const Points& x, const Eigen::VectorXd& activation,
                            Points& gradient) const {
    place_points(x);
    force_.setZero();
    double energy = 0;
    for (const Fibre& fibre : fibres_) {
        const double a = activation[fibre.column];
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            const double l0 = optimal_length_m_[static_cast<std::size_t>(p)];
            const Vec3 d = (position_.row(p + 1) - position_.row(p)).transpose();
            const double length = d.norm();
            const double lam = length / l0;
            // A relaxed, slack segment does nothing; most segments of most frames are that.
            if (a == 0.0 && lam <= 1.0) continue;
            energy +=
                fibre.f0_n * l0 *
                (a * active_force_integral(lam, shape_) + passive_force_integral(lam, shape_));
            if (!(length > 0)) continue;  // no direction to pull along
            const double tension =
                fibre.f0_n * (a * active_force(lam, shape_) + passive_force(lam, shape_));
            const Vec3 pull = (tension / length) * d;
            force_.row(p) -= pull.transpose();
            force_.row(p + 1) += pull.transpose();
        }
    }
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const FibrePoint& point = points_[p];
        for (int i = 0; i < point.count; ++i)
            gradient.row(point.nodes[i]) +=
                point.weights[i] * force_.row(static_cast<Eigen::Index>(p));
    }
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
        double length = 0, optimal = 0;
        for (int p = fibre.first_point; p < fibre.first_point + fibre.point_count - 1; ++p) {
            length += (position_.row(p + 1) - position_.row(p)).norm();
            optimal += optimal_length_m_[static_cast<std::size_t>(p)];
        }
        stretch[static_cast<Eigen::Index>(f)] = length / optimal;
    }
    return stretch;
}

Points FibreSet::positions(const Points& x) const {
    place_points(x);
    return position_;
}

}  // namespace risorius::muscle
