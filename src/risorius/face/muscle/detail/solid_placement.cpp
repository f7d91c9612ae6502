// SPDX-License-Identifier: MIT
#include "risorius/face/muscle/detail/solid_placement.h"

#include <algorithm>
#include <cmath>

#include "risorius/face/muscle/detail/mesh_placement.h"
#include "risorius/geom/polyline.h"
#include "risorius/rig/muscle_force.h"
#include "risorius/rig/muscle_path.h"

namespace risorius::face {

namespace {

using rig::MusclePath;
using rig::PathPoint;

constexpr double kEndThickness = 0.55;   // thickness at both ends / thickness of the belly
constexpr double kSkinCover_m = 1.2e-3;  // minimum depth of a muscle below the skin surface
constexpr double kCornerHalfWidth_m = 1.5e-3,
                 kCornerOpening = 0.22;  // of the ring around the mouth
constexpr const char* kUpperRing = "orbicularis_oris_upper_peripheral";
constexpr const char* kLowerRing = "orbicularis_oris_lower_peripheral";

// A path with the outward direction at each point.
struct Course {
    std::vector<Vec3> point, outward;
    std::vector<double> arc{};  ///< length up to each point
};

Course course_of(const rig::Head& head, const MusclePath& path, const std::string& muscle,
                 const TissueLocator& locator) {
    Course out;
    for (const PathPoint& p : path) {
        const Vec3 place = rig::place_on(head, p, muscle);
        const TissueLocator::Column column = locator.column_at(place);
        out.point.push_back(
            p.on_skin() ? Vec3(column.skin - p.depth * column.thickness * column.outward) : place);
        out.outward.push_back(column.outward);
    }
    return out;
}

// Returns points at equal steps of arc length, `share` 0..1.
Course sampled(const Course& through, const std::vector<double>& fractions, bool closed = false) {
    constexpr double kFine_m = 1e-3;
    std::vector<Vec3> control = through.point, fine;
    if (closed) {
        // One closed turn with the neighbours on both sides, then its middle
        const std::size_t n = control.size();
        control.clear();
        for (std::size_t i = 0; i < n + 3; ++i) control.push_back(through.point[(i + n - 1) % n]);
        fine = geom::sample_curve(control, kFine_m);
        const auto is_start = [&](const Vec3& p) { return (p - through.point[0]).norm() < 1e-9; };
        const auto first = std::find_if(fine.begin(), fine.end(), is_start);
        const auto last = std::find_if(fine.rbegin(), fine.rend(), is_start);
        fine = std::vector<Vec3>(first, last.base());
    } else {
        fine = geom::sample_curve(control, kFine_m);
    }
    std::vector<double> arc{0.0};
    for (std::size_t i = 1; i < fine.size(); ++i)
        arc.push_back(arc.back() + (fine[i] - fine[i - 1]).norm());
    Course out;
    for (double fraction : fractions) {
        const double s = fraction * arc.back();
        const auto above = std::upper_bound(arc.begin(), arc.end(), s);
        const std::size_t i = std::clamp<std::size_t>(static_cast<std::size_t>(above - arc.begin()),
                                                      1, arc.size() - 1);
        const double t = (s - arc[i - 1]) / (arc[i] - arc[i - 1]);
        const Vec3 p = (1 - t) * fine[i - 1] + t * fine[i];
        // Outward direction: mean of those at the given points, weighted by nearness
        Vec3 outward = Vec3::Zero();
        for (std::size_t k = 0; k < through.point.size(); ++k)
            outward += through.outward[k] / ((p - through.point[k]).squaredNorm() + 1e-6);
        out.point.push_back(p);
        out.outward.push_back(outward.normalized());
        out.arc.push_back(s);
    }
    return out;
}

double length_of(const Course& course) {
    double length = 0;
    const std::vector<Vec3> fine = geom::sample_curve(course.point, 1e-3);
    for (std::size_t i = 1; i < fine.size(); ++i) length += (fine[i] - fine[i - 1]).norm();
    return length;
}

// Numbers of cells along, across and through: cells about as long as wide, within the limits of computing time.
std::array<int, 3> cells_of(const rig::SolidMuscle& solid, double length_m, double size) {
    const auto count = [&](int given, double extent_m, double edge_m, int min, int max) {
        return given > 0 ? given
                         : std::clamp(static_cast<int>(std::lround(extent_m / (size * edge_m))),
                                      min, max);
    };
    return {count(solid.cells[0], length_m, 9e-3, 3, 8),
            count(solid.cells[1], size * solid.width_m, 9e-3, 1, 3),
            count(solid.cells[2], size * solid.thickness_m, 8e-3, 1, 2)};
}

// A belly tapers towards both ends: 1 in the middle, smoothly to `ends`.
double taper(double fraction, const std::array<double, 2>& ends) {
    const double end = fraction < 0.5 ? ends[0] : ends[1];
    const double from_end = 1 - std::abs(2 * fraction - 1);
    return end + (1 - end) * geom::smoothstep(0.0, 1.0, from_end);
}

class Placer {
  public:
    Placer(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
           const TissueLocator& locator)
        : head_(head), rig_(rig), jaw_(jaw), locator_(locator), channels_(rig.channels()) {}

