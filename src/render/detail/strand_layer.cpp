#include "render/detail/strand_layer.h"

#include <algorithm>

#include "render/detail/shaders.h"
#include "render/detail/skin_paint.h"

namespace risorius::render {
namespace {

constexpr std::size_t kFloats = 8;  ///< of a vertex: place, direction, opacity, shade
constexpr double kTip = 0.25;       ///< of the width at the root

}  // namespace

StrandLayer::StrandLayer(const Scene& scene, std::vector<Strand> strands, const Camera& camera,
                         double sample_m)
    : strands_(std::move(strands)),
      eyes_(scene.eyes),
      camera_(camera.eye_point()),
      sample_m_(sample_m),
      program_("strand", strand_vertex_shader(), strand_shader()) {
    program_.use();
    const Eigen::Vector3f tone = linear_from_srgb(hair_tone_at(scene.look)).cast<float>();
    glUniform3fv(program_.location("hair_tone"), 1, tone.data());

    for (const Surface& surface : scene.surfaces)
        if (surface.material == Material::kEye && surface.triangles.rows() > 0) {
            const auto eye = static_cast<std::size_t>(std::max(surface.eye, 0));
            eye_vertex_[eye] = surface.triangles(0, 0);
            eye_point_[eye] = scene.rest.row(eye_vertex_[eye]).transpose();
        }

    std::vector<unsigned> indices;
    for (std::size_t s = 0; s < strands_.size(); ++s)
        for (std::size_t i = 0; i + 1 < kStrandPoints; ++i) {
            const auto a = static_cast<unsigned>(2 * (s * kStrandPoints + i));
            indices.insert(indices.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
        }
    index_count_ = static_cast<int>(indices.size());
    GLint outer = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &outer);
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    glGenBuffers(1, &buffer_);
    glGenBuffers(1, &elements_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices.size() * sizeof(unsigned)), indices.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    const auto attribute = [](GLuint index, GLint size, std::size_t offset) {
        glEnableVertexAttribArray(index);
        glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, kFloats * sizeof(float),
                              reinterpret_cast<const void*>(offset * sizeof(float)));
    };
    attribute(0, 3, 0);
    attribute(1, 3, 3);
    attribute(2, 2, 6);
    glBindVertexArray(static_cast<GLuint>(outer));
}

StrandLayer::~StrandLayer() {
    const GLuint buffers[] = {buffer_, elements_};
    glDeleteBuffers(2, buffers);
    glDeleteVertexArrays(1, &array_);
}

void StrandLayer::upload(const Pose& pose, const PosedMarks& marks) {
    vertices_.clear();
    vertices_.reserve(strands_.size() * kStrandPoints * 2 * kFloats);
    const std::array<LidMarks, 2> lids{marks.lids(pose, 0), marks.lids(pose, 1)};
    // An eye turns about its centre, so one of its vertices tells where that has gone.
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
        for (std::size_t i = 0; i < kStrandPoints; ++i) {
            const Vec3 along =
                (p[std::min(i + 1, kStrandPoints - 1)] - p[i > 0 ? i - 1 : 0]).normalized();
            const Vec3 side = along.cross(camera_ - p[i]).normalized();
            const double u = static_cast<double>(i) / (kStrandPoints - 1);
            const double width = strand.width_m * (1 - (1 - kTip) * u * u);
            // Never thinner than a sample and a half, which the rasteriser would miss; as much paler instead.
            const double drawn = std::max(width, 1.5 * sample_m_);
            const auto opacity = static_cast<float>(width / drawn);
            for (const double half : {-0.5, 0.5}) {
                const Vec3 q = p[i] + half * drawn * side;
                for (int k = 0; k < 3; ++k) vertices_.push_back(static_cast<float>(q[k]));
                for (int k = 0; k < 3; ++k) vertices_.push_back(static_cast<float>(along[k]));
                vertices_.push_back(opacity);
                vertices_.push_back(static_cast<float>(strand.shade));
            }
        }
    }
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(float)),
                 vertices_.data(), GL_STREAM_DRAW);
}

void StrandLayer::draw() const {
    if (index_count_ == 0) return;
    glBindVertexArray(array_);
    program_.use();
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

}  // namespace risorius::render
