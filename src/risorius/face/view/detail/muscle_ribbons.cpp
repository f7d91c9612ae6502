// SPDX-License-Identifier: MIT
#include "risorius/face/view/detail/muscle_ribbons.h"

#include <algorithm>
#include <cmath>

#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr double kThinnest_m = 0.25e-3;           ///< minimum thickness on each side
constexpr double kUnderSkin_m = 0.8e-3;           ///< skin and the fat below it
constexpr double kMinArea = 0.4, kMaxArea = 2.5;  ///< limits of area / rest area in the thickness

/// Returns normals of the grid (rows x columns) whose length is the area of each point.
std::vector<Vec3> areas_of(const SheetSize& size, const Points& grid) {
    std::vector<Vec3> areas;
    areas.reserve(static_cast<std::size_t>(size.points()));
    const auto at = [&](int row, int column) -> Vec3 {
        return grid.row(row * size.columns + column).transpose();
    };
    for (int i = 0; i < size.rows; ++i)
        for (int j = 0; j < size.columns; ++j) {
            const Vec3 along = at(std::min(i + 1, size.rows - 1), j) - at(std::max(i - 1, 0), j);
            const Vec3 across =
                at(i, std::min(j + 1, size.columns - 1)) - at(i, std::max(j - 1, 0));
            areas.push_back(along.cross(across));
        }
    return areas;
}

/// Returns the ring of vertices of a row: above the sheet from the first column to the last, and back below it.
int ring_size(const SheetSize& size) { return 2 * (size.columns - 1); }

Triangles tube(const SheetSize& size, double outward) {
    const int ring = ring_size(size);
    std::vector<std::array<int, 3>> faces;
    for (int i = 0; i + 1 < size.rows; ++i)
        for (int k = 0; k < ring; ++k) {
            const int a = i * ring + k, b = i * ring + (k + 1) % ring;
            faces.push_back({a, a + ring, b});
            faces.push_back({b, a + ring, b + ring});
        }
    // The end caps join the vertices above and below each column
    for (const int first : {0, (size.rows - 1) * ring})
        for (int j = 0; j + 1 < size.columns; ++j) {
            const auto over = [&](int column) { return first + column; };
            const auto under = [&](int column) { return first + (ring - column) % ring; };
            const bool begin = first == 0;
            const auto add = [&](int a, int b, int c) {
                if (a == b || b == c || c == a) return;
                if (begin)
                    faces.push_back({a, b, c});
                else
                    faces.push_back({a, c, b});
            };
            add(over(j), over(j + 1), under(j));
            add(over(j + 1), under(j + 1), under(j));
        }
    Triangles triangles(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int k = 0; k < 3; ++k)
            triangles(static_cast<Eigen::Index>(f), k) =
                faces[f][static_cast<std::size_t>(k == 0 || outward > 0 ? k : 3 - k)];
    return triangles;
}

/// Returns thickness / maximum thickness: edges are rounded and ends are thinner.
double profile(const SheetSize& size, int row, int column, const Vec2& bone_ends) {
    const double across = size.across(column), s = size.along(row);
    const double edge = std::sqrt(std::max(0.0, 1 - std::pow(across, 4)));
    const double from = bone_ends[0] > 0 ? 0.15 : 0.2, to = bone_ends[1] > 0 ? 0.15 : 0.2;
    const double begin = from + (1 - from) * geom::smoothstep(0, 0.3, s);
    const double end = to + (1 - to) * geom::smoothstep(0, 0.3, 1 - s);
    return edge * begin * end;
}

bool on_bone(const rig::PathPoint& point) { return point.attach == "bone"; }

}  // namespace

MuscleRibbons::MuscleRibbons(const rig::Head& head, const rig::RigDescription& rig,
                             const MusclePlacement& placement, MuscleSurfaces& surfaces)
    : points_(placement.points) {
    const geom::SurfaceTree skin = outer_skin(head);
    rest_points_.resize(static_cast<Eigen::Index>(points_.size()), 3);
    for (std::size_t f = 0; f < placement.fibres.size(); ++f)
        for (std::size_t p = 0; p < placement.paths[f].size(); ++p)
            rest_points_.row(placement.fibres[f].first_point + static_cast<Eigen::Index>(p)) =
                placement.paths[f][p].transpose();

    const track::ChannelTable channels = rig.channels();
    for (const rig::Muscle& muscle : rig.muscles.muscles) {
        if (rig.solid(muscle.id) != nullptr) continue;
        bool has_fibres = false;
        for (const FibreBundle& bundle : placement.bundles) {
            if (bundle.muscle != muscle.id) continue;
            has_fibres = true;
            add(FibreSheet(placement, bundle), head, muscle,
                {bundle.origin_on_bone, bundle.insertion_on_bone}, skin,
                surfaces.of(muscle.id, bundle.side, bundle.column), surfaces);
        }
        if (has_fibres) continue;
        for (const rig::MusclePath& path : muscle.paths)
            for (const Side side : {Side::kLeft, Side::kRight}) {
                if (!muscle.paired && side == Side::kRight) continue;
                const rig::MusclePath placed = side == Side::kLeft ? path : rig::mirrored(path);
                const std::optional<Side> of_side =
                    muscle.paired ? std::optional(side) : std::nullopt;
                add(BoneSheet(head, muscle, placed, skin), head, muscle,
                    {on_bone(path.front()), on_bone(path.back())}, skin,
                    surfaces.of(muscle.id, of_side, channels.column(muscle.id, side)), surfaces);
            }
    }
}

