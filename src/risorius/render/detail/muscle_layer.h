// SPDX-License-Identifier: MIT
/// \file
/// Renders the muscles alone, colour and depth, so that they can show through the skin.
#pragma once

#include <vector>

#include "risorius/render/detail/camera.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/moving_surface.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class MuscleLayer {
  public:
    /// As large as the framebuffer of a tile of the picture, which is `picture_samples` high. Throws Error for triangles that name a vertex there is not.
    MuscleLayer(const Scene& scene, const Camera& camera, int picture_samples, int width_samples,
                int height_samples);
    ~MuscleLayer();
    MuscleLayer(const MuscleLayer&) = delete;
    MuscleLayer& operator=(const MuscleLayer&) = delete;

    /// Throws Error when the pose has other muscles than the scene.
    void upload(const Pose& pose);

    /// Draws the part of the picture that the frame's uniforms and the viewport are set to, and binds it to its texture units.
    void draw() const;

    /// What a program that looks into the layer has to know of the camera.
    void set_uniform(const GlProgram& program) const;

  private:
    Eigen::Index vertex_count_;
    std::size_t muscle_count_;
    std::vector<int> muscle_of_vertex_;
    MovingSurface surface_;
    std::vector<float> colours_;
    Vec2 distance_of_depth_;    ///< distance along the view = y / (2 depth - 1 + x)
    Vec3 right_;                ///< of the camera
    double samples_per_slope_;  ///< of the picture, across a metre a metre away
    GlProgram program_;
    GLsizei index_count_ = 0;
    GLuint array_ = 0, colour_buffer_ = 0, fixed_buffer_ = 0, elements_ = 0;
    GLuint framebuffer_ = 0, colour_ = 0, depth_ = 0, fibres_ = 0;
};

}  // namespace risorius::render
