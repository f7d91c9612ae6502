// SPDX-License-Identifier: MIT
#include "risorius/plot/write_chart.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "risorius/core/error.h"
#include "temporary_folder.h"

namespace risorius::plot {
namespace {

namespace fs = std::filesystem;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Chart volume_chart() {
    Chart chart;
    chart.name = "volume";
    chart.title = "Volume of the hanging cube";
    chart.x.label = "time (s)";
    chart.y.label = "change of volume (%)";
    for (const int n : {3, 5, 7, 9}) {
        Series series;
        series.label = std::to_string(n) + "^3 nodes";
        for (int i = 0; i <= 200; ++i) {
            const double t = i * 0.02;
            series.x.push_back(t);
            series.y.push_back(60.0 / (n * n) * (1 - std::exp(-t) * std::cos(6 * t)));
        }
        chart.series.push_back(series);
    }
    chart.bands.push_back({"published, 3^3", 8, 13});
    return chart;
}

Chart step_chart() {
    Chart chart;
    chart.name = "steps";
    chart.title = "Longest stable step";
    chart.x = {.label = "step (s)", .logarithmic = true, .range = {}};
    chart.y = {.label = "damping (kg s^-1)", .logarithmic = true, .range = {}};
    chart.series.push_back({"Runge-Kutta 4", {1e-4, 1e-3, 1e-2}, {1, 0.1, 0.01}, Mark::kPoints});
    chart.series.push_back({"linear prediction", {1e-4, 1e-2}, {1.1, 0.011}, Mark::kDashed, 0});
    return chart;
}

template <class Call>
std::string message_of(const Call& call) {
    try {
        call();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "no error";
}

std::string message_of(const Chart& chart) {
    const TemporaryFolder folder;
    const std::string message = message_of([&] { write_chart(chart, folder.path()); });
    EXPECT_EQ(folder.listing(), std::set<std::string>{}) << "a refused chart leaves nothing";
    return message;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Width and height from the header of a PNG.
std::pair<int, int> png_size(const std::string& bytes) {
    if (bytes.size() < 24 || bytes.substr(0, 8) != "\x89PNG\r\n\x1a\n") return {0, 0};
    const auto number = [&](std::size_t at) {
        int value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
        return value;
    };
    return {number(16), number(20)};
}

/// True when elements are closed in order: the part of XML that a drawing program may get wrong.
bool is_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    std::size_t at = 0;
    while ((at = xml.find('<', at)) != std::string::npos) {
        if (xml.compare(at, 4, "<!--") == 0) {
            at = xml.find("-->", at);
            if (at == std::string::npos) return false;
            continue;
        }
        // "<" inside an attribute would end it too early. ">" inside one is allowed, but not used here.
        const std::size_t end = xml.find('>', at);
        if (end == std::string::npos) return false;
        const std::string tag = xml.substr(at + 1, end - at - 1);
        at = end;
        if (tag.find('<') != std::string::npos) return false;
        if (tag.front() == '?' || tag.front() == '!' || tag.back() == '/') continue;
        const std::size_t name_end = tag.find_first_of(" \t\r\n");
        if (tag.front() == '/') {
            if (open.empty() || open.back() != tag.substr(1)) return false;
            open.pop_back();
        } else {
            open.push_back(tag.substr(0, name_end));
        }
    }
    return open.empty();
}

TEST(NamedAxis, HasNamesInPlaceOfNumbers) {
    const TemporaryFolder folder;
    Chart chart;
    chart.name = "named";
    chart.x.names = {{0, "fat's stiffness"}, {1, "force"}};
    chart.x.range = {-0.5, 1.5};
    chart.series.push_back({"", {0, 1}, {0.2, 0.7}, Mark::kPoints});
    write_chart(chart, folder.path());
    const std::string script = bytes_of(folder / "named.gp");
    EXPECT_NE(script.find("set xtics rotate by 35 right ('fat''s stiffness' 0, 'force' 1)"),
              std::string::npos)
        << script;
    EXPECT_NE(bytes_of(folder / "named.svg").find("stiffness"), std::string::npos);
    chart.x.logarithmic = true;
    chart.x.range = {0.5, 1.5};
    EXPECT_EQ(message_of([&] { write_chart(chart, folder.path()); }).substr(0, 60),
              "chart \"named\"/x: expected values above 0 on a logarithmic ax");
    chart.series.front().x = {0.6, 1};
    EXPECT_EQ(
        message_of([&] { write_chart(chart, folder.path()); }),
        "chart \"named\"/x/names: expected none on a logarithmic axis, found fat's stiffness");
}

TEST(WriteChart, LeavesBothPicturesTheScriptAndTheData) {
    const TemporaryFolder folder;
    EXPECT_EQ(
        write_chart(volume_chart(), folder.path()),
        (std::vector<std::string>{"volume.svg", "volume.png", "volume.gp", "volume.data.csv"}));
    EXPECT_EQ(folder.listing(),
              (std::set<std::string>{"volume.svg", "volume.png", "volume.gp", "volume.data.csv"}));
    EXPECT_EQ(png_size(bytes_of(folder / "volume.png")), (std::pair{2160, 1350}));
    const std::string svg = bytes_of(folder / "volume.svg");
    EXPECT_TRUE(is_well_formed(svg));
    for (const char* text : {"Volume of the hanging cube", "time (s)", "change of volume (%)",
                             "3³ nodes", "9³ nodes", "published, 3³"})
        EXPECT_TRUE(contains(svg, text)) << text;
}

TEST(WriteChart, TheSameChartGivesTheSameBytes) {
    const TemporaryFolder a, b;
    for (const std::string& file : write_chart(volume_chart(), a.path())) {
        write_chart(volume_chart(), b.path());
        EXPECT_EQ(bytes_of(a / file), bytes_of(b / file)) << file;
    }
}

TEST(WriteChart, TheScriptDrawsTheSamePictureWhereverItsFolderIs) {
    const TemporaryFolder a, b;
    write_chart(step_chart(), a.path());
    fs::copy(a / "steps.gp", b / "steps.gp");
    fs::copy(a / "steps.data.csv", b / "steps.data.csv");
    ASSERT_EQ(std::system(("cd '" + b.path().string() + "' && gnuplot steps.gp").c_str()), 0);
    EXPECT_EQ(bytes_of(a / "steps.svg"), bytes_of(b / "steps.svg"));
}

TEST(WriteChart, AnotherLanguageOfTheUserChangesNothing) {
    const TemporaryFolder a, b;
    write_chart(volume_chart(), a.path());
    ::setenv("LC_ALL", "de_DE.UTF-8", 1);
    write_chart(volume_chart(), b.path());
    ::unsetenv("LC_ALL");
    EXPECT_EQ(bytes_of(a / "volume.svg"), bytes_of(b / "volume.svg"));
}

TEST(WriteChart, DataKeepEveryDigitAndTheirSeries) {
    const TemporaryFolder folder;
    Chart chart = volume_chart();
    chart.series = {{"a \"b\", c", {0.1, 2}, {1.0 / 3, -1e-20}}, {"", {1}, {2}}};
    write_chart(chart, folder.path());
    EXPECT_EQ(bytes_of(folder / "volume.data.csv"),
              "series,x,y\n\"a \"\"b\"\", c\",0.1,0.3333333333333333\n\"a \"\"b\"\", c\",2,-1e-20\n"
              "\n\n\"\",1,2\n");
}

TEST(WriteChart, LogarithmicAxesAreNumberedInPowersOfTen) {
    const TemporaryFolder folder;
    write_chart(step_chart(), folder.path());
    const std::string svg = bytes_of(folder / "steps.svg");
    for (const char* text : {"10⁻⁴", "10⁻³", "10⁻²", ">0.1<", "damping (kg s⁻¹)"})
        EXPECT_TRUE(contains(svg, text)) << text;
}

TEST(WriteChart, ALogarithmicAxisShorterThanADecadeStillHasNumbers) {
    const TemporaryFolder folder;
    Chart chart = step_chart();
    chart.series = {{"close", {0.25, 0.45}, {300, 450}}};
    write_chart(chart, folder.path());
    const std::string svg = bytes_of(folder / "steps.svg");
    for (const char* text : {">0.3<", ">0.4<", ">300<", ">400<"})
        EXPECT_TRUE(contains(svg, text)) << text;
}

TEST(WriteChart, AGapInTheDataIsAGapInTheCurve) {
    const TemporaryFolder whole, broken;
    Chart chart = volume_chart();
    chart.series.resize(1);
    write_chart(chart, whole.path());
    for (std::size_t i = 50; i < 60; ++i) chart.series[0].y[i] = i % 2 ? kNan : INFINITY;
    write_chart(chart, broken.path());
    // A polyline starts with M, and again after a gap.
    const auto pieces = [](const std::string& svg) {
        const std::size_t begin = svg.find("<path", svg.find("gnuplot_plot_1\""));
        const std::string group = svg.substr(begin, svg.find("</g>", begin) - begin);
        return std::count(group.begin(), group.end(), 'M');
    };
    EXPECT_EQ(pieces(bytes_of(broken / "volume.svg")), pieces(bytes_of(whole / "volume.svg")) + 1);
}

TEST(WriteChart, ASeriesWithoutPointsDoesNotShiftTheOthers) {
    const TemporaryFolder a, b;
    Chart chart = volume_chart();
    chart.series = {{"first", {0, 1}, {0, 1}, Mark::kLine, 0},
                    {"third", {0, 1}, {1, 0}, Mark::kLine, 2}};
    write_chart(chart, a.path());
    chart.series.insert(chart.series.begin() + 1, Series{"", {}, {}, Mark::kLine, 1});
    write_chart(chart, b.path());
    EXPECT_EQ(bytes_of(a / "volume.png"), bytes_of(b / "volume.png"));
}

TEST(WriteChart, LabelsAreTextAndNothingElse) {
    const TemporaryFolder folder;
    Chart chart = volume_chart();
    chart.title = "Smith's `date` <b>$x_0^{2}</b> & \"co\" \\n @home 100 %d";
    chart.series[0].label = "eta'_22 {soft}; system('touch hacked')\nunset key";
    write_chart(chart, folder.path());
    EXPECT_FALSE(fs::exists(folder / "hacked"));
    const std::string svg = bytes_of(folder / "volume.svg");
    EXPECT_TRUE(is_well_formed(svg));
    EXPECT_TRUE(contains(svg,
                         "Smith's `date` &lt;b>$x_0^{2}&lt;/b> &amp; \"co\" \\n @home "
                         "100 %d"));
    EXPECT_TRUE(contains(svg, "eta'_22 {soft}; system('touch hacked') unset key"));
}

TEST(WriteChart, AllThatWasPublishedIsSeenThoughTheCurvesStayBelow) {
    const TemporaryFolder folder;
    Chart chart = volume_chart();
    chart.bands = {{"published", 20, 30}, {"open above", 40, INFINITY}, {"a number", 35, 35}};
    write_chart(chart, folder.path());
    const std::string script = bytes_of(folder / "volume.gp");
    EXPECT_TRUE(contains(script, "first 20 to graph 1, first 30 behind")) << script;
    EXPECT_TRUE(contains(script, "first 40 to graph 1, first 42 behind")) << script;
    EXPECT_TRUE(contains(script, "set arrow from graph 0, first 35")) << script;
    EXPECT_TRUE(contains(script, "set yrange [0:42]")) << script;
}

TEST(WriteChart, ValuesThatALogarithmicAxisDoesNotHaveAreNamed) {
    Chart chart = step_chart();
    chart.series[0].y[1] = 0;
    EXPECT_EQ(message_of(chart),
              "chart \"steps\"/y: expected values above 0 on a logarithmic axis, found 0");
    chart = step_chart();
    chart.series[1].x[0] = -2;
    EXPECT_EQ(message_of(chart),
              "chart \"steps\"/x: expected values above 0 on a logarithmic axis, found -2");
    chart = step_chart();
    chart.y.range = {0.0, 1.0};
    EXPECT_EQ(message_of(chart),
              "chart \"steps\"/y/range: expected a low end above 0 on a logarithmic axis, found 0");
}

TEST(WriteChart, ChartsThatCannotBeDrawnAreNamed) {
    Chart chart = step_chart();
    chart.series[0].x.pop_back();
    EXPECT_EQ(message_of(chart),
              "chart \"steps\"/series/0: expected as many y as x, found 2 x and 3 y");
    chart = step_chart();
    chart.series.clear();
    EXPECT_EQ(message_of(chart), "chart \"steps\"/series: expected at least one, found none");
    chart.series.push_back({"diverged", {1}, {kNan}});
    EXPECT_EQ(message_of(chart), "chart \"steps\"/x: expected a finite value, found none");
    chart = step_chart();
    chart.x.range = {2.0, 1.0};
    EXPECT_EQ(message_of(chart),
              "chart \"steps\"/x/range: expected a low end below a high end, found 2 to 1");
    chart = step_chart();
    chart.bands.push_back({"", 2, 1});
    EXPECT_EQ(message_of(chart),
              "chart \"steps\"/bands/0: expected a low end below a high end, found 2 to 1");
    for (const char* name : {"", "a/b", "..", "a'b", "-o"}) {
        chart.name = name;
        EXPECT_EQ(message_of(chart), "chart/name: expected letters, digits, _ and -, found \"" +
                                         std::string(name) + "\"");
    }
}

TEST(WriteChart, AMissingGnuplotIsNamedWithItsPackage) {
    const TemporaryFolder folder;
    EXPECT_EQ(message_of([&] {
                  write_chart(volume_chart(), folder.path(), {.gnuplot = "no-such-gnuplot"});
              }),
              "no-such-gnuplot: not found; charts are drawn by it (Debian package gnuplot-nox)");
}

TEST(WriteChart, AGnuplotThatFailsIsQuoted) {
    const TemporaryFolder folder;
    const fs::path program = folder / "broken_gnuplot";
    std::ofstream(program) << "#!/bin/sh\necho 'no such terminal' >&2\nexit 3\n";
    fs::permissions(program, fs::perms::owner_all);
    EXPECT_EQ(message_of([&] { write_chart(volume_chart(), folder.path(), {.gnuplot = program}); }),
              program.string() + " volume.gp: exit code 3: no such terminal");
    std::ofstream(program) << "#!/bin/sh\nexit 0\n";
    EXPECT_EQ(message_of([&] { write_chart(volume_chart(), folder.path(), {.gnuplot = program}); }),
              (folder / "volume.svg").string() + ": not written by " + program.string());
}

TEST(WriteChart, AFolderThatCannotBeWrittenIsNamed) {
    const TemporaryFolder folder;
    std::ofstream(folder / "none") << "a file";
    EXPECT_EQ(message_of([&] { write_chart(volume_chart(), folder / "none"); }),
              (folder / "none").string() + ": expected a folder, found a file");
}

}  // namespace
}  // namespace risorius::plot
