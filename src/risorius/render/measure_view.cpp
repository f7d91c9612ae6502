// SPDX-License-Identifier: MIT
#include "risorius/render/measure_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "risorius/core/error.h"

namespace risorius::render {
namespace {

constexpr int kSamples = 2;  // per pixel side
constexpr int kLargest_px = 8192;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// X to the right, y down, depth growing towards the viewer; in samples and metres.
struct Canvas {
    int width, height;
    std::vector<Vec3> colour;
    std::vector<double> depth;

    Canvas(int w, int h, const Vec3& background)
        : width(w),
          height(h),
          colour(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), background),
          depth(colour.size(), -std::numeric_limits<double>::infinity()) {}
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

class Viewpoint {
  public:
    explicit Viewpoint(const MeasureViewOptions& o)
        : centre_(o.centre),
          samples_per_m_(kSamples * o.height_px / o.height_m),
          middle_(0.5 * kSamples * o.width_px, 0.5 * kSamples * o.height_px) {
        const double a = o.azimuth_deg * kDegree;
        towards_ = Vec3(std::sin(a), 0, std::cos(a));
        right_ = Vec3(std::cos(a), 0, -std::sin(a));
    }
    Vec3 project(const Vec3& p) const {
        const Vec3 r = p - centre_;
        return {middle_.x() + samples_per_m_ * r.dot(right_), middle_.y() - samples_per_m_ * r.y(),
                r.dot(towards_)};
    }
    const Vec3& towards() const { return towards_; }
    /// Shading by a light above the viewer and to one side.
    double light(const Vec3& normal) const {
        const Vec3 from = (towards_ + 0.35 * Vec3::UnitY() + 0.25 * right_).normalized();
        return 0.55 + 0.45 * std::max(0.0, normal.dot(from));
    }

  private:
    Vec3 centre_, towards_, right_;
    double samples_per_m_;
    Vec2 middle_;
};

Points smooth_normals(const ColouredSurface& surface) {
    Points normals = Points::Zero(surface.positions.rows(), 3);
    for (long f = 0; f < surface.triangles.rows(); ++f) {
        const Vec3 a = surface.positions.row(surface.triangles(f, 0)),
                   b = surface.positions.row(surface.triangles(f, 1)),
                   c = surface.positions.row(surface.triangles(f, 2));
        for (int k = 0; k < 3; ++k)
            normals.row(surface.triangles(f, k)) += (b - a).cross(c - a).transpose();
    }
    for (long v = 0; v < normals.rows(); ++v)
        if (normals.row(v).norm() > 0) normals.row(v).normalize();
    return normals;
}

void draw_surface(const ColouredSurface& surface, const Viewpoint& eye, Canvas& canvas) {
    const Points normals = smooth_normals(surface);
    Canvas own = surface.opacity < 1 ? Canvas(canvas.width, canvas.height, Vec3::Zero())
                                     : Canvas(0, 0, Vec3::Zero());
    Canvas& target = surface.opacity < 1 ? own : canvas;
    for (long f = 0; f < surface.triangles.rows(); ++f) {
        std::array<Vec3, 3> at, shade;
        for (int k = 0; k < 3; ++k) {
            const int v = surface.triangles(f, k);
            at[k] = eye.project(surface.positions.row(v).transpose());
            const Vec3 n = normals.row(v).transpose();
            shade[k] = eye.light(n.dot(eye.towards()) < 0 ? Vec3(-n) : n) *
                       surface.colours[static_cast<std::size_t>(v)];
        }
        const double area = (at[1].x() - at[0].x()) * (at[2].y() - at[0].y()) -
                            (at[2].x() - at[0].x()) * (at[1].y() - at[0].y());
        if (area == 0 || (surface.opacity < 1 && area > 0)) continue;  // y points down
        const auto low = [&](int axis) {
            return std::min({at[0][axis], at[1][axis], at[2][axis]});
        };
        const auto high = [&](int axis) {
            return std::max({at[0][axis], at[1][axis], at[2][axis]});
        };
        const int x0 = static_cast<int>(std::clamp(std::ceil(low(0) - 0.5), 0.0, 1e6));
        const int y0 = static_cast<int>(std::clamp(std::ceil(low(1) - 0.5), 0.0, 1e6));
        const int x1 = static_cast<int>(
            std::clamp(std::floor(high(0) - 0.5), -1.0, static_cast<double>(target.width - 1)));
        const int y1 = static_cast<int>(
            std::clamp(std::floor(high(1) - 0.5), -1.0, static_cast<double>(target.height - 1)));
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const double px = x + 0.5, py = y + 0.5;
                const double w1 = ((px - at[0].x()) * (at[2].y() - at[0].y()) -
                                   (at[2].x() - at[0].x()) * (py - at[0].y())) /
                                  area;
                const double w2 = ((at[1].x() - at[0].x()) * (py - at[0].y()) -
                                   (px - at[0].x()) * (at[1].y() - at[0].y())) /
                                  area;
                if (w1 < 0 || w2 < 0 || w1 + w2 > 1) continue;
                const double w0 = 1 - w1 - w2;
                const double z = w0 * at[0].z() + w1 * at[1].z() + w2 * at[2].z();
                const std::size_t i = target.at(x, y);
                if (z <= target.depth[i]) continue;
                target.depth[i] = z;
                target.colour[i] = w0 * shade[0] + w1 * shade[1] + w2 * shade[2];
            }
    }
    if (surface.opacity >= 1) return;
    for (std::size_t i = 0; i < own.depth.size(); ++i)
        if (own.depth[i] > canvas.depth[i])
            canvas.colour[i] =
                (1 - surface.opacity) * canvas.colour[i] + surface.opacity * own.colour[i];
}

/// Draws a disc where no surface hides it.
void draw_disc(const Vec3& at, double radius, double hole, const Vec3& colour, double above,
               Canvas& canvas) {
    const int x0 = std::max(0, static_cast<int>(at.x() - radius - 1));
    const int y0 = std::max(0, static_cast<int>(at.y() - radius - 1));
    const int x1 = std::min(canvas.width - 1, static_cast<int>(at.x() + radius + 1));
    const int y1 = std::min(canvas.height - 1, static_cast<int>(at.y() + radius + 1));
    const int cx = std::clamp(static_cast<int>(at.x()), 0, canvas.width - 1);
    const int cy = std::clamp(static_cast<int>(at.y()), 0, canvas.height - 1);
    if (canvas.depth[canvas.at(cx, cy)] > at.z() + above) return;
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const double away = std::hypot(x + 0.5 - at.x(), y + 0.5 - at.y());
            if (away <= radius && away >= hole) canvas.colour[canvas.at(x, y)] = colour;
        }
}

}  // namespace

