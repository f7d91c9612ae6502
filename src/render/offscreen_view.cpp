#include "render/offscreen_view.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/error.h"
#include "render/detail/camera.h"
#include "render/detail/gl_context.h"
#include "render/detail/lights.h"
#include "render/detail/materials.h"
#include "render/detail/occlusion.h"
#include "render/detail/posed_marks.h"
#include "render/detail/resolve.h"
#include "render/detail/scene_buffers.h"
#include "render/detail/shaders.h"
#include "render/detail/skin_paint.h"

namespace risorius::render {
namespace {

constexpr int kLeastSide_px = 16;
constexpr int kMostSide_px = 8192;
constexpr int kMostSupersampling = 4;
constexpr int kTileSide_samples = 4096;  ///< of the framebuffer; larger pictures are drawn in tiles

int checked(const char* field, int value, int least, int most) {
    if (value < least || value > most)
        throw Error(field, std::to_string(least) + ".." + std::to_string(most),
                    std::to_string(value));
    return value;
}

ViewOptions checked(ViewOptions options) {
    checked("width_px", options.width_px, kLeastSide_px, kMostSide_px);
    checked("height_px", options.height_px, kLeastSide_px, kMostSide_px);
    checked("supersampling", options.supersampling, 1, kMostSupersampling);
    checked("threads", options.threads, 0, 256);
    return options;
}

struct Box {
    Vec3 min = Vec3::Constant(1e9), max = Vec3::Constant(-1e9);
};

Box skin_box(const Scene& scene) {
    Box box;
    for (const Surface& surface : scene.surfaces) {
        if (surface.material != Material::kSkin) continue;
        for (Eigen::Index i = 0; i < surface.triangles.size(); ++i) {
            const int v = surface.triangles.data()[i];
            if (v < 0 || v >= scene.rest.rows())
                continue;  // reported with its place by SceneBuffers
            box.min = box.min.cwiseMin(scene.rest.row(v).transpose());
            box.max = box.max.cwiseMax(scene.rest.row(v).transpose());
        }
    }
    if (box.min.x() > box.max.x()) throw Error("scene/surfaces", "a skin surface", "none");
    return box;
}

/// Colour and depth of one tile.
class Target {
  public:
    Target(int width, int height) {
        glGenRenderbuffers(2, buffers_);
        glBindRenderbuffer(GL_RENDERBUFFER, buffers_[0]);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, width, height);
        glBindRenderbuffer(GL_RENDERBUFFER, buffers_[1]);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
        glGenFramebuffers(1, &framebuffer_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                  buffers_[0]);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                  buffers_[1]);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw RunError("the OpenGL framebuffer is incomplete");
    }
    ~Target() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteRenderbuffers(2, buffers_);
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;
    void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }

  private:
    GLuint buffers_[2] = {0, 0};
    GLuint framebuffer_ = 0;
};

}  // namespace

struct OffscreenView::Impl {
    Impl(const Scene& scene, const ViewOptions& view_options)
        : options(checked(view_options)),
          box(skin_box(scene)),
          camera(make_camera(options.camera, scene.landmarks, box.min, box.max,
                             static_cast<double>(options.width_px) / options.height_px)),
          marks(scene),
          resolve(options.background),
          vertex_count(scene.rest.rows()),
          context(options.threads) {
        const GlContext::Current current(context);
        const Vec3 centre = paint_centre(scene, box.min, box.max);
        buffers = std::make_unique<SceneBuffers>(scene, camera.position, centre);
        const int side = kTileSide_samples / options.supersampling;
        tile_width = std::min(options.width_px, side);
        tile_height = std::min(options.height_px, side);
        samples.resize(static_cast<std::size_t>(tile_width) *
                       static_cast<std::size_t>(tile_height) *
                       static_cast<std::size_t>(options.supersampling * options.supersampling) * 4);

        // Baked once: how much sky the skin sees, and its paint
        const double reach = 0.75 * camera.frame_height_m;
        const std::vector<float> sky =
            sky_seen_at_rest(scene.rest, buffers->normals(), buffers->index_count(), centre, reach);
        const std::vector<float> inside = marks.inside_mouth(scene, sky);
        buffers->set_occlusion(sky, inside);
        paint_map = paint_skin(scene, centre, buffers->paintable_triangles(inside));
        pore_map = make_pores(scene.look.seed);

        buffers->bind();
        materials = std::make_unique<Materials>(scene, *buffers);
        lights = std::make_unique<Lights>(camera, centre);
        target = std::make_unique<Target>(tile_width * options.supersampling,
                                          tile_height * options.supersampling);
        glGenBuffers(1, &frame_buffer);
        glBindBuffer(GL_UNIFORM_BUFFER, frame_buffer);
        glBufferData(GL_UNIFORM_BUFFER, sizeof(FrameUniforms), nullptr, GL_STREAM_DRAW);
        if (const GLenum error = glGetError(); error != GL_NO_ERROR)
            throw RunError("OpenGL error " + std::to_string(error) + " while the scene was set up");
    }

