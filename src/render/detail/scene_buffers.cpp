#include "render/detail/scene_buffers.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "render/detail/curvature.h"
#include "render/detail/face_order.h"
#include "render/detail/lash_strands.h"
#include "render/detail/shaders.h"
#include "render/detail/skin_paint.h"

namespace risorius::render {
namespace {

std::vector<const Triangles*> triangle_lists(const Scene& scene) {
    std::vector<const Triangles*> lists;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        const Triangles& triangles = scene.surfaces[i].triangles;
        if (triangles.size() > 0 &&
            (triangles.minCoeff() < 0 || triangles.maxCoeff() >= scene.rest.rows()))
            throw Error(
                "scene/surfaces/" + std::to_string(i) + "/triangles",
                "vertices 0.." + std::to_string(scene.rest.rows() - 1),
                std::to_string(triangles.minCoeff()) + ".." + std::to_string(triangles.maxCoeff()));
        lists.push_back(&triangles);
    }
    return lists;
}

// Skin first, as it hides most of the rest; what is blended last.
constexpr Material kDrawOrder[] = {Material::kSkin,   Material::kEye,    Material::kTeeth,
                                   Material::kTongue, Material::kGums,   Material::kMouth,
                                   Material::kMatte,  Material::kLashes, Material::kCornea};

void attribute(VertexAttribute index, GLint size, int floats_per_vertex, int offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(
        index, size, GL_FLOAT, GL_FALSE,
        static_cast<GLsizei>(static_cast<std::size_t>(floats_per_vertex) * sizeof(float)),
        reinterpret_cast<const void*>(static_cast<std::size_t>(offset) * sizeof(float)));
}

GLsizeiptr bytes(const std::vector<float>& values) {
    return static_cast<GLsizeiptr>(values.size() * sizeof(float));
}

}  // namespace

SceneBuffers::SceneBuffers(const Scene& scene, const Vec3& camera, const Vec3& paint_centre,
                           const Coarseness& coarseness)
    : smooth_(scene.rest, triangle_lists(scene)) {
    // Batches: near triangles first, so that hidden ones fail the depth test before they are shaded.
    for (const Material material : kDrawOrder)
        for (const int eye : {-1, 0, 1})
            for (int texture = -1; texture < static_cast<int>(scene.textures.size()); ++texture)
                add_batch(scene, material, eye, texture, camera, paint_centre, coarseness);
    index_count_ = static_cast<int>(indices_.size());

    // The driver runs a vertex again for each of a few hundred triangles that use it, unless their numbers are near each other.
    const auto vertices = static_cast<std::size_t>(scene.rest.rows());
    constexpr unsigned kNone = ~0U;
    unsigned used = 0;
    number_.assign(vertices, kNone);
    for (const auto* some : {&coarse_skin_[kSeen], &indices_})
        for (const unsigned v : *some)
            if (number_[v] == kNone) number_[v] = used++;
    for (unsigned& number : number_)
        if (number == kNone) number = used++;

    lashes_ = lash_places(scene);
    std::vector<float> fixed(5 * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const Vec3 p = scene.rest.row(static_cast<Eigen::Index>(v)).transpose();
        const Vec2 place = paint_place(p, paint_centre);
        for (int k = 0; k < 2; ++k) paint_.push_back(static_cast<float>(place[k]));
        float* to = fixed.data() + 5 * static_cast<std::size_t>(number_[v]);
        for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(p[k]);
        to[3] = lashes_[v].is_lash ? lashes_[v].along_m : static_cast<float>(place.x());
        to[4] = lashes_[v].is_lash ? lashes_[v].share : static_cast<float>(place.y());
    }

    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    for (GLuint* buffer :
         {&moving_buffer_, &fixed_buffer_, &occlusion_buffer_, &colour_buffer_, &elements_})
        glGenBuffers(1, buffer);
    glGenBuffers(2, chosen_elements_.data());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    const std::vector<unsigned> all = elements(indices_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(all.size() * sizeof(unsigned)),
                 all.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, fixed_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(fixed), fixed.data(), GL_STATIC_DRAW);
    attribute(kRest, 3, 5, 0);
    attribute(kPaintPlace, 2, 5, 3);
    curvature_ = curvature(scene.rest, indices_);
    set_occlusion(std::vector<float>(vertices, 1.0F), std::vector<float>(vertices, 0.0F));
    attribute(kOcclusion, 3, 3, 0);
    if (scene.fold_phase.rows() > 0) {
        std::vector<float> phase(3 * vertices, 0.0F);
        for (std::size_t v = 0; v < vertices; ++v)
            for (std::size_t k = 0; k < 3; ++k)
                phase[3 * number_[v] + k] = static_cast<float>(scene.fold_phase.data()[3 * v + k]);
        glGenBuffers(1, &fold_phase_buffer_);
        glBindBuffer(GL_ARRAY_BUFFER, fold_phase_buffer_);
        glBufferData(GL_ARRAY_BUFFER, bytes(phase), phase.data(), GL_STATIC_DRAW);
        attribute(kFoldPhase, 3, 3, 0);
        glGenBuffers(1, &fold_depth_buffer_);
        glBindBuffer(GL_ARRAY_BUFFER, fold_depth_buffer_);
        attribute(kFoldDepth, 3, 3, 0);
    }
    upload(scene.rest);
    attribute(kPosition, 3, 6, 0);
    attribute(kNormal, 3, 6, 3);
}