void MuscleRibbons::place_grid(const Strap& strap, const Points& fibre_points,
                               const BoneMotion& bones, Points& grid) const {
    if (const auto* fibres = std::get_if<FibreSheet>(&strap.sheet))
        fibres->place(fibre_points, grid);
    else
        std::get<BoneSheet>(strap.sheet).place(bones, grid);
}

void MuscleRibbons::add(std::variant<FibreSheet, BoneSheet> sheet, const rig::Head& head,
                        const rig::Muscle& muscle, const Vec2& bone_ends,
                        const geom::SurfaceTree& skin, MuscleSurface& surface,
                        MuscleSurfaces& surfaces) {
    Strap strap{std::move(sheet), {}, surfaces.rest.rows(), 1, {}, {}, {}};
    strap.size = std::visit([](const auto& s) { return s.size(); }, strap.sheet);
    const SheetSize& size = strap.size;
    Points grid;
    place_grid(strap, rest_points_, {}, grid);

    // The side that faces the skin, and the space below the skin
    const std::vector<Vec3> areas = areas_of(size, grid);
    double outward = 0;
    std::vector<double> depth;
    for (int p = 0; p < size.points(); ++p) {
        const Vec3 at = grid.row(p).transpose();
        const Vec3 up = skin.closest(at)->point - at;
        outward += areas[static_cast<std::size_t>(p)].normalized().dot(up.normalized());
        depth.push_back(up.norm());
    }
    strap.outward = outward < 0 ? -1 : 1;

    TexCoords fibre(size.rows * ring_size(size), 2);
    std::vector<double> tendon;
    const double half = 0.5 * head.size * muscle.thickness_m;
    const double ends = std::max(1.0, bone_ends.sum());
    const double tendon_m = std::clamp(head.size * muscle.tendon_slack_m / ends,
                                       0.03 * size.length_m, 0.10 * size.length_m);
    for (int i = 0; i < size.rows; ++i) {
        for (int j = 0; j < size.columns; ++j) {
            const auto p = static_cast<std::size_t>(i * size.columns + j);
            const double wanted = half * profile(size, i, j, bone_ends);
            const bool edge = j == 0 || j == size.columns - 1;
            const double min = edge ? 0.0 : kThinnest_m;
            strap.over_m.push_back(
                std::max(min, std::min(wanted, depth[p] - head.size * kUnderSkin_m)));
            strap.under_m.push_back(std::max(min, wanted));
            strap.rest_area_m2.push_back(areas[p].norm());
        }
        for (int k = 0; k < ring_size(size); ++k) {
            const int j = k < size.columns ? k : ring_size(size) - k;
            const double along = size.along(i) * size.length_m;
            const double piece = 0.0371 * static_cast<double>(straps_.size());
            fibre.row(i * ring_size(size) + k) << along,
                piece + 0.5 * size.across(j) * size.width_m;
            // Origins are thicker than insertions
            const double from =
                bone_ends[0] * (1 - geom::smoothstep(0.2 * tendon_m, 0.8 * tendon_m, along));
            const double to = bone_ends[1] * (1 - geom::smoothstep(0.5 * tendon_m, 1.5 * tendon_m,
                                                                   size.length_m - along));
            tendon.push_back(std::max(from, to));
        }
    }
    const Triangles triangles = tube(size, strap.outward);
    Points vertices = Points::Zero(size.rows * ring_size(size), 3);
    surfaces.add(surface, vertices, fibre, tendon, triangles);
    straps_.push_back(std::move(strap));
    place_strap(straps_.back(), rest_points_, {}, surfaces.rest);
}

Points MuscleRibbons::place_fibre_points(const Points& nodes, const BoneMotion& bones) const {
    Points out(static_cast<Eigen::Index>(points_.size()), 3);
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const muscle::FibrePoint& point = points_[p];
        auto row = out.row(static_cast<Eigen::Index>(p));
        if (point.count == 0) {
            const Rigid motion = point.body == kMandibleBody ? bones.mandible : Rigid::Identity();
            row = (motion * point.body_rest).transpose();
            continue;
        }
        row.setZero();
        for (int i = 0; i < point.count; ++i) row += point.weights[i] * nodes.row(point.nodes[i]);
    }
    return out;
}

void MuscleRibbons::place_strap(const Strap& strap, const Points& fibre_points,
                                const BoneMotion& bones, Points& vertices) const {
    const SheetSize& size = strap.size;
    Points grid;
    place_grid(strap, fibre_points, bones, grid);
    const std::vector<Vec3> areas = areas_of(size, grid);
    const int ring = ring_size(size);
    for (int i = 0; i < size.rows; ++i)
        for (int j = 0; j < size.columns; ++j) {
            const auto p = static_cast<std::size_t>(i * size.columns + j);
            const double area = areas[p].norm();
            const double thicker =
                1 / std::clamp(area / std::max(strap.rest_area_m2[p], 1e-12), kMinArea, kMaxArea);
            const Vec3 normal = area > 0 ? Vec3(strap.outward / area * areas[p]) : Vec3::Zero();
            const Vec3 middle = grid.row(static_cast<Eigen::Index>(p)).transpose();
            const Eigen::Index row = strap.first_vertex + i * ring;
            vertices.row(row + j) = (middle + thicker * strap.over_m[p] * normal).transpose();
            if (j > 0 && j < size.columns - 1)
                vertices.row(row + ring - j) =
                    (middle - thicker * strap.under_m[p] * normal).transpose();
        }
}

void MuscleRibbons::place(const Points& nodes, const BoneMotion& bones, Points& vertices) const {
    const Points fibre_points = place_fibre_points(nodes, bones);
    for (const Strap& strap : straps_) place_strap(strap, fibre_points, bones, vertices);
}

}  // namespace risorius::face
