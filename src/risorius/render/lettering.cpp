// SPDX-License-Identifier: MIT
#include "risorius/render/lettering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "risorius/render/detail/blend.h"

namespace risorius::render {
namespace {

constexpr double kPenWidth = 0.13;   ///< ratio to the height of a capital
constexpr double kLetterGap = 0.20;  ///< between letters, ratio to the height of a capital

using Line = std::vector<Vec2>;  ///< x to the right, y down, baseline at 0, height of a capital 1

struct Letter {
    double width = 0.4;
    std::vector<Line> lines;
};

/// Part of an ellipse; angles in degrees clockwise from the right, as seen in the picture.
Line arc(double x, double y, double rx, double ry, double from_deg, double to_deg) {
    constexpr int kSteps = 14;
    Line line;
    for (int i = 0; i <= kSteps; ++i) {
        const double a = (from_deg + (to_deg - from_deg) * i / kSteps) * std::numbers::pi / 180;
        line.emplace_back(x + rx * std::cos(a), y + ry * std::sin(a));
    }
    return line;
}

Line joined(Line first, const Line& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

using Alphabet = std::array<Letter, 128>;

void add_small_letters(Alphabet& of) {
    constexpr double kMiddle = -0.33, kRadius = 0.33, kTop = -0.66;
    const Line bowl = arc(0.28, kMiddle, 0.28, kRadius, 0, 360);
    const Line arch = joined(arc(0.25, -0.41, 0.25, 0.25, 180, 360), {{0.50, 0}});
    of['a'] = {0.56, {bowl, {{0.56, kTop}, {0.56, 0}}}};
    of['b'] = {0.56, {bowl, {{0, -1}, {0, 0}}}};
    of['c'] = {0.50, {arc(0.28, kMiddle, 0.28, kRadius, 42, 318)}};
    of['d'] = {0.56, {bowl, {{0.56, -1}, {0.56, 0}}}};
    of['e'] = {0.56, {joined({{0.01, kMiddle}}, arc(0.28, kMiddle, 0.28, kRadius, 0, -312))}};
    of['f'] = {
        0.36,
        {joined(arc(0.34, -0.78, 0.20, 0.22, 300, 180), {{0.14, 0}}), {{0, kTop}, {0.34, kTop}}}};
    of['g'] = {0.56, {bowl, joined({{0.56, kTop}}, arc(0.28, 0.03, 0.28, 0.25, 0, 150))}};
    of['h'] = {0.50, {{{0, -1}, {0, 0}}, arch}};
    of['i'] = {0.10, {{{0.05, kTop}, {0.05, 0}}, {{0.05, -0.93}, {0.05, -0.91}}}};
    of['j'] = {0.12,
               {joined({{0.12, kTop}}, arc(-0.04, 0.10, 0.16, 0.18, 0, 100)),
                {{0.12, -0.93}, {0.12, -0.91}}}};
    of['k'] = {0.46, {{{0, -1}, {0, 0}}, {{0.44, kTop}, {0, -0.22}}, {{0.16, -0.38}, {0.47, 0}}}};
    of['l'] = {0.10, {{{0.05, -1}, {0.05, 0}}}};
    of['m'] = {0.84,
               {{{0, kTop}, {0, 0}},
                joined(arc(0.21, -0.43, 0.21, 0.23, 180, 360), {{0.42, 0}}),
                joined(arc(0.63, -0.43, 0.21, 0.23, 180, 360), {{0.84, 0}})}};
    of['n'] = {0.50, {{{0, kTop}, {0, 0}}, arch}};
    of['o'] = {0.56, {bowl}};
    of['p'] = {0.56, {bowl, {{0, kTop}, {0, 0.28}}}};
    of['q'] = {0.56, {bowl, {{0.56, kTop}, {0.56, 0.28}}}};
    of['r'] = {0.34, {{{0, kTop}, {0, 0}}, arc(0.24, -0.38, 0.24, 0.28, 180, 300)}};
    of['s'] = {0.46,
               {joined(arc(0.23, -0.495, 0.20, 0.165, 325, 90),
                       arc(0.23, -0.165, 0.23, 0.165, 270, 510))}};
    of['t'] = {0.36,
               {joined({{0.14, -0.92}}, arc(0.32, -0.16, 0.18, 0.16, 180, 80)),
                {{0, kTop}, {0.34, kTop}}}};
    of['u'] = {
        0.50,
        {joined({{0, kTop}}, arc(0.25, -0.25, 0.25, 0.25, 180, 0)), {{0.50, kTop}, {0.50, 0}}}};
    of['v'] = {0.52, {{{0, kTop}, {0.26, 0}, {0.52, kTop}}}};
    of['w'] = {0.76, {{{0, kTop}, {0.19, 0}, {0.38, -0.60}, {0.57, 0}, {0.76, kTop}}}};
    of['x'] = {0.48, {{{0, kTop}, {0.48, 0}}, {{0.48, kTop}, {0, 0}}}};
    of['y'] = {0.52, {{{0, kTop}, {0.26, 0}}, {{0.52, kTop}, {0.15, 0.28}}}};
    of['z'] = {0.46, {{{0, kTop}, {0.46, kTop}, {0, 0}, {0.46, 0}}}};
}

void add_capitals(Alphabet& of) {
    const Line stem{{0, 0}, {0, -1}};
    // The bowl of P and R
    const Line head =
        joined({{0, -1}}, joined(arc(0.30, -0.73, 0.27, 0.27, 270, 450), {{0, -0.46}}));
    of['A'] = {0.72, {{{0, 0}, {0.36, -1}, {0.72, 0}}, {{0.12, -0.34}, {0.60, -0.34}}}};
    of['B'] = {
        0.60,
        {stem, joined({{0, -1}}, joined(arc(0.30, -0.76, 0.24, 0.24, 270, 450), {{0, -0.52}})),
         joined({{0, -0.52}}, joined(arc(0.34, -0.26, 0.26, 0.26, 270, 450), {{0, 0}}))}};
    of['C'] = {0.70, {arc(0.40, -0.5, 0.40, 0.5, 45, 315)}};
    of['D'] = {0.68,
               {stem, joined({{0, -1}}, joined(arc(0.26, -0.5, 0.42, 0.5, 270, 450), {{0, 0}}))}};
    of['E'] = {0.54, {{{0.54, -1}, {0, -1}, {0, 0}, {0.54, 0}}, {{0, -0.52}, {0.48, -0.52}}}};
    of['F'] = {0.52, {{{0.52, -1}, {0, -1}, {0, 0}}, {{0, -0.50}, {0.46, -0.50}}}};
    of['G'] = {0.80,
               {joined(arc(0.40, -0.5, 0.40, 0.5, -42, -350), {{0.79, -0.44}, {0.46, -0.44}})}};
    of['H'] = {0.66, {stem, {{0.66, 0}, {0.66, -1}}, {{0, -0.52}, {0.66, -0.52}}}};
    of['I'] = {0.0, {stem}};
    of['J'] = {0.42, {joined({{0.42, -1}}, arc(0.21, -0.26, 0.21, 0.26, 0, 160))}};
    of['K'] = {0.62, {stem, {{0.58, -1}, {0, -0.38}}, {{0.20, -0.59}, {0.62, 0}}}};
    of['L'] = {0.50, {{{0, -1}, {0, 0}, {0.50, 0}}}};
    of['M'] = {0.82, {{{0, 0}, {0, -1}, {0.41, -0.15}, {0.82, -1}, {0.82, 0}}}};
    of['N'] = {0.66, {{{0, 0}, {0, -1}, {0.66, 0}, {0.66, -1}}}};
    of['O'] = {0.84, {arc(0.42, -0.5, 0.42, 0.5, 0, 360)}};
    of['P'] = {0.57, {stem, head}};
    of['Q'] = {0.84, {arc(0.42, -0.5, 0.42, 0.5, 0, 360), {{0.52, -0.24}, {0.84, 0.06}}}};
    of['R'] = {0.60, {stem, head, {{0.30, -0.46}, {0.60, 0}}}};
    of['S'] = {
        0.60,
        {joined(arc(0.30, -0.75, 0.26, 0.25, 325, 90), arc(0.30, -0.25, 0.30, 0.25, 270, 510))}};
    of['T'] = {0.66, {{{0, -1}, {0.66, -1}}, {{0.33, -1}, {0.33, 0}}}};
    of['U'] = {0.64,
               {joined(joined({{0, -1}}, arc(0.32, -0.32, 0.32, 0.32, 180, 0)), {{0.64, -1}})}};
    of['V'] = {0.70, {{{0, -1}, {0.35, 0}, {0.70, -1}}}};
    of['W'] = {1.00, {{{0, -1}, {0.25, 0}, {0.50, -0.92}, {0.75, 0}, {1.00, -1}}}};
    of['X'] = {0.62, {{{0, -1}, {0.62, 0}}, {{0.62, -1}, {0, 0}}}};
    of['Y'] = {0.64, {{{0, -1}, {0.32, -0.48}, {0.64, -1}}, {{0.32, -0.48}, {0.32, 0}}}};
    of['Z'] = {0.60, {{{0, -1}, {0.60, -1}, {0, 0}, {0.60, 0}}}};
}

void add_digits_and_marks(Alphabet& of) {
    of['0'] = {0.60, {arc(0.30, -0.5, 0.30, 0.5, 0, 360)}};
    of['1'] = {0.26, {{{0, -0.78}, {0.26, -1.0}, {0.26, 0}}}};
    of['2'] = {0.58, {joined(arc(0.29, -0.72, 0.27, 0.28, 195, 400), {{0, 0}, {0.58, 0}})}};
    of['3'] = {
        0.56,
        {joined(arc(0.27, -0.76, 0.24, 0.24, 200, 450), arc(0.27, -0.26, 0.29, 0.26, 270, 520))}};
    of['4'] = {0.62, {{{0.45, 0}, {0.45, -1}, {0, -0.28}, {0.62, -0.28}}}};
    of['5'] = {0.58, {joined({{0.52, -1}, {0.10, -1}}, arc(0.28, -0.32, 0.30, 0.32, 224, 510))}};
    of['6'] = {0.60,
               {arc(0.30, -0.31, 0.30, 0.31, 0, 360), arc(0.62, -0.31, 0.62, 0.69, 180, 255)}};
    of['7'] = {0.56, {{{0, -1}, {0.56, -1}, {0.18, 0}}}};
    of['8'] = {0.58, {arc(0.29, -0.76, 0.23, 0.24, 0, 360), arc(0.29, -0.26, 0.29, 0.26, 0, 360)}};
    of['9'] = {0.60, {arc(0.30, -0.69, 0.30, 0.31, 0, 360), arc(-0.02, -0.69, 0.62, 0.69, 0, 75)}};
    of[' '] = {0.30, {}};
    of['.'] = {0.14, {{{0.07, -0.04}, {0.07, -0.02}}}};
    of[','] = {0.06, {{{0.06, -0.06}, {0, 0.14}}}};
    of[':'] = {0.14, {{{0.07, -0.04}, {0.07, -0.02}}, {{0.07, -0.60}, {0.07, -0.58}}}};
    of[';'] = {0.06, {{{0.06, -0.06}, {0, 0.14}}, {{0.06, -0.60}, {0.06, -0.58}}}};
    of['-'] = {0.34, {{{0, -0.36}, {0.34, -0.36}}}};
    of['+'] = {0.48, {{{0, -0.38}, {0.48, -0.38}}, {{0.24, -0.62}, {0.24, -0.14}}}};
    of['='] = {0.48, {{{0, -0.50}, {0.48, -0.50}}, {{0, -0.24}, {0.48, -0.24}}}};
    of['/'] = {0.38, {{{0, 0.10}, {0.38, -1.05}}}};
    of['%'] = {0.84,
               {arc(0.17, -0.79, 0.17, 0.21, 0, 360),
                arc(0.67, -0.21, 0.17, 0.21, 0, 360),
                {{0.66, -1}, {0.18, 0}}}};
    of['('] = {0.14, {arc(0.36, -0.40, 0.36, 0.72, 128, 232)}};
    of[')'] = {0.14, {arc(-0.22, -0.40, 0.36, 0.72, -52, 52)}};
    of['_'] = {0.54, {{{0, 0.08}, {0.54, 0.08}}}};
    of['\''] = {0.0, {{{0, -1}, {0, -0.74}}}};
}

/// Letters with a sign above them, the letters alone, and the signs: d diaeresis, a acute, g grave, c circumflex, t tilde, r ring,
/// v caron.
constexpr std::u32string_view kSigned =
    U"ÀÁÂÃÄÅÈÉÊËÌÍÎÏÑÒÓÔÕÖÙÚÛÜÝàáâãäåèéêëìíîïñòóôõöùúûüýÿČčĎďĚěŇňŘřŠšŤťŮůŽž";
constexpr std::string_view kAlone =
    "AAAAAAEEEEIIIINOOOOOUUUUYaaaaaaeeeeiiiinooooouuuuyyCcDdEeNnRrSsTtUuZz";
constexpr std::string_view kSigns =
    "gactdrgacdgacdtgactdgacdagactdrgacdgacdtgactdgacdadvvvvvvvvvvvvvvrrvv";
static_assert(kSigned.size() == kAlone.size() && kSigned.size() == kSigns.size());

std::vector<Line> sign_lines(char sign, double x, double y) {
    switch (sign) {
        case 'd':
            return {{{x - 0.13, y - 0.01}, {x - 0.13, y + 0.01}},
                    {{x + 0.13, y - 0.01}, {x + 0.13, y + 0.01}}};
        case 'a':
            return {{{x - 0.06, y + 0.07}, {x + 0.10, y - 0.09}}};
        case 'g':
            return {{{x + 0.06, y + 0.07}, {x - 0.10, y - 0.09}}};
        case 'c':
            return {{{x - 0.15, y + 0.07}, {x, y - 0.09}, {x + 0.15, y + 0.07}}};
        case 'v':
            return {{{x - 0.15, y - 0.09}, {x, y + 0.07}, {x + 0.15, y - 0.09}}};
        case 'r':
            return {arc(x, y - 0.02, 0.10, 0.10, 0, 360)};
        default:
            return {joined(arc(x - 0.09, y + 0.02, 0.09, 0.07, 180, 360),
                           arc(x + 0.09, y + 0.02, 0.09, 0.07, 180, 0))};
    }
}

Letter with_sign(const Alphabet& of, char alone, char sign) {
    Letter out = of[static_cast<std::size_t>(alone)];
    if (alone == 'i') {  // the sign stands in place of the dot
        out.lines.resize(1);
        out.width = 0.2;
        for (Vec2& p : out.lines[0]) p.x() += 0.05;
    }
    const double y = alone >= 'a' && alone != 'd' && alone != 't' ? -0.90 : -1.22;
    for (Line& line : sign_lines(sign, out.width / 2, y)) out.lines.push_back(std::move(line));
    return out;
}

const Letter& letter(char32_t c) {
    static const Alphabet kAlphabet = [] {
        Alphabet of;
        of.fill({0.50, {{{0, 0}, {0, -0.8}, {0.5, -0.8}, {0.5, 0}, {0, 0}}}});
        add_small_letters(of);
        add_capitals(of);
        add_digits_and_marks(of);
        return of;
    }();
    static const std::vector<Letter> kWithSigns = [] {
        std::vector<Letter> of;
        for (std::size_t i = 0; i < kSigned.size(); ++i)
            of.push_back(with_sign(kAlphabet, kAlone[i], kSigns[i]));
        return of;
    }();
    if (c < 128) return kAlphabet[c];
    const std::size_t at = kSigned.find(c);
    return at == std::u32string_view::npos ? kAlphabet[0] : kWithSigns[at];
}

/// The characters of UTF-8. A byte that starts none is left out.
std::u32string characters_of(std::string_view text) {
    std::u32string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80)
            out += byte;
        else if (byte >= 0xC0)
            out += byte & (byte < 0xE0 ? 0x1F : byte < 0xF0 ? 0x0F : 0x07);
        else if (!out.empty())
            out.back() = out.back() << 6 | (byte & 0x3F);
    }
    return out;
}

double distance_to(const Line& line, const Vec2& p) {
    double best = 1e9;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2 along = line[i + 1] - line[i];
        const double length2 = along.squaredNorm();
        const double t =
            length2 > 0 ? std::clamp((p - line[i]).dot(along) / length2, 0.0, 1.0) : 0.0;
        best = std::min(best, (p - line[i] - t * along).norm());
    }
    return best;
}

}  // namespace

