// SPDX-License-Identifier: MIT
#include "risorius/render/detail/shell_layer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "risorius/render/detail/paint_strokes.h"
#include "risorius/render/detail/shaders.h"
#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

constexpr int kLengthSide = 512;  ///< texels of the map of lengths
/// Between shells; small enough that the slant of hairs hides the gaps
constexpr double kShellGap_m = 0.0003;
constexpr int kFewestShells = 8, kMaxShells = 40;

double smooth(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// Length of the hair as a fraction of its full length, for scalp and beard, at places of the paint map.
class Lengths {
  public:
    Lengths(const Scene& scene, const SkinPlan& plan, const Vec3& centre,
            const std::vector<unsigned>& skin)
        : texels_(2 * kLengthSide * kLengthSide, 0) {
        const EarMask ears(scene, plan, centre, skin);
        if (scene.appearance.hair_length_mm > 0 && plan.hairline[0] < 1)
            for (int y = 0; y < kLengthSide; ++y)
                for (int x = 0; x < kLengthSide; ++x) {
                    const Vec2 place((x + 0.5) / kLengthSide, (y + 0.5) / kLengthSide);
                    const double radius = (place - Vec2(0.5, 0.5)).norm();
                    if (radius > 0.5 || ears.at(place)) continue;
                    texel(x, y, 0) =
                        byte(smooth(-0.004, 0.060, radius - hairline_radius(plan, place)));
                }
        if (scene.appearance.beard_length_mm <= 0) return;
        // The density of a beard is given by position in space, so it is painted triangle by triangle.
        for (std::size_t i = 0; i + 2 < skin.size(); i += 3) {
            std::array<Vec3, 3> p;
            double max = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = scene.rest.row(static_cast<Eigen::Index>(skin[i + k])).transpose();
                max = std::max(max, beard_density(plan, p[k]));
            }
            if (max <= 0) continue;
            constexpr int kSteps = 12;
            for (int a = 0; a <= kSteps; ++a)
                for (int b = 0; a + b <= kSteps; ++b) {
                    const Vec3 q = (a * p[0] + b * p[1] + (kSteps - a - b) * p[2]) / kSteps;
                    if (inside_lips(plan, q)) continue;
                    const Vec2 place = paint_place(q, centre);
                    const auto at = [](double v) {
                        return std::clamp(static_cast<int>(v * kLengthSide), 0, kLengthSide - 1);
                    };
                    std::uint8_t& there = texel(at(place.x()), at(place.y()), 1);
                    there = std::max(there, byte(beard_density(plan, q)));
                }
        }
    }
    const std::vector<std::uint8_t>& texels() const { return texels_; }
    bool any_at(const Vec2& place) const {
        const auto at = [](double v) {
            return std::clamp(static_cast<int>(v * kLengthSide), 0, kLengthSide - 1);
        };
        const std::size_t i = index(at(place.x()), at(place.y()));
        return texels_[i] > 0 || texels_[i + 1] > 0;
    }

  private:
    static std::uint8_t byte(double fraction) {
        return static_cast<std::uint8_t>(std::lround(255 * fraction));
    }
    static std::size_t index(int x, int y) {
        return 2 * (static_cast<std::size_t>(y) * kLengthSide + static_cast<std::size_t>(x));
    }
    std::uint8_t& texel(int x, int y, std::size_t channel) {
        return texels_[index(x, y) + channel];
    }
    std::vector<std::uint8_t> texels_;
};

}  // namespace

ShellLayer::ShellLayer(const Scene& scene, const SceneBuffers& buffers, const SkinPlan& plan,
                       const Vec3& paint_centre, const std::vector<unsigned>& skin,
                       ShaderConstants constants) {
    const double hair_m = 1e-3 * scene.appearance.hair_length_mm,
                 beard_m = 1e-3 * scene.appearance.beard_length_mm;
    if (std::max(hair_m, beard_m) <= 0 || has_own_skin(scene)) return;
    const Lengths lengths(scene, plan, paint_centre, skin);
    std::vector<unsigned> indices;
    for (std::size_t i = 0; i + 2 < skin.size(); i += 3) {
        bool hairy = false;
        Vec3 middle = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = scene.rest.row(static_cast<Eigen::Index>(skin[i + k])).transpose();
            middle += p / 3;
            hairy |= lengths.any_at(paint_place(p, paint_centre));
        }
        bool ear = false;
        for (std::size_t k = 0; k < 3; ++k)
            for (const EarRegion& region : plan.ears)
                ear |= region.contains(
                    scene.rest.row(static_cast<Eigen::Index>(skin[i + k])).transpose());
        if (ear) continue;
        if (hairy || lengths.any_at(paint_place(middle, paint_centre)))
            indices.insert(indices.end(), {skin[i], skin[i + 1], skin[i + 2]});
    }
    if (indices.empty()) return;
    indices = buffers.elements(indices);
    index_count_ = static_cast<int>(indices.size());
    shells_ = std::clamp(static_cast<int>(std::max(hair_m, beard_m) / kShellGap_m), kFewestShells,
                         kMaxShells);

    GLint outer = 0;
    glGetIntegerv(GL_ELEMENT_ARRAY_BUFFER_BINDING, &outer);
    glGenBuffers(1, &elements_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices.size() * sizeof(unsigned)), indices.data(),
                 GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLuint>(outer));
    glGenTextures(1, &lengths_);
    glBindTexture(GL_TEXTURE_2D, lengths_);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RG8, kLengthSide, kLengthSide);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kLengthSide, kLengthSide, GL_RG, GL_UNSIGNED_BYTE,
                    lengths.texels().data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);

    const auto crown = scene.landmarks.find("v");
    const Vec3 top =
        crown != scene.landmarks.end() ? crown->second : paint_centre + Vec3(0, 0.12, 0);
    constants.set("whorl", Vec3(top + Vec3(0.008, 0, -0.03)));
    constants.set("centre", paint_centre);
    constants.set("hair_tone", linear_from_srgb(hair_tone_at(scene.appearance)));
    constants.set("full_length", Vec2(hair_m, beard_m));
    constants.set("shells", static_cast<double>(shells_));
    program_ = std::make_unique<GlProgram>("shells", constants.in(shell_vertex_shader()),
                                           constants.in(shell_shader()));
}

ShellLayer::~ShellLayer() {
    glDeleteBuffers(1, &elements_);
    glDeleteTextures(1, &lengths_);
}

void ShellLayer::draw() const {
    if (!program_) return;
    program_->use();
    glActiveTexture(GL_TEXTURE0 + kHairLengthUnit);
    glBindTexture(GL_TEXTURE_2D, lengths_);
    GLint outer = 0;
    glGetIntegerv(GL_ELEMENT_ARRAY_BUFFER_BINDING, &outer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, elements_);
    glDrawElementsInstanced(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr, shells_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLuint>(outer));
}

}  // namespace risorius::render
