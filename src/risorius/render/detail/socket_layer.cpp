// SPDX-License-Identifier: MIT
#include "risorius/render/detail/socket_layer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

/// From the rim to the pole behind the eye, and around the axis
constexpr unsigned kRings = 8, kAround = 24;
// The rim lies on the eyeball, so that it does not show from the side, a little in front of the corners of the eye. From there
// the bowl widens (radii as ratios to the eyeball) over the fraction kWidens of its rings.
constexpr double kBeforeCorners_m = 0.0035, kAtRim = 1.005, kWidest = 1.25, kWidens = 0.375;

std::vector<unsigned> bowls(const std::array<int, 2>& vertex) {
    std::vector<unsigned> indices;
    unsigned first = 0;
    for (const int v : vertex) {
        if (v < 0) continue;
        // Counter-clockwise from inside
        for (unsigned ring = 0; ring < kRings; ++ring)
            for (unsigned k = 0; k < kAround; ++k) {
                const unsigned next = (k + 1) % kAround, a = first + ring * kAround + k,
                               b = first + ring * kAround + next, c = a + kAround, d = b + kAround;
                indices.insert(indices.end(), {a, b, d, a, d, c});
            }
        first += (kRings + 1) * kAround;
    }
    return indices;
}

/// A vertex on each eyeball that exists and has lids; else -1.
std::array<int, 2> eye_vertices(const Scene& scene, const PosedMarks& marks) {
    std::array<int, 2> vertex{-1, -1};
    Pose rest;
    rest.positions = scene.rest;
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != Material::kEye || surface.triangles.rows() == 0) continue;
        const int eye = std::max(surface.eye, 0);
        const auto side = static_cast<std::size_t>(eye);
        if (scene.eyes[side].radius_m > 0 && marks.lids(rest, eye).known)
            vertex[side] = surface.triangles(0, 0);
    }
    return vertex;
}

}  // namespace

SocketLayer::SocketLayer(const Scene& scene, const PosedMarks& marks,
                         const ShaderConstants& constants)
    : SocketLayer(scene, eye_vertices(scene, marks), constants) {}

SocketLayer::SocketLayer(const Scene& scene, const std::array<int, 2>& vertex,
                         const ShaderConstants& constants)
    : vertex_(vertex),
      eyes_(scene.eyes),
      program_("sockets", constants.in(socket_vertex_shader()), constants.in(socket_shader())),
      triangles_(bowls(vertex), {3, 3, 1}) {  // position, normal, openness
    for (std::size_t eye = 0; eye < 2; ++eye)
        if (vertex_[eye] >= 0) rest_[eye] = scene.rest.row(vertex_[eye]).transpose();
}

void SocketLayer::upload(const Pose& pose, const PosedMarks& marks) {
    std::vector<float> vertices = triangles_.take();
    for (std::size_t eye = 0; eye < 2; ++eye) {
        if (vertex_[eye] < 0) continue;
        // The eyeball is rigid, so any vertex on it gives its centre.
        const Vec3 centre = pose.positions.row(vertex_[eye]).transpose() -
                            pose.eye_rotation[eye] * (rest_[eye] - eyes_[eye].centre);
        const LidMarks lids = marks.lids(pose, static_cast<int>(eye));
        const double ball = eyes_[eye].radius_m;
        const Vec3 across = (lids.outer - lids.inner).normalized();
        const Vec3 middle = (lids.inner + lids.outer) / 2 - centre;
        const Vec3 ahead = (middle - middle.dot(across) * across).normalized();
        const Vec3 up = ahead.cross(across);
        const double rim =
            std::acos(std::clamp((middle.dot(ahead) + kBeforeCorners_m) / ball, -0.5, 0.9));
        for (unsigned ring = 0; ring <= kRings; ++ring) {
            const double fraction = static_cast<double>(ring) / kRings;
            const double angle = rim + fraction * (std::numbers::pi - rim);
            const double radius =
                ball * (kAtRim + (kWidest - kAtRim) * std::min(fraction / kWidens, 1.0));
            for (unsigned k = 0; k < kAround; ++k) {
                const double turn = 2 * std::numbers::pi * k / kAround;
                const Vec3 out = std::cos(angle) * ahead +
                                 std::sin(angle) * (std::cos(turn) * across + std::sin(turn) * up);
                const Vec3 p = centre + radius * out;
                for (int i = 0; i < 3; ++i) vertices.push_back(static_cast<float>(p[i]));
                for (int i = 0; i < 3; ++i) vertices.push_back(static_cast<float>(-out[i]));
                vertices.push_back(static_cast<float>((1 - fraction) * (1 - fraction)));
            }
        }
    }
    triangles_.upload(std::move(vertices));
}

void SocketLayer::draw() const {
    program_.use();
    glBlendFuncSeparate(GL_ONE, GL_ZERO, GL_ONE, GL_ZERO);
    glEnable(GL_CULL_FACE);  // the outside is never visible
    triangles_.draw();
    glDisable(GL_CULL_FACE);
}

}  // namespace risorius::render
