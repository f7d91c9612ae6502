// SPDX-License-Identifier: MIT
// risorius landmarks MESH -o FILE
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/landmarks/propose_landmarks.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/part_option.h"

namespace risorius::cli {

namespace {

struct LandmarksArguments {
    Common common;
    landmarks::LandmarkOptions options;
    std::vector<std::string> parts, templates;
    std::filesystem::path out, report;
};

// Reads "MESH,LANDMARKS".
landmarks::TemplateFiles template_of(const std::string& text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || comma == 0 || comma + 1 == text.size())
        throw Error("--template", "MESH,LANDMARKS", in_quotes(text));
    return {text.substr(0, comma), text.substr(comma + 1)};
}

void print_proposal(const landmarks::LandmarkProposal& proposal, const std::filesystem::path& out) {
    std::printf("%s\n", out.string().c_str());
    std::printf("  unit        %g m%s\n", proposal.metres_per_unit,
                proposal.guessed_unit ? ", told from the size of the face" : "");
    std::printf("  size        %.3f of the average adult\n", proposal.size);
    std::printf("  face        score %.3f; views differ by %.1f mm (median)\n", proposal.score,
                proposal.spread_mm);
    std::string doubtful, unsure;
    std::size_t sure = 0;
    for (const auto& [id, landmark] : proposal.landmarks) {
        if (landmark.certainty() == landmarks::Certainty::kSure)
            ++sure;
        else
            (landmark.certainty() == landmarks::Certainty::kDoubtful ? doubtful : unsure) +=
                " " + id;
    }
    std::printf("  landmarks   %zu, %zu of them sure\n", proposal.landmarks.size(), sure);
    if (!doubtful.empty()) std::printf("  doubtful   %s\n", doubtful.c_str());
    if (!unsure.empty()) std::printf("  check      %s\n", unsure.c_str());
    for (const std::string& note : proposal.notes) std::printf("  note: %s\n", note.c_str());
    const std::vector<std::string> needed = proposal.unsure_required();
    if (needed.empty()) return;
    std::string ids;
    for (const std::string& id : needed) ids += " " + id;
    std::printf("  a rig needs these, which are not sure:%s\n", ids.c_str());
}

void run(LandmarksArguments& arguments) {
    arguments.options.parts = parts_of(arguments.parts);
    for (const std::string& text : arguments.templates)
        arguments.options.templates.push_back(template_of(text));
    arguments.options.pictures = !arguments.report.empty();
    landmarks::LandmarkProposal proposal;
    {
        ProgressBar bar(arguments.common);
        proposal = landmarks::propose_landmarks(arguments.options, bar.monitor());
    }
    landmarks::write_landmarks(proposal, arguments.out, arguments.report);
    if (arguments.common.json)
        std::printf("%s\n", json_text(proposal.json(), 2).c_str());
    else if (!arguments.common.quiet)
        print_proposal(proposal, arguments.out);
}

}  // namespace

void add_landmarks(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("landmarks", "Find the landmarks of a head mesh in pictures of it");
    auto arguments = std::make_shared<LandmarksArguments>();
    landmarks::LandmarkOptions& options = arguments->options;
    command->add_option("MESH", options.mesh, "The mesh of the head: OBJ, PLY, glTF, FBX, ...")
        ->required();
    command->add_option("-o,--out", arguments->out, "The file of landmarks to write")->required();
    command->add_option("--report", arguments->report,
                        "A folder for pictures of the head with its landmarks, and a table of how "
                        "sure each of them is");
    command->add_option("--metres-per-unit", options.metres_per_unit,
                        "Size of one unit of the mesh in metres, 0.01 for cm. Default: estimated "
                        "from the size of the face");
    command->add_option("--part", arguments->parts,
                        "ROLE=GROUP,GROUP: sets the role of groups of the mesh whose names do not "
                        "show it, as in `risorius fit`");
    command->add_option(
        "--template", arguments->templates,
        "MESH,LANDMARKS: a head whose landmarks are known, to compare with, instead "
        "of the adult; repeat for several");
    command->add_option("--standard", options.standard, "Folder of the standard anatomy");
    add_common(*command, arguments->common);
    command->footer(
        "The head may lie or be turned in any way. tools/web/fetch_weights.sh fetches the network "
        "that finds the landmarks.\n\nExample:\n  risorius landmarks head.obj -o landmarks.json "
        "--report look");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