void SceneBuffers::add_batch(const Scene& scene, Material material, int eye, int texture,
                             const Vec3& camera, const Vec3& paint_centre,
                             const Coarseness& coarseness) {
    std::vector<Face> faces;
    const bool of_eye = material == Material::kEye || material == Material::kCornea;
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != material || (of_eye ? std::max(surface.eye, 0) : -1) != eye ||
            (material == Material::kSkin ? -1 : surface.texture) != texture)
            continue;
        for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
            faces.push_back(
                {surface.triangles(f, 0), surface.triangles(f, 1), surface.triangles(f, 2)});
    }
    if (faces.empty()) return;
    bool cull = false;
    if (material == Material::kSkin) {
        cull = is_wound_outwards(scene.rest, faces, paint_centre);
        const auto coarse = [&](double error_m, bool folds) {
            std::vector<unsigned> corners;
            if (error_m <= 0) return corners;
            std::vector<Face> fewer =
                coarser_faces(scene.rest, faces, error_m, much_moved(scene, folds));
            order_for_drawing(scene.rest, camera, fewer);
            for (const Face& face : fewer)
                for (const int v : face) corners.push_back(static_cast<unsigned>(v));
            return corners;
        };
        coarse_skin_ = {coarse(coarseness.seen_m, coarseness.keeps_folds),
                        coarse(coarseness.shadow_m, false)};
    } else if (material == Material::kEye || material == Material::kTeeth) {
        wind_outwards(scene.rest, faces);
        cull = true;
    }
    order_for_drawing(scene.rest, camera, faces);
    batches_.push_back({material, eye, texture, static_cast<int>(indices_.size()),
                        static_cast<int>(3 * faces.size()), cull});
    for (const Face& face : faces)
        for (const int v : face) indices_.push_back(static_cast<unsigned>(v));
}

SceneBuffers::~SceneBuffers() {
    const GLuint buffers[] = {moving_buffer_, fixed_buffer_,      occlusion_buffer_, colour_buffer_,
                              elements_,      fold_phase_buffer_, fold_depth_buffer_};
    glDeleteBuffers(7, buffers);
    glDeleteBuffers(2, chosen_elements_.data());
    glDeleteVertexArrays(1, &array_);
}

