// SPDX-License-Identifier: MIT
#include "risorius/plot/write_chart.h"

#include <algorithm>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/output_set.h"
#include "risorius/plot/detail/chart_script.h"
#include "risorius/plot/detail/run_gnuplot.h"

namespace risorius::plot {
namespace {

namespace fs = std::filesystem;

// Checks the name, which becomes part of a script and of paths.
void check_name(const std::string& name) {
    const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
    });
    if (name.empty() || !plain || name.front() == '-')
        throw Error("chart/name", "letters, digits, _ and -", "\"" + name + "\"");
}

void check_series(const Chart& chart, const std::string& place) {
    if (chart.series.empty()) throw Error(place + "/series", "at least one", "none");
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const Series& series = chart.series[i];
        if (series.x.size() != series.y.size())
            throw Error(place + "/series/" + std::to_string(i), "as many y as x",
                        std::to_string(series.x.size()) + " x and " +
                            std::to_string(series.y.size()) + " y");
    }
}

void check_bands(const Chart& chart, const std::string& place) {
    for (std::size_t i = 0; i < chart.bands.size(); ++i) {
        const Band& band = chart.bands[i];
        if (!(band.low <= band.high))
            throw Error(place + "/bands/" + std::to_string(i), "a low end below a high end",
                        format_number(band.low) + " to " + format_number(band.high));
    }
}

// Collects the points that are drawn. A gap in one coordinate is a gap in the other too.
void gather(const Chart& chart, std::vector<double>& x, std::vector<double>& y) {
    for (const Series& series : chart.series)
        for (std::size_t k = 0; k < series.x.size(); ++k)
            if (std::isfinite(series.x[k]) && std::isfinite(series.y[k])) {
                x.push_back(series.x[k]);
                y.push_back(series.y[k]);
            }
    if (x.empty()) return;
    // A published range is shown completely, unless an end is infinite or the axis cannot show it.
    for (const Band& band : chart.bands)
        for (const double end : {band.low, band.high})
            if (std::isfinite(end) && (!chart.y.logarithmic || end > 0)) y.push_back(end);
}

}  // namespace

std::vector<std::string> write_chart(const Chart& chart, const fs::path& folder,
                                     const ChartWriter& writer) {
    check_name(chart.name);
    const std::string place = "chart \"" + chart.name + "\"";
    check_series(chart, place);
    check_bands(chart, place);
    std::vector<double> x, y;
    gather(chart, x, y);
    const AxisLayout x_layout = lay_out(chart.x, x, place + "/x");
    const AxisLayout y_layout = lay_out(chart.y, y, place + "/y");

    write_file(folder / (chart.name + ".data.csv"), chart_data(chart));
    write_file(folder / (chart.name + ".gp"), chart_script(chart, x_layout, y_layout));
    run_gnuplot(writer.gnuplot, chart.name + ".gp", folder);

    std::vector<std::string> files;
    for (const char* ending : {".svg", ".png", ".gp", ".data.csv"}) {
        files.push_back(chart.name + ending);
        std::error_code failure;
        if (fs::file_size(folder / files.back(), failure) == 0 || failure)
            throw RunError((folder / files.back()).string() + ": not written by " + writer.gnuplot);
    }
    return files;
}

}  // namespace risorius::plot
