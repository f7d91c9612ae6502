// SPDX-License-Identifier: MIT
#include "risorius/render/detail/object_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "risorius/core/error.h"
#include "risorius/render/detail/crease_normals.h"

namespace risorius::render {
namespace {

// Linear light
const Vec3 kBlue(0.22, 0.46, 0.86), kPale(0.80, 0.82, 0.78), kOrange(0.90, 0.36, 0.06);
const Vec3 kWire(0.012, 0.028, 0.075), kWireFarAway(0.36, 0.43, 0.52);
const Vec3 kInnerWire(0.10, 0.16, 0.28), kInnerWireFarAway(0.55, 0.60, 0.66);
const Vec3 kOutline(0.48, 0.50, 0.53);
const Vec3 kHeld(0.62, 0.075, 0.02);

constexpr double kWire_px = 2.0;
constexpr double kInnerWireFraction = 0.55;  ///< fraction of the width of a wire on the surface
constexpr double kCurve_px = 4.5;            ///< width of lines where there is no surface
constexpr double kOutline_px = 1.4;
/// Ratio to the cell; keeps the wires of fine grids apart
constexpr double kWidestWirePerCell = 0.1;
constexpr double kBallPerCell = 0.13;  ///< radius, ratio to the cell
constexpr double kMinBall_px = 3.5, kMaxBall_px = 9.0;
constexpr double kNearerPerCell = 0.5;  ///< ratio to the cell by which wires are moved nearer

struct PartByDepth {
    double depth;  ///< from the camera, m
    std::size_t begin, end;
};

class Parts {
  public:
    Parts(const Object& object, const ObjectRow& row, const ObjectCamera& camera)
        : object_(object), row_(row), camera_(camera) {
        double length = 0;
        for (const auto& [a, b] : object.wires) length += (at(a) - at(b)).norm();
        cell_ = object.wires.empty() ? 0.1 * row.reach_m
                                     : length / static_cast<double>(object.wires.size());
    }

    std::vector<PartVertex> in_order() {
        add_surface();
        add_outline();
        add_wires();
        add_balls();
        // Parts of equal depth keep their order.
        std::stable_sort(
            parts_.begin(), parts_.end(),
            [](const PartByDepth& a, const PartByDepth& b) { return a.depth > b.depth; });
        std::vector<PartVertex> ordered;
        ordered.reserve(vertices_.size());
        for (const PartByDepth& part : parts_)
            ordered.insert(ordered.end(),
                           vertices_.begin() + static_cast<std::ptrdiff_t>(part.begin),
                           vertices_.begin() + static_cast<std::ptrdiff_t>(part.end));
        return ordered;
    }

  private:
    Vec3 at(int v) const { return object_.positions.row(v).transpose(); }
    double depth(const Vec3& p) const { return (camera_.position - p).norm(); }

    void push(const Vec3& p, const Vec3& normal, const Vec3& colour, PartKind kind,
              const Vec2& place = Vec2::Zero()) {
        PartVertex vertex;
        for (int k = 0; k < 3; ++k) {
            vertex.position[k] = static_cast<float>(p[k]);
            vertex.normal[k] = static_cast<float>(normal[k]);
            vertex.colour[k] = static_cast<float>(colour[k]);
        }
        vertex.place[0] = static_cast<float>(place.x());
        vertex.place[1] = static_cast<float>(place.y());
        vertex.kind = static_cast<float>(kind);
        vertices_.push_back(vertex);
    }

    void end_part(double depth_m) {
        const std::size_t begin = parts_.empty() ? 0 : parts_.back().end;
        parts_.push_back({depth_m, begin, vertices_.size()});
    }

    Vec3 surface_colour(int v) const {
        if (object_.shade.empty()) return kBlue;
        const double s = std::clamp(object_.shade[static_cast<std::size_t>(v)], 0.0, 1.0);
        return s < 0.5 ? Vec3(kBlue + 2 * s * (kPale - kBlue))
                       : Vec3(kPale + (2 * s - 1) * (kOrange - kPale));
    }

    void add_surface() {
        const std::vector<Vec3> normals = crease_normals(object_.positions, object_.surface);
        for (Eigen::Index f = 0; f < object_.surface.rows(); ++f) {
            Vec3 middle = Vec3::Zero();
            for (int k = 0; k < 3; ++k) {
                const int v = object_.surface(f, k);
                const Vec3& n = normals[static_cast<std::size_t>(3 * f + k)];
                middle += at(v) / 3;
                push(at(v),
                     Vec3(n.dot(row_.axes.right), n.dot(row_.axes.up), n.dot(row_.axes.backward)),
                     surface_colour(v), PartKind::kSurface);
            }
            end_part(depth(middle));
        }
    }

    /// Pairs of vertices along the edges of triangles, smaller index first, sorted.
    std::vector<std::pair<int, int>> surface_edges() const {
        std::vector<std::pair<int, int>> edges;
        for (Eigen::Index f = 0; f < object_.surface.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const auto [a, b] =
                    std::minmax({object_.surface(f, k), object_.surface(f, (k + 1) % 3)});
                edges.emplace_back(a, b);
            }
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        return edges;
    }

