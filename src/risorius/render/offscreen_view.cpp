// SPDX-License-Identifier: MIT
#include "risorius/render/offscreen_view.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/render/detail/baked_scene.h"
#include "risorius/render/detail/bone_layer.h"
#include "risorius/render/detail/camera.h"
#include "risorius/render/detail/cell_clear.h"
#include "risorius/render/detail/colour_scale.h"
#include "risorius/render/detail/framebuffer.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/lights.h"
#include "risorius/render/detail/materials.h"
#include "risorius/render/detail/muscle_layer.h"
#include "risorius/render/detail/occlusion.h"
#include "risorius/render/detail/own_textures.h"
#include "risorius/render/detail/part_texture.h"
#include "risorius/render/detail/pass_clock.h"
#include "risorius/render/detail/posed_marks.h"
#include "risorius/render/detail/resolve.h"
#include "risorius/render/detail/scene_buffers.h"
#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/shell_layer.h"
#include "risorius/render/detail/skin_box.h"
#include "risorius/render/detail/skin_layer.h"
#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/detail/skin_texture.h"
#include "risorius/render/detail/socket_layer.h"
#include "risorius/render/detail/strand_layer.h"
#include "risorius/render/detail/tear_layer.h"
#include "risorius/render/detail/worn_layer.h"
#include "risorius/render/texture_square.h"
#include "risorius/render/value_colour.h"

namespace risorius::render {
namespace {

// Errors of simplified skin and eyes, in samples of the picture, and of shadow casters, whose shadow edges are 3.5 mm wide.
constexpr double kCoarseSamples = 0.6, kCoarseShadow_m = 0.25e-3, kCoarseEyeSamples = 0.2,
                 kCoarseMovedSamples = 0.2, kDraftSkin_m = 0.7e-3;

ViewOptions checked(ViewOptions options) {
    check_range("width_px", options.width_px, kMinSide_px, kMaxSide_px);
    check_range("height_px", options.height_px, kMinSide_px, kMaxSide_px);
    check_range("supersampling", options.supersampling, 1, kMaxSupersampling);
    check_range("threads", options.threads, 0, 256);
    return options;
}

std::vector<float> colours_of(const SkinValues& values) {
    std::vector<float> rgb;
    rgb.reserve(3 * values.at.size());
    for (const double value : values.at) {
        const Vec3 colour =
            std::isfinite(value) ? value_colour(value, values.from, values.to) : no_value_colour();
        for (int k = 0; k < 3; ++k) rgb.push_back(static_cast<float>(colour[k]));
    }
    return rgb;
}

// In the order of Show
constexpr const char* kShowNames[] = {"skin",   "muscles", "skull",     "wire",
                                      "strain", "error",   "landmarks", "articulation"};

}  // namespace

const std::vector<std::string>& show_names() {
    static const std::vector<std::string> names(std::begin(kShowNames), std::end(kShowNames));
    return names;
}

Show show_named(const std::string& name, const std::string& place) {
    return static_cast<Show>(index_of_name(place, name, show_names()));
}

struct OffscreenView::Impl {
    Impl(const Scene& scene, const ViewOptions& view_options, const Impl* first)
        : options(checked(view_options)),
          appearance(scene.appearance),
          box(box_of_skin(scene)),
          camera(make_camera(options.camera, scene.landmarks, box.min, box.max,
                             static_cast<double>(options.width_px) / options.height_px,
                             options.lens)),
          views(lens_views(camera, scene.landmarks, options.lens)),
          marks(scene),
          picture(options.width_px, options.height_px, options.supersampling),
          resolve(options.background),
          vertex_count(scene.rest.rows()),
          context(options.threads, first ? &first->context : nullptr) {
        if (scene.fold_phase.rows() != 0 && scene.fold_phase.rows() != vertex_count)
            throw Error("scene/fold_phase", std::to_string(vertex_count) + " rows, or none",
                        std::to_string(scene.fold_phase.rows()));
        if (scene.shut.rows() != 0 && scene.shut.rows() != vertex_count)
            throw Error("scene/shut", std::to_string(vertex_count) + " rows, or none",
                        std::to_string(scene.shut.rows()));
        if (options.show == Show::kMuscles && options.lens.orthographic)
            throw Error("projection", "\"perspective\" when muscles are shown", "\"orthographic\"");
        const GlContext::Current current(context);
        const Vec3 centre = paint_centre(scene, box.min, box.max);
        lights = std::make_unique<Lights>(camera, centre, options.light, scene.appearance.skin_tone,
                                          options.height_px, options.draft);
        const ShaderConstants lit = lights->constants();
        if (options.show == Show::kMuscles)
            muscles = std::make_unique<MuscleLayer>(
                scene, camera, options.height_px * options.supersampling,
                picture.tile_width_samples(), picture.tile_height_samples());
        if (options.show == Show::kSkull) bones = std::make_unique<BoneLayer>(scene);
        buffers = std::make_unique<SceneBuffers>(scene, camera.position, centre, coarseness());

        baked = first ? first->baked : bake_scene(scene, *buffers, marks, centre, bake_options());
        sky_about_eyes = baked->sky_about_eyes;
        buffers->set_occlusion(baked->sky, baked->inside);
        const double sample_m = camera.frame_height_m / (options.height_px * options.supersampling);
        hair = std::make_unique<StrandLayer>(scene, baked->hair, camera, sample_m, lit);
        worn = std::make_unique<WornLayer>(scene, looks_inside(), centre, camera, lit,
                                           shaded_per_side() < options.supersampling);
        buffers->hide(worn->covered());
        sockets = std::make_unique<SocketLayer>(scene, marks, lit);
        tears = std::make_unique<TearLayer>(scene, lit);
        buffers->bind();
        shells = std::make_unique<ShellLayer>(muscles ? without_hair(scene) : scene, *buffers,
                                              plan_skin(scene, centre), centre,
                                              buffers->paintable_triangles(baked->inside), lit);

        buffers->bind();
        const int shaded = shaded_per_side();
        if (shaded < options.supersampling) {
            cell_clear = std::make_unique<CellClear>();
            skin_layer =
                std::make_unique<SkinLayer>(picture.tile_width_samples() / options.supersampling,
                                            picture.tile_height_samples() / options.supersampling,
                                            options.supersampling, shaded, lit);
        }
        const Materials::Skin skin = muscles      ? Materials::Skin::kVeil
                                     : skin_layer ? Materials::Skin::kLayer
                                                  : Materials::Skin::kPlain;
        materials = std::make_unique<Materials>(
            scene, *buffers, skin, options.draft,
            camera.frame_height_m / (options.height_px * shaded), lit, muscles.get());
        target = std::make_unique<Framebuffer>(
            picture.tile_width_samples(), picture.tile_height_samples(),
            options.deep ? Framebuffer::Colour::kLinearFloats : Framebuffer::Colour::kSrgbBytes);
        glGenBuffers(1, &frame_buffer);
        glBindBuffer(GL_UNIFORM_BUFFER, frame_buffer);
        glBufferData(GL_UNIFORM_BUFFER, sizeof(FrameUniforms), nullptr, GL_STREAM_DRAW);
        if (options.deep) picture.keep_deep(options.background);
        if (const GLenum error = glGetError(); error != GL_NO_ERROR)
            throw RunError("OpenGL error " + std::to_string(error) + " while the scene was set up");
    }

