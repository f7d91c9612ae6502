// SPDX-License-Identifier: MIT
#include "risorius/render/lash_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "risorius/render/detail/lash_strands.h"

namespace risorius::render {

Vec2 lash_place(bool upper, double along, double out) {
    constexpr double kMargin = 0.01, kHeight = 0.5 - 2 * kMargin;
    return {kMargin + (1 - 2 * kMargin) * along,
            upper ? 0.5 + kMargin + kHeight * out : 0.5 - kMargin - kHeight * out};
}

Image lash_opacity(int side_px) {
    constexpr double kHalfWidth = 0.0035;  // of the lid's length, at the root
    Image image(side_px, side_px);
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    std::mt19937 random(1);
    const auto next = [&] { return static_cast<double>(random()) / 4294967296.0; };
    for (const bool upper : {true, false}) {
        const int hairs = upper ? 95 : 60;
        for (int hair = 0; hair < hairs; ++hair) {
            const double root = (hair + next()) / hairs, bend = 0.03 * (next() - 0.5),
                         length = 0.55 + 0.45 * next();
            for (int y = 0; y < side_px; ++y) {
                // The row's share of the way out, as lash_place() has it
                const double from = lash_place(upper, 0, 0).y(), to = lash_place(upper, 0, 1).y();
                const double t = (1 - (y + 0.5) / side_px - from) / (to - from);
                if (t < 0 || t > length) continue;
                const double along = root + bend * t * t,
                             half = kHalfWidth * side_px * (1 - 0.8 * t / length),
                             middle = lash_place(upper, along, t).x() * side_px;
                for (int x = std::max(0, static_cast<int>(middle - half - 1));
                     x < std::min(side_px, static_cast<int>(middle + half + 2)); ++x) {
                    const double covered =
                        std::clamp(half + 0.5 - std::abs(x + 0.5 - middle), 0.0, 1.0);
                    const auto byte = static_cast<std::uint8_t>(std::lround(255 * covered));
                    std::uint8_t* pixel = image.pixel(x, y);
                    for (int k = 0; k < 3; ++k) pixel[k] = std::max(pixel[k], byte);
                }
            }
        }
    }
    return image;
}

TexCoords lash_coordinates(const Scene& scene) {
    const std::vector<LashPlace> places = lash_places(scene);
    TexCoords out = TexCoords::Zero(static_cast<long>(places.size()), 2);
    // The ends of each ribbon: upper and lower, left and right
    struct Ends {
        double from = std::numeric_limits<double>::infinity(), to = -from;
    };
    std::array<std::array<Ends, 2>, 2> ends;
    const auto ends_of = [&](std::size_t v) -> Ends& {
        return ends[places[v].lower_lid][scene.rest(static_cast<long>(v), 0) < 0];
    };
    for (std::size_t v = 0; v < places.size(); ++v) {
        if (!places[v].is_lash) continue;
        Ends& own = ends_of(v);
        own.from = std::min(own.from, static_cast<double>(places[v].along_m));
        own.to = std::max(own.to, static_cast<double>(places[v].along_m));
    }
    for (std::size_t v = 0; v < places.size(); ++v) {
        if (!places[v].is_lash) continue;
        const Ends& own = ends_of(v);
        const double along =
            own.to > own.from ? (places[v].along_m - own.from) / (own.to - own.from) : 0.5;
        out.row(static_cast<long>(v)) =
            lash_place(!places[v].lower_lid, along, places[v].fraction).transpose();
    }
    return out;
}

}  // namespace risorius::render
