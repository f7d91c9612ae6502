// SPDX-License-Identifier: MIT
#include "risorius/contact/distance_field.h"

#include <algorithm>
#include <cmath>

#include "risorius/contact/detail/closed_surface.h"
#include "risorius/core/json_cursor.h"

namespace risorius::contact {

namespace {

constexpr int kMarginCells = 3;

/// Replaces the values at grid points 1..count of a line of count + 2 by the coefficients of the natural cubic spline through
/// them: (c[i-1] + 4 c[i] + c[i+1]) / 6 = value, without curvature at the ends.
void fit_line(double* line, int count, std::ptrdiff_t stride, std::vector<double>& scratch) {
    const auto at = [&](int i) -> double& { return line[i * stride]; };
    // The end coefficients equal the end values. Thomas' algorithm solves for the others.
    scratch.assign(static_cast<std::size_t>(count + 2), 0.0);
    for (int i = 2; i < count; ++i) {
        const double pivot = 4 - scratch[i - 1];
        scratch[i] = 1 / pivot;
        at(i) = (6 * at(i) - at(i - 1)) / pivot;
    }
    for (int i = count - 1; i >= 2; --i) at(i) -= scratch[i] * at(i + 1);
    at(0) = 2 * at(1) - at(2);
    at(count + 1) = 2 * at(count) - at(count - 1);
}

}  // namespace

struct DistanceField::Cell {
    int first[3];            // index of the first coefficient of the splines
    double value[3][4];      // of the four splines on each axis
    double slope[3][4];      // 1/m
    double curvature[3][4];  // 1/m^2
};

DistanceField::DistanceField(const Points& positions, const Triangles& triangles,
                             const DistanceFieldOptions& options, const std::string& place) {
    if (options.cells < 4 || options.cells > 400)
        throw Error(place + "/cells", "[4, 400]", std::to_string(options.cells));
    if (!(options.margin_m >= 0 && std::isfinite(options.margin_m)))
        throw Error(place + "/margin_m", "[0, inf)", format_number(options.margin_m));
    const ClosedSurface surface(positions, triangles, place);

    // Vertices that no triangle uses must not enlarge the grid.
    Vec3 low = positions.row(triangles(0, 0)).transpose(), high = low;
    for (long t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            low = low.cwiseMin(positions.row(triangles(t, k)).transpose());
            high = high.cwiseMax(positions.row(triangles(t, k)).transpose());
        }
    spacing_ = (high - low).maxCoeff() / options.cells;
    const double margin = spacing_ * (kMarginCells + std::ceil(options.margin_m / spacing_));
    low_ = low - Vec3::Constant(margin);
    int points[3];
    for (int axis = 0; axis < 3; ++axis) {
        points[axis] =
            1 + static_cast<int>(std::ceil((high(axis) - low(axis) + 2 * margin) / spacing_));
        high_(axis) = low_(axis) + spacing_ * (points[axis] - 1);
        size_[axis] = points[axis] + 2;
    }

    // Exact distances at the grid points. Between neighbours they differ by the spacing at most, which shortens the search.
    coefficients_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], 0.0);
    const auto index = [&](int i, int j, int k) {
        return static_cast<std::size_t>((i * size_[1] + j) * size_[2] + k);
    };
    const double reach = spacing_ * (1 + 1e-9);
    for (int i = 1; i <= points[0]; ++i)
        for (int j = 1; j <= points[1]; ++j)
            for (int k = 1; k <= points[2]; ++k) {
                const Vec3 p = low_ + spacing_ * Vec3(i - 1, j - 1, k - 1);
                const std::size_t before = k > 1   ? index(i, j, k - 1)
                                           : j > 1 ? index(i, j - 1, k)
                                           : i > 1 ? index(i - 1, j, k)
                                                   : 0;
                const bool first = i == 1 && j == 1 && k == 1;
                const auto nearest =
                    first ? surface.nearest(p)
                          : surface.nearest(p, std::abs(coefficients_[before]) + reach);
                coefficients_[index(i, j, k)] =
                    nearest ? nearest->gap_m : surface.nearest(p)->gap_m;
            }

    // Spline coefficients, axis by axis. Each pass also fills the border beyond the grid points.
    std::vector<double> scratch;
    for (int i = 1; i <= points[0]; ++i)
        for (int j = 1; j <= points[1]; ++j)
            fit_line(&coefficients_[index(i, j, 0)], points[2], 1, scratch);
    for (int i = 1; i <= points[0]; ++i)
        for (int k = 0; k < size_[2]; ++k)
            fit_line(&coefficients_[index(i, 0, k)], points[1], size_[2], scratch);
    for (int j = 0; j < size_[1]; ++j)
        for (int k = 0; k < size_[2]; ++k)
            fit_line(&coefficients_[index(0, j, k)], points[0],
                     static_cast<std::ptrdiff_t>(size_[1]) * size_[2], scratch);
}

