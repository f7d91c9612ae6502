// SPDX-License-Identifier: MIT
#include "risorius/render/detail/paint_strokes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "risorius/render/detail/complexion.h"
#include "risorius/render/detail/gl_context.h"
#include "risorius/render/detail/lock_style.h"
#include "risorius/render/detail/shader_paint.h"
#include "risorius/render/detail/skin_paint.h"
#include "risorius/render/detail/strand_texture.h"

namespace risorius::render {
namespace {

/// Length on the map per metre on a sphere of 0.1 m radius, at the centre of the map
constexpr double kMapPerMetre = 2.5;

class StrokePad {
  public:
    /// Adds a tapering quad from root to tip on the map.
    void add(const Vec2& root, const Vec2& tip, double half_width, const Vec3& linear,
             double opacity) {
        const Vec2 along = tip - root;
        const double length = along.norm();
        if (length <= 0) return;
        const Vec2 across = Vec2(-along.y(), along.x()) * (half_width / length);
        const Eigen::Vector3f c = linear.cwiseSqrt().cast<float>();
        const auto corner = [&](const Vec2& p, float t, float s) {
            vertices_.push_back({{static_cast<float>(p.x()), static_cast<float>(p.y())},
                                 {t, s},
                                 {c.x(), c.y(), c.z(), static_cast<float>(opacity)}});
        };
        corner(root - across, 0, -1);
        corner(root + across, 0, 1);
        corner(tip + across, 1, 1);
        corner(root - across, 0, -1);
        corner(tip + across, 1, 1);
        corner(tip - across, 1, -1);
    }
    std::vector<StrokeVertex> take() { return std::move(vertices_); }

