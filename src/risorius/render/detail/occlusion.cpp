// SPDX-License-Identifier: MIT
#include "risorius/render/detail/occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr int kSide = 512;
constexpr int kSkyDirections = 48;
constexpr double kLift_m = 0.0012;  ///< offset from the surface, against self-shadowing
constexpr double kBias_m = 0.0010;
constexpr double kNoise_m = 0.003;  ///< distance below which texels of the depth maps show as noise

}  // namespace

std::vector<float> sky_seen(const Points& positions, const std::vector<float>& normals,
                            const std::vector<Batch>& batches, const Vec3& centre,
                            double radius_m) {
    const auto vertices = static_cast<std::size_t>(positions.rows());
    std::vector<float> seen(vertices, 0.0F), weight(vertices, 0.0F);

    GLuint depth = 0, framebuffer = 0;
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, kSide, kSide);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    glViewport(0, 0, kSide, kSide);
    glEnable(GL_DEPTH_TEST);
    const GlProgram program("occlusion", depth_vertex_shader(), "");
    program.use();
    std::vector<float> image(static_cast<std::size_t>(kSide) * kSide);

    for (int i = 0; i < kSkyDirections; ++i) {
        // Fibonacci sphere
        const double y = 1 - 2 * (i + 0.5) / kSkyDirections;
        const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
        const double level = std::sqrt(1 - y * y);
        const Vec3 towards(level * std::cos(turn), y, level * std::sin(turn));
        const Vec3 across =
            towards.cross(std::abs(y) < 0.9 ? Vec3::UnitY() : Vec3::UnitX()).normalized();
        const Vec3 up = across.cross(towards);
        Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();
        clip.block<1, 3>(0, 0) = across.transpose() / radius_m;
        clip.block<1, 3>(1, 0) = up.transpose() / radius_m;
        clip.block<1, 3>(2, 0) = -towards.transpose() / (2 * radius_m);
        clip.block<3, 1>(0, 3) = -clip.block<3, 3>(0, 0) * centre;
        const Eigen::Matrix4f clip_f = clip.cast<float>();
        glUniformMatrix4fv(program.location("clip_from_world"), 1, GL_FALSE, clip_f.data());
        glClear(GL_DEPTH_BUFFER_BIT);
        for (const Batch& batch : batches)
            if (batch.material != Material::kLashes)
                glDrawElements(GL_TRIANGLES, batch.index_count, GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(
                                   static_cast<std::size_t>(batch.first_index) * sizeof(unsigned)));
        glReadPixels(0, 0, kSide, kSide, GL_DEPTH_COMPONENT, GL_FLOAT, image.data());

        const double bias = kBias_m / (4 * radius_m);
        for (std::size_t v = 0; v < vertices; ++v) {
            const Vec3 normal(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]);
            const double cosine = normal.dot(towards);
            if (cosine <= 0) continue;
            const Vec3 p =
                positions.row(static_cast<Eigen::Index>(v)).transpose() + kLift_m * normal;
            const Vec3 c = clip.block<3, 3>(0, 0) * p + clip.block<3, 1>(0, 3);
            const int px = static_cast<int>((c.x() * 0.5 + 0.5) * kSide);
            const int py = static_cast<int>((c.y() * 0.5 + 0.5) * kSide);
            const bool inside = px >= 0 && px < kSide && py >= 0 && py < kSide;
            const float blocker =
                inside ? image[static_cast<std::size_t>(py) * kSide + static_cast<std::size_t>(px)]
                       : 1.0F;
            weight[v] += static_cast<float>(cosine);
            if (c.z() * 0.5 + 0.5 - bias <= blocker) seen[v] += static_cast<float>(cosine);
        }
    }
    for (std::size_t v = 0; v < vertices; ++v) seen[v] = weight[v] > 0 ? seen[v] / weight[v] : 1.0F;

    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &depth);
    return seen;
}

std::vector<float> with_neighbours(std::vector<float> seen, const Points& positions,
                                   const std::vector<float>& normals,
                                   const std::vector<unsigned>& corners, int passes) {
    // The two sides of a thin edge are not mixed.
    const auto shared = [&](unsigned a, unsigned b) {
        const std::size_t i = 3 * static_cast<std::size_t>(a), j = 3 * static_cast<std::size_t>(b);
        const double along = normals[i] * normals[j] + normals[i + 1] * normals[j + 1] +
                             normals[i + 2] * normals[j + 2];
        const double apart = (positions.row(a) - positions.row(b)).squaredNorm();
        return std::pow(std::max(along, 0.0), 3) * std::exp(-apart / (kNoise_m * kNoise_m));
    };
    std::vector<float> weight(2 * corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t first = i - i % 3;
        for (std::size_t k = 1; k < 3; ++k)
            weight[2 * i + k - 1] =
                static_cast<float>(shared(corners[i], corners[first + (i + k) % 3]));
    }
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<float> sum(seen.size(), 0.0F), count(seen.size(), 0.0F);
        for (std::size_t i = 0; i < corners.size(); ++i)
            for (std::size_t k = 1; k < 3; ++k) {
                const unsigned a = corners[i], b = corners[i - i % 3 + (i + k) % 3];
                sum[a] += weight[2 * i + k - 1] * (seen[b] - seen[a]);
                ++count[a];
            }
        for (std::size_t v = 0; v < seen.size(); ++v)
            if (count[v] > 0) seen[v] += 0.5F * sum[v] / count[v];
    }
    return seen;
}

SkyAboutEyes::SkyAboutEyes(const Scene& scene, std::vector<float> at_rest,
                           const std::vector<float>& shut)
    : at_rest_(std::move(at_rest)), seen_(at_rest_) {
    constexpr double kWithin = 2.2, kUpTo = 3.0;  // radii of the eye
    for (std::size_t v = 0; v < shut.size(); ++v)
        for (int eye = 0; eye < 2; ++eye) {
            const Eye& at = scene.eyes[static_cast<std::size_t>(eye)];
            if (at.radius_m <= 0) continue;
            const Vec3 off = scene.rest.row(static_cast<Eigen::Index>(v)).transpose() - at.centre;
            const double t =
                std::clamp((kUpTo - off.norm() / at.radius_m) / (kUpTo - kWithin), 0.0, 1.0);
            // Where the zones of both eyes overlap, each has its own entry.
            if (t > 0)
                near_.push_back(
                    {static_cast<int>(v), eye, static_cast<float>(t) * (shut[v] - at_rest_[v])});
        }
}

const std::vector<float>& SkyAboutEyes::seen(const std::array<double, 2>& closed) {
    for (const Near& at : near_)
        seen_[static_cast<std::size_t>(at.vertex)] = at_rest_[static_cast<std::size_t>(at.vertex)];
    for (const Near& at : near_)
        seen_[static_cast<std::size_t>(at.vertex)] +=
            static_cast<float>(closed[static_cast<std::size_t>(at.eye)]) * at.change;
    return seen_;
}

}  // namespace risorius::render
