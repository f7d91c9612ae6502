// SPDX-License-Identifier: MIT
// The file of landmarks, and the report: pictures, a page, and results.json for programs.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/data_folder.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/landmarks/propose_landmarks.h"
#include "risorius/media/image_file.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/report/html_writer.h"
#include "risorius/report/output_paths.h"
#include "risorius/rig/atlas.h"

namespace risorius::landmarks {

namespace fs = std::filesystem;

namespace {

double rounded_to(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

const char* word_for(Certainty certainty) {
    switch (certainty) {
        case Certainty::kSure:
            return "sure";
        case Certainty::kDoubtful:
            return "doubtful";
        case Certainty::kUnsure:
            break;
    }
    return "unsure";
}

const char* colour_for(Certainty certainty) {
    switch (certainty) {
        case Certainty::kSure:
            return "background:#cfe8d5";
        case Certainty::kDoubtful:
            return "background:#fbe3bd";
        case Certainty::kUnsure:
            break;
    }
    return "background:#f6c9cc";
}

void row(report::HtmlWriter& html, const std::string& name, const std::string& value) {
    html.open("tr").element("th", name).element("td", value).close();
}

/// Landmarks with the least sure first.
std::vector<std::string> least_sure_first(const LandmarkProposal& proposal) {
    std::vector<std::string> out;
    for (const auto& [id, landmark] : proposal.landmarks) out.push_back(id);
    std::stable_sort(out.begin(), out.end(), [&](const std::string& a, const std::string& b) {
        return proposal.landmarks.at(a).confidence < proposal.landmarks.at(b).confidence;
    });
    return out;
}

std::string page_of(const LandmarkProposal& proposal) {
    std::map<std::string, std::string> names;
    for (const JsonCursor& item :
         JsonCursor::read_file(data_folder() / "rigs" / "standard" / "landmarks.json")
             .at("landmarks")
             .items())
        names[item.at("id").string()] =
            item.has("definition") ? item.at("definition").string() : item.at("name").string();
    report::HtmlWriter html;
    html.element("h1", "Landmarks of " + proposal.mesh);
    html.element("p",
                 "Green landmarks are sure, amber ones may be some millimetres off, red ones have "
                 "to be checked. Left and right are the subject's own.");
    for (const LandmarkPicture& picture : proposal.pictures)
        html.single("img", {{"src", picture.name + ".png"},
                            {"alt", "The head with its landmarks, " + picture.name},
                            {"width", "280"}});
    html.element("h2", "What was found").open("table");
    row(html, "unit of the mesh",
        format_number(proposal.metres_per_unit) + " m" +
            (proposal.guessed_unit ? ", told from the size of the face" : ""));
    row(html, "size", format_number(rounded_to(proposal.size, 1000)) + " of the average adult");
    row(html, "face", "score " + format_number(rounded_to(proposal.score, 1000)));
    row(html, "views",
        "differ by " + format_number(rounded_to(proposal.spread_mm, 10)) + " mm (median)");
    html.close();
    if (!proposal.notes.empty()) {
        html.element("h2", "To look at").open("ul");
        for (const std::string& note : proposal.notes) html.element("li", note);
        html.close();
    }
    html.element("h2", "Landmarks, the least sure first").open("table").open("tr");
    for (const char* name : {"landmark", "where", "may be off, mm", "confidence", ""})
        html.element("th", name);
    html.close();
    for (const std::string& id : least_sure_first(proposal)) {
        const ProposedLandmark& landmark = proposal.landmarks.at(id);
        html.open("tr", {{"style", colour_for(landmark.certainty())}});
        html.element("td", id).element("td", names[id]);
        html.element("td", format_number(rounded_to(landmark.expected_mm, 10)));
        html.element("td", format_number(rounded_to(landmark.confidence, 100)));
        html.element("td", landmark.reason).close();
    }
    html.close();
    return report::html_page("Landmarks of " + proposal.mesh, html);
}

void write_report(const LandmarkProposal& proposal, const fs::path& folder) {
    Json json = json_object({{"format", "risorius-landmark-report"}, {"version", 1}});
    json.update(proposal.json());
    Json files = Json::array();
    for (const LandmarkPicture& picture : proposal.pictures) {
        media::write_png(picture.image, folder / (picture.name + ".png"));
        files.push_back(picture.name + ".png");
    }
    files.push_back("index.html");
    files.push_back("results.json");
    json[report::kFilesKey] = files;
    report::write_text(folder / "index.html", page_of(proposal));
    report::write_text(folder / "results.json", json_text(json, 2) + "\n");
}

}  // namespace

Json LandmarkProposal::json() const {
    Json landmark_list = Json::array();
    for (const std::string& id : least_sure_first(*this)) {
        const ProposedLandmark& landmark = landmarks.at(id);
        Json item = json_object({{"id", id},
                                 {"expected_mm", rounded_to(landmark.expected_mm, 100)},
                                 {"confidence", rounded_to(landmark.confidence, 1000)},
                                 {"certainty", word_for(landmark.certainty())}});
        if (!landmark.reason.empty()) item["reason"] = landmark.reason;
        landmark_list.push_back(item);
    }
    return json_object({{"mesh", mesh},
                        {"metres_per_unit", metres_per_unit},
                        {"guessed_unit", guessed_unit},
                        {"usual_unit", usual_unit},
                        {"size", size},
                        {"score", score},
                        {"spread_mm", spread_mm},
                        {"up", {up.x(), up.y(), up.z()}},
                        {"forward", {forward.x(), forward.y(), forward.z()}},
                        {"templates", templates},
                        {"unsure_required", unsure_required()},
                        {"notes", notes},
                        {"landmarks", landmark_list}});
}

Json LandmarkProposal::landmarks_json() const {
    Json at = Json::object();
    for (const auto& [id, landmark] : landmarks)
        at[id] = json_object({{"xyz", {landmark.xyz.x(), landmark.xyz.y(), landmark.xyz.z()}},
                              {"confidence", rounded_to(landmark.confidence, 1000)}});
    return json_object({{"format", "risorius-landmarks"},
                        {"version", 1},
                        {"mesh", mesh},
                        {"note", "proposed by risorius landmarks"},
                        {"landmarks", at}});
}

void write_landmarks(const LandmarkProposal& proposal, const fs::path& out,
                     const fs::path& report) {
    report::check_overwritten(out, {"risorius-landmarks"}, "no file, or earlier landmarks");
    OutputSet outputs(folder_of_output(out));
    report::write_text(outputs.file(out), json_text(proposal.landmarks_json(), 2) + "\n");
    if (!report.empty()) {
        report::AtomicFolder folder(report, OutputSet::Then::kRunGoesOn);
        write_report(proposal, folder.partial());
        folder.commit();
    }
    outputs.commit();
}

}  // namespace risorius::landmarks
