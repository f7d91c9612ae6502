// The scene as GL holds it: one vertex array, the triangles of each draw ordered front to back.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "render/detail/coarser_faces.h"
#include "render/detail/gl_context.h"
#include "render/detail/lash_strands.h"
#include "render/detail/skin_layer.h"
#include "render/detail/smooth_normals.h"
#include "render/scene.h"

namespace risorius::render {

/// Triangles of one material (and one eye): a range of the element buffer.
struct Batch {
    Material material;
    int eye;
    int texture;  ///< of the scene, or -1; the skin has its own in its paint
    int first_index;
    int index_count;
    bool cull_back;  ///< counter-clockwise from outside, so what turns away is hidden
};

class SceneBuffers {
  public:
    /// Throws Error for triangles that name a vertex there is not. The context must be current from here on.
    SceneBuffers(const Scene& scene, const Vec3& camera, const Vec3& paint_centre,
                 const Coarseness& coarseness);
    ~SceneBuffers();
    SceneBuffers(const SceneBuffers&) = delete;
    SceneBuffers& operator=(const SceneBuffers&) = delete;

    void bind() const { glBindVertexArray(array_); }
    /// `fold_depth` has no rows when nothing is folded; it is not read when the scene has no folds.
    void upload(const Points& positions, const Points& fold_depth = {});
    void set_colours(const std::vector<float>& rgb);  ///< linear, 3 per vertex
    void set_occlusion(const std::vector<float>& sky_seen, const std::vector<float>& inside_mouth);

    /// What a choice of triangles is for.
    enum Purpose { kSeen, kShadow };
    /// Which triangles of each batch the next draws are of: those within the clip space that do not turn their back to it, of
    /// batches that have one; of where things are now. Skin with wrinkles on it apart from the rest. As coarse as may be unless
    /// `whole`.
    void choose(const Eigen::Matrix4f& clip_from_world, bool whole);
    /// Which throw shadows: those of the skin, whichever side is lit (light that has come in at the mouth does not go out at the
    /// back of the head), that lie nearer to the lamp than something that is seen there. Without a clip space all is taken to be seen.
    void choose_casters(const Eigen::Matrix4f& light_from_world,
                        const Eigen::Matrix4f* clip_from_world);
    /// Of what was chosen to be seen leaves out: eyes, teeth, gums and tongue where they lie behind the skin of the layer; and
    /// skin where the layer is the picture already, which the cells know afterwards. What lines the mouth stays: a gap narrower
    /// than the layer's pixels shows it.
    void leave_out_unseen(SkinLayer& skin, PictureCells& cells,
                          const std::function<void(PictureCells&)>& mark_others);
    /// What was chosen, of which batches() are the whole.
    void draw(const Batch& batch, Purpose purpose = kSeen) const;
    void draw_smooth(const Batch& batch) const;    ///< without wrinkles
    void draw_wrinkled(const Batch& batch) const;  ///< and with them
    bool has_wrinkled(const Batch& batch) const { return chosen_of(batch).wrinkled > 0; }

    const std::vector<Batch>& batches() const { return batches_; }
    const std::vector<unsigned>& indices() const { return indices_; }
    int index_count() const { return index_count_; }
    int skin_index_count() const;
    const std::vector<float>& normals() const { return normals_; }

    /// Skin triangles outside the mouth that the map of the paint shows unbroken.
    std::vector<unsigned> paintable_triangles(const std::vector<float>& inside_mouth) const;
    /// Vertices of the scene as the vertex array numbers them.
    std::vector<unsigned> elements(const std::vector<unsigned>& vertices) const;

  private:
    void add_batch(const Scene& scene, Material material, int eye, int texture, const Vec3& camera,
                   const Vec3& paint_centre, const Coarseness& coarseness);
    /// Corners of its triangles, three each: fewer ones where it has them for the purpose.
    std::span<const unsigned> corners_of(const Batch& batch, Purpose purpose, bool whole) const;
    /// In the elements of a purpose: first smooth triangles, then wrinkled ones, in indices.
    struct Chosen {
        int first = 0, smooth = 0, wrinkled = 0;
    };
    const Chosen& chosen_of(const Batch& batch, Purpose purpose = kSeen) const {
        return chosen_[purpose][static_cast<std::size_t>(&batch - batches_.data())];
    }
    void look_from(const Eigen::Matrix4f& clip_from_world);
    bool is_seen(const unsigned* face, bool cull_back) const;
    void upload_choice(Purpose purpose);
    /// Where a triangle lies in the clip space last chosen by, and its nearest depth, 0..1.
    ClipBox box_of(const unsigned* face) const;
    float nearest_depth(const unsigned* face) const;
    bool may_hide(const Batch& batch) const;
    /// Keeps of the choice to be seen the triangles of batches that keep(batch, triangle).
    template <typename Keep>
    void keep_if(Keep keep);
    void draw(const Batch& batch, Purpose purpose, int first, int count) const;

    SmoothNormals smooth_;
    std::vector<Batch> batches_;
    std::vector<unsigned> indices_;
    std::array<std::vector<unsigned>, 2> coarse_skin_;  ///< for each purpose; empty: as it is
    std::vector<unsigned> number_;  ///< of each vertex in the vertex array, in the order of drawing
    std::vector<float> paint_;
    std::vector<LashPlace> lashes_;
    std::vector<float> curvature_, occlusion_;
    std::vector<float> positions_, normals_, moving_, fold_depth_;
    std::array<std::vector<Chosen>, 2> chosen_;
    std::vector<unsigned> choice_, wrinkled_choice_;
    std::vector<float> clip_places_;  ///< x, y, z over w, and w
    std::vector<float> lit_places_, farthest_lit_;
    std::vector<std::uint8_t> wrinkled_;  ///< per vertex, now
    int index_count_ = 0;
    std::array<GLuint, 2> chosen_elements_{0, 0};
    GLuint array_ = 0, moving_buffer_ = 0, fixed_buffer_ = 0, occlusion_buffer_ = 0,
           colour_buffer_ = 0, elements_ = 0;
    GLuint fold_phase_buffer_ = 0, fold_depth_buffer_ = 0;  ///< 0 when nothing folds
};

}  // namespace risorius::render
