// SPDX-License-Identifier: MIT
#include "risorius/headmodel/head_quality.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <map>
#include <set>

#include "risorius/geom/closest_point.h"
#include "risorius/geom/self_intersections.h"

namespace risorius::headmodel {
namespace {

Vec3 place_of(const HeadModel& model, const std::string& landmark) {
    return model.mesh.positions.row(model.landmarks.at(landmark)).transpose();
}

double fraction_of(std::vector<double> values, double fraction) {
    if (values.empty()) return 0;
    const auto at =
        static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + static_cast<long>(at), values.end());
    return values[at];
}

/// Depth of the front-most skin under a ray along z, or nothing.
bool front_most(const geom::PolygonMesh& mesh, const Triangles& skin, double x, double y,
                double& z) {
    z = -1e9;
    for (long t = 0; t < skin.rows(); ++t) {
        const Vec3 a = mesh.positions.row(skin(t, 0)), b = mesh.positions.row(skin(t, 1)),
                   d = mesh.positions.row(skin(t, 2));
        const double area = (b.x() - a.x()) * (d.y() - a.y()) - (b.y() - a.y()) * (d.x() - a.x());
        if (area < 1e-9) continue;  // only what faces forward
        const double u = ((x - a.x()) * (d.y() - a.y()) - (y - a.y()) * (d.x() - a.x())) / area;
        const double v = ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x())) / area;
        if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9) continue;
        z = std::max(z, (1 - u - v) * a.z() + u * b.z() + v * d.z());
    }
    return z > -1e8;
}

void compare_with_tables(const HeadModel& model, const DesignTables& tables, HeadQuality& quality) {
    const auto& mesh = model.mesh;
    const Triangles skin = geom::triangulate(mesh, {mesh.group_index("skin")});
    const geom::SurfaceTree tree(mesh.positions, skin);
    const auto& depth = tables.face_depth;
    double along = 0, nearest = 0;
    int points = 0;
    for (std::size_t r = 0; r < depth.rows.size(); ++r)
        for (std::size_t c = 0; c < depth.columns.size(); ++c) {
            const double x = depth.columns[c], y = depth.rows[r], measured = depth.value[r][c];
            if (std::isnan(measured)) continue;
            const double distance = std::sqrt(tree.closest(Vec3(x, y, measured))->squared_distance);
            nearest += distance * distance;
            quality.relief_worst_mm = std::max(quality.relief_worst_mm, distance);
            ++points;
            double z = 0;
            if (!front_most(mesh, skin, x, y, z)) continue;
            along += (z - measured) * (z - measured);
            ++quality.rays;
        }
    quality.depth_rms_mm = std::sqrt(along / quality.rays);
    quality.relief_rms_mm = std::sqrt(nearest / points);
    const auto& radius = tables.head_radius;
    double square = 0;
    points = 0;
    for (std::size_t r = 0; r < radius.rows.size(); ++r)
        for (std::size_t c = 0; c < radius.columns.size(); ++c) {
            const double y = radius.rows[r], azimuth = radius.columns[c],
                         value = radius.value[r][c];
            const bool ear = y < 35 && y > -36 && azimuth > 75 && azimuth < 125;
            // Above 70 mm the crown is lowered on purpose; below -85 mm begin neck and shoulder of this project.
            if (std::isnan(value) || y > 70 || y < -85 || azimuth < 35 || ear) continue;
            const double a = azimuth * M_PI / 180.0;
            square += tree.closest(Vec3(value * std::sin(a), y, 20.0 + value * std::cos(a)))
                          ->squared_distance;
            ++points;
        }
    quality.radius_rms_mm = std::sqrt(square / points);
    square = 0;
    for (const auto& [id, p] : tables.landmarks) {
        const double distance = (place_of(model, id) - p).norm();
        square += distance * distance;
        quality.landmarks.push_back({id, distance});
    }
    std::stable_sort(
        quality.landmarks.begin(), quality.landmarks.end(),
        [](const LandmarkMiss& a, const LandmarkMiss& b) { return a.distance_mm > b.distance_mm; });
    quality.landmark_rms_mm = std::sqrt(square / static_cast<double>(tables.landmarks.size()));
}

