// SPDX-License-Identifier: MIT
/// \file
/// Draws the muscles alone into textures of colour and depth. The shader of the skin reads them, so that the muscles show through
/// the skin.
#pragma once

#include <vector>

#include "risorius/render/detail/camera.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/moving_surface.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class MuscleLayer {
  public:
    /// The layer is as large as the framebuffer of a tile. `picture_samples`: height of the whole picture, samples. Throws Error
    /// for triangles with a vertex index out of range.
    MuscleLayer(const Scene& scene, const Camera& camera, int picture_samples, int width_samples,
                int height_samples);
    ~MuscleLayer();
    MuscleLayer(const MuscleLayer&) = delete;
    MuscleLayer& operator=(const MuscleLayer&) = delete;

    /// Throws Error when the pose and the scene have different muscles.
    void upload(const Pose& pose);

    /// Draws the part of the picture that the uniforms of the frame and the viewport select. Binds the textures of colour and
    /// depth to kMuscleColourUnit and kMuscleDepthUnit.
    void draw() const;

    /// Sets the uniforms of the camera in a program that reads the layer.
    void set_uniform(const GlProgram& program) const;

  private:
    Eigen::Index vertex_count_;
    std::size_t muscle_count_;
    std::vector<int> muscle_of_vertex_;
    MovingSurface surface_;
    std::vector<float> colours_;
    /// (x, y) such that the distance along the view direction, m, is y / (2 depth - 1 + x)
    Vec2 distance_of_depth_;
    Vec3 right_;  ///< unit, right axis of the camera
    /// Samples of the picture across one metre at a distance of one metre
    double samples_per_slope_;
    GlProgram program_;
    GLsizei index_count_ = 0;
    GLuint array_ = 0, colour_buffer_ = 0, fixed_buffer_ = 0, elements_ = 0;
    GLuint framebuffer_ = 0, colour_ = 0, depth_ = 0, fibres_ = 0;
};

}  // namespace risorius::render