double text_width(std::string_view text) {
    double width = text.empty() ? 0 : -kLetterGap;
    for (const char32_t c : characters_of(text)) width += letter(c).width + kLetterGap;
    return width;
}

void write_text(std::string_view text, const Vec2& at, const TextStyle& style, Image& image) {
    constexpr double kAbove = 1.4, kBelow = 0.3;  ///< signs above capitals, descenders
    const double half = std::max(0.55, 0.5 * kPenWidth * style.height_px);
    const double rim = style.rim > 0 ? 0.10 * style.height_px + 0.6 : 0.0;
    const int reach = static_cast<int>(std::ceil(half + rim)) + 1;
    Vec2 pen = at;
    for (const char32_t c : characters_of(text)) {
        const Letter& shape = letter(c);
        // A letter that begins with a stem has it on one column of pixels, not half on two.
        Vec2 drawn = pen;
        if (!shape.lines.empty() && shape.lines[0][0].x() == shape.lines[0][1].x()) {
            const double stem = shape.lines[0][0].x() * style.height_px;
            drawn.x() = std::floor(pen.x() + stem) + 0.5 - stem;
        }
        const int left = static_cast<int>(pen.x()) - reach,
                  top = static_cast<int>(pen.y() - kAbove * style.height_px) - reach,
                  right = static_cast<int>(pen.x() + shape.width * style.height_px) + reach + 1,
                  bottom = static_cast<int>(pen.y() + kBelow * style.height_px) + reach;
        for (int y = std::max(0, top); y <= std::min(bottom, image.height_px - 1); ++y)
            for (int x = std::max(0, left); x <= std::min(right, image.width_px - 1); ++x) {
                const Vec2 p = (Vec2(x + 0.5, y + 0.5) - drawn) / style.height_px;
                double d = 1e9;
                for (const Line& line : shape.lines) d = std::min(d, distance_to(line, p));
                d *= style.height_px;
                std::uint8_t* pixel = image.pixel(x, y);
                if (rim > 0)
                    blend(pixel, Vec3::Constant(1 - style.ink),
                          style.rim * std::clamp((half + rim - d) / rim, 0.0, 1.0));
                blend(pixel, Vec3::Constant(style.ink), std::clamp(half - d + 0.5, 0.0, 1.0));
            }
        pen.x() += (shape.width + kLetterGap) * style.height_px;
    }
}

}  // namespace risorius::render
