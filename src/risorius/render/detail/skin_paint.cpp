// SPDX-License-Identifier: MIT
#include "risorius/render/detail/skin_paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "risorius/core/srgb.h"
#include "risorius/render/detail/crease_strokes.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/own_textures.h"
#include "risorius/render/detail/paint_strokes.h"
#include "risorius/render/detail/scene_buffers.h"
#include "risorius/render/detail/shader_paint.h"
#include "risorius/render/detail/skin_plan.h"

namespace risorius::render {
namespace {

void set_plan(const GlProgram& program, const SkinPlan& plan, const Appearance& appearance) {
    const auto colour = [&](const char* name, const Vec3& tone) {
        const Eigen::Vector3f linear = tone.cast<float>();
        glUniform3fv(program.location(name), 1, linear.data());
    };
    colour("skin_tone", linear_from_srgb(appearance.skin_tone));
    colour("lip_tone", lip_tone_at(appearance));
    colour("hair_tone", linear_from_srgb(hair_tone_at(appearance)));
    glUniform1f(program.location("scalp_hair"), static_cast<float>(scalp_paint(appearance)));
    glUniform1f(program.location("ring"), static_cast<float>(plan.ring_m));
    // Below a cap of locks the skin is dark up to its border, or that would show as a line.
    if (has_cap(appearance, plan))
        glUniform2f(program.location("hair_begins"), -0.004F, 0.012F);
    else
        glUniform2f(program.location("hair_begins"), -0.010F, 0.042F);
    glUniform1f(program.location("seed"), static_cast<float>(appearance.seed % 1000));

    std::vector<float> place, log_tint, oil;
    for (const SkinZone& zone : plan.zones) {
        for (int k = 0; k < 3; ++k) place.push_back(static_cast<float>(zone.centre[k]));
        place.push_back(static_cast<float>(0.5 / (zone.spread_m * zone.spread_m)));
        for (int k = 0; k < 3; ++k) log_tint.push_back(static_cast<float>(zone.log_tint[k]));
        log_tint.push_back(static_cast<float>(zone.oil));
    }
    const auto zones = static_cast<GLsizei>(plan.zones.size());
    glUniform1i(program.location("zones"), zones);
    if (zones > 0) {
        glUniform4fv(program.location("zone_place"), zones, place.data());
        glUniform4fv(program.location("zone_tint"), zones, log_tint.data());
    }

    glUniform1f(program.location("age"), static_cast<float>(appearance.age));
    glUniform1f(program.location("mottling"), static_cast<float>(appearance.mottling));
    glUniform1f(program.location("beard"), static_cast<float>(appearance.beard));
    glUniform1f(program.location("white_beard"),
                static_cast<float>(white_share_of_beard(appearance)));
    glUniform1f(program.location("trimmed"), plan.trimmed ? 1.0F : 0.0F);
    std::vector<float> beard;
    for (const SkinZone& zone : plan.beard) {
        for (int k = 0; k < 3; ++k) beard.push_back(static_cast<float>(zone.centre[k]));
        beard.push_back(static_cast<float>(0.5 / (zone.spread_m * zone.spread_m)));
    }
    const auto spots = static_cast<GLsizei>(appearance.beard > 0 ? plan.beard.size() : 0);
    glUniform1i(program.location("beard_places"), spots);
    if (spots > 0) glUniform4fv(program.location("beard_place"), spots, beard.data());

    std::vector<float> lips;
    Vec2 low(1e3, 1e3), high(-1e3, -1e3);
    for (const Vec3& p : plan.lip_outline) {
        lips.push_back(static_cast<float>(p.x()));
        lips.push_back(static_cast<float>(p.y()));
        low = low.cwiseMin(p.head<2>());
        high = high.cwiseMax(p.head<2>());
    }
    const auto points = static_cast<GLsizei>(plan.lip_outline.size());
    glUniform1i(program.location("lip_points"), points);
    if (points > 0) glUniform2fv(program.location("lip_outline"), points, lips.data());
    glUniform4f(program.location("lip_box"), static_cast<float>(low.x() - 0.006),
                static_cast<float>(low.y() - 0.006), static_cast<float>(high.x() + 0.006),
                static_cast<float>(high.y() + 0.006));
    glUniform1f(program.location("lip_back"), static_cast<float>(plan.lip_back_m));

    std::vector<float> hairline;
    for (const double r : plan.hairline) hairline.push_back(static_cast<float>(r));
    glUniform1fv(program.location("hairline"), static_cast<GLsizei>(hairline.size()),
                 hairline.data());
    std::vector<float> ear_low, ear_high;
    for (const EarRegion& ear : plan.ears) {
        for (int k = 0; k < 3; ++k) {
            ear_low.push_back(ear.known ? static_cast<float>(ear.low[k]) : 1.0F);
            ear_high.push_back(ear.known ? static_cast<float>(ear.high[k]) : -1.0F);
        }
        ear_low.push_back(static_cast<float>(ear.out_m));
        ear_high.push_back(static_cast<float>(ear.lean));
    }
    glUniform4fv(program.location("ear_low"), 2, ear_low.data());
    glUniform4fv(program.location("ear_high"), 2, ear_high.data());
}

}  // namespace

Vec3 linear_from_srgb(const Vec3& srgb) {
    return srgb.unaryExpr([](double encoded) { return linear_of_srgb(encoded); });
}

double skin_darkness(const Vec3& tone) {
    return std::clamp((0.30 - tone.dot(Vec3(0.2126, 0.7152, 0.0722))) / 0.25, 0.0, 1.0);
}

Vec2 paint_place(const Vec3& rest, const Vec3& centre) {
    const Vec3 d = (rest - centre).normalized();
    const double scale = std::sqrt(2 / std::max(1 + d.z(), 1e-6));
    return Vec2(0.5, 0.5) + 0.25 * scale * d.head<2>();
}

Vec3 paint_centre(const Scene& scene, const Vec3& skin_min, const Vec3& skin_max) {
    const auto left = scene.landmarks.find("t_l"), right = scene.landmarks.find("t_r");
    if (left != scene.landmarks.end() && right != scene.landmarks.end())
        return (left->second + right->second) / 2;
    return (skin_min + skin_max) / 2;
}

int paint_side(double pixels_per_metre) {
    // Length of a metre of skin on the map (for a head of 0.1 m radius), and texels per pixel: a quarter more than one.
    constexpr double kMapPerMetre = 2.5, kTexelsPerPixel = 1.25;
    int side = kMinPaintSide;
    while (side < kMaxPaintSide && side * kMapPerMetre < kTexelsPerPixel * pixels_per_metre)
        side *= 2;
    return side;
}

GLuint make_paint_map(int side, const std::vector<std::uint8_t>& texels) {
    GLuint map = 0;
    glGenTextures(1, &map);
    glBindTexture(GL_TEXTURE_2D, map);
    int levels = 1;
    while ((side >> levels) > 0) ++levels;
    glTexStorage2D(GL_TEXTURE_2D, levels, GL_RGBA8, side, side);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    return map;
}

std::vector<std::uint8_t> paint_skin(const Scene& scene, const SceneBuffers& buffers,
                                     const OwnTextures& own, const Vec3& centre,
                                     const std::vector<unsigned>& triangles, int side) {
    GLuint colour = 0, depth = 0, framebuffer = 0, elements = 0;
    glGenRenderbuffers(1, &colour);
    glBindRenderbuffer(GL_RENDERBUFFER, colour);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, side, side);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, side, side);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);

    const SkinPlan plan = plan_skin(scene, centre);
    const Eigen::Vector3f bare =
        linear_from_srgb(scene.appearance.skin_tone).cwiseSqrt().cast<float>();
    glViewport(0, 0, side, side);
    glClearColor(bare.x(), bare.y(), bare.z(), 0.4F);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);

    // No triangle covers the map between the lips, but their inner sides look it up. It gets the tone of the lips.
    glDisable(GL_DEPTH_TEST);
    draw_strokes(plan_lip_ground(scene, plan, centre));
    glEnable(GL_DEPTH_TEST);

    // Where the surface folds, the outermost layer is the visible one.
    {
        const GlProgram program("paint", paint_vertex_shader(), paint_fragment_shader());
        program.use();
        const Eigen::Vector3f middle = centre.cast<float>();
        glUniform3fv(program.location("centre"), 1, middle.data());
        set_plan(program, plan, scene.appearance);
        GLint outer = 0;  // state of the vertex array, which belongs to the caller
        glGetIntegerv(GL_ELEMENT_ARRAY_BUFFER_BINDING, &outer);
        glGenBuffers(1, &elements);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements);
        const std::vector<unsigned> numbers = buffers.elements(triangles);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                     static_cast<GLsizeiptr>(numbers.size() * sizeof(unsigned)), numbers.data(),
                     GL_STATIC_DRAW);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(numbers.size()), GL_UNSIGNED_INT,
                       nullptr);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLuint>(outer));
        glDeleteBuffers(1, &elements);
    }

    // Hair and freckles over the skin, or the texture that shows them
    if (has_own_skin(scene)) own.paint_skin(scene, centre, triangles);
    glDisable(GL_DEPTH_TEST);
    if (!has_own_skin(scene)) draw_strokes(plan_creases(scene, centre));
    if (!has_own_skin(scene)) draw_strokes(plan_strokes(scene, plan, centre, triangles));
    glEnable(GL_DEPTH_TEST);

    std::vector<std::uint8_t> texels(4 * static_cast<std::size_t>(side) *
                                     static_cast<std::size_t>(side));
    glReadPixels(0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    glActiveTexture(GL_TEXTURE0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &colour);
    glDeleteRenderbuffers(1, &depth);
    return texels;
}