  private:
    std::vector<StrokeVertex> vertices_;
};

/// Tone of one short hair, linear; see is_white_hair()
Vec3 tone_of_hair(const Appearance& appearance, double draw, double whites) {
    return linear_from_srgb(is_white_hair(draw, whites) ? kWhiteHair : dark_hair_tone(appearance));
}

/// The ground of a brow: shadows of its hairs and the finest hairs.
void brow(const Scene& scene, const std::vector<Vec3>& line, const Vec3& centre,
          RandomSequence& random, StrokePad& pad) {
    if (line.size() < 3) return;
    const int hairs = brow_hairs(scene.appearance, 420);
    const double width = scene.appearance.brow_width,
                 whites = white_share_of_brows(scene.appearance);
    for (int i = 0; i < hairs; ++i) {
        const BrowHair next = next_brow_hair(line, width, centre, random);
        const double shade = 0.7 + 0.7 * random.next(), density = 0.22 + 0.16 * random.next();
        const Vec2 tip = next.root + kMapPerMetre * next.length_m * next.step.normalized();
        const Vec3 hair = tone_of_hair(scene.appearance, shade, whites);
        pad.add(next.root, tip, kMapPerMetre * 0.00022, hair * shade, density * next.density);
    }
}

/// Whether a place of the map lies on the bald crown, for a head of 0.105 m radius.
bool on_bald_crown(const SkinPlan& plan, const Vec2& place, const Vec3& centre) {
    if (plan.ring_m > 100) return false;
    constexpr double kRadius_m = 0.105;
    const Vec2 off = place - Vec2(0.5, 0.5);
    const double z = 1 - 8 * off.squaredNorm(), scale = 4 / std::sqrt(2 / std::max(1 + z, 1e-6));
    const Vec3 at = centre + kRadius_m * Vec3(scale * off.x(), scale * off.y(), z);
    return at.y() + SkinPlan::kRingSlope * at.z() > plan.ring_m;
}

/// Cropped hair beyond the hairline, combed away from the whorl at the crown.
void scalp(const Scene& scene, const SkinPlan& plan, const Vec3& centre, const EarMask& ears,
           RandomSequence& random, StrokePad& pad) {
    const double scalp_hair = scalp_paint(scene.appearance);
    // Combed locks begin at the border and hide it.
    const LockStyle* style = lock_style(scene.appearance.hair_style);
    const bool bordered = has_cap(scene.appearance, plan) && style->flow != HairFlow::kParting;
    if (scalp_hair <= 0 || plan.hairline[0] > 1) return;
    const double outside = has_cap(scene.appearance, plan) && !bordered ? 0.0 : 0.22;
    // Roots follow the low-discrepancy sequence of the plastic number (Roberts 2018); plain random points leave bald spots and
    // clusters.
    constexpr int kHairs = 170000;
    constexpr double kPlastic = 1.32471795724474602596;
    const Vec3 hair = linear_from_srgb(hair_tone_at(scene.appearance));
    const auto crown = scene.landmarks.find("v");
    const Vec3 top = crown != scene.landmarks.end() ? crown->second : centre + Vec3(0, 0.12, 0);
    const Vec2 whorl = paint_place(top + Vec3(0.008, 0, -0.03), centre);
    for (int i = 0; i < kHairs; ++i) {
        const double u = (i + 0.5) / kPlastic, v = (i + 0.5) / (kPlastic * kPlastic);
        const double radius = 0.5 * std::sqrt(u - std::floor(u));
        const double turn = 2 * std::numbers::pi * (v - std::floor(v));
        const double keep = random.next(), length_draw = random.next(), bend = random.next(),
                     shade = random.next();
        const Vec2 root = Vec2(0.5, 0.5) + radius * Vec2(std::sin(turn), std::cos(turn));
        // The hairline is ragged, and thins out over a centimetre.
        // Over forehead and temples roots stand closer, and break the border of a cap of locks.
        const double front = bordered ? std::clamp((root.y() - 0.5) / 0.08, 0.0, 1.0) : 0.0;
        const double inside = (1 + front) * (radius - hairline_radius(plan, root)) / 0.034;
        const double thick = std::clamp(inside + outside + 0.38 * front, 0.0, 1.0);
        if (keep > thick * thick * (3 - 2 * thick)) continue;
        if (on_bald_crown(plan, root, centre)) continue;
        Vec2 away = root - whorl;
        const double distance = away.norm();
        away = distance > 1e-4 ? Vec2(away / distance) : Vec2(0, 1);
        const double angle = (bend - 0.5) * 0.8;
        const Vec2 direction(std::cos(angle) * away.x() - std::sin(angle) * away.y(),
                             std::sin(angle) * away.x() + std::cos(angle) * away.y());
        const double length = 0.0014 + 0.0016 * length_draw;
        if (ears.at(root) || ears.at(root + kMapPerMetre * length * direction)) continue;
        pad.add(root, root + kMapPerMetre * length * direction, kMapPerMetre * 0.00014,
                hair * (0.65 + 0.6 * shade),
                std::min(1.0, 1.3 * scalp_hair) * (0.45 + 0.45 * length_draw) *
                    std::clamp(0.35 + 0.35 * front + inside, 0.0, 1.0));
    }
}

/// Short hairs of a beard that grow downwards, thickest under the chin; none on the lips.
void beard(const Scene& scene, const SkinPlan& plan, const Vec3& centre,
           const std::vector<unsigned>& skin, RandomSequence& random, StrokePad& pad) {
    if (scene.appearance.beard <= 0 || plan.beard.empty()) return;
    constexpr double kPerSquareMetre = 1.1e6;  // on the chin of a man
    constexpr double kTrimmed_m = 0.0026;      // what the hairs of a trimmed beard are longer
    const double longer_m = plan.trimmed ? kTrimmed_m : 0.0,
                 whites = white_share_of_beard(scene.appearance);
    const auto at = [&](std::size_t i) -> Vec3 {
        return scene.rest.row(static_cast<Eigen::Index>(skin[i])).transpose();
    };
    for (std::size_t i = 0; i + 2 < skin.size(); i += 3) {
        const Vec3 a = at(i), u = at(i + 1) - a, v = at(i + 2) - a, n = u.cross(v);
        const double density = beard_density(plan, a + (u + v) / 3);
        if (density <= 0) continue;
        const double expected = 0.5 * n.norm() * kPerSquareMetre * density;
        for (auto left = static_cast<int>(expected + random.next()); left > 0; --left) {
            double s = random.next(), t = random.next();
            const double length = random.next(), shade = random.next(), turn = random.next();
            if (s + t > 1) {
                s = 1 - s;
                t = 1 - t;
            }
            const Vec3 root = a + s * u + t * v;
            if (inside_lips(plan, root) || plan.ears[0].has_beside(root) ||
                plan.ears[1].has_beside(root))
                continue;
            const Vec3 down = (Vec3(0.9 * (turn - 0.5) + 2.5 * root.x(), -1, 0.0)).normalized();
            const Vec2 from = paint_place(root, centre);
            const Vec2 to = paint_place(
                root +
                    (0.0004 + (0.0022 * scene.appearance.beard + longer_m) * (0.5 + 0.5 * length)) *
                        down,
                centre);
            const Vec3 tone = tone_of_hair(scene.appearance, turn, whites) * (0.7 + 0.6 * shade);
            pad.add(from, to, kMapPerMetre * 0.00011, tone,
                    (0.25 + 0.55 * scene.appearance.beard) * density);
        }
    }
}

void freckles(const Scene& scene, const SkinPlan& plan, RandomSequence& random, StrokePad& pad) {
    const int count = static_cast<int>(900 * std::clamp(scene.appearance.freckles, 0.0, 1.0));
    const Vec3 tint =
        linear_from_srgb(scene.appearance.skin_tone).cwiseProduct(Vec3(0.55, 0.36, 0.26));
    const bool hairless = plan.hairline[0] > 1;
    for (int i = 0; i < count; ++i) {
        // Freckles are densest across nose and cheeks, a little below the centre of the map.
        const double turn = 2 * std::numbers::pi * random.next();
        const double r = std::sqrt(-2 * std::log(1 - random.next()));
        const double size = random.next(), strength = random.next();
        const Vec2 place =
            Vec2(0.5, 0.475) + r * Vec2(0.105 * std::sin(turn), 0.075 * std::cos(turn));
        if (!hairless && (place - Vec2(0.5, 0.5)).norm() > hairline_radius(plan, place)) continue;
        const double half = kMapPerMetre * (0.00035 + 0.0006 * size * size);
        pad.add(place - Vec2(half, 0), place + Vec2(half, 0), half, tint, 0.10 + 0.22 * strength);
    }
}

/// Single dark spots of some millimetres, on the face.
void moles(const Scene& scene, const Vec3& centre, const std::vector<unsigned>& skin,
           StrokePad& pad) {
    const int count = complexion_of(scene.appearance).moles;
    if (count == 0 || skin.size() < 3) return;
    RandomSequence random(scene.appearance.seed * 6007U + 13U);
    const Vec3 tint =
        linear_from_srgb(scene.appearance.skin_tone).cwiseProduct(Vec3(0.36, 0.23, 0.18));
    for (int left = count, tries = 0; left > 0 && tries < 4000; ++tries) {
        const double pick = random.next();
        const auto first =
            3 * static_cast<std::size_t>(pick * static_cast<double>(skin.size() / 3));
        const Vec3 at = scene.rest.row(static_cast<Eigen::Index>(skin[first])).transpose();
        if (at.z() - centre.z() < 0.045 || at.y() - centre.y() > 0.055) continue;
        const double size = random.next(), strength = random.next();
        const Vec2 place = paint_place(at, centre);
        const double half = kMapPerMetre * (0.0006 + 0.0011 * size * size);
        pad.add(place - Vec2(1.2 * half, 0), place + Vec2(1.2 * half, 0), half, tint,
                0.55 + 0.40 * strength);
        --left;
    }
}

}  // namespace

EarMask::EarMask(const Scene& scene, const SkinPlan& plan, const Vec3& centre,
                 const std::vector<unsigned>& skin)
    : covered_(kSide * kSide, false) {
    constexpr int kSteps = 6;
    for (std::size_t i = 0; i + 2 < skin.size(); i += 3) {
        Vec3 corner[3];
        bool ear = true;
        for (std::size_t k = 0; k < 3; ++k) {
            corner[k] = scene.rest.row(static_cast<Eigen::Index>(skin[i + k])).transpose();
            ear &= plan.ears[0].contains(corner[k]) || plan.ears[1].contains(corner[k]);
        }
        if (!ear) continue;
        for (int a = 0; a <= kSteps; ++a)
            for (int b = 0; a + b <= kSteps; ++b)
                covered_[cell(paint_place(
                    (a * corner[0] + b * corner[1] + (kSteps - a - b) * corner[2]) / kSteps,
                    centre))] = true;
    }
}

std::size_t EarMask::cell(const Vec2& place) {
    const auto along = [](double x) {
        return static_cast<std::size_t>(std::clamp(x * kSide, 0.0, kSide - 1.0));
    };
    return along(place.y()) * kSide + along(place.x());
}

bool inside_lips(const SkinPlan& plan, const Vec3& p) {
    bool inside = false;
    const std::vector<Vec3>& outline = plan.lip_outline;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        if ((a.head<2>() - p.head<2>()).norm() < 0.0012) return true;
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
            inside = !inside;
    }
    return inside && p.z() > plan.lip_back_m;
}