DistanceField::Cell DistanceField::cell_of(const Vec3& p) const {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis) {
        const double place = (p(axis) - low_(axis)) / spacing_;
        const int last = size_[axis] - 4;  // last cell between grid points
        cell.first[axis] = std::clamp(static_cast<int>(std::floor(place)), 0, last);
        const double u = place - cell.first[axis], r = 1 - u;
        const double s = 1 / spacing_;
        const double value[4] = {r * r * r / 6, (4 - 6 * u * u + 3 * u * u * u) / 6,
                                 (4 - 6 * r * r + 3 * r * r * r) / 6, u * u * u / 6};
        const double slope[4] = {-r * r / 2, -2 * u + 1.5 * u * u, 2 * r - 1.5 * r * r, u * u / 2};
        const double curvature[4] = {r, 3 * u - 2, 3 * r - 2, u};
        for (int i = 0; i < 4; ++i) {
            cell.value[axis][i] = value[i];
            cell.slope[axis][i] = s * slope[i];
            cell.curvature[axis][i] = s * s * curvature[i];
        }
    }
    return cell;
}

Distance DistanceField::distance(const Vec3& p) const {
    const Vec3 inside = p.cwiseMax(low_).cwiseMin(high_);
    const Cell cell = cell_of(inside);
    double gap = 0;
    Vec3 gradient = Vec3::Zero();
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            double along = 0, slope_along = 0;
            for (int k = 0; k < 4; ++k) {
                const double c =
                    coefficient(cell.first[0] + i, cell.first[1] + j, cell.first[2] + k);
                along += cell.value[2][k] * c;
                slope_along += cell.slope[2][k] * c;
            }
            gap += cell.value[0][i] * cell.value[1][j] * along;
            gradient += Vec3(cell.slope[0][i] * cell.value[1][j] * along,
                             cell.value[0][i] * cell.slope[1][j] * along,
                             cell.value[0][i] * cell.value[1][j] * slope_along);
        }
    const double off = (p - inside).norm();
    if (off > 0) {
        gap += off;
        gradient = (gradient + (p - inside) / off).normalized();
    }
    return {gap, gradient};
}

Mat3 DistanceField::curvature(const Vec3& p) const {
    if (p != p.cwiseMax(low_).cwiseMin(high_)) return Mat3::Zero();
    const Cell cell = cell_of(p);
    Mat3 sum = Mat3::Zero();
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 4; ++k) {
                const double c =
                    coefficient(cell.first[0] + i, cell.first[1] + j, cell.first[2] + k);
                const double *x = cell.value[0], *y = cell.value[1], *z = cell.value[2];
                const double *dx = cell.slope[0], *dy = cell.slope[1], *dz = cell.slope[2];
                sum(0, 0) += c * cell.curvature[0][i] * y[j] * z[k];
                sum(1, 1) += c * x[i] * cell.curvature[1][j] * z[k];
                sum(2, 2) += c * x[i] * y[j] * cell.curvature[2][k];
                sum(0, 1) += c * dx[i] * dy[j] * z[k];
                sum(0, 2) += c * dx[i] * y[j] * dz[k];
                sum(1, 2) += c * x[i] * dy[j] * dz[k];
            }
    sum(1, 0) = sum(0, 1);
    sum(2, 0) = sum(0, 2);
    sum(2, 1) = sum(1, 2);
    return sum;
}

std::shared_ptr<const Shape> make_mesh(const Points& positions, const Triangles& triangles,
                                       const DistanceFieldOptions& options,
                                       const std::string& place) {
    return std::make_shared<DistanceField>(positions, triangles, options, place);
}

}  // namespace risorius::contact
