// SPDX-License-Identifier: MIT
#include "risorius/plot/detail/chart_script.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/json_cursor.h"

namespace risorius::plot {
namespace {

struct Colour {
    const char* name;
    const char* rgb;
};

// Okabe and Ito 2008, "Color Universal Design". Yellow is faint on white and comes last.
constexpr Colour kPalette[] = {
    {"blue", "#0072b2"},   {"vermillion", "#d55e00"}, {"green", "#009e73"}, {"purple", "#cc79a7"},
    {"orange", "#e69f00"}, {"sky blue", "#56b4e9"},   {"black", "#000000"}, {"yellow", "#f0e442"}};
constexpr int kColours = static_cast<int>(std::size(kPalette));

// Published ranges are grey and lie behind the curves. Several ranges have different shades.
constexpr const char* kBandShades[] = {"#e3e3e3", "#f3e3c8", "#d8e8f2", "#e2efe4"};

// Filled circle, square, triangle, diamond and down triangle, then the same ones open.
constexpr int kPointTypes[] = {7, 5, 9, 13, 11, 6, 4, 8, 12, 10};

// Size of the SVG, px. The PNG is three times as large: 18 cm wide at 300 dots per inch.
constexpr int kWidth_px = 720;
constexpr int kHeight_px = 450;
constexpr int kPngScale = 3;
constexpr std::size_t kLongestLabelBeside = 22;  ///< characters; longer labels go below the chart
constexpr std::size_t kMaxLabelsBelow = 9;

// Puts a text in single quotes. In such a string, gnuplot interprets only the quote itself.
std::string in_quotes(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
    return out + "'";
}

std::string number(double value) { return std::isnan(value) ? "nan" : format_number(value); }

std::size_t letters(const std::string& utf8) {
    return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }));
}

/// The given colours, and the next free one for each other series.
std::vector<int> colours_of(const std::vector<Series>& series) {
    std::vector<int> colours;
    int next = 0;
    for (const Series& s : series) colours.push_back(s.colour >= 0 ? s.colour : next++);
    return colours;
}

std::string axis_lines(const char* name, const Axis& axis, const AxisLayout& layout) {
    const std::string n = name;
    std::string text = "set " + n + "label " + in_quotes(typeset(axis.label)) + "\n";
    text += "set " + n + "range [" + number(layout.low) + ":" + number(layout.high) + "]\n";
    if (!axis.logarithmic && layout.tics.empty()) return text + "set format " + n + " '%h'\n";
    if (axis.logarithmic) text += "set logscale " + n + " 10\n";
    // Names lean, so that they do not run into one another.
    text += "set " + n + "tics " + (axis.logarithmic ? "(" : "rotate by 35 right (");
    for (std::size_t i = 0; i < layout.tics.size(); ++i) {
        const Tic& tic = layout.tics[i];
        text += (i ? ", " : "") + in_quotes(tic.label) + " " + number(tic.at);
        if (tic.label.empty()) text += " 1";
    }
    return text + ")\n";
}

std::string band_lines(const Chart& chart, const AxisLayout& y) {
    std::string text;
    for (std::size_t i = 0; i < chart.bands.size(); ++i) {
        const double low = std::max(chart.bands[i].low, y.low);
        const double high = std::min(chart.bands[i].high, y.high);
        if (low > high) continue;  // outside the given range
        const std::string shade = kBandShades[i % std::size(kBandShades)];
        const std::string place =
            " from graph 0, first " + number(low) + " to graph 1, first " + number(high);
        // A single published value is a line.
        text += low < high ? "set object rectangle" + place + " behind fillcolor rgb '" + shade +
                                 "' fillstyle solid 1 noborder\n"
                           : "set arrow" + place + " nohead back linewidth 3 linecolor rgb '" +
                                 shade + "'\n";
    }
    return text;
}

std::string key_line(const Chart& chart) {
    std::size_t count = 0, longest = 0;
    const auto count_label = [&](const std::string& label) {
        if (label.empty()) return;
        ++count;
        longest = std::max(longest, letters(typeset(label)));
    };
    for (const Series& series : chart.series) count_label(series.label);
    for (const Band& band : chart.bands) count_label(band.label);
    if (count == 0) return "unset key\n";
    // Beside or below the curves, never over them.
    if (longest <= kLongestLabelBeside || count > kMaxLabelsBelow)
        return "set key outside right top vertical Left reverse samplen 2 spacing 1.25\n";
    return "set key outside below center horizontal Left reverse samplen 2 spacing 1.25 "
           "maxcols 2 height 0.8\n";
}