    /// The colour of a wire, paler with distance, over the depth of the largest object.
    Vec3 paled(const Vec3& p, const Vec3& near, const Vec3& far) const {
        const double t = (depth(p) - row_.distance_m) / (2 * row_.reach_m) + 0.5;
        return near + std::clamp(t, 0.0, 1.0) * (far - near);
    }

    void add_wires() {
        const std::vector<std::pair<int, int>> edges = surface_edges();
        const double width = edges.empty()
                                 ? kCurve_px * row_.pixel_m
                                 : std::min(kWire_px * row_.pixel_m, kWidestWirePerCell * cell_);
        for (const auto& [i, j] : object_.wires) {
            const bool outside = std::binary_search(edges.begin(), edges.end(),
                                                    std::pair(std::min(i, j), std::max(i, j)));
            // Without a surface there is no inside.
            const bool strong = outside || edges.empty();
            const double half = width / 2 * (strong ? 1 : kInnerWireFraction);
            const auto& near = strong ? kWire : kInnerWire;
            const auto& far = strong ? kWireFarAway : kInnerWireFarAway;
            add_line(at(i), at(j), half, paled(at(i), near, far), paled(at(j), near, far),
                     kNearerPerCell * cell_);
        }
    }

    void add_outline() {
        for (Eigen::Index s = 0; s + 1 < object_.outline.rows(); s += 2)
            add_line(object_.outline.row(s).transpose(), object_.outline.row(s + 1).transpose(),
                     kOutline_px / 2 * row_.pixel_m, kOutline, kOutline, 0);
    }

    void add_line(Vec3 a, Vec3 b, double half, const Vec3& at_a, const Vec3& at_b, double nearer) {
        const Vec3 middle = (a + b) / 2;
        const Vec3 along = (b - a).normalized();
        Vec3 across = along.cross(camera_.position - middle);
        if (across.norm() < 1e-9 * row_.distance_m) return;  // seen end on, or without length
        across *= half / across.norm();
        // Lengthened a little, so that lines meet in a filled corner.
        a -= half * along;
        b += half * along;
        for (const auto& [p, colour] :
             {std::pair(Vec3(a - across), at_a), std::pair(Vec3(b - across), at_b),
              std::pair(Vec3(b + across), at_b), std::pair(Vec3(a - across), at_a),
              std::pair(Vec3(b + across), at_b), std::pair(Vec3(a + across), at_a)})
            push(p, Vec3::Zero(), colour, PartKind::kWire);
        end_part(depth(middle) - nearer);
    }

    void add_balls() {
        const double radius = object_.surface.rows() == 0
                                  ? kMaxBall_px * row_.pixel_m
                                  : std::clamp(kBallPerCell * cell_, kMinBall_px * row_.pixel_m,
                                               kMaxBall_px * row_.pixel_m);
        for (const int v : object_.fixed) {
            for (const Vec2& place :
                 {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, -1), Vec2(1, 1), Vec2(-1, 1)})
                push(at(v) + radius * (place.x() * row_.axes.right + place.y() * row_.axes.up),
                     Vec3::Zero(), kHeld, PartKind::kBall, place);
            // The ball is drawn before the wires that end in it, including the one towards the camera.
            end_part(depth(at(v)) - 2 * kNearerPerCell * cell_ - radius);
        }
    }

    const Object& object_;
    const ObjectRow& row_;
    const ObjectCamera& camera_;
    double cell_;  ///< mean length of a wire
    std::vector<PartVertex> vertices_;
    std::vector<PartByDepth> parts_;
};

void check_index(int v, Eigen::Index vertices, const std::string& place) {
    if (v < 0 || v >= vertices)
        throw Error(place, "vertices 0.." + std::to_string(vertices - 1), std::to_string(v));
}

}  // namespace

void check_object(const Object& object, const std::string& place) {
    const Eigen::Index vertices = object.positions.rows();
    if (vertices == 0) throw Error(place + "/positions", "at least one vertex", "none");
    for (Eigen::Index v = 0; v < vertices; ++v)
        if (!object.positions.row(v).allFinite())
            throw Error(place + "/positions/" + std::to_string(v), "finite coordinates",
                        "one that is not");
    for (Eigen::Index i = 0; i < object.surface.size(); ++i)
        check_index(object.surface.data()[i], vertices, place + "/surface");
    for (const auto& wire : object.wires)
        for (const int v : wire) check_index(v, vertices, place + "/wires");
    for (const int v : object.fixed) check_index(v, vertices, place + "/fixed");
    if (!object.outline.allFinite())
        throw Error(place + "/outline", "finite coordinates", "one that is not");
    if (!object.shade.empty() && static_cast<Eigen::Index>(object.shade.size()) != vertices)
        throw Error(place + "/shade", std::to_string(vertices) + " values",
                    std::to_string(object.shade.size()));
}

std::vector<PartVertex> object_parts(const Object& object, const ObjectRow& row,
                                     const ObjectCamera& camera) {
    return Parts(object, row, camera).in_order();
}

}  // namespace risorius::render