void SceneBuffers::upload(const Points& positions, const Points& fold_depth) {
    const auto vertices = static_cast<std::size_t>(positions.rows());
    positions_.resize(3 * vertices);
    for (std::size_t i = 0; i < positions_.size(); ++i)
        positions_[i] = static_cast<float>(positions.data()[i]);
    smooth_.compute(positions_, normals_);
    moving_.resize(6 * vertices);
    for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t k = 0; k < 3; ++k) {
            moving_[6 * number_[v] + k] = positions_[3 * v + k];
            moving_[6 * number_[v] + 3 + k] = normals_[3 * v + k];
        }
    if (fold_depth_buffer_ != 0) {
        fold_depth_.assign(3 * vertices, 0.0F);
        wrinkled_.assign(vertices, 0);
        if (fold_depth.rows() > 0)
            for (std::size_t v = 0; v < vertices; ++v)
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto depth = static_cast<float>(fold_depth.data()[3 * v + k]);
                    fold_depth_[3 * number_[v] + k] = depth;
                    if (depth > 0) wrinkled_[v] = 1;
                }
        glBindBuffer(GL_ARRAY_BUFFER, fold_depth_buffer_);
        glBufferData(GL_ARRAY_BUFFER, bytes(fold_depth_), fold_depth_.data(), GL_STREAM_DRAW);
    }
    glBindBuffer(GL_ARRAY_BUFFER, moving_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(moving_), moving_.data(), GL_STREAM_DRAW);
}

void SceneBuffers::set_colours(const std::vector<float>& rgb) {
    std::vector<float> numbered(rgb.size());
    for (std::size_t v = 0; v < rgb.size() / 3; ++v)
        std::copy_n(rgb.begin() + static_cast<std::ptrdiff_t>(3 * v), 3,
                    numbered.begin() + 3 * static_cast<std::ptrdiff_t>(number_[v]));
    glBindBuffer(GL_ARRAY_BUFFER, colour_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(numbered), numbered.data(), GL_STREAM_DRAW);
    attribute(kColour, 3, 3, 0);
}

void SceneBuffers::set_occlusion(const std::vector<float>& sky_seen,
                                 const std::vector<float>& inside_mouth) {
    occlusion_.resize(3 * sky_seen.size());
    for (std::size_t v = 0; v < sky_seen.size(); ++v) {
        float* to = occlusion_.data() + 3 * static_cast<std::size_t>(number_[v]);
        to[0] = lashes_[v].is_lash ? (lashes_[v].lower_lid ? 1.0F : 0.0F) : sky_seen[v];
        to[1] = inside_mouth[v];
        to[2] = curvature_[v];
    }
    glBindBuffer(GL_ARRAY_BUFFER, occlusion_buffer_);
    glBufferData(GL_ARRAY_BUFFER, bytes(occlusion_), occlusion_.data(), GL_STREAM_DRAW);
}

std::span<const unsigned> SceneBuffers::corners_of(const Batch& batch, Purpose purpose,
                                                   bool whole) const {
    const std::vector<unsigned>& coarse = coarse_skin_[purpose];
    if (batch.material == Material::kSkin && !coarse.empty() && !whole) return coarse;
    return std::span(indices_).subspan(static_cast<std::size_t>(batch.first_index),
                                       static_cast<std::size_t>(batch.index_count));
}

int SceneBuffers::skin_index_count() const {
    return batches_.front().material == Material::kSkin ? batches_.front().index_count : 0;
}

void SceneBuffers::look_from(const Eigen::Matrix4f& clip_from_world) {
    const std::size_t vertices = positions_.size() / 3;
    clip_places_.resize(4 * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const Eigen::Vector4f clip =
            clip_from_world *
            Eigen::Vector4f(positions_[3 * v], positions_[3 * v + 1], positions_[3 * v + 2], 1.0F);
        clip_places_[4 * v] = clip.x() / clip.w();
        clip_places_[4 * v + 1] = clip.y() / clip.w();
        clip_places_[4 * v + 2] = clip.z() / clip.w();
        clip_places_[4 * v + 3] = clip.w();
    }
}

bool SceneBuffers::is_seen(const unsigned* face, bool cull_back) const {
    const float *a = clip_places_.data() + 4 * static_cast<std::size_t>(face[0]),
                *b = clip_places_.data() + 4 * static_cast<std::size_t>(face[1]),
                *c = clip_places_.data() + 4 * static_cast<std::size_t>(face[2]);
    if (a[3] <= 0 || b[3] <= 0 || c[3] <= 0) return true;
    for (std::size_t k = 0; k < 2; ++k)
        if ((a[k] < -1 && b[k] < -1 && c[k] < -1) || (a[k] > 1 && b[k] > 1 && c[k] > 1))
            return false;
    // A thousandth of a pixel of any picture is left to the rasteriser to judge.
    constexpr float kRounding = 1e-10F;
    return !cull_back || (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]) > -kRounding;
}

