// SPDX-License-Identifier: MIT
#include "risorius/plot/detail/axis_layout.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"

namespace risorius::plot {
namespace {

constexpr double kMargin = 0.05;  ///< fraction of the data's range, added at either end

std::string raised(const std::string& digits) {
    static const char* const kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char c : digits) text += c == '-' ? "⁻" : kDigits[c - '0'];
    return text;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string power_of_ten(int exponent) { return "10" + raised(std::to_string(exponent)); }

// Decades, thinned to at most eight labels. With fewer than three decades, 2 and 5 have labels too.
std::vector<Tic> logarithmic_tics(double low, double high) {
    const double decades = std::log10(high / low);
    const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9));
    const int last = static_cast<int>(std::ceil(std::log10(high) - 1e-9));
    const int stride = std::max(1, static_cast<int>(std::ceil(decades / 8)));
    // Powers of ten when some plain number would be long.
    const bool powers = first < -3 || last > 4;
    std::vector<Tic> tics;
    const auto add = [&](double at, const std::string& label) {
        if (at >= low * (1 - 1e-9) && at <= high * (1 + 1e-9)) tics.push_back({at, label});
    };
    for (int e = first; e <= last; ++e) {
        const double decade = std::pow(10.0, e);
        const bool named = e % stride == 0;
        add(decade, named ? (powers ? power_of_ten(e) : format_number(decade)) : "");
        for (int k = 2; k <= 9; ++k) {
            const bool labelled = decades < 1.05 || (decades < 2.5 && (k == 2 || k == 5));
            // Rounded to its two digits, so that 3 * 0.1 becomes 0.3.
            const std::string digit = std::to_string(k);
            add(k * decade, !labelled ? ""
                            : powers  ? digit + "×" + power_of_ten(e)
                                      : format_number(std::stod(digit + "e" + std::to_string(e))));
        }
    }
    return tics;
}

}  // namespace

std::string typeset(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (static_cast<unsigned char>(text[i]) < ' ' || text[i] == 0x7f) {
            out += ' ';
            continue;
        }
        std::size_t end = i + 1;
        if (text[i] == '^') {
            if (end < text.size() && text[end] == '-') ++end;
            const std::size_t digits = end;
            while (end < text.size() && is_digit(text[end])) ++end;
            if (end > digits) {
                out += raised(text.substr(i + 1, end - i - 1));
                i = end - 1;
                continue;
            }
        }
        out += text[i];
    }
    return out;
}

AxisLayout lay_out(const Axis& axis, const std::vector<double>& values, const std::string& place) {
    AxisLayout layout;
    if (axis.range) {
        layout.low = axis.range->first;
        layout.high = axis.range->second;
        if (!std::isfinite(layout.low) || !std::isfinite(layout.high) ||
            !(layout.low < layout.high))
            throw Error(place + "/range", "a low end below a high end",
                        format_number(layout.low) + " to " + format_number(layout.high));
    }
    double min = INFINITY, max = -INFINITY;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        if (axis.logarithmic && value <= 0)
            throw Error(place, "values above 0 on a logarithmic axis", format_number(value));
        min = std::min(min, value);
        max = std::max(max, value);
    }
    if (axis.logarithmic && axis.range && layout.low <= 0)
        throw Error(place + "/range", "a low end above 0 on a logarithmic axis",
                    format_number(layout.low));
    if (!axis.range) {
        if (min > max) throw Error(place, "a finite value", "none");
        if (axis.logarithmic) {
            const double margin = std::max(kMargin * std::log10(max / min), 0.05);
            layout.low = min * std::pow(10.0, -margin);
            layout.high = max * std::pow(10.0, margin);
        } else {
            // All values are equal: the range around them is wide enough for distinct numbers.
            const double span = max - min;
            const double margin = span > 0 ? kMargin * span : std::max(0.1 * std::abs(max), 1e-3);
            // Data that start at zero keep zero as the end of the axis.
            layout.low = min == 0 && span > 0 ? 0 : min - margin;
            layout.high = max == 0 && span > 0 ? 0 : max + margin;
        }
    }
    if (axis.logarithmic) layout.tics = logarithmic_tics(layout.low, layout.high);
    if (axis.logarithmic && !axis.names.empty())
        throw Error(place + "/names", "none on a logarithmic axis", axis.names.front().second);
    for (const auto& [at, name] : axis.names) layout.tics.push_back({at, typeset(name)});
    return layout;
}

}  // namespace risorius::plot
