// SPDX-License-Identifier: MIT
#include "risorius/render/detail/strand_layer.h"

#include <algorithm>

#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

constexpr double kTip = 0.25;  ///< width at the tip, fraction of that at the root

constexpr double kBend = 0.5;  ///< largest deviation of a simplified hair, in samples

// Step from one drawn point of a hair to the next: two, if leaving out the points between hardly straightens the hair.
std::size_t stride_of(const Strand& strand, double sample_m) {
    for (std::size_t i = 1; i + 1 < kStrandPoints; i += 2) {
        const Vec3 &before = strand.offset[i - 1], &after = strand.offset[i + 1];
        if ((strand.offset[i] - 0.5 * (before + after)).norm() > kBend * sample_m) return 1;
    }
    return 2;
}

std::vector<unsigned> strand_ribbons(const std::vector<Strand>& strands, double sample_m) {
    std::vector<unsigned> indices;
    unsigned a = 0;
    for (const Strand& strand : strands) {
        const std::size_t stride = stride_of(strand, sample_m);
        for (std::size_t i = stride; i < kStrandPoints; i += stride, a += 2)
            indices.insert(indices.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
        a += 2;
    }
    return indices;
}

std::string with_tone(const Scene& scene, ShaderConstants constants) {
    constants.set("hair_tone", linear_from_srgb(hair_tone_at(scene.appearance)));
    return constants.in(strand_vertex_shader());
}

}  // namespace

StrandLayer::StrandLayer(const Scene& scene, std::vector<Strand> strands, const Camera& camera,
                         double sample_m, ShaderConstants constants)
    : strands_(std::move(strands)),
      eyes_(scene.eyes),
      camera_(camera.eye_point()),
      sample_m_(sample_m),
      program_("strand", with_tone(scene, std::move(constants)), strand_shader()),
      triangles_(strand_ribbons(strands_, sample_m),
                 {3, 3, 2}) {  // position, direction, opacity and shade
    for (const Surface& surface : scene.surfaces)
        if (surface.material == Material::kEye && surface.triangles.rows() > 0) {
            const auto eye = static_cast<std::size_t>(std::max(surface.eye, 0));
            eye_vertex_[eye] = surface.triangles(0, 0);
            eye_point_[eye] = scene.rest.row(eye_vertex_[eye]).transpose();
        }
}

void StrandLayer::upload(const Pose& pose, const PosedMarks& marks) {
    std::vector<float> vertices = triangles_.take();
    const std::array<LidMarks, 2> lids{marks.lids(pose, 0), marks.lids(pose, 1)};
    // An eye rotates about its centre, so one of its vertices gives the position of the centre.
    std::array<Vec3, 2> centre;
    for (std::size_t eye = 0; eye < 2; ++eye) {
        centre[eye] = eyes_[eye].centre;
        if (eye_vertex_[eye] >= 0)
            centre[eye] = pose.positions.row(eye_vertex_[eye]).transpose() -
                          pose.eye_rotation[eye] * (eye_point_[eye] - eyes_[eye].centre);
    }
    for (const Strand& strand : strands_) {
        const Vec3 root = strand.root.on(pose.positions);
        Mat3 frame;
        if (strand.eye < 0) {
            frame = skin_frame(strand.root, pose.positions);
        } else {
            const auto eye = static_cast<std::size_t>(strand.eye);
            frame = lid_frame(strand.eye, root, centre[eye], lids[eye].inner, lids[eye].outer);
        }
        std::array<Vec3, kStrandPoints> p;
        for (std::size_t i = 0; i < kStrandPoints; ++i) p[i] = root + frame * strand.offset[i];
        for (std::size_t i = 0; i < kStrandPoints; i += stride_of(strand, sample_m_)) {
            const Vec3 along =
                (p[std::min(i + 1, kStrandPoints - 1)] - p[i > 0 ? i - 1 : 0]).normalized();
            const Vec3 side = along.cross(camera_ - p[i]).normalized();
            const double u = static_cast<double>(i) / (kStrandPoints - 1);
            const double width = strand.width_m * (1 - (1 - kTip) * u * u);
            // A hair is at least one and a half samples wide, since the rasteriser misses thinner ones; it is paler instead.
            const double drawn = std::max(width, 1.5 * sample_m_);
            const auto opacity = static_cast<float>(width / drawn);
            for (const double half : {-0.5, 0.5}) {
                const Vec3 q = p[i] + half * drawn * side;
                for (int k = 0; k < 3; ++k) vertices.push_back(static_cast<float>(q[k]));
                for (int k = 0; k < 3; ++k) vertices.push_back(static_cast<float>(along[k]));
                vertices.push_back(opacity);
                vertices.push_back(static_cast<float>(strand.shade));
            }
        }
    }
    triangles_.upload(std::move(vertices));
}

void StrandLayer::draw() const {
    program_.use();
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    triangles_.draw();
}

}  // namespace risorius::render