int brow_hairs(const Appearance& appearance, int usual) {
    return static_cast<int>(std::lround(usual * appearance.brow_density));
}

BrowHair next_brow_hair(const std::vector<Vec3>& line, double width, const Vec3& centre,
                        RandomSequence& random) {
    const auto map = [&](std::size_t k) { return paint_place(line[k], centre); };
    const std::size_t end = line.size() - 1;
    const double mirrored = map(end).x() < map(0).x() ? -1 : 1;
    // Dense over the first two thirds, then increasingly sparse: the tail ends in single hairs.
    const double draw = std::pow(random.next(), 0.85);
    const double t = draw < 0.62 ? draw : draw - 0.40 * (draw - 0.62) * random.next();
    const double at = t * static_cast<double>(end);
    const auto k = std::min(static_cast<std::size_t>(at), end - 1);
    const Vec2 axis = (map(k + 1) - map(k)).normalized();
    const Vec2 up(-axis.y() * mirrored, axis.x() * mirrored);
    // Full in the middle, thin at the tail, ragged at the head of the brow.
    const double half_band =
        0.0050 * (0.50 + 0.50 * std::min(1.0, t / 0.22)) * (1.0 - 0.58 * std::pow(t, 1.6));
    const double offset = random.next() + random.next() - 1.0;
    BrowHair hair;
    hair.root = map(k) + (at - static_cast<double>(k)) * (map(k + 1) - map(k)) +
                kMapPerMetre * (offset * width * half_band - 0.0006) * up;
    const double lean = (46.0 - 32.0 * std::min(1.0, t / 0.40)) -
                        42.0 * offset * std::min(1.0, t / 0.3) +
                        (24.0 + 18.0 * t) * (random.next() - 0.5);
    const double angle = lean * std::numbers::pi / 180;
    hair.length_m = (0.0048 + 0.0036 * random.next()) * (1.0 - 0.42 * t);
    hair.step =
        0.4 * kMapPerMetre * hair.length_m * (std::cos(angle) * axis + std::sin(angle) * up);
    hair.density = std::min(1.0, 0.35 + t / 0.22) * (1.0 - 0.75 * std::pow(t, 3));
    return hair;
}

