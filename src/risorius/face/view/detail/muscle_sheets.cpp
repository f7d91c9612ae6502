// SPDX-License-Identifier: MIT
#include "risorius/face/view/detail/muscle_sheets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/geom/polyline.h"
#include "risorius/rig/muscle_path.h"

namespace risorius::face {

namespace {

constexpr double kSpacing_m = 3.0e-3;  ///< distance of rows, and of columns in the middle

SheetSize sheet_size(double length_m, double width_m) {
    SheetSize size;
    size.length_m = length_m;
    size.width_m = width_m;
    size.rows = std::max(7, static_cast<int>(std::ceil(length_m / kSpacing_m)) + 1);
    size.columns = std::max(7, static_cast<int>(std::ceil(1.3 * width_m / kSpacing_m)) + 1);
    return size;
}

// Returns width / full width at a distance from the nearer end: corners are round.
double outline(const SheetSize& size, double along) {
    const double corner = std::min(0.5 * size.width_m, 0.3 * size.length_m);
    const double gone = 1.0 - std::min(1.0, std::min(along, 1 - along) * size.length_m / corner);
    return 1.0 - 0.3 * gone * gone;
}

void catmull_rom(double t, double weight[4]) {
    const double t2 = t * t, t3 = t2 * t;
    weight[0] = 0.5 * (-t + 2 * t2 - t3);
    weight[1] = 0.5 * (2 - 5 * t2 + 3 * t3);
    weight[2] = 0.5 * (t + 4 * t2 - 3 * t3);
    weight[3] = 0.5 * (-t2 + t3);
}

/// Interpolates at position `at` among `count` knots, 0..count - 1; extrapolates linearly beyond the ends.
template <typename Mix>
Mix mix_of(double at, int count, int first) {
    Mix mix;
    const int knot = std::clamp(static_cast<int>(std::floor(at)), 0, count - 2);
    const double t = at - knot;
    if (t < 0 || t > 1) {
        const double weight[4] = {0, 1 - t, t, 0};
        std::copy(weight, weight + 4, mix.weight);
    } else {
        catmull_rom(t, mix.weight);
    }
    for (int k = 0; k < 4; ++k) mix.of[k] = first + std::clamp(knot - 1 + k, 0, count - 1);
    // A knot beyond an end is the end's neighbour reflected in it: 2 p1 - p2.
    if (knot == 0) {
        mix.weight[1] += 2 * mix.weight[0];
        mix.weight[2] -= mix.weight[0];
        mix.weight[0] = 0;
    }
    if (knot == count - 2) {
        mix.weight[2] += 2 * mix.weight[3];
        mix.weight[1] -= mix.weight[3];
        mix.weight[3] = 0;
    }
    return mix;
}

double length_of(const std::vector<Vec3>& path) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) length += (path[i + 1] - path[i]).norm();
    return length;
}

/// Fractional index of the point at a share of the polyline's length.
double knot_at(const std::vector<Vec3>& path, double fraction) {
    double left = fraction * length_of(path);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const double step = (path[i + 1] - path[i]).norm();
        if (left <= step || i + 2 == path.size())
            return static_cast<double>(i) + std::min(1.0, left / step);
        left -= step;
    }
    return 0;
}

}  // namespace

double SheetSize::across(int column) const {
    return -std::cos(std::numbers::pi * column / (columns - 1));
}

FibreSheet::FibreSheet(const MusclePlacement& placement, const FibreBundle& bundle)
    : strands_(bundle.fibre_count) {
    double length = 0;
    for (int s = 0; s < strands_; ++s)
        length += length_of(placement.paths[static_cast<std::size_t>(bundle.first_fibre + s)]);
    size_ = sheet_size(length / strands_, bundle.width_m);
    for (int row = 0; row < size_.rows; ++row) {
        for (int s = 0; s < strands_; ++s) {
            const auto f = static_cast<std::size_t>(bundle.first_fibre + s);
            const muscle::Fibre& fibre = placement.fibres[f];
            stations_.push_back(mix_of<Mix>(knot_at(placement.paths[f], size_.along(row)),
                                            fibre.point_count, fibre.first_point));
        }
        const double half = 0.55 * strands_ * outline(size_, size_.along(row));
        for (int column = 0; column < size_.columns; ++column) {
            const double at = 0.5 * (strands_ - 1) + half * size_.across(column);
            if (strands_ > 1)
                columns_.push_back(mix_of<Mix>(at, strands_, 0));
            else
                columns_.push_back({{0, 0, 0, 0}, {0, 1, 0, 0}});
        }
    }
}

