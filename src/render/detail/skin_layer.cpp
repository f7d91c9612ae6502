#include "render/detail/skin_layer.h"

#include "core/error.h"
#include "render/detail/shaders.h"

namespace risorius::render {

SkinLayer::SkinLayer(int width_px, int height_px, int samples, int shaded)
    : shaded_(shaded), program_("skin looked up", lookup_vertex_shader(), lookup_shader()) {
    const int width = width_px * shaded, height = height_px * shaded;
    program_.use();
    glUniform1f(program_.location("shaded_per_sample"),
                static_cast<float>(shaded) / static_cast<float>(samples));

    // One store in two lights: sRGB to shade into, and its bytes to copy from
    glGenTextures(1, &colour_);
    glBindTexture(GL_TEXTURE_2D, colour_);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, width, height);
    glGenTextures(1, &bytes_);
    glTextureView(bytes_, GL_TEXTURE_2D, colour_, GL_RGBA8, 0, 1, 0, 1);
    glBindTexture(GL_TEXTURE_2D, bytes_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glGenRenderbuffers(1, &depth_);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw RunError("the OpenGL framebuffer of the skin is incomplete");
}

SkinLayer::~SkinLayer() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &depth_);
    glDeleteTextures(1, &bytes_);
    glDeleteTextures(1, &colour_);
}

void SkinLayer::begin(int width_px, int height_px) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, width_px * shaded_, height_px * shaded_);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_FRAMEBUFFER_SRGB);
}

void SkinLayer::use() const {
    glActiveTexture(GL_TEXTURE0 + kSkinLayerUnit);
    glBindTexture(GL_TEXTURE_2D, bytes_);
    program_.use();
}

}  // namespace risorius::render