void SceneBuffers::choose(const Eigen::Matrix4f& clip_from_world, bool whole) {
    look_from(clip_from_world);
    choice_.clear();
    std::vector<Chosen>& chosen = chosen_[kSeen];
    chosen.assign(batches_.size(), {});
    for (std::size_t i = 0; i < batches_.size(); ++i) {
        const Batch& batch = batches_[i];
        chosen[i].first = static_cast<int>(choice_.size());
        const bool apart = batch.material == Material::kSkin && !wrinkled_.empty();
        wrinkled_choice_.clear();
        const std::span<const unsigned> corners = corners_of(batch, kSeen, whole);
        for (std::size_t k = 0; k < corners.size(); k += 3) {
            const unsigned* face = corners.data() + k;
            // What has a texture is looked up by the number of its triangle.
            if (batch.texture < 0 && !is_seen(face, batch.cull_back)) continue;
            const bool wrinkled =
                apart && (wrinkled_[face[0]] || wrinkled_[face[1]] || wrinkled_[face[2]]);
            std::vector<unsigned>& to = wrinkled ? wrinkled_choice_ : choice_;
            to.insert(to.end(), face, face + 3);
        }
        chosen[i].smooth = static_cast<int>(choice_.size()) - chosen[i].first;
        chosen[i].wrinkled = static_cast<int>(wrinkled_choice_.size());
        choice_.insert(choice_.end(), wrinkled_choice_.begin(), wrinkled_choice_.end());
    }
    upload_choice(kSeen);
}

void SceneBuffers::choose_casters(const Eigen::Matrix4f& light_from_world,
                                  const Eigen::Matrix4f* clip_from_world) {
    // What is seen, in cells of the shadow map: how far from the lamp it is at most
    constexpr int kCells = 64;
    constexpr float kNowhere = -1e9F;
    const std::size_t vertices = positions_.size() / 3;
    lit_places_.resize(3 * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const Eigen::Vector4f at =
            light_from_world *
            Eigen::Vector4f(positions_[3 * v], positions_[3 * v + 1], positions_[3 * v + 2], 1.0F);
        for (std::size_t k = 0; k < 2; ++k)
            lit_places_[3 * v + k] =
                std::clamp((0.5F * at[static_cast<Eigen::Index>(k)] + 0.5F) * kCells, -2.0F,
                           static_cast<float>(kCells) + 1.0F);
        lit_places_[3 * v + 2] = at.z();
    }
    struct Cells {
        int from_x = kCells, to_x = 0, from_y = kCells, to_y = 0;
        float nearest = 1e9F, farthest = kNowhere;
    };
    const auto cells_of = [&](const unsigned* face, int wider) {
        Cells cells;
        for (std::size_t k = 0; k < 3; ++k) {
            const float* p = lit_places_.data() + 3 * static_cast<std::size_t>(face[k]);
            // Counted from -2, so that cutting off rounds down
            const int x = static_cast<int>(p[0] + 2) - 2, y = static_cast<int>(p[1] + 2) - 2;
            cells.from_x = std::min(cells.from_x, x - wider);
            cells.to_x = std::max(cells.to_x, x + wider);
            cells.from_y = std::min(cells.from_y, y - wider);
            cells.to_y = std::max(cells.to_y, y + wider);
            cells.nearest = std::min(cells.nearest, p[2]);
            cells.farthest = std::max(cells.farthest, p[2]);
        }
        cells.from_x = std::max(cells.from_x, 0);
        cells.from_y = std::max(cells.from_y, 0);
        cells.to_x = std::min(cells.to_x, kCells - 1);
        cells.to_y = std::min(cells.to_y, kCells - 1);
        return cells;
    };
    if (clip_from_world) look_from(*clip_from_world);
    farthest_lit_.assign(static_cast<std::size_t>(kCells) * kCells, kNowhere);
    for (const Batch& batch : batches_) {
        const std::span<const unsigned> corners = corners_of(batch, kShadow, /*whole=*/false);
        for (std::size_t k = 0; k < corners.size(); k += 3) {
            const unsigned* face = corners.data() + k;
            if (clip_from_world && !is_seen(face, batch.cull_back)) continue;
            // A cell more on each side, a hundredth of a picture, for soft edges and for hairs
            const Cells cells = cells_of(face, 1);
            for (int y = cells.from_y; y <= cells.to_y; ++y)
                for (int x = cells.from_x; x <= cells.to_x; ++x) {
                    float& there = farthest_lit_[static_cast<std::size_t>(y * kCells + x)];
                    there = std::max(there, cells.farthest);
                }
        }
    }

    choice_.clear();
    std::vector<Chosen>& chosen = chosen_[kShadow];
    chosen.assign(batches_.size(), {});
    for (std::size_t i = 0; i < batches_.size(); ++i) {
        const Batch& batch = batches_[i];
        chosen[i].first = static_cast<int>(choice_.size());
        if (batch.material != Material::kSkin) continue;
        const std::span<const unsigned> corners = corners_of(batch, kShadow, /*whole=*/false);
        for (std::size_t k = 0; k < corners.size(); k += 3) {
            const unsigned* face = corners.data() + k;
            const Cells cells = cells_of(face, 0);
            bool throws_any = false;
            for (int y = cells.from_y; y <= cells.to_y && !throws_any; ++y)
                for (int x = cells.from_x; x <= cells.to_x && !throws_any; ++x)
                    throws_any =
                        cells.nearest <= farthest_lit_[static_cast<std::size_t>(y * kCells + x)];
            if (throws_any) choice_.insert(choice_.end(), face, face + 3);
        }
        chosen[i].smooth = static_cast<int>(choice_.size()) - chosen[i].first;
    }
    upload_choice(kShadow);
}