void judge_topology(const HeadModel& model, HeadQuality& quality) {
    const auto& mesh = model.mesh;
    const int groups[2] = {mesh.group_index("skin"), mesh.group_index("mouth")};
    std::map<std::pair<int, int>, int> edges;
    std::map<int, int> valence;
    std::vector<double> aspect;
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face_group[f] != groups[0] && mesh.face_group[f] != groups[1]) continue;
        ++quality.faces;
        const int corners = mesh.corner_count(f);
        if (corners != 4) ++quality.triangles;
        double longest = 0, shortest = 1e9;
        for (int k = 0; k < corners; ++k) {
            const int a = mesh.corner_vertex[mesh.face_begin[f] + k],
                      b = mesh.corner_vertex[mesh.face_begin[f] + (k + 1) % corners];
            ++edges[{std::min(a, b), std::max(a, b)}];
            const double length = (mesh.positions.row(a) - mesh.positions.row(b)).norm();
            longest = std::max(longest, length);
            shortest = std::min(shortest, length);
        }
        aspect.push_back(longest / shortest);
    }
    std::set<int> boundary;
    for (const auto& [edge, count] : edges) {
        ++valence[edge.first];
        ++valence[edge.second];
        if (count == 1) boundary.insert({edge.first, edge.second});
    }
    int unusual = 0, inner = 0;
    for (const auto& [v, count] : valence) {
        if (boundary.count(v)) continue;
        ++inner;
        if (count < 3 || count > 5) ++unusual;
    }
    quality.vertices = static_cast<int>(valence.size());
    quality.quad_fraction = 1.0 - static_cast<double>(quality.triangles) / quality.faces;
    quality.unusual_valence_fraction = static_cast<double>(unusual) / inner;
    quality.aspect_median = fraction_of(aspect, 0.5);
    quality.aspect_99 = fraction_of(aspect, 0.99);
    quality.aspect_worst = fraction_of(aspect, 1.0);
    const Triangles both = geom::triangulate(mesh, {groups[0], groups[1]});
    quality.self_intersections =
        static_cast<int>(geom::self_intersections(mesh.positions, both).size());
    // Every vertex has one at its mirrored place: nearest in the order of x, y, z of the other half.
    std::map<std::array<long, 3>, double> places;
    const auto key = [&](int v, double side) {
        return std::array<long, 3>{std::lround(side * mesh.positions(v, 0) * 1e6),
                                   std::lround(mesh.positions(v, 1) * 1e6),
                                   std::lround(mesh.positions(v, 2) * 1e6)};
    };
    for (const auto& [v, count] : valence) places[key(v, 1)] = 0;
    const geom::SurfaceTree tree(mesh.positions, both);
    for (const auto& [v, count] : valence)
        if (!places.count(key(v, -1))) {
            Vec3 p = mesh.positions.row(v).transpose();
            p.x() = -p.x();
            quality.mirror_error_mm =
                std::max(quality.mirror_error_mm, std::sqrt(tree.closest(p)->squared_distance));
        }
}

void judge_layout(const HeadModel& model, HeadQuality& quality) {
    const auto& mesh = model.mesh;
    if (mesh.corner_texcoord.rows() == 0) return;
    std::vector<double> stretch;
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (mesh.group_names[static_cast<std::size_t>(mesh.face_group[f])] != "skin") continue;
        const int corners = mesh.corner_count(f), begin = mesh.face_begin[f];
        double area = 0;
        for (int k = 0; k < corners; ++k) {
            const int a = begin + k, b = begin + (k + 1) % corners;
            area += mesh.corner_texcoord(a, 0) * mesh.corner_texcoord(b, 1) -
                    mesh.corner_texcoord(b, 0) * mesh.corner_texcoord(a, 1);
            const double flat = (mesh.corner_texcoord.row(a) - mesh.corner_texcoord.row(b)).norm();
            const double length = (mesh.positions.row(mesh.corner_vertex[a]) -
                                   mesh.positions.row(mesh.corner_vertex[b]))
                                      .norm();
            stretch.push_back(length / std::max(flat, 1e-12));
        }
        if (area < 0) ++quality.turned_over;
    }
    const double usual = fraction_of(stretch, 0.5);
    quality.stretch_low = fraction_of(stretch, 0.01) / usual;
    quality.stretch_high = fraction_of(stretch, 0.99) / usual;
}

