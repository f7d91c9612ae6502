// SPDX-License-Identifier: MIT
#include "risorius/muscle/detail/fill_surface.h"

#include <cmath>

#include "risorius/core/error.h"
#include "risorius/muscle/detail/framed_path.h"
#include "risorius/muscle/detail/surface_sections.h"
#include "risorius/tissue/grid_shape.h"

namespace risorius::muscle::detail {

namespace {

/// Names a place at a fraction of the length, for messages.
std::string at_fraction(double s) {
    return " at " + std::to_string(static_cast<int>(std::lround(100 * s))) + " % of the length";
}

/// The loop around the path, or the only loop.
Loop section_at(const SectionedSurface& surface, const PathFrame& frame, double s,
                const std::string& place) {
    std::vector<Loop> loops = surface.loops(frame);
    const auto refuse = [&](const std::string& found) -> Error {
        return {place, "a body with one section across its middle line", found + at_fraction(s)};
    };
    if (loops.empty()) throw refuse("none");
    if (loops.size() == 1) return std::move(loops.front());
    for (Loop& loop : loops)
        if (loop_area(loop) > 0 && encloses(loop, Vec2::Zero())) return std::move(loop);
    throw refuse(std::to_string(loops.size()) + " and none around it");
}

Vec3 lifted(const PathFrame& frame, const Vec2& p) {
    return frame.at + p.x() * frame.across + p.y() * frame.outward;
}

double station(int k, int count, double margin) {
    return margin + (1 - 2 * margin) * k / (count - 1);
}

Points first_line(const SectionedSurface& surface, const MuscleShape& shape) {
    if (shape.path_m.rows() > 0) return shape.path_m;
    constexpr double kMinSlenderness = 1.1;
    double slenderness;
    const Vec3 axis = surface.long_axis(slenderness);
    if (!(slenderness > kMinSlenderness))
        throw Error(shape.place, "\"path_m\" for a body without a long axis", "none");
    const std::array<double, 2> extent = surface.extent(axis);
    Points line(2, 3);
    line.row(0) = (surface.centroid() + extent[0] * axis).transpose();
    line.row(1) = (surface.centroid() + extent[1] * axis).transpose();
    return line;
}

/// A line from tip to tip through the centroids of the sections perpendicular to it.
Points middle_line(const SectionedSurface& surface, const MuscleShape& shape) {
    constexpr int kRounds = 4, kStations = 16;
    constexpr double kFirstMargin = 0.1;  // the first guess may begin outside the body
    Points line = first_line(surface, shape);
    for (int round = 0; round < kRounds; ++round) {
        const FramedPath path(line, Points(), /*closed=*/false, shape.place);
        Points centres(kStations, 3);
        for (int k = 0; k < kStations; ++k) {
            const double s = station(k, kStations, round == 0 ? kFirstMargin : shape.tip_ratio);
            const PathFrame frame = path.frame(s);
            const Loop loop = section_at(surface, frame, s, shape.place);
            centres.row(k) = lifted(frame, loop_centroid(loop)).transpose();
        }
        // The tips are where straight extensions of the line leave the body.
        line.resize(kStations + 2, 3);
        line.middleRows(1, kStations) = centres;
        for (int k = 1; k + 1 < kStations; ++k)  // planes that follow each wiggle would intersect
            line.row(k + 1) = (centres.row(k - 1) + 2 * centres.row(k) + centres.row(k + 1)) / 4;
        const auto tip = [&](int last, int before) {
            const Vec3 from = line.row(last).transpose();
            const Vec3 outward = (from - line.row(before).transpose()).normalized();
            const double way = surface.way_out(from, outward);
            if (!std::isfinite(way))
                throw Error(shape.place, "a body around its middle line", "one that bends off it");
            return Vec3(from + way * outward);
        };
        line.row(0) = tip(1, 2).transpose();
        line.row(kStations + 1) = tip(kStations, kStations - 1).transpose();
    }
    return line;
}

/// Nodes of one section. The square is mapped to the unit disc, and the disc is stretched along rays to the loop.
std::vector<Vec2> fill_loop(const Loop& loop, int n, int o, double s, const std::string& place) {
    if (!(loop_area(loop) > 0) || crosses_itself(loop))
        throw Error(place, "sections that do not cross themselves", "one" + at_fraction(s));
    const Vec2 centre = loop_centroid(loop), spread = loop_spread(loop).cwiseSqrt();
    const auto rim = [&](const Vec2& direction) {
        double found = 0;
        int count = 0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2 a = loop[i] - centre, b = loop[(i + 1) % loop.size()] - centre;
            const double from = direction.x() * a.y() - direction.y() * a.x();
            const double to = direction.x() * b.y() - direction.y() * b.x();
            if ((from >= 0) == (to >= 0)) continue;
            const Vec2 p = a + from / (from - to) * (b - a);
            if (!(p.dot(direction) > 0)) continue;
            found = p.norm() / direction.norm();
            ++count;
        }
        if (count != 1)
            throw Error(place, "sections that can be seen whole from their middle",
                        "one that cannot" + at_fraction(s));
        return found;
    };
    std::vector<Vec2> nodes;
    for (int j = 0; j < n; ++j)
        for (int k = 0; k < o; ++k) {
            const Vec2 p = square_to_disc(2.0 * j / (n - 1) - 1, 2.0 * k / (o - 1) - 1);
            if (p.norm() < 1e-12) {
                nodes.push_back(centre);
                continue;
            }
            const Vec2 direction = p.normalized().cwiseProduct(spread);
            nodes.push_back(centre + p.norm() * rim(direction) * direction);
        }
    return nodes;
}

double rim_area(const std::vector<Vec2>& nodes, int n, int o) {
    Loop rim;
    const auto add = [&](int j, int k) {
        rim.push_back(nodes[static_cast<std::size_t>(j * o + k)]);
    };
    for (int j = 0; j + 1 < n; ++j) add(j, 0);
    for (int k = 0; k + 1 < o; ++k) add(n - 1, k);
    for (int j = n - 1; j > 0; --j) add(j, o - 1);
    for (int k = o - 1; k > 0; --k) add(0, k);
    return loop_area(rim);
}

}  // namespace