ClipBox SceneBuffers::box_of(const unsigned* face) const {
    ClipBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        const float* p = clip_places_.data() + 4 * static_cast<std::size_t>(face[k]);
        box.add(p[0], p[1], p[3]);
    }
    return box;
}

float SceneBuffers::nearest_depth(const unsigned* face) const {
    float nearest = 1e9F;
    for (std::size_t k = 0; k < 3; ++k)
        nearest = std::min(nearest, clip_places_[4 * static_cast<std::size_t>(face[k]) + 2]);
    return 0.5F * nearest + 0.5F;
}

bool SceneBuffers::may_hide(const Batch& batch) const {
    return batch.texture < 0 &&
           (batch.material == Material::kEye || batch.material == Material::kTeeth ||
            batch.material == Material::kGums || batch.material == Material::kTongue ||
            batch.material == Material::kMouth);
}

template <typename Keep>
void SceneBuffers::keep_if(Keep keep) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < batches_.size(); ++i) {
        Chosen& chosen = chosen_[kSeen][i];
        auto from = static_cast<std::size_t>(chosen.first);
        chosen.first = static_cast<int>(kept);
        for (int* count : {&chosen.smooth, &chosen.wrinkled}) {
            const std::size_t end = from + static_cast<std::size_t>(*count), first = kept;
            for (; from < end; from += 3) {
                if (!keep(batches_[i], choice_.data() + from)) continue;
                std::copy_n(choice_.begin() + static_cast<std::ptrdiff_t>(from), 3,
                            choice_.begin() + static_cast<std::ptrdiff_t>(kept));
                kept += 3;
            }
            *count = static_cast<int>(kept - first);
        }
    }
    choice_.resize(kept);
}

