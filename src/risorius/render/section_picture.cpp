// SPDX-License-Identifier: MIT
#include "risorius/render/section_picture.h"

#include <algorithm>
#include <cmath>

#include "risorius/render/detail/blend.h"

namespace risorius::render {

namespace {

constexpr unsigned char kPaper = 246;
constexpr int kRowsPerPixel = 4;

/// Places along a row at which segments cross it, in order.
std::vector<double> crossings(const std::vector<std::pair<Vec2, Vec2>>& segments, double y) {
    std::vector<double> out;
    for (const auto& [a, b] : segments)
        if ((a.y() < y) != (b.y() < y))
            out.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    std::sort(out.begin(), out.end());
    return out;
}

void fill(const SectionPart& part, Image& image) {
    std::vector<double> cover(static_cast<std::size_t>(image.width_px));
    for (int y = 0; y < image.height_px; ++y) {
        std::fill(cover.begin(), cover.end(), 0.0);
        for (int k = 0; k < kRowsPerPixel; ++k) {
            const std::vector<double> ends =
                crossings(part.segments, y + (k + 0.5) / kRowsPerPixel + 1e-7);
            if (ends.size() % 2 == 1) continue;
            for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
                const double from = std::max(0.0, ends[i]),
                             to = std::min(static_cast<double>(image.width_px), ends[i + 1]);
                for (int x = static_cast<int>(from); x < to; ++x)
                    cover[static_cast<std::size_t>(x)] +=
                        std::clamp(std::min(to, x + 1.0) - std::max<double>(from, x), 0.0, 1.0) /
                        kRowsPerPixel;
            }
        }
        for (int x = 0; x < image.width_px; ++x)
            if (const double c = cover[static_cast<std::size_t>(x)]; c > 0)
                blend(image.pixel(x, y), part.ink, part.fill * std::min(1.0, c));
    }
}

/// All lines of a part at once, so that their joints are no darker than the rest.
void draw_lines(const SectionPart& part, Image& image) {
    std::vector<float> cover(static_cast<std::size_t>(image.width_px * image.height_px), 0.0f);
    const double radius = part.line_px / 2;
    const auto inside = [](double v, int size) {
        return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size)));
    };
    for (const auto& [a, b] : part.segments) {
        const Vec2 way = b - a;
        const double squared = std::max(way.squaredNorm(), 1e-12);
        const int x0 = inside(std::min(a.x(), b.x()) - radius - 1, image.width_px),
                  x1 = inside(std::max(a.x(), b.x()) + radius + 2, image.width_px),
                  y0 = inside(std::min(a.y(), b.y()) - radius - 1, image.height_px),
                  y1 = inside(std::max(a.y(), b.y()) + radius + 2, image.height_px);
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) {
                const Vec2 at(x + 0.5, y + 0.5);
                const double s = std::clamp((at - a).dot(way) / squared, 0.0, 1.0);
                const double c = std::clamp(radius + 0.5 - (at - a - s * way).norm(), 0.0, 1.0);
                float& now = cover[static_cast<std::size_t>(y * image.width_px + x)];
                now = std::max(now, static_cast<float>(c));
            }
    }
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x)
            if (const float c = cover[static_cast<std::size_t>(y * image.width_px + x)]; c > 0)
                blend(image.pixel(x, y), part.ink, c);
}

}  // namespace

void draw_sections(const std::vector<SectionPart>& parts, Image& image) {
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = i % 4 == 3 ? 255 : kPaper;
    for (const SectionPart& part : parts) {
        if (part.fill > 0) fill(part, image);
        if (part.line_px > 0) draw_lines(part, image);
    }
}

}  // namespace risorius::render
