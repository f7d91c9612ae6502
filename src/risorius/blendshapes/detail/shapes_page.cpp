// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/shapes_page.h"

#include <cmath>
#include <cstdio>

#include "risorius/core/version.h"
#include "risorius/report/drive_bars.h"
#include "risorius/report/html_writer.h"

namespace risorius::blendshapes {

namespace {

constexpr const char* kShapesStyle = R"(
.faces { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: .5rem; margin: .5rem 0; }
)";

std::string rounded(double value, int decimals) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string in_mm(const std::optional<double>& metres) {
    return metres ? rounded(1e3 * *metres, 2) : "–";
}

std::string shape_anchor(std::size_t i) { return "shape-" + std::to_string(i); }

const char* const kHeads[] = {"moves, mm",       "volume, %",     "lip in lip, mm",
                              "skin in eye, mm", "lids open, mm", "sides differ, mm",
                              "stretch",         "99 % below"};

std::vector<std::string> numbers_of(const ShapeCertificate& of) {
    return {rounded(1e3 * of.peak_m, 1), rounded(100 * of.volume_change, 2),
            in_mm(of.lip_depth_m),       in_mm(of.eye_depth_m),
            in_mm(of.lid_gap_m),         in_mm(of.asymmetry_m),
            rounded(of.stretch.max, 2),  rounded(of.stretch.max_of_99, 2)};
}

void write_all(report::HtmlWriter& html, const ShapesReport& report) {
    html.open("section").element("h2", "Certificate");
    const ShapeLimits limits;
    const int beyond = report.complaints();
    html.element("p",
                 (beyond == 0 ? "All " + std::to_string(report.shapes.list.size()) + " shapes are"
                              : std::to_string(beyond) + " of " +
                                    std::to_string(report.shapes.list.size()) + " shapes are not") +
                     " within the limits: volume of the tissue kept to " +
                     rounded(100 * limits.volume_ratio, 0) + " %, lips and skin no deeper than " +
                     rounded(1e3 * limits.penetration_m, 1) +
                     " mm in one another and in the eyes, lids shut to " +
                     rounded(1e3 * limits.lid_gap_m, 1) + " mm" +
                     (report.shapes.mirrored
                          ? ", sides alike to " + rounded(1e3 * limits.asymmetry_m, 1) + " mm."
                          : ". This head is not its own mirror image, so "
                            "sides are not compared."));
    html.open("div", {{"class", "scroll"}}).open("table").open("tr").element("th", "shape");
    for (const char* head : kHeads) html.element("th", head, {{"class", "number"}});
    html.element("th", "").close();
    for (std::size_t i = 0; i < report.shapes.list.size(); ++i) {
        const MadeShape& made = report.shapes.list[i];
        html.open("tr").open("td").element("a", made.goal.name, {{"href", "#" + shape_anchor(i)}});
        html.close();
        for (const std::string& number : numbers_of(made.certificate))
            html.element("td", number, {{"class", "number"}});
        std::string remarks;
        for (const std::string& one : made.certificate.complaints())
            remarks += (remarks.empty() ? "" : "; ") + one;
        if (made.certificate.inverted_tets > 0)
            remarks += (remarks.empty() ? "" : "; ") +
                       std::to_string(made.certificate.inverted_tets) + " tetrahedra inverted";
        html.element("td", remarks, {{"class", "bad"}}).close();
    }
    html.close().close();
    html.element(
        "p",
        "Lip in lip is measured on the nodes of the simulation, beyond what overlaps at rest; skin "
        "in "
        "eye on the mesh itself. Stretch: of the simulated skin's triangles, ratio of length; "
        "99 % of the area is stretched less than the last column. Left and right halves add up to "
        "the whole they were solved as within " +
            rounded(1e3 * report.shapes.halves_error_m, 2) + " mm.",
        {{"class", "soft"}});
    if (!report.left_out.empty()) {
        std::string names;
        for (const auto& [name, why] : report.left_out)
            names += (names.empty() ? "" : "; ") + name + " (" + why + ")";
        html.element("p", "Left out: " + names + ".", {{"class", "soft"}});
    }
    html.close();
}

void write_linear(report::HtmlWriter& html, const ShapesReport& report) {
    if (report.tracks.empty() && report.correctives.tried.empty()) return;
    html.open("section").element("h2", "Added up, against the simulation");
    if (!report.tracks.empty()) {
        html.open("div", {{"class", "scroll"}}).open("table").open("tr").element("th", "track");
        for (const char* head : {"frames", "RMS, mm", "largest, mm", "RMS without correctives",
                                 "largest without correctives"})
            html.element("th", head, {{"class", "number"}});
        html.close();
        for (const TrackError& track : report.tracks) {
            html.open("tr").element("td", track.name);
            for (const std::string& number :
                 {std::to_string(track.frames), rounded(1e3 * track.rms_m, 2),
                  rounded(1e3 * track.max_m, 2), rounded(1e3 * track.plain_rms_m, 2),
                  rounded(1e3 * track.plain_max_m, 2)})
                html.element("td", number, {{"class", "number"}});
            html.close();
        }
        html.close().close();
        html.element(
            "p",
            "Every frame of a track once by the linear rig and once in equilibrium with the "
            "drive that its weights stand for, over the simulated skin.",
            {{"class", "soft"}});
    }
    if (!report.correctives.tried.empty()) {
        html.element("p", std::to_string(report.correctives.rig.correctives.size()) +
                              " correctives put right what the sum lacks in the following of " +
                              std::to_string(report.correctives.tried.size()) +
                              " pairs and halves that were simulated:");
        html.open("div", {{"class", "scroll"}}).open("table").open("tr");
        html.element("th", "simulated together");
        html.element("th", "sum is wrong by, mm", {{"class", "number"}});
        html.element("th", "RMS, mm", {{"class", "number"}}).element("th", "").close();
        for (const TriedCorrective& one : report.correctives.tried) {
            if (!one.corrected) continue;
            html.open("tr").element("td", one.name);
            html.element("td", rounded(1e3 * one.max_m, 2), {{"class", "number"}});
            html.element("td", rounded(1e3 * one.rms_m, 2), {{"class", "number"}});
            html.element("td", "").close();
        }
        html.close().close();
    }
    html.close();
}

void write_shape(report::HtmlWriter& html, const ShapesReport& report, std::size_t i,
                 const ShapesPictures* pictures) {
    const MadeShape& made = report.shapes.list[i];
    html.open("section", {{"id", shape_anchor(i)}}).element("h2", made.goal.name);
    if (made.goal.on_top_of >= 0)
        html.element(
            "p",
            "On top of " +
                report.shapes.list[static_cast<std::size_t>(made.goal.on_top_of)].goal.name +
                ", solved with both at " + rounded(made.solved_at, 2) + "; the lips are then " +
                in_mm(made.certificate.lip_gap_m) + " mm further apart than at rest.",
            {{"class", "soft"}});
    for (const std::string& one : made.certificate.complaints())
        html.element("p", one, {{"class", "bad"}});
    if (pictures) {
        html.open("div", {{"class", "faces"}});
        for (const auto& [kind, caption] :
             {std::pair{"front", "from the front"}, std::pair{"three_quarter", "from the side"},
              std::pair{"moved", "how far the skin moves"}}) {
            const std::string& file = pictures->shapes[i].at(kind);
            html.open("figure").open("a", {{"href", file}});
            html.single("img", {{"src", file},
                                {"alt", made.goal.name + ", " + caption},
                                {"loading", "lazy"},
                                {"width", std::to_string(ShapesPictures::kWidth_px)},
                                {"height", std::to_string(ShapesPictures::kHeight_px)}});
            html.close().element("figcaption", caption).close();
        }
        html.close();
    }
    report::write_drive_bars(html, made.goal.drive, nullptr, report.channels);
    html.close();
}

}  // namespace