void FibreSheet::place(const Points& fibre_points, Points& grid) const {
    Points strands(strands_, 3);
    grid.resize(size_.points(), 3);
    for (int row = 0; row < size_.rows; ++row) {
        for (int s = 0; s < strands_; ++s) {
            const Mix& mix = stations_[static_cast<std::size_t>(row * strands_ + s)];
            strands.row(s).setZero();
            for (int k = 0; k < 4; ++k)
                strands.row(s) += mix.weight[k] * fibre_points.row(mix.of[k]);
        }
        for (int column = 0; column < size_.columns; ++column) {
            const int p = row * size_.columns + column;
            const Mix& mix = columns_[static_cast<std::size_t>(p)];
            grid.row(p).setZero();
            for (int k = 0; k < 4; ++k) grid.row(p) += mix.weight[k] * strands.row(mix.of[k]);
        }
    }
}

geom::SurfaceTree outer_skin(const rig::Head& head) {
    std::vector<Eigen::Index> outer;
    for (Eigen::Index f = 0; f < head.skin.rows(); ++f) {
        const Vec3 a = head.vertices.row(head.skin(f, 0)), b = head.vertices.row(head.skin(f, 1)),
                   c = head.vertices.row(head.skin(f, 2));
        Vec3 away = (a + b + c) / 3;
        away.y() *= 0.3;  // a head is closer to a column than to a sphere
        away.z() -= head.mm(20);
        if ((b - a).cross(c - a).normalized().dot(away.normalized()) > 0.2) outer.push_back(f);
    }
    Triangles triangles(static_cast<Eigen::Index>(outer.size()), 3);
    for (std::size_t f = 0; f < outer.size(); ++f)
        triangles.row(static_cast<Eigen::Index>(f)) = head.skin.row(outer[f]);
    return {head.vertices, triangles};
}

