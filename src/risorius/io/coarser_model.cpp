// SPDX-License-Identifier: MIT
#include "risorius/io/coarser_model.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "risorius/geom/closest_point.h"
#include "risorius/io/detail/part_vertices.h"

namespace risorius::io {

namespace {

constexpr std::size_t kFewTriangles = 200;
constexpr float kAnyError =
    1;  // of the size of the part: the number of triangles alone ends the search

/// Vertices with another texture coordinate are vertices of their own, so that seams of the texture stay.
void make_coarser(const Points& vertices, double fraction, MorphPart& part) {
    const detail::PartVertices own(part);
    if (own.corner.size() < 3 * kFewTriangles) return;
    const detail::Floats places = own.gather(vertices);
    const auto wanted = static_cast<std::size_t>(
        std::lround(fraction * static_cast<double>(own.corner.size()) / 3) * 3);
    std::vector<unsigned> fewer(own.corner.size());
    fewer.resize(meshopt_simplify(fewer.data(), own.corner.data(), own.corner.size(), places.data(),
                                  own.count(), 3 * sizeof(float), wanted, kAnyError,
                                  meshopt_SimplifyLockBorder, nullptr));
    const auto corners = static_cast<long>(fewer.size());
    const bool mapped = part.texcoords.rows() > 0;
    part.triangles.resize(corners / 3, 3);
    if (mapped) part.texcoords.resize(corners, 2);
    for (long c = 0; c < corners; ++c) {
        const unsigned from = fewer[static_cast<std::size_t>(c)];
        part.triangles(c / 3, c % 3) = own.vertex[from];
        if (mapped) part.texcoords.row(c) << own.texcoord[from][0], own.texcoord[from][1];
    }
}

/// The vertices that a part has lost.
std::vector<int> lost_vertices(const MorphPart& fine, const MorphPart& coarse) {
    std::vector<int> before(fine.triangles.data(), fine.triangles.data() + fine.triangles.size()),
        after(coarse.triangles.data(), coarse.triangles.data() + coarse.triangles.size()), lost;
    for (std::vector<int>* list : {&before, &after}) {
        std::sort(list->begin(), list->end());
        list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    std::set_difference(before.begin(), before.end(), after.begin(), after.end(),
                        std::back_inserter(lost));
    return lost;
}

/// Distances of vertices from a surface.
struct Distances {
    double max_m = 0, squares = 0;
    void add(const geom::SurfaceTree& surface, const Points& vertices, int v) {
        if (const auto at = surface.closest(vertices.row(v).transpose())) {
            max_m = std::max(max_m, std::sqrt(at->squared_distance));
            squares += at->squared_distance;
        }
    }
};

}  // namespace

MorphModel coarser_model(const MorphModel& model, double fraction) {
    MorphModel out = model;
    for (MorphPart& part : out.parts)
        if (part.triangles.size() > 0 && part.triangles(0, 0) < model.first_worn())
            make_coarser(out.vertices, fraction, part);
    return out;
}

LevelError level_error(const MorphModel& fine, const MorphModel& coarse) {
    LevelError out;
    std::vector<std::vector<int>> lost;
    std::vector<geom::SurfaceTree> surfaces;
    std::size_t count = 0;
    Distances at_rest;
    for (std::size_t p = 0; p < fine.parts.size(); ++p) {
        out.triangles += coarse.parts[p].triangles.rows();
        lost.push_back(lost_vertices(fine.parts[p], coarse.parts[p]));
        surfaces.emplace_back(fine.vertices, coarse.parts[p].triangles);
        for (const int v : lost.back()) at_rest.add(surfaces.back(), fine.vertices, v);
        count += lost.back().size();
    }
    out.surface_m = at_rest.max_m;
    if (count == 0) return out;
    for (const MorphTarget& target : fine.targets) {
        if (target.usual_weight != 1) continue;  // a corrective
        Points moved = fine.vertices;
        for (std::size_t i = 0; i < target.vertex.size(); ++i)
            moved.row(target.vertex[i]) += target.delta.row(static_cast<long>(i));
        Distances in_shape;
        for (std::size_t p = 0; p < surfaces.size(); ++p) {
            if (lost[p].empty()) continue;
            surfaces[p].refit(moved);
            for (const int v : lost[p])
                if (moved.row(v) != fine.vertices.row(v)) in_shape.add(surfaces[p], moved, v);
        }
        out.shape_max_m = std::max(out.shape_max_m, in_shape.max_m);
        out.shape_rms_m =
            std::max(out.shape_rms_m, std::sqrt(in_shape.squares / static_cast<double>(count)));
    }
    return out;
}

}  // namespace risorius::io