void print(std::string& out, const char* form, ...) {
    char line[256];
    va_list arguments;
    va_start(arguments, form);
    std::vsnprintf(line, sizeof line, form, arguments);
    va_end(arguments);
    out += line;
}

}  // namespace

double HeadQuality::worst_deviation() const {
    double worst = 0;
    for (const MeasureScore& m : measures) worst = std::max(worst, std::abs(m.deviation));
    return worst;
}

std::vector<MeasureScore> measure_head(const HeadModel& model, const DesignTables& tables,
                                       double sex) {
    std::vector<MeasureScore> scores;
    for (const Measure& m : tables.measures) {
        const double length = (place_of(model, m.from) - place_of(model, m.to)).norm();
        const double mean = m.mean_mm + 0.5 * sex * m.men_less_women_mm;
        scores.push_back({m.name, length, (length - mean) / m.sd_mm});
    }
    return scores;
}

bool runs_through_itself(const HeadModel& model) {
    const geom::PolygonMesh& mesh = model.mesh;
    return !geom::self_intersections(
                mesh.positions,
                geom::triangulate(mesh, {mesh.group_index("skin"), mesh.group_index("mouth")}))
                .empty();
}

HeadQuality head_quality(const HeadModel& model, const DesignTables& tables, double sex,
                         bool compare_with_relief) {
    HeadQuality quality;
    if (compare_with_relief) compare_with_tables(model, tables, quality);
    quality.measures = measure_head(model, tables, sex);
    judge_topology(model, quality);
    judge_layout(model, quality);
    return quality;
}

std::string quality_report(const HeadQuality& q) {
    std::string out;
    if (q.rays > 0) {
        print(out, "relief           RMS %.2f mm from the measured points, greatest %.2f mm\n",
              q.relief_rms_mm, q.relief_worst_mm);
        print(out, "                 RMS %.2f mm along %d rays; sides and back RMS %.2f mm\n",
              q.depth_rms_mm, q.rays, q.radius_rms_mm);
        print(out, "landmarks        RMS %.2f mm; farthest", q.landmark_rms_mm);
        for (std::size_t k = 0; k < std::min<std::size_t>(6, q.landmarks.size()); ++k)
            print(out, " %s %.2f", q.landmarks[k].landmark.c_str(), q.landmarks[k].distance_mm);
        out += "\n";
    }
    print(out, "measures         within %.2f standard deviations of their means\n",
          q.worst_deviation());
    for (const MeasureScore& m : q.measures)
        print(out, "  %-20s %6.1f mm  %+5.2f\n", m.measure.c_str(), m.length_mm, m.deviation);
    print(out, "skin and mouth   %d vertices, %d faces, %.2f %% quads (%d triangles)\n", q.vertices,
          q.faces, 100 * q.quad_fraction, q.triangles);
    print(out, "valence          %.2f %% of the inner vertices not 3 to 5\n",
          100 * q.unusual_valence_fraction);
    print(out, "intersections    %d pairs of triangles\n", q.self_intersections);
    print(out, "mirror           %.1e mm\n", q.mirror_error_mm);
    print(out, "aspect           median %.2f, 99 of 100 below %.1f, greatest %.1f\n",
          q.aspect_median, q.aspect_99, q.aspect_worst);
    if (q.stretch_high > 0)
        print(out,
              "layout           98 of 100 edges %.2f to %.2f of the usual length, %d faces turned "
              "over\n",
              q.stretch_low, q.stretch_high, q.turned_over);
    return out;
}

}  // namespace risorius::headmodel