    /// Whether the skin is translucent.
    bool looks_inside() const {
        return options.show == Show::kMuscles || options.show == Show::kSkull;
    }

    /// Places of skin that are shaded per pixel side; equal to the samples when more than 8 bits are wanted.
    int shaded_per_side() const {
        if (options.deep || looks_inside()) return options.supersampling;
        return std::max(options.supersampling / 2, 1);
    }

    /// Simplification of skin with generated colours, by the sample size of the picture.
    Coarseness coarseness() const {
        if (options.deep || looks_inside()) return {};
        const double sample_m = camera.frame_height_m / (options.height_px * options.supersampling);
        // A draft may be coarser. Its shading depends on the vertices, so the error is limited in large pictures as in small
        // ones.
        const double enough = kDraftSkin_m / (kCoarseSamples * sample_m);
        const double skin = options.draft ? std::clamp(enough, 1.5, 3.0) : 1,
                     others = options.draft ? 2 : 1;
        return {.seen_m = skin * kCoarseSamples * sample_m,
                .shadow_m = others * kCoarseShadow_m,
                .eyes_m = others * kCoarseEyeSamples * sample_m,
                .moved_m = skin * kCoarseMovedSamples * sample_m,
                .keeps_folds = !options.draft};
    }

    BakeOptions bake_options() const {
        return {.sky_reach_m = 0.75 * camera.portrait_height_m,
                .paint_side = paint_side(options.height_px / camera.frame_height_m),
                .show_muscles = options.show == Show::kMuscles};
    }

