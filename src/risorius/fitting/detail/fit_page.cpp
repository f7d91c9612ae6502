// SPDX-License-Identifier: MIT
#include "risorius/fitting/detail/fit_page.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/report/html_writer.h"

namespace risorius::fitting {
namespace {

constexpr std::size_t kMaxWorthGiving = 10;

std::string rounded(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

void row(report::HtmlWriter& html, const std::string& name, const std::string& value) {
    html.open("tr").element("th", name).element("td", value).close();
}

std::string page_of(const FitReport& report, const rig::RigDescription& rig) {
    report::HtmlWriter html;
    html.element("h1", "Fit of " + rig.name);
    html.single("img",
                {{"src", kFitPicture},
                 {"alt", "Landmarks from the front and the side, thickness of tissue, bone"}});
    html.element("p",
                 "Landmarks should lie where the legend of the standard landmarks says, the line "
                 "between the lips in "
                 "the furrow between them, the margins of the lids on the rims of the lids. Left "
                 "and right are the "
                 "subject's own.");

    html.element("h2", "What was found");
    html.open("table");
    row(html, "unit of the mesh",
        format_number(report.metres_per_unit) + " m" +
            (report.guessed_unit ? ", told from the landmarks" : ""));
    row(html, "size", rounded(report.size, 3) + " of the average adult");
    row(html, "landmarks from the atlas", rounded(report.residual_mm, 1) + " mm RMS");
    row(html, "landmarks",
        std::to_string(report.given_landmarks) + " given, " +
            std::to_string(report.warped_landmarks.size()) + " placed by the atlas");
    row(html, "tissue over the bone",
        rounded(report.bone.thinnest_mm, 1) + " to " + rounded(report.bone.thickest_mm, 1) +
            " mm, " + rounded(report.bone.mean_mm, 1) + " on average; " +
            std::to_string(report.bone.through_skin) + " points of bone outside of the skin");
    row(html, "tissue",
        std::to_string(report.nodes) + " nodes, " + std::to_string(report.tets) + " tetrahedra, " +
            std::to_string(report.dropped_tets) + " too thin to be used");
    row(html, "eyes", report.eyes ? "found" : "guessed");
    row(html, "teeth", report.teeth ? "found" : "guessed");
    row(html, "lips", report.lips_cut ? "cut apart" : "apart");
    for (const auto& [role, groups] : report.parts) {
        std::string list;
        for (const std::string& group : groups) list += (list.empty() ? "" : ", ") + group;
        row(html, role, list);
    }
    html.close();

    if (!report.notes.empty()) {
        html.element("h2", "To look at").open("ul");
        for (const std::string& note : report.notes) html.element("li", note);
        html.close();
    }
    if (!report.worth_giving.empty()) {
        html.element("h2", "Landmarks that would help most").open("table");
        for (std::size_t i = 0; i < std::min(kMaxWorthGiving, report.worth_giving.size()); ++i) {
            const rig::AtlasLandmark* landmark = rig.atlas.landmark(report.worth_giving[i]);
            row(html, landmark->id, landmark->name);
        }
        html.close();
    }
    if (!report.strengths.empty()) {
        html.element("h2", "Strength of the muscles");
        html.element("p",
                     "Strength is a ratio to what the cross-section gives; length that of the "
                     "fibres at full "
                     "activation over their length at rest.");
        if (report.difference_before > 0)
            html.element("p",
                         "Then all are scaled together until the expressions move the landmarks "
                         "as on the standard head: they differ by " +
                             rounded(report.difference, 2) + ", before by " +
                             rounded(report.difference_before, 2) + ".");
        html.open("table").open("tr");
        for (const char* name : {"muscle", "strength", "length", "target", ""})
            html.element("th", name);
        html.close();
        for (const MuscleStrength& m : report.strengths) {
            html.open("tr").element("th", m.muscle).element("td", rounded(m.strength, 2));
            html.element("td", rounded(m.stretch, 2)).element("td", rounded(m.target_stretch, 2));
            html.element("td", std::string(m.at_limit ? "at the limit " : "") +
                                   (m.converged ? "" : "did not come to rest"));
            html.close();
        }
        html.close();
    }
    return report::html_page("Fit of " + rig.name, html);
}

}  // namespace

void write_fit_report(const FitReport& report, const rig::RigDescription& rig,
                      const std::filesystem::path& folder) {
    report::write_text(folder / "index.html", page_of(report, rig));
    Json json = json_object({{"format", "risorius-fit"}, {"version", 1}});
    json.update(report.json());
    json[report::kFilesKey] = {kFitPicture, "index.html", "results.json"};
    report::write_text(folder / "results.json", json_text(json, 2) + "\n");
}

}  // namespace risorius::fitting