    SolidPlacement place() {
        const bool ring = rig_.solid(kUpperRing) && rig_.solid(kLowerRing);
        for (const rig::SolidMuscle& solid : rig_.solids) {
            const rig::Muscle& muscle = muscle_of(solid);
            if (ring && (muscle.id == kUpperRing || muscle.id == kLowerRing)) continue;
            const auto lay_one = [&](Side side, const std::vector<MusclePath>& paths) {
                solid.mesh ? lay_mesh(solid, muscle, side, paths) : lay(solid, muscle, side, paths);
            };
            lay_one(Side::kLeft, muscle.paths);
            if (!muscle.paired) continue;
            std::vector<MusclePath> right;
            for (const MusclePath& path : muscle.paths) right.push_back(rig::mirrored(path));
            lay_one(Side::kRight, right);
        }
        if (ring) lay_ring(*rig_.solid(kUpperRing), *rig_.solid(kLowerRing));
        return std::move(out_);
    }

  private:
    const rig::Muscle& muscle_of(const rig::SolidMuscle& solid) const {
        return *std::find_if(rig_.muscles.muscles.begin(), rig_.muscles.muscles.end(),
                             [&](const rig::Muscle& m) { return m.id == solid.muscle; });
    }

    SolidPart part(const rig::SolidMuscle& solid, const rig::Muscle& muscle, Side side,
                   const tissue::GridShape& grid) const {
        SolidPart part;
        part.muscle = &muscle;
        part.solid = &solid;
        part.side = side;
        part.column = channels_.column(muscle.id, side);
        part.f0_n = rig::solid_force_n(rig_, solid, muscle, head_.size);
        part.grid = grid;
        return part;
    }

    // A slab of nodes across `along`; rounded, u to the side and v outwards in [-1, 1].
    void add_slab(const Vec3& centre, const Vec3& along, const Vec3& outward, double half_width_m,
                  double half_thickness_m, const tissue::GridShape& grid, bool under_skin) {
        const Vec3 sideways = outward.cross(along).normalized();
        const Vec3 up = along.normalized().cross(sideways);
        for (int n = 0; n < grid.n; ++n)
            for (int o = 0; o < grid.o; ++o) {
                const double x = 2.0 * n / (grid.n - 1) - 1, y = 2.0 * o / (grid.o - 1) - 1;
                const double u = x * std::sqrt(1 - y * y / 2), v = y * std::sqrt(1 - x * x / 2);
                SolidNode node;
                node.rest = centre + half_width_m * u * sideways + half_thickness_m * v * up;
                node.outward = up;
                if (under_skin) keep_under_skin(node.rest);
                out_.nodes.push_back(node);
            }
    }