    ~Impl() {
        const GlContext::Current current(context);
        glDeleteBuffers(1, &frame_buffer);
        baked.reset();
        skin_layer.reset();
        cell_clear.reset();
        target.reset();
        lights.reset();
        materials.reset();
        hair.reset();
        worn.reset();
        tears.reset();
        sockets.reset();
        shells.reset();
        muscles.reset();
        bones.reset();
        buffers.reset();
    }

    /// Draws the skin of the layer into the cells that need samples.
    void look_up_skin(const Tile& tile) {
        target->bind_bytes();
        cell_clear->clear(cells, tile.width, tile.height);
        worn->look_up_hair(cells, *skin_layer);
        buffers->bind();
        skin_layer->use();
        for (const Batch& batch : buffers->batches())
            if (batch.material == Material::kSkin) buffers->draw(batch);
        worn->look_up_garment(cells);
        buffers->bind();
    }

    /// Draws all visible surfaces. `looked_up`: the skin is already drawn.
    void draw_surfaces(const Pose& pose, bool looked_up) {
        for (const Batch& batch : buffers->batches()) {
            if (batch.material == Material::kLashes && !baked->mesh_lashes) continue;
            if (batch.material == Material::kSkin && looked_up) continue;
            if (batch.material == Material::kSkin && !pose.values) {
                materials->draw_skin(batch, *buffers);
            } else {
                materials->use(batch, pose, marks);
                baked->own->bind(batch);
                buffers->draw(batch);
            }
        }
        materials->done();
        if (!pose.values && !looked_up) worn->draw();
        clock.passed("surfaces");
        sockets->draw();
        buffers->bind();
        shells->draw();
        tears->draw();
        hair->draw();
        buffers->bind();
        clock.passed("thin parts");
    }

    void draw_tile(const Tile& tile, const Mat4& clip_from_world, const Pose& pose,
                   FrameUniforms frame, Image& image) {
        const Eigen::Matrix4f clip = (picture.crop(tile) * clip_from_world).cast<float>();
        std::memcpy(frame.clip_from_world, clip.data(), sizeof frame.clip_from_world);
        glBindBuffer(GL_UNIFORM_BUFFER, frame_buffer);
        glBufferSubData(GL_UNIFORM_BUFFER, 0, sizeof frame, &frame);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_buffer);

        buffers->choose(clip, pose.values.has_value());
        const bool looked_up = skin_layer && !pose.values;
        if (looked_up) {
            skin_layer->begin(tile.width, tile.height);
            worn->draw();  // before the skin, which is then not shaded where it is hidden
            buffers->bind();
            for (const Batch& batch : buffers->batches())
                if (batch.material == Material::kSkin) materials->draw_skin(batch, *buffers);
            clock.passed("skin");
            cells.begin(tile.width, tile.height);
            buffers->leave_out_unseen(*skin_layer, cells, [&](PictureCells& marked) {
                if (!shells->empty()) marked.mark_all();
                hair->mark(clip, marked);
                worn->touch(clip, marked);
                tears->mark(clip, marked);
                sockets->mark(clip, marked);
            });
            clock.passed("choice");
        }
        picture.set_viewport(tile);
        if (muscles) {
            muscles->draw();
            buffers->bind();
        }
        glEnable(GL_DEPTH_TEST);
        if (looked_up) look_up_skin(tile);
        clock.passed("look up");
        target->bind();
        if (!looked_up) {
            glClearColor(0, 0, 0, 0);
            glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        }
        glEnable(GL_FRAMEBUFFER_SRGB);
        if (bones) {
            bones->draw(*buffers);
        } else {
            draw_surfaces(pose, looked_up);
        }
        glDisable(GL_FRAMEBUFFER_SRGB);
        finish_drawing();  // otherwise reading back would wait for it
        const double drawn_s = processor_s();
        if (looked_up)
            picture.read_back(tile, resolve, cells, skin_layer->places(), skin_layer->shaded(),
                              image);
        else
            picture.read_back(tile, resolve, image);
        read_back_s += processor_s() - drawn_s;
        clock.passed("reading back");
    }