Points fill_surface(const MuscleShape& shape, const tissue::GridShape& grid) {
    if (!(shape.tip_ratio >= 0.001 && shape.tip_ratio <= 0.25))
        throw Error(shape.place + "/tip_ratio", "[0.001, 0.25]", format_number(shape.tip_ratio));
    if (shape.outward.rows() > 1)
        throw Error(shape.place + "/outward", "one direction",
                    std::to_string(shape.outward.rows()));
    const SectionedSurface surface(shape.surface_m, shape.triangles, shape.place);
    FramedPath path(middle_line(surface, shape), shape.outward, /*closed=*/false, shape.place);
    if (shape.outward.rows() == 0)
        path.turn(loop_tilt(section_at(surface, path.frame(0.5), 0.5, shape.place)));

    const int layer = grid.n * grid.o;
    Points nodes(grid.size(), 3), equal(grid.size(), 3), centres(grid.size(), 3);
    for (int i = 0; i < grid.m; ++i) {
        const double s = station(i, grid.m, shape.tip_ratio);
        const PathFrame frame = path.frame(s);
        const Loop loop = section_at(surface, frame, s, shape.place);
        const std::vector<Vec2> section = fill_loop(loop, grid.n, grid.o, s, shape.place);
        const double swell = std::sqrt(loop_area(loop) / rim_area(section, grid.n, grid.o));
        const Vec3 centre = lifted(frame, loop_centroid(loop));
        for (int k = 0; k < layer; ++k) {
            const Vec3 p = lifted(frame, section[static_cast<std::size_t>(k)]);
            nodes.row(i * layer + k) = p.transpose();
            centres.row(i * layer + k) = centre.transpose();
            equal.row(i * layer + k) = (centre + swell * (p - centre)).transpose();
        }
    }
    // When sections have the right area, volume is missing because of branches, or because the middle line missed a part.
    constexpr double kMinFraction = 0.85, kMaxFraction = 1.1;
    double fraction = tissue::enclosed_volume(grid, equal) / surface.volume_m3();
    if (!(fraction > kMinFraction && fraction < kMaxFraction))
        throw Error(shape.place, "a body that its sections fill, without branches or sharp bends",
                    std::to_string(std::lround(100 * fraction)) + " % of its volume in them");
    if (!shape.equal_volume) return nodes;
    for (int round = 0; round < 4; ++round) {
        equal = centres + (equal - centres) / std::sqrt(fraction);
        fraction = tissue::enclosed_volume(grid, equal) / surface.volume_m3();
    }
    return equal;
}

}  // namespace risorius::muscle::detail