    void keep_under_skin(Vec3& p) const {
        const TissueLocator::Column column = locator_.column_at(p);
        const double depth = (column.skin - p).dot(column.outward);
        const double min = head_.size * kSkinCover_m;
        if (depth < min && (p - column.skin).norm() < head_.mm(6))
            p -= (min - depth) * column.outward;
    }

    struct Hold {
        bool bone = false;
        double jaw_fraction = 0;
    };
    Hold hold_of(const PathPoint& end, const std::string& group) const {
        if (end.attach == "bone" || end.body == PathPoint::Body::kMandible)
            return {true, end.body == PathPoint::Body::kMandible ? 1.0 : 0.0};
        // The pterygomandibular raphe spans both bones.
        if (end.attach == "raphe" && group == "mimetic" && !end.on_skin()) return {true, 0.5};
        return {};
    }

    // Marks what the nodes of an end slab are attached to.
    void tie(SolidNode& node, const Hold& hold) const {
        node.on_bone = hold.bone;
        node.soft_end = !hold.bone;
        if (hold.bone) node.jaw_fraction = hold.jaw_fraction;
    }

    void lay(const rig::SolidMuscle& solid, const rig::Muscle& muscle, Side side,
             const std::vector<MusclePath>& paths) {
        std::vector<Course> courses;
        double length = 0;
        for (const MusclePath& path : paths) {
            courses.push_back(course_of(head_, path, muscle.id, locator_));
            length += length_of(courses.back()) / static_cast<double>(paths.size());
        }
        const std::array<int, 3> cells = cells_of(solid, length, head_.size);
        const tissue::GridShape grid{cells[0] + 1, cells[1] + 1, cells[2] + 1};
        std::vector<double> fractions;
        for (int m = 0; m < grid.m; ++m) fractions.push_back(m / static_cast<double>(grid.m - 1));
        std::vector<Course> along;
        for (const Course& course : courses) along.push_back(sampled(course, fractions));
        // Paths of a sheet in the order of the n axis
        std::vector<std::size_t> order(paths.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        if (paths.size() > 1) {
            const Course& middle = along[paths.size() / 2];
            const Vec3 sideways =
                middle.outward.front().cross(middle.point[1] - middle.point[0]).normalized();
            std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
                return along[a].point.front().dot(sideways) < along[b].point.front().dot(sideways);
            });
        }

        const int first = static_cast<int>(out_.nodes.size());
        const bool jaw_muscle = muscle.group == "jaw";
        for (int m = 0; m < grid.m; ++m) {
            const std::size_t i = static_cast<std::size_t>(m);
            const double wide = 0.5 * head_.size * solid.width_m * taper(fractions[i], solid.ends);
            const double thick = 0.5 * head_.size * solid.thickness_m *
                                 taper(fractions[i], {kEndThickness, kEndThickness});
            const std::size_t before = i == 0 ? 0 : i - 1,
                              after = std::min(i + 1, fractions.size() - 1);
            if (paths.size() == 1) {
                add_slab(along[0].point[i], along[0].point[after] - along[0].point[before],
                         along[0].outward[i], wide, thick, grid, !jaw_muscle);
            } else {
                add_sheet_slab(along, order, i, before, after, wide, thick, grid);
            }
            for (int k = 0; k < grid.n * grid.o; ++k) {
                SolidNode& node = out_.nodes[out_.nodes.size() - 1 - static_cast<std::size_t>(k)];
                const int n = grid.n - 1 - k / grid.o, o = grid.o - 1 - k % grid.o;
                const MusclePath& path = paths[order[static_cast<std::size_t>(
                    std::lround((paths.size() - 1.0) * n / std::max(1, grid.n - 1)))]];
                const Hold from = hold_of(path.front(), muscle.group),
                           to = hold_of(path.back(), muscle.group);
                const double soft = jaw_.weight(node.rest);
                node.jaw_fraction = (1 - fractions[i]) * (from.bone ? from.jaw_fraction : soft) +
                                    fractions[i] * (to.bone ? to.jaw_fraction : soft);
                if (m == 0) tie(node, from);
                if (m == grid.m - 1) tie(node, to);
                node.against_bone = jaw_muscle && o == 0 && !node.on_bone;
            }
        }
        SolidPart made = part(solid, muscle, side, grid);
        for (int k = 0; k < grid.size(); ++k) made.node.push_back(first + k);
        out_.parts.push_back(std::move(made));
    }

