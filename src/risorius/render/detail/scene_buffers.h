// SPDX-License-Identifier: MIT
/// \file
/// The scene in GL memory: one vertex array, and the triangles of each draw call.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/lash_strands.h"
#include "risorius/render/detail/scene_triangles.h"
#include "risorius/render/detail/smooth_normals.h"
#include "risorius/render/detail/triangle_choice.h"
#include "risorius/render/scene.h"

namespace risorius::render {

class SceneBuffers {
  public:
    /// Throws Error for triangles with a vertex index out of range. The context must be current from here on.
    SceneBuffers(const Scene& scene, const Vec3& camera, const Vec3& paint_centre,
                 const Coarseness& coarseness);
    ~SceneBuffers();
    SceneBuffers(const SceneBuffers&) = delete;
    SceneBuffers& operator=(const SceneBuffers&) = delete;

    void bind() const { glBindVertexArray(array_); }
    /// Uploads positions, V x 3, m, world. `fold_depth`: see Pose; it is ignored when the scene has no folds.
    void upload(const Points& positions, const Points& fold_depth = {});
    void set_colours(const std::vector<float>& rgb);  ///< linear, 3 per vertex
    void set_occlusion(const std::vector<float>& sky_seen, const std::vector<float>& inside_mouth);

    /// These functions select triangles for the current positions. They are those of the same name in triangle_choice.h.
    void choose(const Eigen::Matrix4f& clip_from_world, bool whole);
    void hide(const std::vector<std::uint8_t>& vertices) { choice_.hide(vertices); }
    void choose_casters(const Eigen::Matrix4f& light_from_world,
                        const Eigen::Matrix4f* clip_from_world);
    void leave_out_unseen(SkinLayer& skin, PictureCells& cells,
                          const std::function<void(PictureCells&)>& mark_others);
    /// Draws the selected triangles of a batch; batches() lists all of them.
    void draw(const Batch& batch, Purpose purpose = Purpose::kSeen) const;
    void draw_smooth(const Batch& batch) const;    ///< the selected triangles without wrinkles
    void draw_wrinkled(const Batch& batch) const;  ///< the selected triangles with wrinkles
    bool has_wrinkled(const Batch& batch) const {
        return choice_.range(batch, Purpose::kSeen).wrinkled > 0;
    }

    const std::vector<Batch>& batches() const { return triangles_.batches(); }
    const std::vector<unsigned>& indices() const { return triangles_.indices(); }
    int skin_index_count() const { return triangles_.skin_index_count(); }
    const std::vector<float>& normals() const { return normals_; }

    /// Returns the skin triangles outside the mouth that the border of the paint map does not tear, three vertex indices each.
    std::vector<unsigned> paintable_triangles(const std::vector<float>& inside_mouth) const;
    /// Converts vertex indices of the scene to indices in the vertex array.
    std::vector<unsigned> elements(const std::vector<unsigned>& vertices) const;

  private:
    /// Computes positions and normals without uploading them.
    void place(const Points& positions);
    void upload_choice(Purpose purpose);
    void draw(const Batch& batch, Purpose purpose, int first, int count) const;

    SmoothNormals smooth_;
    SceneTriangles triangles_;
    /// Index in the vertex array of each scene vertex; the vertex array has the order of drawing
    std::vector<unsigned> number_;
    std::vector<float> paint_;
    std::vector<LashPlace> lashes_;
    std::vector<float> curvature_, pores_, occlusion_;
    std::vector<float> positions_, normals_, moving_, fold_depth_;
    std::vector<std::uint8_t> wrinkled_;  ///< per vertex: 1 if it has wrinkles in the current pose
    TriangleChoice choice_{triangles_, positions_, wrinkled_};
    std::array<GLuint, kPurposes> chosen_elements_{0, 0};
    GLuint array_ = 0, moving_buffer_ = 0, fixed_buffer_ = 0, occlusion_buffer_ = 0,
           colour_buffer_ = 0, elements_ = 0;
    GLuint fold_phase_buffer_ = 0, fold_depth_buffer_ = 0;  ///< 0 when nothing folds
};

}  // namespace risorius::render