    ~Impl() {
        const GlContext::Current current(context);
        glDeleteBuffers(1, &frame_buffer);
        glDeleteTextures(1, &paint_map);
        glDeleteTextures(1, &pore_map);
        target.reset();
        lights.reset();
        materials.reset();
        buffers.reset();
    }

    void draw_tile(const Tile& tile, const Pose& pose, FrameUniforms frame) {
        // The tile's part of clip space fills the viewport.
        const double w = options.width_px, h = options.height_px;
        Mat4 crop = Mat4::Identity();
        crop(0, 0) = w / tile.width;
        crop(1, 1) = h / tile.height;
        crop(0, 3) = (w - 2.0 * tile.x - tile.width) / tile.width;
        crop(1, 3) = (2.0 * tile.y + tile.height - h) / tile.height;
        const Eigen::Matrix4f clip = (crop * camera.clip_from_world).cast<float>();
        std::memcpy(frame.clip_from_world, clip.data(), sizeof frame.clip_from_world);
        glBindBuffer(GL_UNIFORM_BUFFER, frame_buffer);
        glBufferSubData(GL_UNIFORM_BUFFER, 0, sizeof frame, &frame);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_buffer);

        target->bind();
        glViewport(0, 0, tile.width * options.supersampling, tile.height * options.supersampling);
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_FRAMEBUFFER_SRGB);
        for (const Batch& batch : buffers->batches()) {
            materials->use(batch, pose, marks);
            buffers->draw(batch);
        }
        materials->done();
        glDisable(GL_FRAMEBUFFER_SRGB);
        glReadPixels(0, 0, tile.width * options.supersampling, tile.height * options.supersampling,
                     GL_RGBA, GL_UNSIGNED_BYTE, samples.data());
    }

    ViewOptions options;
    Box box;
    Camera camera;
    PosedMarks marks;
    Resolve resolve;
    Eigen::Index vertex_count;
    GlContext context;
    std::unique_ptr<SceneBuffers> buffers;
    std::unique_ptr<Materials> materials;
    std::unique_ptr<Lights> lights;
    std::unique_ptr<Target> target;
    GLuint paint_map = 0, pore_map = 0, frame_buffer = 0;
    int tile_width = 0, tile_height = 0;
    std::vector<std::uint8_t> samples;
};

OffscreenView::OffscreenView(const Scene& scene, const ViewOptions& options)
    : impl_(std::make_unique<Impl>(scene, options)) {}

OffscreenView::~OffscreenView() = default;

Image OffscreenView::draw(const Pose& pose) {
    Impl& view = *impl_;
    if (pose.positions.rows() != view.vertex_count)
        throw Error("pose/positions", std::to_string(view.vertex_count) + " rows",
                    std::to_string(pose.positions.rows()));
    const GlContext::Current current(view.context);

    // What moved
    view.buffers->bind();
    view.buffers->upload(pose.positions);

    // Shadow of the key light
    FrameUniforms frame = view.lights->uniforms(view.marks.mouth_gap(pose));
    view.lights->draw_shadow(*view.buffers);
    glActiveTexture(GL_TEXTURE0 + kPaintUnit);
    glBindTexture(GL_TEXTURE_2D, view.paint_map);
    glActiveTexture(GL_TEXTURE0 + kPoreUnit);
    glBindTexture(GL_TEXTURE_2D, view.pore_map);

    // The picture, tile by tile
    Image image(view.options.width_px, view.options.height_px);
    for (int y = 0; y < image.height_px; y += view.tile_height)
        for (int x = 0; x < image.width_px; x += view.tile_width) {
            const Tile tile{x, y, std::min(view.tile_width, image.width_px - x),
                            std::min(view.tile_height, image.height_px - y)};
            view.draw_tile(tile, pose, frame);
            view.resolve(view.samples, view.options.supersampling, tile, image);
        }
    return image;
}

Vec2 OffscreenView::project(const Vec3& world) const {
    const Eigen::Vector4d clip = impl_->camera.clip_from_world * world.homogeneous();
    return {(clip.x() / clip.w() * 0.5 + 0.5) * impl_->options.width_px,
            (0.5 - clip.y() / clip.w() * 0.5) * impl_->options.height_px};
}

}  // namespace risorius::render