GLuint make_pores(unsigned seed) {
    constexpr int kSide = 512;  // of a 20 mm tile
    constexpr int kPoreCount = 5200;
    constexpr auto kCount = static_cast<std::size_t>(kSide) * kSide;
    std::vector<float> height(kCount, 0.0F);
    RandomSequence random(seed * 7919U + 17U);
    const auto wrap = [](int i) { return static_cast<std::size_t>((i + 4 * kSide) % kSide); };

    // Pits of some hundredths of a square millimetre at most, many small and few large, denser in some places than in others,
    // with a shallow lattice between them
    const auto crowded = [](double x, double y) {
        const double u = 2 * std::numbers::pi * x / kSide, v = 2 * std::numbers::pi * y / kSide;
        return 0.60 + 0.20 * std::sin(2 * u + std::sin(v)) + 0.20 * std::sin(3 * v - u + 1.0);
    };
    for (int i = 0; i < kPoreCount; ++i) {
        const double cx = random.next() * kSide, cy = random.next() * kSide;
        const double large = std::pow(random.next(), 3.0), shallow = random.next();
        if (random.next() > crowded(cx, cy)) continue;
        const double radius = 1.7 + 3.6 * large, depth = (0.35 + 0.75 * shallow) * (1 + large);
        const int reach = static_cast<int>(3 * radius);
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx) {
                const int x = static_cast<int>(cx) + dx, y = static_cast<int>(cy) + dy;
                const double q = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (radius * radius);
                height[wrap(y) * kSide + wrap(x)] -= static_cast<float>(depth * std::exp(-q));
            }
    }
    std::vector<std::uint8_t> slopes(2 * kCount);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const auto at = [&](int i, int j) { return height[wrap(j) * kSide + wrap(i)]; };
            const float sx = at(x + 1, y) - at(x - 1, y), sy = at(x, y + 1) - at(x, y - 1);
            const std::size_t i = 2 * (wrap(y) * kSide + wrap(x));
            slopes[i] = static_cast<std::uint8_t>(std::clamp(127.5F + 110 * sx, 0.0F, 255.0F));
            slopes[i + 1] = static_cast<std::uint8_t>(std::clamp(127.5F + 110 * sy, 0.0F, 255.0F));
        }
    return make_repeating_texture(kSide, kSide, slopes);
}

}  // namespace risorius::render