void SceneBuffers::leave_out_unseen(SkinLayer& skin, PictureCells& cells,
                                    const std::function<void(PictureCells&)>& mark_others) {
    // What lies behind the skin
    ClipBox inner;
    for (std::size_t i = 0; i < batches_.size(); ++i) {
        if (!may_hide(batches_[i])) continue;
        const Chosen& chosen = chosen_[kSeen][i];
        for (int k = 0; k < chosen.smooth + chosen.wrinkled; k += 3)
            inner.add(box_of(choice_.data() + chosen.first + k));
    }
    const FarthestSkin& farthest = skin.farthest(inner);
    const auto is_hidden = [&](const unsigned* face) {
        const ClipBox box = box_of(face);
        if (box.behind) return false;
        const auto cell = [](float clip, float cells_, float by, int most) {
            return std::clamp(static_cast<int>((0.5F * clip + 0.5F) * cells_ + by), 0, most - 1);
        };
        // A pixel more on each side: samples lie beside the middle of theirs.
        constexpr float kPixel = 1.0F / FarthestSkin::kCell;
        const int from_x = cell(box.left, farthest.width, -kPixel, farthest.columns),
                  to_x = cell(box.right, farthest.width, kPixel, farthest.columns),
                  from_y = cell(box.low, farthest.height, -kPixel, farthest.rows),
                  to_y = cell(box.high, farthest.height, kPixel, farthest.rows);
        const float near = nearest_depth(face);
        for (int y = from_y; y <= to_y; ++y)
            for (int x = from_x; x <= to_x; ++x)
                if (near <= farthest.depth[static_cast<std::size_t>(y * farthest.columns + x)])
                    return false;
        return true;
    };
    keep_if([&](const Batch& batch, const unsigned* face) {
        return !may_hide(batch) || !is_hidden(face);
    });

    // Skin where nothing else is
    keep_if([&](const Batch& batch, const unsigned* face) {
        if (batch.material == Material::kSkin)
            cells.touch(box_of(face));
        else
            cells.mark(box_of(face));
        return true;
    });
    mark_others(cells);
    cells.find_steps(skin.read(cells.touched()), skin.shaded());
    keep_if([&](const Batch& batch, const unsigned* face) {
        return batch.material != Material::kSkin || cells.needs_samples(box_of(face));
    });
    upload_choice(kSeen);
}

void SceneBuffers::upload_choice(Purpose purpose) {
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, chosen_elements_[purpose]);
    const std::vector<unsigned> numbers = elements(choice_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(numbers.size() * sizeof(unsigned)), numbers.data(),
                 GL_STREAM_DRAW);
}

std::vector<unsigned> SceneBuffers::elements(const std::vector<unsigned>& vertices) const {
    std::vector<unsigned> numbers;
    numbers.reserve(vertices.size());
    for (const unsigned v : vertices) numbers.push_back(number_[v]);
    return numbers;
}

void SceneBuffers::draw(const Batch& batch, Purpose purpose, int first, int count) const {
    if (count == 0) return;
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, chosen_elements_[purpose]);
    if (batch.cull_back && purpose == kSeen) glEnable(GL_CULL_FACE);
    glDrawElements(
        GL_TRIANGLES, count, GL_UNSIGNED_INT,
        reinterpret_cast<const void*>(static_cast<std::size_t>(first) * sizeof(unsigned)));
    glDisable(GL_CULL_FACE);
}

void SceneBuffers::draw(const Batch& batch, Purpose purpose) const {
    const Chosen& chosen = chosen_of(batch, purpose);
    draw(batch, purpose, chosen.first, chosen.smooth + chosen.wrinkled);
}

void SceneBuffers::draw_smooth(const Batch& batch) const {
    const Chosen& chosen = chosen_of(batch);
    draw(batch, kSeen, chosen.first, chosen.smooth);
}

void SceneBuffers::draw_wrinkled(const Batch& batch) const {
    const Chosen& chosen = chosen_of(batch);
    draw(batch, kSeen, chosen.first + chosen.smooth, chosen.wrinkled);
}

std::vector<unsigned> SceneBuffers::paintable_triangles(
    const std::vector<float>& inside_mouth) const {
    // Around the back of the head a triangle may span the whole rim of the map.
    constexpr float kWidest = 0.15F;
    std::vector<unsigned> triangles;
    for (std::size_t i = 0; i < static_cast<std::size_t>(skin_index_count()); i += 3) {
        const bool hidden = inside_mouth[indices_[i]] > 0.5F &&
                            inside_mouth[indices_[i + 1]] > 0.5F &&
                            inside_mouth[indices_[i + 2]] > 0.5F;
        float widest = 0;
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t k = 0; k < 2; ++k)
                widest = std::max(widest, std::abs(paint_[2 * indices_[i + a] + k] -
                                                   paint_[2 * indices_[i + (a + 1) % 3] + k]));
        if (!hidden && widest < kWidest)
            triangles.insert(triangles.end(), {indices_[i], indices_[i + 1], indices_[i + 2]});
    }
    return triangles;
}

}  // namespace risorius::render