    ViewOptions options;
    Appearance appearance;
    SkinBox box;
    Camera camera;
    std::vector<Mat4> views;  ///< one per point of the lens aperture
    PosedMarks marks;
    TiledPicture picture;
    Resolve resolve;
    PictureCells cells;
    Eigen::Index vertex_count;
    GlContext context;
    std::unique_ptr<SceneBuffers> buffers;
    std::unique_ptr<MuscleLayer> muscles;  ///< only with Show::kMuscles
    std::unique_ptr<BoneLayer> bones;      ///< only with Show::kSkull
    std::unique_ptr<Materials> materials;
    std::unique_ptr<StrandLayer> hair;
    std::unique_ptr<WornLayer> worn;
    std::unique_ptr<SocketLayer> sockets;
    std::unique_ptr<TearLayer> tears;
    std::unique_ptr<ShellLayer> shells;
    std::unique_ptr<Lights> lights;
    std::unique_ptr<CellClear> cell_clear;
    /// Null unless the skin is shaded at fewer places than sampled
    std::unique_ptr<SkinLayer> skin_layer;
    std::unique_ptr<Framebuffer> target;
    std::shared_ptr<BakedScene> baked;
    /// A copy per view, because it caches the last result
    std::optional<SkyAboutEyes> sky_about_eyes;
    GLuint frame_buffer = 0;
    double read_back_s = 0;
    PassClock clock;
};

OffscreenView::OffscreenView(const Scene& scene, const ViewOptions& options)
    : impl_(std::make_unique<Impl>(scene, options, nullptr)) {}

OffscreenView::OffscreenView(const Scene& scene, const OffscreenView& first)
    : impl_(std::make_unique<Impl>(scene, first.impl_->options, first.impl_.get())) {}

OffscreenView::~OffscreenView() = default;

Image OffscreenView::draw(const Pose& pose) {
    Impl& view = *impl_;
    if (pose.positions.rows() != view.vertex_count)
        throw Error("pose/positions", std::to_string(view.vertex_count) + " rows",
                    std::to_string(pose.positions.rows()));
    if (pose.fold_depth.rows() != 0 && pose.fold_depth.rows() != view.vertex_count)
        throw Error("pose/fold_depth", std::to_string(view.vertex_count) + " rows, or none",
                    std::to_string(pose.fold_depth.rows()));
    if (pose.values && static_cast<Eigen::Index>(pose.values->at.size()) != view.vertex_count)
        throw Error("pose/values", std::to_string(view.vertex_count) + " values",
                    std::to_string(pose.values->at.size()));
    const GlContext::Current current(view.context);

    // Uploads of the pose
    view.read_back_s = 0;
    view.clock.begin();
    view.buffers->bind();
    view.buffers->upload(pose.positions, pose.fold_depth);
    if (auto& sky = view.sky_about_eyes)
        view.buffers->set_occlusion(
            sky->seen({view.marks.lids_closed(pose, 0), view.marks.lids_closed(pose, 1)}),
            view.baked->inside);
    if (pose.values) view.buffers->set_colours(colours_of(*pose.values));
    if (view.muscles) view.muscles->upload(pose);
    if (view.bones) view.bones->upload(pose);
    view.hair->upload(pose, view.marks);
    if (!pose.values) view.worn->upload(pose);
    view.tears->upload(pose, view.marks);
    view.sockets->upload(pose, view.marks);

    view.clock.passed("pose");

    // Shadow of the key light
    FrameUniforms frame = view.lights->uniforms(view.marks.mouth_gap(pose));
    const Eigen::Matrix4f seen = view.views.front().cast<float>();
    view.lights->draw_shadow(*view.buffers, view.views.size() == 1 ? &seen : nullptr,
                             pose.values ? nullptr : &view.worn->locks());
    view.clock.passed("shadow");
    glActiveTexture(GL_TEXTURE0 + kPaintUnit);
    glBindTexture(GL_TEXTURE_2D, view.baked->paint_map);
    glActiveTexture(GL_TEXTURE0 + kPoreUnit);
    glBindTexture(GL_TEXTURE_2D, view.baked->pore_map);

    // The picture, tile by tile
    std::vector<Image> images;
    for (const Mat4& clip_from_world : view.views) {
        images.emplace_back(view.options.width_px, view.options.height_px);
        for (const Tile& tile : view.picture.tiles())
            view.draw_tile(tile, clip_from_world, pose, frame, images.back());
    }
    Image image = images.size() > 1 ? mean_of(images) : std::move(images.front());
    if (pose.values)
        draw_colour_scale(values_scale(*pose.values), view.options.background, image);
    else if (view.muscles)
        draw_colour_scale(activation_scale(view.appearance), view.options.background, image);
    return image;
}

