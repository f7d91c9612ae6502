// SPDX-License-Identifier: MIT
#include "risorius/report/contact_sheet.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

#include "risorius/render/lettering.h"
#include "risorius/render/value_colour.h"

namespace risorius::report {

namespace {

// Lengths in px
constexpr int kMargin = 24, kGap = 3, kBetweenBlocks = 30, kHeading = 26, kBelowRow = 10;
constexpr int kTitle = 82, kColumnNames = 22, kScaleLength = 220, kScaleHeight = 12;
constexpr render::TextStyle kTitleText{.height_px = 17}, kNameText{.height_px = 12},
    kNumberText{.height_px = 10, .ink = 0.30};
constexpr double kMaxAspect = 1.6;  ///< width of a sheet over its height

void paste(const Image& picture, int left, int top, Image& sheet) {
    for (int y = 0; y < picture.height_px; ++y)
        std::copy_n(picture.pixel(0, y), 4 * picture.width_px, sheet.pixel(left, top + y));
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

/// Draws the name of the colour scale, and its bar with numbers below.
void draw_scale(const render::SkinValues& scale, int left, int top, Image& sheet) {
    const std::string name = scale.name + ", " + scale.unit;
    render::write_text(name, {static_cast<double>(left), top + 12.0}, kNameText, sheet);
    left += static_cast<int>(render::text_width(name) * kNameText.height_px) + 16;
    for (int x = 0; x < kScaleLength && left + x < sheet.width_px; ++x) {
        const double value = scale.from + (x + 0.5) / kScaleLength * (scale.to - scale.from);
        const Vec3 colour = render::srgb_of(render::value_colour(value, scale.from, scale.to));
        for (int y = 0; y < kScaleHeight; ++y)
            for (int k = 0; k < 3; ++k)
                sheet.pixel(left + x, top + y)[k] =
                    static_cast<std::uint8_t>(std::lround(255 * colour[k]));
    }
    for (const double fraction : {0.0, 0.5, 1.0}) {
        const std::string text = number(scale.from + fraction * (scale.to - scale.from));
        const double half = render::text_width(text) * kNumberText.height_px / 2;
        render::write_text(text, {left + fraction * kScaleLength - half, top + kScaleHeight + 15.0},
                           kNumberText, sheet);
    }
}

}  // namespace

Image draw_contact_sheet(const ContactSheet& sheet) {
    assert(!sheet.rows.empty());
    const Image& first = sheet.rows.front().pictures.front();
    const int title = sheet.title.empty() && sheet.scale.name.empty() ? 0 : kTitle;
    const int columns = static_cast<int>(sheet.columns.size());
    const int rows = static_cast<int>(sheet.rows.size());
    const int row_width = columns * (first.width_px + kGap) - kGap;
    const int row_height = kHeading + first.height_px + kBelowRow;
    const auto width = [&](int blocks) {
        return 2 * kMargin + blocks * (row_width + kBetweenBlocks) - kBetweenBlocks;
    };
    const auto height = [&](int blocks) {
        return 2 * kMargin + title + kColumnNames + (rows + blocks - 1) / blocks * row_height;
    };
    int blocks = 1;
    while (blocks < rows && width(blocks + 1) <= kMaxAspect * height(blocks + 1)) ++blocks;
    const int per_block = (rows + blocks - 1) / blocks;
    blocks = (rows + per_block - 1) / per_block;

    Image out(width(blocks), height(blocks));
    std::fill(out.rgba.begin(), out.rgba.end(), std::uint8_t{255});
    render::write_text(sheet.title, {kMargin, kMargin + 17.0}, kTitleText, out);
    if (!sheet.scale.name.empty()) draw_scale(sheet.scale, kMargin, kMargin + 34, out);
    for (int b = 0; b < blocks; ++b) {
        const int left = kMargin + b * (row_width + kBetweenBlocks);
        for (int c = 0; c < columns; ++c)
            render::write_text(sheet.columns[static_cast<std::size_t>(c)],
                               {left + c * (first.width_px + kGap) + 1.0, kMargin + title + 11.0},
                               kNumberText, out);
        for (int r = 0; r < per_block && b * per_block + r < rows; ++r) {
            const ContactRow& row = sheet.rows[static_cast<std::size_t>(b * per_block + r)];
            assert(static_cast<int>(row.pictures.size()) == columns);
            const int top = kMargin + title + kColumnNames + r * row_height;
            const double baseline = top + 18;
            render::write_text(row.name, {left + 1.0, baseline}, kNameText, out);
            const double numbers = render::text_width(row.numbers) * kNumberText.height_px;
            render::write_text(row.numbers, {left + row_width - numbers - 1, baseline}, kNumberText,
                               out);
            for (int c = 0; c < columns; ++c)
                paste(row.pictures[static_cast<std::size_t>(c)], left + c * (first.width_px + kGap),
                      top + kHeading, out);
        }
    }
    return out;
}

Image shrunk(const Image& image, int width_px, int height_px) {
    // The fraction of each source row or column that a pixel of the small picture covers
    struct Span {
        int first;
        std::vector<double> fraction;
    };
    const auto spans = [](int from, int to) {
        std::vector<Span> out;
        const double step = static_cast<double>(from) / to;
        for (int i = 0; i < to; ++i) {
            const double begin = i * step, end = begin + step;
            Span span{static_cast<int>(begin), {}};
            for (int p = span.first; p < from && p < end; ++p)
                span.fraction.push_back(
                    (std::min<double>(end, p + 1) - std::max<double>(begin, p)) / step);
            out.push_back(span);
        }
        return out;
    };
    const std::vector<Span> across = spans(image.width_px, width_px),
                            down = spans(image.height_px, height_px);
    Image out(width_px, height_px);
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x) {
            double sum[4] = {0, 0, 0, 0};
            const Span &h = across[static_cast<std::size_t>(x)],
                       &v = down[static_cast<std::size_t>(y)];
            for (std::size_t j = 0; j < v.fraction.size(); ++j)
                for (std::size_t i = 0; i < h.fraction.size(); ++i) {
                    const std::uint8_t* pixel =
                        image.pixel(h.first + static_cast<int>(i), v.first + static_cast<int>(j));
                    for (int k = 0; k < 4; ++k) sum[k] += v.fraction[j] * h.fraction[i] * pixel[k];
                }
            for (int k = 0; k < 4; ++k)
                out.pixel(x, y)[k] = static_cast<std::uint8_t>(std::lround(sum[k]));
        }
    return out;
}

}  // namespace risorius::report
