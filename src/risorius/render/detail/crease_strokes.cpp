// SPDX-License-Identifier: MIT
#include "risorius/render/detail/crease_strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "risorius/render/detail/skin_paint.h"

namespace risorius::render {
namespace {

constexpr double kCreaseMapPerMetre = 2.5;  ///< of the paint map, for a head of 0.1 m radius

double grown(double from, double to, double years) {
    const double t = std::clamp((years - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

class Creases {
  public:
    Creases(const Scene& scene, const Vec3& centre)
        : scene_(scene),
          centre_(centre),
          skin_(linear_from_srgb(scene.appearance.skin_tone)),
          dark_(skin_darkness(skin_)),
          random_(scene.appearance.seed * 7001U + 3U),
          // Appearance::age runs from 25 to 75 years.
          years_(25 + 50 * scene.appearance.age) {
        // Nobody's face ages evenly: one has a lined forehead, another crow's feet. The weights have a sequence of their own.
        RandomSequence own(scene.appearance.seed * 9001U + 17U);
        for (double* part : {&own_.forehead, &own_.glabella, &own_.crows_feet, &own_.below_eye,
                             &own_.nasolabial, &own_.marionette, &own_.upper_lip})
            *part = 0.35 + 1.3 * own.next();
    }

    std::vector<StrokeVertex> all() {
        forehead();
        for (const double side : {1.0, -1.0}) {
            glabella(side);
            crows_feet(side);
            below_eye(side);
            cheek(side);
        }
        upper_lip();
        return std::move(strokes_);
    }

  private:
    const Vec3* mark(const std::string& id) const {
        const auto found = scene_.landmarks.find(id);
        return found == scene_.landmarks.end() ? nullptr : &found->second;
    }
    const Vec3* mark(const char* id, double side) const {
        return mark(std::string(id) + (side > 0 ? "_l" : "_r"));
    }
    double even(double from, double to) { return from + (to - from) * random_.next(); }

    /// A ribbon along a line that fades towards both ends.
    void ribbon(const std::vector<Vec3>& line, double width_m, const Vec3& shift, const Vec3& tone,
                double strength) {
        const Eigen::Vector3f root = tone.cwiseSqrt().cast<float>();
        const auto count = line.size();
        std::vector<std::array<StrokeVertex, 2>> rows;
        for (std::size_t i = 0; i < count; ++i) {
            const auto place = [&](std::size_t k) { return paint_place(line[k] + shift, centre_); };
            const Vec2 along =
                (place(std::min(i + 1, count - 1)) - place(i > 0 ? i - 1 : 0)).normalized();
            const double s = static_cast<double>(i) / static_cast<double>(count - 1);
            const double fade = grown(0, 0.3, s) * grown(0, 0.35, 1 - s);
            const Vec2 aside =
                kCreaseMapPerMetre * width_m * (0.5 + 0.5 * fade) * Vec2(-along.y(), along.x());
            std::array<StrokeVertex, 2> row;
            for (const std::size_t k : {0U, 1U}) {
                const Vec2 at = place(i) + (k == 0 ? -1.0 : 1.0) * aside;
                // The middle of a stroke's shaft, where it is opaque
                row[k] = {{static_cast<float>(at.x()), static_cast<float>(at.y())},
                          {0.4F, k == 0 ? -1.0F : 1.0F},
                          {root.x(), root.y(), root.z(), static_cast<float>(strength * fade)}};
            }
            rows.push_back(row);
        }
        for (std::size_t i = 0; i + 1 < rows.size(); ++i)
            for (const StrokeVertex& v : {rows[i][0], rows[i][1], rows[i + 1][1], rows[i][0],
                                          rows[i + 1][1], rows[i + 1][0]})
                strokes_.push_back(v);
    }
    /// A crease: soft shade, valley, and the ridge below it. `deep`: 0..1.
    void crease(const std::vector<Vec3>& line, double width_mm, double deep) {
        const double strength = std::clamp(deep * scene_.appearance.age_lines, 0.0, 1.0);
        if (strength < 0.02 || line.size() < 2) return;
        const double width_m = 1e-3 * width_mm;
        const Vec3 valley = (1 - 0.45 * dark_) * skin_.cwiseProduct(Vec3(0.50, 0.36, 0.31)),
                   shade = (1 - 0.25 * dark_) * skin_.cwiseProduct(Vec3(0.72, 0.60, 0.56)),
                   ridge = ((1.18 + 0.45 * dark_) * skin_).cwiseMin(1.0);
        ribbon(line, 2.6 * width_m, Vec3::Zero(), shade, 0.45 * strength);
        ribbon(line, 1.1 * width_m, Vec3(0, -1.9 * width_m, 0), ridge, 0.40 * strength);
        ribbon(line, 0.7 * width_m, Vec3::Zero(), valley, 0.58 * strength);
    }
    static std::vector<Vec3> bow(const Vec3& from, const Vec3& to, const Vec3& out) {
        std::vector<Vec3> line;
        constexpr int kSteps = 12;
        for (int i = 0; i <= kSteps; ++i) {
            const double s = static_cast<double>(i) / kSteps;
            line.push_back(from + s * (to - from) + 4 * s * (1 - s) * out);
        }
        return line;
    }

    void forehead() {
        const Vec3 *g = mark("g"), *tr = mark("tr"), *temple = mark("ft_l");
        const double deep = own_.forehead * grown(25, 54, years_);
        const int rows = 3 + static_cast<int>(3 * random_.next());
        if (!g || !tr || !temple) return;
        for (int row = 0; row < rows; ++row) {
            const double at = 0.22 + 0.62 * (row + even(-0.15, 0.15)) / rows;
            const Vec3 middle = *g + at * (*tr - *g);
            const double half = std::abs(temple->x()) * even(0.78, 1.05), phase = even(0, 6.3),
                         shift = even(-0.006, 0.006), gap = even(0, 1);
            // Two halves that may not meet over the root of the nose
            for (const double side : {-1.0, 1.0}) {
                std::vector<Vec3> line;
                for (int i = 0; i <= 14; ++i) {
                    const double x = side * half *
                                     (gap > 0.5 ? 0.06 + 0.94 * i / 14.0 : -0.25 + 1.25 * i / 14.0);
                    const double y =
                        0.0022 * std::sin(55 * x + phase) + 0.0035 * std::cos(2.2 * x / half);
                    line.push_back(middle + Vec3(x + shift, y, -4.2 * x * x));
                }
                crease(line, even(0.7, 1.1), deep * even(0.55, 1.0));
            }
        }
    }
    void glabella(double side) {
        const Vec3* g = mark("g");
        if (!g) return;
        const double deep = 0.7 * own_.glabella * grown(26, 56, years_) * even(0.4, 1.0),
                     x = side * even(0.005, 0.008);
        crease(bow(*g + Vec3(x, -0.007, 0), *g + Vec3(1.35 * x, even(0.010, 0.015), 0),
                   Vec3(-0.15 * x, 0, 0)),
               1.1, deep);
    }
    void crows_feet(double side) {
        const Vec3* ex = mark("ex", side);
        if (!ex) return;
        const int rays = 3 + static_cast<int>(3 * random_.next());
        for (int i = 0; i < rays; ++i) {
            const double angle = (-28 + 62.0 * (i + even(-0.2, 0.2)) / (rays - 1)) *
                                 std::numbers::pi / 180,
                         length = even(0.011, 0.021);
            const Vec3 way(side * 0.75 * std::cos(angle), std::sin(angle), -0.66 * std::cos(angle));
            const Vec3 from = *ex + 0.007 * way;
            crease(bow(from, from + length * way, Vec3(0, -0.0012, 0)), 0.6,
                   own_.crows_feet * grown(26, 55, years_) * even(0.5, 1.0));
        }
    }
    void below_eye(double side) {
        const Vec3 *en = mark("en", side), *ex = mark("ex", side), *pi = mark("pi", side);
        if (!en || !ex || !pi) return;
        const double x = side;
        crease(
            bow(*en + Vec3(0, -0.006, 0), *pi + Vec3(0.006 * x, -0.0105, 0), Vec3(0, -0.0025, 0)),
            2.2, own_.below_eye * 0.8 * grown(25, 52, years_));
        for (int i = 0; i < 3; ++i)
            crease(bow(*pi + Vec3(-0.008 * x, -0.0035 - 0.0022 * i, 0),
                       *ex + Vec3(-0.001 * x, -0.005 - 0.0024 * i, 0), Vec3(0, -0.0016, 0)),
                   0.45, own_.below_eye * grown(30, 57, years_) * even(0.3, 0.8));
    }
    void cheek(double side) {
        const Vec3 *al = mark("al", side), *ch = mark("ch", side);
        if (!al || !ch) return;
        crease(bow(*al + Vec3(side * 0.003, 0.004, -0.002), *ch + Vec3(side * 0.010, 0.001, -0.004),
                   Vec3(side * 0.003, 0.001, 0)),
               1.5, own_.nasolabial * grown(25, 52, years_) * even(0.8, 1.0));
        crease(bow(*ch + Vec3(side * 0.002, -0.002, 0), *ch + Vec3(side * 0.006, -0.019, -0.006),
                   Vec3(side * 0.0015, 0, 0)),
               1.2, own_.marionette * grown(34, 62, years_) * even(0.7, 1.0));
    }
    void upper_lip() {
        const Vec3 *ls = mark("ls"), *left = mark("ulc_l"), *right = mark("ulc_r");
        if (!ls || !left || !right) return;
        constexpr int kLines = 9;
        for (int i = 0; i < kLines; ++i) {
            const double s = 2.0 * (i + even(0.2, 0.8)) / kLines - 1;
            const Vec3& corner = s > 0 ? *left : *right;
            const Vec3 border = *ls + std::abs(s) * 1.25 * (corner - *ls);
            crease(bow(border + Vec3(0, 0.0006, 0),
                       border + Vec3(0.0012 * s, even(0.004, 0.0065), 0), Vec3::Zero()),
                   0.45, own_.upper_lip * grown(42, 66, years_) * even(0.3, 0.7));
        }
    }

    const Scene& scene_;
    Vec3 centre_, skin_;
    double dark_;  ///< 0..1; on dark skin the same shares of its colour are hardly seen
    RandomSequence random_;
    double years_;
    /// How deep the lines of this person are, against the mean.
    struct {
        double forehead, glabella, crows_feet, below_eye, nasolabial, marionette, upper_lip;
    } own_{};
    std::vector<StrokeVertex> strokes_;
};

}  // namespace

std::vector<StrokeVertex> plan_creases(const Scene& scene, const Vec3& paint_centre) {
    if (scene.appearance.age_lines <= 0) return {};
    return Creases(scene, paint_centre).all();
}

}  // namespace risorius::render