Image OffscreenView::skin_texture(const Scene& scene, int side_px) const {
    Vec3 low = Vec3::Constant(1e9), high = -low;
    bool laid_out = false;
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != Material::kSkin) continue;
        laid_out = laid_out || surface.texcoords.rows() > 0;
        for (long f = 0; f < surface.triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const Vec3 p = scene.rest.row(surface.triangles(f, k)).transpose();
                low = low.cwiseMin(p);
                high = high.cwiseMax(p);
            }
    }
    if (!laid_out) throw Error("skin", "texture coordinates", "none");
    check_range("side_px", side_px, kMinSide_px, kMaxSide_px);
    const GlContext::Current current(impl_->context);
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           impl_->baked->paint_map, 0);
    const int map_side = paint_side(impl_->options.height_px / impl_->camera.frame_height_m);
    std::vector<std::uint8_t> map(4 * static_cast<std::size_t>(map_side) *
                                  static_cast<std::size_t>(map_side));
    glReadPixels(0, 0, map_side, map_side, GL_RGBA, GL_UNSIGNED_BYTE, map.data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &framebuffer);
    return unfold_paint(scene, paint_centre(scene, low, high), map, map_side,
                        unfold_part(scene, *impl_->materials, Material::kMouth, side_px, {}));
}

Image OffscreenView::part_texture(const Scene& scene, Material part, int side_px,
                                  const std::vector<double>& crown_height) const {
    static const std::map<Material, const char*> kParts{{Material::kEye, "eyes"},
                                                        {Material::kTeeth, "teeth"},
                                                        {Material::kGums, "gums"},
                                                        {Material::kTongue, "tongue"}};
    const auto named = kParts.find(part);
    if (named == kParts.end())
        throw Error("part", "eyes, teeth, gums or tongue", std::to_string(static_cast<int>(part)));
    check_range("side_px", side_px, kMinSide_px, kMaxSide_px);
    if (!crown_height.empty() && static_cast<long>(crown_height.size()) != scene.rest.rows())
        throw Error("crown_height", std::to_string(scene.rest.rows()) + " rows, or none",
                    std::to_string(crown_height.size()));
    if (std::none_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
            return surface.material == part && surface.texcoords.rows() > 0;
        }))
        throw Error(named->second, "texture coordinates", "none");
    const GlContext::Current current(impl_->context);
    Image image = unfold_part(scene, *impl_->materials, part, side_px, crown_height);
    fill_uncovered(image, mean_colour(image));
    return image;
}

Image OffscreenView::draw(const std::vector<Pose>& poses) {
    if (poses.empty()) throw Error("poses", "at least one", "none");
    if (poses.size() == 1) return draw(poses.front());
    const auto same = [](const Points& a, const Points& b) {
        return a.rows() == b.rows() && a == b;
    };
    const auto looks_as = [&](const Pose& a, const Pose& b) {
        return same(a.positions, b.positions) && a.eye_rotation == b.eye_rotation &&
               a.jaw_open == b.jaw_open && same(a.fold_depth, b.fold_depth) &&
               same(a.muscle_positions, b.muscle_positions) &&
               same(a.bone_positions, b.bone_positions) && a.activations == b.activations &&
               !a.values && !b.values;
    };
    std::vector<Image> images;
    for (std::size_t i = 0; i < poses.size(); ++i)
        images.push_back(i > 0 && looks_as(poses[i], poses[i - 1]) ? images.back()
                                                                   : draw(poses[i]));
    return mean_of(images);
}

double OffscreenView::read_back_s() const { return impl_->read_back_s; }
void OffscreenView::time_passes() { impl_->clock.turn_on(); }
const std::vector<std::pair<std::string, double>>& OffscreenView::passes_s() const {
    return impl_->clock.times();
}

Vec2 OffscreenView::project(const Vec3& world) const {
    const Eigen::Vector4d clip = impl_->camera.clip_from_world * world.homogeneous();
    return {(clip.x() / clip.w() * 0.5 + 0.5) * impl_->options.width_px,
            (0.5 - clip.y() / clip.w() * 0.5) * impl_->options.height_px};
}

Eigen::Matrix4d OffscreenView::clip_from_world() const { return impl_->camera.clip_from_world; }

}  // namespace risorius::render
