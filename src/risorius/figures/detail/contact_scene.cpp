// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/contact_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "risorius/contact/distance_field.h"
#include "risorius/contact/surface_samples.h"
#include "risorius/geom/surface_topology.h"
#include "risorius/softbody/action_description.h"
#include "risorius/solve/part_term.h"

namespace risorius::figures {
namespace {

constexpr int kAround = 48;  // corners of a drawn circle

struct DrawnSurface {
    Points positions;
    Triangles triangles;
};

/// Triangulates rows of `around` points each between neighbouring rows, and between the last and the first row when `closed`.
DrawnSurface joined_rows(int rows, int around, bool closed, const auto& point) {
    DrawnSurface surface;
    surface.positions.resize(rows * around, 3);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < around; ++j)
            surface.positions.row(i * around + j) = point(i, j).transpose();
    const int bands = closed ? rows : rows - 1;
    surface.triangles.resize(2 * bands * around, 3);
    for (int i = 0; i < bands; ++i)
        for (int j = 0; j < around; ++j) {
            const int below = i * around, above = (i + 1) % rows * around;
            const int a = below + j, b = below + (j + 1) % around;
            const int c = above + (j + 1) % around, d = above + j;
            surface.triangles.row(2 * (i * around + j)) << a, b, c;
            surface.triangles.row(2 * (i * around + j) + 1) << a, c, d;
        }
    return surface;
}

/// A capsule around the segment from `start` to `end`; equal points give a sphere.
DrawnSurface drawn_capsule(const Vec3& start, const Vec3& end, double radius) {
    const Vec3 way = end - start;
    const Vec3 axis = way.norm() > 0 ? Vec3(way.normalized()) : Vec3(Vec3::UnitZ());
    const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
    return joined_rows(kAround / 2 + 2, kAround, false, [&](int i, int j) -> Vec3 {
        const bool upper = i > kAround / 4;  // the equator exists twice, at both ends
        const double polar = std::numbers::pi * ((upper ? i - 1 : i) * 2.0 / kAround - 0.5);
        const double turn = 2 * std::numbers::pi * j / kAround;
        return (upper ? end : start) +
               radius * (std::sin(polar) * axis +
                         std::cos(polar) * (std::cos(turn) * u + std::sin(turn) * v));
    });
}

DrawnSurface torus(const Vec3& centre, double radius, double tube) {
    return joined_rows(kAround, kAround, true, [&](int i, int j) -> Vec3 {
        const double turn = 2 * std::numbers::pi * i / kAround;
        const double round = 2 * std::numbers::pi * j / kAround;
        const double r = radius + tube * std::cos(round);
        return centre + Vec3(r * std::sin(turn), r * std::cos(turn), tube * std::sin(round));
    });
}

/// A square of the plane below the points.
DrawnSurface drawn_plane(const Vec3& point, const Vec3& normal, const Points& above) {
    constexpr double kReach = 1.3;  // ratio to the distance of the farthest point
    const Vec3 mean = above.colwise().mean().transpose();
    const Vec3 centre = mean - normal * normal.dot(mean - point);
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const double half = kReach * std::max(((above * u).array() - centre.dot(u)).abs().maxCoeff(),
                                          ((above * v).array() - centre.dot(v)).abs().maxCoeff());
    DrawnSurface surface;
    surface.positions.resize(4, 3);
    for (int k = 0; k < 4; ++k)
        surface.positions.row(k) =
            (centre + half * ((k == 1 || k == 2 ? 1.0 : -1.0) * u + (k < 2 ? -1.0 : 1.0) * v))
                .transpose();
    surface.triangles.resize(2, 3);
    surface.triangles << 0, 1, 2, 0, 2, 3;
    return surface;
}

std::vector<SceneObstacle> read_scene_obstacles(const JsonCursor& json) {
    std::vector<SceneObstacle> obstacles;
    for (const JsonCursor& entry : json.items()) {
        SceneObstacle one;
        DrawnSurface drawn;
        if (const auto ring = entry.find("torus")) {
            entry.allow_keys({"torus"});
            ring->allow_keys({"centre_m", "radius_m", "tube_m"});
            const double radius = ring->at("radius_m").number();
            const double tube = ring->at("tube_m").number();
            if (!(radius > 0)) ring->at("radius_m").fail("a number in (0, inf)");
            if (!(tube > 0 && tube < radius))
                ring->at("tube_m").fail("a number in (0, " + format_number(radius) +
                                        "), less than radius_m");
            drawn = torus(ring->at("centre_m").vec3(), radius, tube);
            one.obstacle = std::make_shared<contact::Obstacle>(
                contact::make_mesh(drawn.positions, drawn.triangles, {.cells = 64}, ring->place()));
        } else {
            const softbody::ObstacleDescription read = softbody::read_obstacle(entry);
            one.obstacle = read.obstacle;
            if (const auto sphere = entry.find("sphere")) {
                const Vec3 centre = sphere->at("centre_m").vec3();
                drawn = drawn_capsule(centre, centre, sphere->at("radius_m").number());
            } else if (const auto capsule = entry.find("capsule")) {
                drawn = drawn_capsule(capsule->at("start_m").vec3(), capsule->at("end_m").vec3(),
                                      capsule->at("radius_m").number());
            } else if (const auto plane = entry.find("plane")) {
                one.is_plane = true;
                one.point_m = plane->at("point_m").vec3();
                one.normal = plane->at("normal").vec3().normalized();
            }
        }
        one.positions = drawn.positions;
        one.triangles = drawn.triangles;
        obstacles.push_back(std::move(one));
    }
    return obstacles;
}

}  // namespace