BoneSheet::BoneSheet(const rig::Head& head, const rig::Muscle& muscle, const rig::MusclePath& path,
                     const geom::SurfaceTree& skin) {
    std::vector<Vec3> knots;
    for (const rig::PathPoint& point : path) knots.push_back(rig::place_on(head, point, muscle.id));
    const std::vector<Vec3> curve = geom::sample_curve(knots, head.mm(0.5));
    size_ = sheet_size(length_of(curve), head.size * muscle.width_m);

    // The centre line, the bone it follows, and the direction of the skin
    const int count = static_cast<int>(knots.size());
    std::vector<Vec3> outward;
    for (int row = 0; row < size_.rows; ++row) {
        const double at = knot_at(curve, size_.along(row));
        const auto i = static_cast<std::size_t>(at);
        const Vec3& next = curve[std::min(i + 1, curve.size() - 1)];
        centre_.push_back(curve[i] + (at - std::floor(at)) * (next - curve[i]));
        const double knot = size_.along(row) * (count - 1);
        const int before = std::min(static_cast<int>(knot), count - 2);
        const auto fraction = [&](rig::PathPoint::Body body) {
            const auto rides = [&](int k) {
                return path[static_cast<std::size_t>(k)].body == body ? 1.0 : 0.0;
            };
            return rides(before) + (knot - before) * (rides(before + 1) - rides(before));
        };
        fraction_.push_back(fraction(rig::PathPoint::Body::kMandible));
        hyoid_fraction_.push_back(fraction(rig::PathPoint::Body::kHyoid));
        outward.push_back((skin.closest(centre_.back())->point - centre_.back()).normalized());
    }
    for (int pass = 0; pass < 2 * size_.rows; ++pass) {  // a muscle twists little
        const std::vector<Vec3> rough = outward;
        for (std::size_t i = 0; i < rough.size(); ++i)
            outward[i] =
                (rough[i > 0 ? i - 1 : 0] + 2 * rough[i] + rough[std::min(i + 1, rough.size() - 1)])
                    .normalized();
    }

    // A fan is widest at its origin and converges on the coronoid process; other muscles are spindles
    const bool fan = muscle.id.starts_with("temporalis");
    std::vector<Vec3> flat;
    Eigen::MatrixXd shift(size_.rows, size_.columns);
    for (int row = 0; row < size_.rows; ++row) {
        const auto i = static_cast<std::size_t>(row);
        const Vec3 tangent =
            centre_[std::min(i + 1, centre_.size() - 1)] - centre_[i > 0 ? i - 1 : 0];
        const Vec3 sideways = tangent.cross(outward[i]).normalized();
        const double s = size_.along(row);
        const double width = fan ? 1.35 - 1.05 * geom::smoothstep(0.1, 0.9, s)
                                 : 0.6 + 0.4 * std::sin(std::numbers::pi * s);
        const double half = 0.5 * size_.width_m * width * outline(size_, s);
        // Near the skin, points beside the centre line lie as deep as those on it
        const double depth = (skin.closest(centre_[i])->point - centre_[i]).norm();
        const double follows = 1.0 - geom::smoothstep(head.mm(14), head.mm(24), depth);
        for (int column = 0; column < size_.columns; ++column) {
            flat.push_back(centre_[i] + half * size_.across(column) * sideways);
            const Vec3 on_skin = skin.closest(flat.back() + depth * outward[i])->point;
            const double ahead = (on_skin - flat.back()).dot(outward[i]);
            shift(row, column) = follows * std::clamp(ahead - depth, -head.mm(18), head.mm(6));
        }
    }
    for (int pass = 0; pass < 6; ++pass) {  // smooths out the relief of ears and cheek bones
        const Eigen::MatrixXd rough = shift;
        const auto at = [&](int row, int column) {
            return rough(std::clamp(row, 0, size_.rows - 1),
                         std::clamp(column, 0, size_.columns - 1));
        };
        for (int row = 0; row < size_.rows; ++row)
            for (int column = 0; column < size_.columns; ++column)
                shift(row, column) =
                    0.2 * (at(row, column) + at(row - 1, column) + at(row + 1, column) +
                           at(row, column - 1) + at(row, column + 1));
    }
    for (int row = 0; row < size_.rows; ++row)
        for (int column = 0; column < size_.columns; ++column) {
            const auto i = static_cast<std::size_t>(row);
            offset_.push_back(flat[static_cast<std::size_t>(row * size_.columns + column)] +
                              shift(row, column) * outward[i] - centre_[i]);
        }
}

void BoneSheet::place(const BoneMotion& bones, Points& grid) const {
    std::vector<Vec3> centre(centre_.size());
    for (std::size_t i = 0; i < centre_.size(); ++i)
        centre[i] = centre_[i] + fraction_[i] * (bones.mandible * centre_[i] - centre_[i]) +
                    hyoid_fraction_[i] * bones.hyoid_m;
    // A shorter muscle is wider and thicker, so that its volume is constant; its ends on bone keep their width
    const double wider = std::sqrt(size_.length_m / std::max(1e-4, length_of(centre))) - 1;
    grid.resize(size_.points(), 3);
    for (int row = 0; row < size_.rows; ++row) {
        const auto i = static_cast<std::size_t>(row);
        const double bulge = 1 + wider * std::sin(std::numbers::pi * size_.along(row));
        const Mat3 turn =
            Mat3::Identity() + fraction_[i] * (bones.mandible.linear() - Mat3::Identity());
        for (int column = 0; column < size_.columns; ++column) {
            const int p = row * size_.columns + column;
            grid.row(p) =
                (centre[i] + bulge * (turn * offset_[static_cast<std::size_t>(p)])).transpose();
        }
    }
}

}  // namespace risorius::face