    void lay_mesh(const rig::SolidMuscle& solid, const rig::Muscle& muscle, Side side,
                  const std::vector<MusclePath>& paths) {
        std::vector<std::vector<Vec3>> courses;
        for (const MusclePath& path : paths)
            courses.push_back(course_of(head_, path, muscle.id, locator_).point);
        PlacedMesh mesh =
            place_mesh(head_, *solid.mesh, side, courses, "anatomy/solids/" + muscle.id + "/mesh");
        const Hold from = hold_of(paths.front().front(), muscle.group),
                   to = hold_of(paths.front().back(), muscle.group);
        SolidPart made = part(solid, muscle, side, {});
        for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            SolidNode node;
            node.rest = mesh.nodes.row(i).transpose();
            node.outward = locator_.column_at(node.rest).outward;
            const double soft = jaw_.weight(node.rest), t = mesh.along[k];
            node.jaw_fraction = (1 - t) * (from.bone ? from.jaw_fraction : soft) +
                                t * (to.bone ? to.jaw_fraction : soft);
            if (mesh.end[k] == PlacedMesh::End::kOrigin) tie(node, from);
            if (mesh.end[k] == PlacedMesh::End::kInsertion) tie(node, to);
            node.against_bone = muscle.group == "jaw" && !node.on_bone &&
                                mesh.normals.row(i).dot(node.outward.transpose()) < -0.5;
            made.node.push_back(static_cast<int>(out_.nodes.size()));
            out_.nodes.push_back(node);
        }
        made.tets = std::move(mesh.tets);
        made.fibres = std::move(mesh.fibres);
        made.density = std::move(mesh.density);
        made.along = std::move(mesh.along);
        made.length_m = mesh.length_m;
        out_.parts.push_back(std::move(made));
    }

    // Interpolates between the paths of a sheet and extends it by half the distance of two paths at its borders.
    void add_sheet_slab(const std::vector<Course>& along, const std::vector<std::size_t>& order,
                        std::size_t i, std::size_t before, std::size_t after, double half_width_m,
                        double half_thickness_m, const tissue::GridShape& grid) {
        const auto at = [&](double place, const auto& of) -> Vec3 {
            const double clamped = std::clamp(place, 0.0, static_cast<double>(order.size() - 1));
            const std::size_t low = std::min(static_cast<std::size_t>(clamped), order.size() - 2);
            const double t = clamped - static_cast<double>(low);
            return (1 - t) * of(along[order[low]]) + t * of(along[order[low + 1]]);
        };
        const auto point = [&](std::size_t k) {
            return [k](const Course& c) -> Vec3 { return c.point[k]; };
        };
        const double paths = static_cast<double>(order.size() - 1);
        const Vec3 low = at(0, point(i)), high = at(paths, point(i));
        // Where paths meet, as at the corner of the mouth, the sheet keeps a third of its width
        const Vec3 out = at(0.5 * paths, [i](const Course& c) -> Vec3 { return c.outward[i]; });
        const Vec3 forward = at(0.5 * paths, point(after)) - at(0.5 * paths, point(before));
        const Vec3 sideways = out.cross(forward).normalized();
        const double spread = std::max((high - low).dot(sideways), 1e-6);
        const double min = 2 * half_width_m / 3;
        for (int n = 0; n < grid.n; ++n) {
            const double x = 2.0 * n / (grid.n - 1) - 1;
            const Vec3 on_paths = at(0.5 * (x + 1) * paths, point(i));
            const Vec3 centre = on_paths + 0.5 * x * std::max(0.0, min - spread) * sideways;
            const Vec3 up = forward.normalized().cross(sideways);
            for (int o = 0; o < grid.o; ++o) {
                const double y = 2.0 * o / (grid.o - 1) - 1;
                SolidNode node;
                node.rest = centre + half_thickness_m * y * std::sqrt(1 - x * x / 2) * up;
                node.outward = up;
                keep_under_skin(node.rest);
                out_.nodes.push_back(node);
            }
        }
    }

