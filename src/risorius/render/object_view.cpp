// SPDX-License-Identifier: MIT
#include "risorius/render/object_view.h"

#include <cmath>
#include <cstddef>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/render/detail/framebuffer.h"
#include "risorius/render/detail/object_camera.h"
#include "risorius/render/detail/object_parts.h"
#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

ObjectViewOptions checked(const ObjectViewOptions& options) {
    check_range("width_px", options.width_px, kMinSide_px, kMaxSide_px);
    check_range("height_px", options.height_px, kMinSide_px, kMaxSide_px);
    check_range("supersampling", options.supersampling, 1, kMaxSupersampling);
    check_range("threads", options.threads, 0, 256);
    if (!std::isfinite(options.azimuth_deg))
        throw Error("azimuth_deg", "a number", format_number(options.azimuth_deg));
    if (!(std::abs(options.elevation_deg) <= 90))
        throw Error("elevation_deg", "[-90, 90]", format_number(options.elevation_deg));
    return options;
}

ObjectRow framed(const std::vector<Object>& objects, const ObjectViewOptions& options) {
    if (objects.empty()) throw Error("objects", "at least one", "none");
    std::vector<Points> all(objects.size());
    std::vector<const Points*> positions;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        check_object(objects[i], "objects/" + std::to_string(i));
        const Points &x = objects[i].positions, &outline = objects[i].outline;
        all[i].resize(x.rows() + outline.rows(), 3);
        all[i].topRows(x.rows()) = x;
        all[i].bottomRows(outline.rows()) = outline;
        positions.push_back(&all[i]);
    }
    return frame_objects(positions, object_axes(options.azimuth_deg, options.elevation_deg),
                         options.width_px, options.height_px);
}

/// The parts of one object in GL memory.
class PartBuffer {
  public:
    explicit PartBuffer(const std::vector<PartVertex>& vertices)
        : count_(static_cast<GLsizei>(vertices.size())) {
        glGenVertexArrays(1, &array_);
        glBindVertexArray(array_);
        glGenBuffers(1, &buffer_);
        glBindBuffer(GL_ARRAY_BUFFER, buffer_);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(PartVertex)),
                     vertices.data(), GL_STATIC_DRAW);
        attribute(0, 3, offsetof(PartVertex, position));
        attribute(1, 3, offsetof(PartVertex, normal));
        attribute(2, 3, offsetof(PartVertex, colour));
        attribute(3, 2, offsetof(PartVertex, place));
        attribute(4, 1, offsetof(PartVertex, kind));
    }
    ~PartBuffer() {
        glDeleteBuffers(1, &buffer_);
        glDeleteVertexArrays(1, &array_);
    }
    PartBuffer(const PartBuffer&) = delete;
    PartBuffer& operator=(const PartBuffer&) = delete;

    void draw() const {
        glBindVertexArray(array_);
        glDrawArrays(GL_TRIANGLES, 0, count_);
    }

  private:
    static void attribute(GLuint index, GLint size, std::size_t offset) {
        glEnableVertexAttribArray(index);
        glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(PartVertex),
                              reinterpret_cast<const void*>(offset));
    }

    GLsizei count_;
    GLuint array_ = 0, buffer_ = 0;
};

}  // namespace

struct ObjectView::Impl {
    Impl(const std::vector<Object>& objects, const ObjectViewOptions& view_options)
        : options(checked(view_options)),
          row(framed(objects, options)),
          picture(options.width_px, options.height_px, options.supersampling),
          resolve(Background{.transparent = false, .rgb = {1, 1, 1}}),
          context(options.threads) {
        const GlContext::Current current(context);
        for (std::size_t i = 0; i < objects.size(); ++i)
            buffers.push_back(
                std::make_unique<PartBuffer>(object_parts(objects[i], row, row.cameras[i])));
        program = std::make_unique<GlProgram>("object", object_vertex_shader(), object_shader());
        target = std::make_unique<Framebuffer>(picture.tile_width_samples(),
                                               picture.tile_height_samples());
        if (const GLenum error = glGetError(); error != GL_NO_ERROR)
            throw RunError("OpenGL error " + std::to_string(error) +
                           " while the objects were set up");
    }

    ~Impl() {
        const GlContext::Current current(context);
        target.reset();
        program.reset();
        buffers.clear();
    }

    ObjectViewOptions options;
    ObjectRow row;
    TiledPicture picture;
    Resolve resolve;
    GlContext context;
    std::vector<std::unique_ptr<PartBuffer>> buffers;
    std::unique_ptr<GlProgram> program;
    std::unique_ptr<Framebuffer> target;
};

ObjectView::ObjectView(const std::vector<Object>& objects, const ObjectViewOptions& options)
    : impl_(std::make_unique<Impl>(objects, options)) {}

ObjectView::~ObjectView() = default;

Image ObjectView::draw() {
    Impl& view = *impl_;
    const GlContext::Current current(view.context);
    Image image(view.options.width_px, view.options.height_px);
    view.program->use();
    view.target->bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_FRAMEBUFFER_SRGB);  // blend in linear light
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (const Tile& tile : view.picture.tiles()) {
        view.picture.set_viewport(tile);
        glClearColor(1, 1, 1, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        for (std::size_t i = 0; i < view.buffers.size(); ++i) {
            const Eigen::Matrix4f clip =
                (view.picture.crop(tile) * view.row.cameras[i].clip_from_world).cast<float>();
            glUniformMatrix4fv(view.program->location("clip_from_world"), 1, GL_FALSE, clip.data());
            view.buffers[i]->draw();
        }
        // The samples are already encoded in sRGB.
        glDisable(GL_FRAMEBUFFER_SRGB);
        finish_drawing();
        view.picture.read_back(tile, view.resolve, image);
        glEnable(GL_FRAMEBUFFER_SRGB);
    }
    glDisable(GL_BLEND);
    glDisable(GL_FRAMEBUFFER_SRGB);
    return image;
}

Vec2 ObjectView::project(std::size_t object, const Vec3& point) const {
    const Eigen::Vector4d clip =
        impl_->row.cameras.at(object).clip_from_world * point.homogeneous();
    return {(clip.x() / clip.w() * 0.5 + 0.5) * impl_->options.width_px,
            (0.5 - clip.y() / clip.w() * 0.5) * impl_->options.height_px};
}

}  // namespace risorius::render