std::string curve(const Series& series, std::size_t index, int colour, std::size_t nth_marked) {
    const std::string line = " linewidth 1.8";
    const std::string point = " pointtype " +
                              std::to_string(kPointTypes[nth_marked % std::size(kPointTypes)]) +
                              " pointsize 0.75";
    std::string style;
    switch (series.mark) {
        case Mark::kLine:
            style = "lines" + line;
            break;
        case Mark::kDashed:
            style = "lines" + line + " dashtype (8,5)";
            break;
        case Mark::kPoints:
            style = "points" + point;
            break;
        case Mark::kLinePoints:
            style = "linespoints" + line + point;
            break;
    }
    return "DATA skip 1 index " + std::to_string(index) + " using 2:3 with " + style +
           " linecolor rgb '" + kPalette[colour % kColours].rgb + "' " +
           (series.label.empty() ? "notitle" : "title " + in_quotes(typeset(series.label)));
}

std::string plot_lines(const Chart& chart) {
    const std::vector<int> colours = colours_of(chart.series);
    std::vector<std::string> parts;
    std::size_t marked = 0;
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const Mark mark = chart.series[i].mark;
        parts.push_back(curve(chart.series[i], i, colours[i], marked));
        marked += mark == Mark::kPoints || mark == Mark::kLinePoints;
    }
    for (std::size_t i = 0; i < chart.bands.size(); ++i)
        if (!chart.bands[i].label.empty())
            parts.push_back("keyentry with boxes fillstyle solid 1 noborder fillcolor rgb '" +
                            std::string(kBandShades[i % std::size(kBandShades)]) + "' title " +
                            in_quotes(typeset(chart.bands[i].label)));
    std::string text = "plot ";
    for (std::size_t i = 0; i < parts.size(); ++i) text += (i ? ", \\\n     " : "") + parts[i];
    return text + "\n";
}

/// Draws the same curves twice, as vectors and as pixels.
std::string output_lines(const std::string& name, const std::string& plot) {
    const auto size = [](int scale) {
        return " size " + std::to_string(scale * kWidth_px) + "," +
               std::to_string(scale * kHeight_px);
    };
    const std::string scale = std::to_string(kPngScale);
    return "set terminal svg noenhanced" + size(1) +
           " font 'DejaVu Sans,Helvetica,Arial,sans-serif,11' background 'white'\n"
           "set output " +
           in_quotes(name + ".svg") + "\n" + plot + "set terminal pngcairo noenhanced" +
           size(kPngScale) + " font 'DejaVu Sans,11' fontscale " + scale + " linewidth " + scale +
           " pointscale " + scale +
           " background 'white'\n"
           "set output " +
           in_quotes(name + ".png") + "\n" + plot + "set output\n";
}

}  // namespace

std::string chart_data(const Chart& chart) {
    std::string text = "series,x,y\n";
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const Series& series = chart.series[i];
        if (i > 0) text += "\n\n";
        // CSV doubles a quote inside a name.
        std::string name = "\"";
        for (const char c : typeset(series.label))
            name += c == '"' ? std::string("\"\"") : std::string(1, c);
        name += "\",";
        if (series.x.empty()) text += name + "nan,nan\n";  // every series has a block
        for (std::size_t k = 0; k < series.x.size(); ++k)
            text += name + number(series.x[k]) + "," + number(series.y[k]) + "\n";
    }
    return text;
}

std::string chart_script(const Chart& chart, const AxisLayout& x, const AxisLayout& y) {
    return "# Draws " + chart.name + ".data.csv as " + chart.name + ".svg and " + chart.name +
           ".png: gnuplot " + chart.name +
           ".gp\n"
           "set encoding utf8\n"
           "set datafile separator comma\n"
           "DATA = " +
           in_quotes(chart.name + ".data.csv") +
           "\n"
           "set title " +
           in_quotes(typeset(chart.title)) + "\n" + axis_lines("x", chart.x, x) +
           axis_lines("y", chart.y, y) +
           "set border 3 linewidth 0.8 linecolor rgb '#404040'\n"
           "set tics nomirror out scale 0.6\n"
           "set grid xtics ytics linewidth 0.6 linecolor rgb '#c8c8c8' dashtype solid\n" +
           band_lines(chart, y) + key_line(chart) + output_lines(chart.name, plot_lines(chart));
}

}  // namespace risorius::plot