std::string shapes_page(const ShapesReport& report, const ShapesPictures* pictures) {
    const std::string title = report.name + ": blend shapes, " + report.set;
    report::HtmlWriter html;
    html.element("style", kShapesStyle + report::drive_bars_style()).element("h1", title);
    html.element("p",
                 "Rig " + report.rig + ", " + std::to_string(report.vertices) + " vertices, " +
                     std::to_string(report.nodes) + " nodes simulated (" + report.quality + "), " +
                     std::to_string(report.shapes.list.size()) + " shapes.",
                 {{"class", "soft"}});
    write_all(html, report);
    write_linear(html, report);
    if (pictures && !pictures->sheet.empty()) {
        html.open("section").element("h2", "Contact sheet");
        html.open("a", {{"href", pictures->sheet}})
            .single("img", {{"src", pictures->sheet}, {"alt", "all shapes"}})
            .close();
        html.close();
    }
    for (std::size_t i = 0; i < report.shapes.list.size(); ++i)
        write_shape(html, report, i, pictures);
    html.open("p", {{"class", "soft"}}).text("Numbers for other programs: ");
    html.element("a", "results.json", {{"href", "results.json"}});
    html.text(". Made by Risorius " + std::string(kVersion) + ".").close();
    return report::html_page(title, html);
}

}  // namespace risorius::blendshapes