std::vector<StrokeVertex> plan_strokes(const Scene& scene, const SkinPlan& plan, const Vec3& centre,
                                       const std::vector<unsigned>& skin) {
    RandomSequence random(scene.appearance.seed);
    StrokePad pad;
    freckles(scene, plan, random, pad);
    moles(scene, centre, skin, pad);
    scalp(scene, plan, centre, EarMask(scene, plan, centre, skin), random, pad);
    beard(scene, plan, centre, skin, random, pad);
    for (const std::vector<Vec3>& line : plan.brows) brow(scene, line, centre, random, pad);
    return pad.take();
}

std::vector<StrokeVertex> plan_lip_ground(const Scene& scene, const SkinPlan& plan,
                                          const Vec3& centre) {
    std::vector<StrokeVertex> fan;
    if (plan.lip_outline.empty()) return fan;
    const Eigen::Vector3f tone = (0.85 * lip_tone_at(scene.appearance)).cwiseSqrt().cast<float>();
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : plan.lip_outline)
        middle += p / static_cast<double>(plan.lip_outline.size());
    const auto corner = [&](const Vec3& p) {
        const Vec2 place = paint_place(p, centre);
        // The fan uses the middle of a stroke's shaft, where it is opaque.
        fan.push_back({{static_cast<float>(place.x()), static_cast<float>(place.y())},
                       {0.5F, 0.0F},
                       {tone.x(), tone.y(), tone.z(), 1.0F}});
    };
    for (std::size_t i = 0; i < plan.lip_outline.size(); ++i) {
        corner(middle);
        corner(plan.lip_outline[i]);
        corner(plan.lip_outline[(i + 1) % plan.lip_outline.size()]);
    }
    return fan;
}

void draw_strokes(const std::vector<StrokeVertex>& strokes) {
    if (strokes.empty()) return;
    GLint outer = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &outer);
    GLuint array = 0, buffer = 0;
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(strokes.size() * sizeof(StrokeVertex)),
                 strokes.data(), GL_STATIC_DRAW);
    const auto attribute = [](GLuint index, GLint size, std::size_t offset) {
        glEnableVertexAttribArray(index);
        glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(StrokeVertex),
                              reinterpret_cast<const void*>(offset));
    };
    attribute(0, 2, offsetof(StrokeVertex, place));
    attribute(1, 2, offsetof(StrokeVertex, local));
    attribute(2, 4, offsetof(StrokeVertex, rgba));
    const GlProgram program("strokes", stroke_vertex_shader(), stroke_fragment_shader());
    program.use();
    glEnable(GL_BLEND);
    // Colour is blended over the paint; the oil below it is reduced.
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(strokes.size()));
    glDisable(GL_BLEND);
    glBindVertexArray(static_cast<GLuint>(outer));
    glDeleteBuffers(1, &buffer);
    glDeleteVertexArrays(1, &array);
}

}  // namespace risorius::render