ContactSceneDescription read_contact_scene(const JsonCursor& json) {
    json.allow_keys(
        {"name", "caption", "duration_s", "parts_per_side", "bodies", "obstacles", "contact"});
    ContactSceneDescription scene;
    scene.name = json.at("name").string();
    scene.caption = json.at("caption").string();
    scene.duration_s = json.at("duration_s").number({1e-9, 1e6});
    if (const auto parts = json.find("parts_per_side"))
        scene.parts_per_side = parts->integer(1, 16);
    for (const JsonCursor& body : json.at("bodies").items())
        scene.bodies.push_back(softbody::read_body(body));
    if (scene.bodies.empty()) json.at("bodies").fail("at least one body");
    if (const auto obstacles = json.find("obstacles"))
        scene.obstacles = read_scene_obstacles(*obstacles);
    scene.contact = softbody::read_contact(json.at("contact"));
    return scene;
}

ContactScene::ContactScene(const ContactSceneDescription& description) {
    int count = 0;
    for (const softbody::BodyDescription& one : description.bodies) {
        bodies_.push_back(softbody::build_body(one));
        first_.push_back(count);
        count += bodies_.back().system.size();
        length_scale_m_ = std::max(length_scale_m_, bodies_.back().length_scale_m);
    }
    state_.x.resize(count, 3);
    state_.v.setZero(count, 3);
    mass_kg_.resize(count);
    std::vector<char> fixed;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const solve::MotionSystem& own = bodies_[i].system;
        state_.x.middleRows(first_[i], own.size()) = bodies_[i].rest;
        mass_kg_.segment(first_[i], own.size()) = own.mass_kg();
        fixed.insert(fixed.end(), own.fixed().begin(), own.fixed().end());
    }
    system_ = std::make_unique<solve::MotionSystem>(mass_kg_, fixed);
    std::vector<Triangles> surfaces;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        for (const auto& term : bodies_[i].system.terms())
            system_->add(
                std::make_shared<solve::PartTerm>(term, first_[i], bodies_[i].system.size()));
        surfaces.push_back(bodies_[i].surface.array() + first_[i]);
        for (const SceneObstacle& obstacle : description.obstacles)
            on_obstacles_.push_back(std::make_shared<contact::ObstacleContact>(
                contact::surface_samples(state_.x, surfaces[i], description.parts_per_side),
                obstacle.obstacle, description.contact));
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        for (std::size_t j = i + 1; j < bodies_.size(); ++j) {
            if (bodies_[i].kind != softbody::Kind::kSolid ||
                bodies_[j].kind != softbody::Kind::kSolid)
                continue;
            between_.push_back(std::make_shared<contact::SurfaceContact>(
                state_.x, surfaces[i], surfaces[j], description.contact,
                contact::SurfaceContactOptions{.per_side = description.parts_per_side}));
        }
    for (const auto& term : on_obstacles_) system_->add(term);
    for (const auto& term : between_) system_->add(term);
}