    // The upper half runs from left to right, the lower half back; slab M - 1 of each is slab 0 of the other.
    void lay_ring(const rig::SolidMuscle& upper, const rig::SolidMuscle& lower) {
        const rig::Muscle& above = muscle_of(upper);
        const rig::Muscle& below = muscle_of(lower);
        const Course up = course_of(head_, above.paths.front(), above.id, locator_);
        const Course down = course_of(head_, below.paths.front(), below.id, locator_);
        Course ring = up;
        for (std::size_t k = down.point.size() - 1; k-- > 1;) {
            ring.point.push_back(down.point[k]);
            ring.outward.push_back(down.outward[k]);
        }
        const double half_length = 0.5 * (length_of(up) + length_of(down));
        const std::array<int, 3> cells = cells_of(upper, half_length, head_.size);
        const tissue::GridShape grid{cells[0] + 1, cells[1] + 1, cells[2] + 1};
        const int slabs = 2 * cells[0];
        const double upper_fraction = length_of(up) / (2 * half_length);
        std::vector<double> fractions;
        for (int m = 0; m <= slabs; ++m)
            fractions.push_back(m <= cells[0] ? upper_fraction * m / cells[0]
                                              : upper_fraction + (1 - upper_fraction) *
                                                                     (m - cells[0]) / cells[0]);
        const Course along = sampled(ring, fractions, /*closed=*/true);
        const int first = static_cast<int>(out_.nodes.size());
        for (int m = 0; m < slabs; ++m) {
            const std::size_t before = static_cast<std::size_t>((m + slabs - 1) % slabs),
                              i = static_cast<std::size_t>(m), after = i + 1;
            const rig::SolidMuscle& solid = m < cells[0] ? upper : lower;
            // Both halves meet in the corners at a sharp angle, where there is less room
            const double from_corner = std::min(
                along.arc[i] - (m < cells[0] ? 0.0 : along.arc[static_cast<std::size_t>(cells[0])]),
                (m < cells[0] ? along.arc[static_cast<std::size_t>(cells[0])] : along.arc.back()) -
                    along.arc[i]);
            add_slab(along.point[i], along.point[after] - along.point[before], along.outward[i],
                     std::min(0.5 * head_.size * solid.width_m,
                              head_.size * kCornerHalfWidth_m + kCornerOpening * from_corner),
                     0.5 * head_.size * solid.thickness_m, grid, /*under_skin=*/true);
            for (int k = 0; k < grid.n * grid.o; ++k) {
                SolidNode& node = out_.nodes[out_.nodes.size() - 1 - static_cast<std::size_t>(k)];
                node.soft_end = m % cells[0] == 0;
                node.jaw_fraction = jaw_.weight(node.rest);
            }
        }
        for (int half = 0; half < 2; ++half) {
            SolidPart made =
                part(half == 0 ? upper : lower, half == 0 ? above : below, Side::kLeft, grid);
            for (int m = 0; m < grid.m; ++m)
                for (int k = 0; k < grid.n * grid.o; ++k)
                    made.node.push_back(first + (half * cells[0] + m) % slabs * grid.n * grid.o +
                                        k);
            out_.parts.push_back(std::move(made));
        }
    }

    const rig::Head& head_;
    const rig::RigDescription& rig_;
    const Jaw& jaw_;
    const TissueLocator& locator_;
    track::ChannelTable channels_;
    SolidPlacement out_;
};

}  // namespace

SolidPlacement place_solids(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
                            const TissueLocator& locator) {
    return Placer(head, rig, jaw, locator).place();
}

}  // namespace risorius::face
