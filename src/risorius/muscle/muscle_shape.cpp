// SPDX-License-Identifier: MIT
#include "risorius/muscle/muscle_shape.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "risorius/core/error.h"
#include "risorius/muscle/detail/fill_surface.h"
#include "risorius/muscle/detail/framed_path.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::muscle {

using tissue::GridShape;
using Form = MuscleShape::Form;
using Section = MuscleShape::Section;

namespace {

void require_positive(double value, const std::string& place) {
    if (!(std::isfinite(value) && value > 0)) throw Error(place, "(0, inf)", format_number(value));
}

void require_sizes(const std::vector<double>& values, const Points& path,
                   const std::string& place) {
    if (values.size() != 1 && static_cast<Eigen::Index>(values.size()) != path.rows())
        throw Error(place, "one number, or one per point of the path",
                    std::to_string(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
        require_positive(values[i], values.size() == 1 ? place : place + "/" + std::to_string(i));
}

void check_grid(const MuscleShape& shape, const GridShape& grid) {
    const int min = shape.form == Form::kRing ? 3 : 2;
    if (grid.m < min || grid.n < 2 || grid.o < 2)
        throw Error(shape.place, "a grid of at least " + std::to_string(min) + " x 2 x 2 nodes",
                    std::to_string(grid.m) + " x " + std::to_string(grid.n) + " x " +
                        std::to_string(grid.o));
}

double square_coordinate(int i, int count) { return 2.0 * i / (count - 1) - 1; }

/// How far a section extends from its middle along the unit vector `to`, which lies in it.
double reach(const PathFrame& frame, Section section, double width_m, double thickness_m,
             const Vec3& to) {
    const double y = width_m / 2 * std::abs(to.dot(frame.across));
    const double z = thickness_m / 2 * std::abs(to.dot(frame.outward));
    return section == Section::kRound ? std::hypot(y, z) : y + z;
}

/// Checks that a path does not bend more sharply than its section is deep. Beyond the centre of the bend, sections would
/// intersect.
void check_bends(const FramedPath& path, const MuscleShape& shape, double scale) {
    constexpr int kPlaces = 400;
    for (int k = 0; k <= kPlaces; ++k) {
        const PathFrame frame = path.frame(static_cast<double>(k) / kPlaces);
        const double bend = frame.bend.norm();
        if (!(bend > 0)) continue;
        const double depth =
            scale *
            reach(frame, shape.section, value_along(shape.widths_m, path.closed(), frame.knot),
                  value_along(shape.thicknesses_m, path.closed(), frame.knot), frame.bend / bend);
        if (depth * bend < 1) continue;
        const auto mm = [](double metres) {
            return format_number(std::round(1e4 * metres) / 10) + " mm";
        };
        throw Error(shape.place + "/path_m",
                    "bends wider than the section is deep on their inner side",
                    "a radius of " + mm(1 / bend) + " against " + mm(depth) + " at " +
                        std::to_string(100 * k / kPlaces) + " % of the length");
    }
}

Points swept(const MuscleShape& shape, const GridShape& grid) {
    require_sizes(shape.widths_m, shape.path_m, shape.place + "/width_m");
    require_sizes(shape.thicknesses_m, shape.path_m, shape.place + "/thickness_m");
    const FramedPath path(shape.path_m, shape.outward, grid.closed, shape.place);
    const bool round = shape.section == Section::kRound;
    const double scale =
        round && shape.equal_volume ? std::sqrt(disc_over_polygon(grid.n, grid.o)) : 1;
    check_bends(path, shape, scale);
    Points rest(grid.size(), 3);
    for (int i = 0; i < grid.m; ++i) {
        const PathFrame frame = path.frame(i * grid.spacing(0));
        const double width = scale * value_along(shape.widths_m, grid.closed, frame.knot);
        const double thickness = scale * value_along(shape.thicknesses_m, grid.closed, frame.knot);
        for (int j = 0; j < grid.n; ++j)
            for (int k = 0; k < grid.o; ++k) {
                Vec2 p(square_coordinate(j, grid.n), square_coordinate(k, grid.o));
                if (round) p = square_to_disc(p.x(), p.y());
                rest.row(grid.index(i, j, k)) = (frame.at + p.x() * width / 2 * frame.across +
                                                 p.y() * thickness / 2 * frame.outward)
                                                    .transpose();
            }
    }
    return rest;
}

Points straight(const MuscleShape& shape, const GridShape& grid) {
    require_positive(shape.length_m, shape.place + "/length_m");
    require_positive(shape.width_m, shape.place + "/width_m");
    require_positive(shape.thickness_m, shape.place + "/thickness_m");
    if (shape.form == Form::kBlock)
        return tissue::block_rest(
            grid, {shape.length_m, shape.width_m, shape.thickness_m},
            Rigid(Eigen::Translation3d(0, -shape.width_m / 2, -shape.thickness_m / 2)));
    if (!(shape.end_ratio > 0 && shape.end_ratio <= 1))
        throw Error(shape.place + "/end_ratio", "(0, 1]", format_number(shape.end_ratio));
    Points rest = tissue::cylinder_rest(grid, shape.width_m / 2, shape.length_m);
    rest.col(2) *= shape.thickness_m / shape.width_m;
    const double scale = shape.equal_volume ? std::sqrt(disc_over_polygon(grid.n, grid.o)) : 1;
    if (shape.end_ratio == 1 && scale == 1) return rest;
    const int layer = grid.n * grid.o;
    for (int i = 0; i < grid.m; ++i) {
        // A parabola: flat in the middle, steepest at the tendons.
        const double s = square_coordinate(i, grid.m);
        rest.middleRows(i * layer, layer).rightCols(2) *=
            scale * (shape.end_ratio + (1 - shape.end_ratio) * (1 - s * s));
    }
    return rest;
}

Points fan(const MuscleShape& shape, const GridShape& grid) {
    require_positive(shape.length_m, shape.place + "/length_m");
    require_positive(shape.width_m, shape.place + "/origin_width_m");
    require_positive(shape.insertion_width_m, shape.place + "/insertion_width_m");
    require_positive(shape.thickness_m, shape.place + "/thickness_m");
    MuscleShape along = shape;
    along.path_m.setZero(2, 3);
    along.path_m(1, 0) = shape.length_m;
    along.outward = Vec3::UnitZ().transpose();
    along.widths_m = {shape.width_m, shape.insertion_width_m};
    along.thicknesses_m = {shape.thickness_m};
    along.section = Section::kBlock;
    return swept(along, grid);
}

/// Checks that cells are right-handed and not flat at the eight points at which the solid is integrated.
void check_cells(const std::string& place, const GridShape& grid, const Points& x) {
    const double low = 0.5 - 0.5 / std::sqrt(3.0);
    for (int i = 0; i < grid.cells(0); ++i)
        for (int j = 0; j + 1 < grid.n; ++j)
            for (int k = 0; k + 1 < grid.o; ++k) {
                Vec3 corner[8];
                for (int c = 0; c < 8; ++c)
                    corner[c] =
                        x.row(grid.index(c & 4 ? grid.next(i) : i, j + (c >> 1 & 1), k + (c & 1)));
                for (int point = 0; point < 8; ++point) {
                    Vec3 t[3] = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
                    for (int c = 0; c < 8; ++c)
                        for (int axis = 0; axis < 3; ++axis) {
                            double weight = 1;
                            for (int other = 0; other < 3; ++other) {
                                const bool high = c >> (2 - other) & 1;
                                const double at = point >> (2 - other) & 1 ? 1 - low : low;
                                if (other == axis)
                                    weight *= high ? 1 : -1;
                                else
                                    weight *= high ? at : 1 - at;
                            }
                            t[axis] += weight * corner[c];
                        }
                    constexpr double kFlat = 1e-4;  // fraction of a box with the same edges
                    const double box = t[0].norm() * t[1].norm() * t[2].norm();
                    const double determinant = t[0].dot(t[1].cross(t[2]));
                    if (!(determinant > kFlat * box))
                        throw Error(place, "a grid whose cells all have volume",
                                    std::string(determinant < 0 ? "an inverted" : "a flat") +
                                        " cell [" + std::to_string(i) + ", " + std::to_string(j) +
                                        ", " + std::to_string(k) + "]");
                }
            }
}

Points nodes_of(const MuscleShape& shape, const GridShape& grid) {
    switch (shape.form) {
        case Form::kBlock:
        case Form::kRound:
            return straight(shape, grid);
        case Form::kSheet:
            return fan(shape, grid);
        case Form::kPath:
        case Form::kRing:
            return swept(shape, grid);
        case Form::kSurface:
            break;
    }
    return detail::fill_surface(shape, grid);
}

}  // namespace

Belly muscle_belly(const MuscleShape& shape, const GridShape& grid) {
    check_grid(shape, grid);
    Belly belly;
    belly.grid = {grid.m, grid.n, grid.o, shape.form == Form::kRing};
    belly.rest = nodes_of(shape, belly.grid);
    check_cells(shape.place, belly.grid, belly.rest);
    belly.fibre_length_m = fibre_lengths(belly.grid, belly.rest);
    belly.volume_m3 = tissue::enclosed_volume(belly.grid, belly.rest);
    return belly;
}

Eigen::VectorXd fibre_lengths(const GridShape& grid, const Points& x) {
    const int chains = grid.n * grid.o;
    Eigen::VectorXd length = Eigen::VectorXd::Zero(chains);
    for (int i = 0; i < grid.cells(0); ++i)
        length += (x.middleRows(grid.next(i) * chains, chains) - x.middleRows(i * chains, chains))
                      .rowwise()
                      .norm();
    return length;
}

Vec2 square_to_disc(double y, double z) {
    return {y * std::sqrt(1 - 0.5 * z * z), z * std::sqrt(1 - 0.5 * y * y)};
}

double disc_over_polygon(int n, int o) {
    std::vector<Vec2> rim;
    const auto add = [&](int j, int k) {
        rim.push_back(square_to_disc(square_coordinate(j, n), square_coordinate(k, o)));
    };
    for (int j = 0; j + 1 < n; ++j) add(j, 0);
    for (int k = 0; k + 1 < o; ++k) add(n - 1, k);
    for (int j = n - 1; j > 0; --j) add(j, o - 1);
    for (int k = o - 1; k > 0; --k) add(0, k);
    double twice_area = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const Vec2 &a = rim[i], &b = rim[(i + 1) % rim.size()];
        twice_area += a.x() * b.y() - a.y() * b.x();
    }
    return 2 * std::numbers::pi / twice_area;
}

}  // namespace risorius::muscle