solve::IntegratorReport ContactScene::run(solve::IntegratorOptions integrator, double until_s,
                                          const RunOptions& options) {
    integrator.length_scale_m = length_scale_m_;
    const auto steps = solve::make_integrator(integrator);
    solve::IntegratorReport report;
    constexpr int kParts = 50;  // a run can be interrupted between these parts
    const double from = state_.t_s;
    for (int i = 1; i <= kParts && !report.diverged; ++i) {
        options.monitor.throw_if_stopped();
        report.add(steps->advance(*system_, state_, from + (until_s - from) * i / kParts));
    }
    return report;
}

Vec3 ContactScene::velocity(int body) const {
    const int first = first_[static_cast<std::size_t>(body)];
    const int count = bodies_[static_cast<std::size_t>(body)].system.size();
    const auto mass = mass_kg_.segment(first, count);
    return (mass.transpose() * state_.v.middleRows(first, count)).transpose() / mass.sum();
}

Vec3 ContactScene::support_n() const {
    Vec3 sum = Vec3::Zero();
    for (const auto& term : on_obstacles_) sum += term->total_force(state_.t_s, state_.x, state_.v);
    return sum;
}

Vec3 ContactScene::load_on_first_n() const {
    Points force = Points::Zero(state_.x.rows(), 3);
    for (const auto& term : between_) term->add_force(state_.t_s, state_.x, state_.v, force);
    return force.topRows(bodies_.front().system.size()).colwise().sum().transpose();
}

double ContactScene::min_gap_m() const {
    double min = kInfinity;
    for (const auto& term : on_obstacles_)
        min = std::min(min, term->min_gap_m(state_.t_s, state_.x));
    for (const auto& term : between_) min = std::min(min, term->min_gap_m(state_.x));
    return min;
}

Shape ContactScene::shape(const ContactSceneDescription& description) const {
    Shape shape{.name = description.name,
                .caption = description.caption,
                .positions = state_.x,
                .surface = {},
                .wires = {},
                .fixed = {}};
    const auto append_triangles = [&](const Triangles& triangles, int first) {
        Triangles all(shape.surface.rows() + triangles.rows(), 3);
        all << shape.surface, (triangles.array() + first).matrix();
        shape.surface = all;
    };
    // Bodies have the colours at the ends of the scale, rigid obstacles its pale middle.
    constexpr double kRigid = 0.5;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        append_triangles(bodies_[i].surface, first_[i]);
        for (const auto& [a, b] : bodies_[i].wires)
            shape.wires.push_back({a + first_[i], b + first_[i]});
        for (const int node : bodies_[i].fixed) shape.fixed.push_back(node + first_[i]);
        shape.shade.insert(shape.shade.end(), static_cast<std::size_t>(bodies_[i].system.size()),
                           i % 2 == 0 ? 1.0 : 0.0);
    }
    for (const SceneObstacle& obstacle : description.obstacles) {
        DrawnSurface drawn{obstacle.positions, obstacle.triangles};
        if (obstacle.is_plane) drawn = drawn_plane(obstacle.point_m, obstacle.normal, state_.x);
        // The obstacle is drawn smaller by the contact thickness, so that flat triangles that lie on it do not dip into it.
        drawn.positions -= description.contact.thickness_m *
                           geom::vertex_normals(drawn.positions, drawn.triangles);
        const int first = static_cast<int>(shape.positions.rows());
        Points all(first + drawn.positions.rows(), 3);
        all << shape.positions, drawn.positions;
        shape.positions = all;
        append_triangles(drawn.triangles, first);
        shape.shade.insert(shape.shade.end(), static_cast<std::size_t>(drawn.positions.rows()),
                           kRigid);
    }
    return shape;
}

}  // namespace risorius::figures