Image draw_measured(const std::vector<ColouredSurface>& surfaces, const std::vector<Mark>& marks,
                    const std::vector<MarkedLine>& lines, const MeasureViewOptions& options) {
    for (const int side : {options.width_px, options.height_px})
        if (side < 1 || side > kLargest_px)
            throw Error("width_px, height_px", "[1, 8192]", std::to_string(side));
    const Viewpoint eye(options);
    Canvas canvas(kSamples * options.width_px, kSamples * options.height_px, options.background);
    for (const ColouredSurface& surface : surfaces) draw_surface(surface, eye, canvas);
    for (const MarkedLine& line : lines)
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
            const Vec3 a = eye.project(line.points[i]), b = eye.project(line.points[i + 1]);
            const int steps = 1 + static_cast<int>((b - a).head<2>().norm());
            for (int s = 0; s <= steps; ++s)
                draw_disc(a + (b - a) * s / steps, 0.5 * kSamples * line.width_px, 0, line.colour,
                          options.marks_above_m, canvas);
        }
    for (const Mark& mark : marks) {
        const Vec3 at = eye.project(mark.at);
        const double radius = kSamples * mark.radius_px;
        draw_disc(at, radius + kSamples, mark.ring ? 0.45 * radius : 0.0, Vec3(0.1, 0.1, 0.1),
                  options.marks_above_m, canvas);
        draw_disc(at, radius, mark.ring ? 0.55 * radius : 0.0, mark.colour, options.marks_above_m,
                  canvas);
    }

    Image image(options.width_px, options.height_px);
    for (int y = 0; y < options.height_px; ++y)
        for (int x = 0; x < options.width_px; ++x) {
            Vec3 sum = Vec3::Zero();
            for (int j = 0; j < kSamples; ++j)
                for (int i = 0; i < kSamples; ++i)
                    sum += canvas.colour[canvas.at(kSamples * x + i, kSamples * y + j)];
            sum /= kSamples * kSamples;
            for (int k = 0; k < 3; ++k)
                image.pixel(x, y)[k] =
                    static_cast<std::uint8_t>(std::lround(255 * std::clamp(sum[k], 0.0, 1.0)));
            image.pixel(x, y)[3] = 255;
        }
    return image;
}

Vec3 scale_colour(double fraction) {
    static const std::array<Vec3, 9> kColours{
        Vec3(0.267, 0.005, 0.329), Vec3(0.278, 0.176, 0.483), Vec3(0.231, 0.322, 0.545),
        Vec3(0.173, 0.449, 0.558), Vec3(0.128, 0.567, 0.551), Vec3(0.154, 0.681, 0.505),
        Vec3(0.361, 0.785, 0.388), Vec3(0.667, 0.862, 0.196), Vec3(0.993, 0.906, 0.144)};
    const double at = std::clamp(fraction, 0.0, 1.0) * (kColours.size() - 1);
    const std::size_t i = std::min(kColours.size() - 2, static_cast<std::size_t>(at));
    const double t = at - static_cast<double>(i);
    return (1 - t) * kColours[i] + t * kColours[i + 1];
}

}  // namespace risorius::render
