// SPDX-License-Identifier: MIT
#include "risorius/study/detail/study_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "risorius/core/version.h"
#include "risorius/report/html_writer.h"
#include "risorius/study/detail/study_charts.h"

namespace risorius::study {

namespace {

using report::HtmlWriter;

constexpr std::size_t kRows = 16;

std::string fixed(double value, int decimals) {
    if (!std::isfinite(value)) return "–";
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

void head_row(HtmlWriter& html, const std::vector<std::string>& names) {
    html.open("tr");
    for (std::size_t i = 0; i < names.size(); ++i)
        html.element(
            "th", names[i],
            i == 0 ? HtmlWriter::Attributes{} : HtmlWriter::Attributes{{"class", "number"}});
    html.close();
}

void row(HtmlWriter& html, const std::vector<std::string>& cells) {
    html.open("tr");
    for (std::size_t i = 0; i < cells.size(); ++i)
        html.element(
            "td", cells[i],
            i == 0 ? HtmlWriter::Attributes{} : HtmlWriter::Attributes{{"class", "number"}});
    html.close();
}

void write_parameters(HtmlWriter& html, const StudyDescription& study) {
    html.open("section").element("h2", "What varies");
    html.open("div", {{"class", "scroll"}}).open("table");
    html.open("tr");
    for (const char* name : {"parameter", "how", "numbers of the rig", ""})
        html.element("th", name);
    html.close();
    for (const Parameter& parameter : study.parameters) {
        std::string paths;
        for (const std::string& path : parameter.of) paths += (paths.empty() ? "" : ", ") + path;
        html.open("tr").element("td", parameter.name).element("td", parameter.text());
        html.element("td", paths)
            .element("td", std::to_string(parameter.numbers.size()) +
                               (parameter.each ? ", each by itself" : ""));
        html.close();
    }
    html.close().close().close();
}

void write_chart_picture(HtmlWriter& html, const std::string& file, const std::string& what) {
    html.open("figure").open("a", {{"href", file}});
    html.single("img", {{"src", file}, {"alt", what}, {"loading", "lazy"}}).close();
    html.element("figcaption", what).close();
}

void write_indices(HtmlWriter& html, const StudyDescription& study, const Output& pose) {
    html.open("div", {{"class", "scroll"}}).open("table");
    head_row(html, {"parameter", "first order", "95 %", "total", "95 %"});
    std::vector<std::size_t> order;
    for (std::size_t p = 0; p < study.parameters.size(); ++p) order.push_back(p);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return pose.indices[a].total.value > pose.indices[b].total.value;
    });
    for (const std::size_t p : order) {
        const sensitivity::SobolIndices& one = pose.indices[p];
        row(html,
            {study.parameters[p].name, fixed(one.first.value, 2),
             fixed(one.first.low, 2) + " to " + fixed(one.first.high, 2), fixed(one.total.value, 2),
             fixed(one.total.low, 2) + " to " + fixed(one.total.high, 2)});
    }
    html.close().close();
}

void write_spread(HtmlWriter& html, const StudyDescription& study, const StudyResults& results,
                  int pose) {
    html.open("div", {{"class", "scroll"}}).open("table");
    head_row(html, {"landmark", "the rig as it is, mm", "mean, mm", "5 %", "95 %", "sd, mm",
                    "95 % within, mm"});
    for (const Output* output : shown_landmarks(study, results, pose, kRows)) {
        const Spread& s = output->spread;
        row(html, {study.landmarks[static_cast<std::size_t>(output->landmark)], fixed(s.rig, 2),
                   fixed(s.mean, 2), fixed(s.low, 2), fixed(s.high, 2), fixed(s.deviation, 2),
                   fixed(s.away, 2)});
    }
    html.close().close();
}

void write_pose(HtmlWriter& html, const StudyDescription& study, const StudyResults& results,
                const Output& pose) {
    const std::string& name = study.poses[static_cast<std::size_t>(pose.pose)].name;
    html.open("section").element("h2", name);
    html.open("div", {{"class", "pictures"}});
    if (!pose.indices.empty() && std::isfinite(pose.indices.front().total.value))
        write_chart_picture(html, "indices_" + name + ".svg",
                            "Where the variance of all landmarks together comes from");
    write_chart_picture(html, "spread_" + name + ".svg", "How far landmarks move");
    html.close();
    if (!pose.indices.empty()) write_indices(html, study, pose);
    write_spread(html, study, results, pose.pose);
    html.close();
}

}  // namespace

std::string study_page(const StudyDescription& study, const StudyResults& results) {
    HtmlWriter html;
    html.element("h1", study.name);
    html.element("p",
                 "Rig " + study.rig.generic_string() + ", " + std::to_string(study.runs()) +
                     " faces: the rig as it is, and " + std::to_string(study.count) +
                     (study.indices ? " rows of two samples, with each parameter exchanged in turn."
                                    : " rows of a sample."),
                 {{"class", "soft"}});
    if (results.unsettled() > 0)
        html.element("p",
                     std::to_string(results.unsettled()) +
                         " poses did not come to rest within the limit of iterations.",
                     {{"class", "bad"}});
    write_parameters(html, study);
    html.element(
        "p",
        "First order: the part of the variance that would go away if the parameter were known. "
        "Total: the part that would stay if all others were known. Lengths are those of the "
        "displacement from the head at rest; 95 % of the faces have the landmark within the last "
        "column of where the rig as it is has it.",
        {{"class", "soft"}});
    for (const Output& pose : results.poses) write_pose(html, study, results, pose);
    html.open("p", {{"class", "soft"}}).text("Numbers for other programs: ");
    std::vector<std::string> tables{"results.json", "samples.tsv", "displacements.tsv",
                                    "spread.tsv"};
    if (study.indices) tables.push_back("indices.tsv");
    for (std::size_t i = 0; i < tables.size(); ++i)
        html.text(i == 0 ? "" : ", ").element("a", tables[i], {{"href", tables[i]}});
    html.text(". Made by Risorius " + std::string(kVersion) + ".").close();
    return report::html_page(study.name, html);
}

}  // namespace risorius::study
