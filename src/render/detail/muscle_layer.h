// The muscles drawn by themselves, colour and depth, for the skin to show through.
#pragma once

#include <vector>

#include "render/detail/camera.h"
#include "render/detail/gl_context.h"
#include "render/detail/smooth_normals.h"
#include "render/scene.h"

namespace risorius::render {

class MuscleLayer {
  public:
    /// As large as the framebuffer of the picture. Throws Error for triangles that name a vertex there is not.
    MuscleLayer(const Scene& scene, const Camera& camera, int width_samples, int height_samples);
    ~MuscleLayer();
    MuscleLayer(const MuscleLayer&) = delete;
    MuscleLayer& operator=(const MuscleLayer&) = delete;

    /// Throws Error when the pose has other muscles than the scene.
    void upload(const Pose& pose);

    /// Draws the part of the picture that the frame's uniforms and the viewport are set to, and binds it to its texture units.
    void draw() const;

    /// Distance along the view over depth: distance = y / (2 depth - 1 + x).
    Vec2 distance_of_depth() const { return distance_of_depth_; }

  private:
    Eigen::Index vertex_count_;
    std::size_t muscle_count_;
    std::vector<int> muscle_of_vertex_;
    SmoothNormals smooth_;
    std::vector<float> positions_, normals_, moving_;
    Vec2 distance_of_depth_;
    GlProgram program_;
    GLsizei index_count_ = 0;
    GLuint array_ = 0, moving_buffer_ = 0, fixed_buffer_ = 0, elements_ = 0;
    GLuint framebuffer_ = 0, colour_ = 0, depth_ = 0;
};

}  // namespace risorius::render
