// SPDX-License-Identifier: MIT
// risorius fit MESH --landmarks FILE -o RIG; risorius fit --voice RIG
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/fitting/fit_rig.h"
#include "risorius/landmarks/propose_landmarks.h"
#include "risorius/rig/head.h"
#include "risorius/scene/rig_files.h"
#include "risorius/talk/rig_voice_file.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/part_option.h"

namespace risorius::cli {

namespace {

constexpr double kReached = 0.9;  // units that reach less of what their table asks for are named

struct FitArguments {
    Common common;
    fitting::FitOptions options;
    std::vector<std::string> parts;
    std::string tables = "inline";
    bool no_calibrate = false, muscles_apart = false;
    std::filesystem::path voice;
};

std::string joined(const std::vector<std::string>& list, std::size_t max = 1000) {
    std::string out;
    for (std::size_t i = 0; i < std::min(max, list.size()); ++i) out += (i ? " " : "") + list[i];
    if (list.size() > max) out += " ...";
    return out;
}

void print(const fitting::FitReport& report) {
    std::printf("%s\n", report.out.string().c_str());
    std::printf("  unit        %g m%s\n", report.metres_per_unit,
                report.guessed_unit ? ", told from the landmarks" : "");
    std::printf("  size        %.3f of the average adult\n", report.size);
    std::printf("  residual    %.1f mm RMS between the landmarks and the atlas\n",
                report.residual_mm);
    std::printf("  landmarks   %d given, %zu placed by the atlas\n", report.given_landmarks,
                report.warped_landmarks.size());
    if (!report.worth_giving.empty())
        std::printf("              most worth giving: %s\n",
                    joined(report.worth_giving, 10).c_str());
    for (const auto& [role, groups] : report.parts)
        std::printf("  %-11s %s\n", role.c_str(), joined(groups).c_str());
    std::printf(
        "  tissue      %d nodes, %d tetrahedra (%d dropped, %d inverted), %d muscle fibres\n",
        report.nodes, report.tets, report.dropped_tets, report.inverted_tets, report.fibres);
    std::printf("  bone        %.1f to %.1f mm under the skin, %.1f on average\n",
                report.bone.thinnest_mm, report.bone.thickest_mm, report.bone.mean_mm);
    if (!report.strengths.empty())
        std::printf("\n  %-40s %8s %8s %8s\n", "muscle", "strength", "length", "target");
    for (const fitting::MuscleStrength& m : report.strengths)
        std::printf("  %-40s %8.2f %8.2f %8.2f%s%s\n", m.muscle.c_str(), m.strength, m.stretch,
                    m.target_stretch, m.at_limit ? "  at the limit" : "",
                    m.converged ? "" : "  did not come to rest");
    if (report.difference_before > 0)
        std::printf(
            "\n  expressions differ by %.2f from those of the standard head (%.2f before all "
            "muscles "
            "were scaled together)\n",
            report.difference, report.difference_before);
    std::string short_of;
    for (const auto& [unit, gain] : report.unit_gains)
        if (gain.reached < kReached) {
            char words[32];
            std::snprintf(words, sizeof words, "%s%s %.2f", short_of.empty() ? "" : ", ",
                          unit.c_str(), gain.reached);
            short_of += words;
        }
    if (!report.unit_gains.empty())
        std::printf("  action units are scaled to this head: %zu%s%s\n", report.unit_gains.size(),
                    short_of.empty() ? "; all reach what their table asks for"
                                     : "; of what their table asks for, these reach ",
                    short_of.c_str());
    for (const std::string& note : report.notes) std::printf("  note: %s\n", note.c_str());
}

void require(bool given, const char* what) {
    if (!given) throw CLI::RequiredError(what);
}

void run_voice(const FitArguments& arguments) {
    const scene::RigFiles files = scene::read_rig_files(arguments.voice);
    std::filesystem::path file;
    {
        ProgressBar bar(arguments.common);
        file = talk::write_voice_of_rig(
            files, [&](double fraction) { bar.monitor().report(fraction, "simulating mouths"); });
    }
    if (!arguments.common.quiet) std::printf("%s\n", file.string().c_str());
}

// Proposes landmarks and writes them beside the rig. Refuses where a landmark that a rig needs is not sure.
void find_landmarks(fitting::FitOptions& options, const ProgressMonitor& monitor) {
    namespace fs = std::filesystem;
    fs::path file = options.out;
    file.replace_filename(options.out.stem().string() + "_landmarks.json");
    if (fs::exists(file))
        throw Error(file.string(),
                    "no file, since the landmarks that are found are written there (--landmarks "
                    "reads them)",
                    "one");
    const landmarks::LandmarkProposal proposal =
        landmarks::propose_landmarks({.mesh = options.mesh,
                                      .metres_per_unit = options.metres_per_unit,
                                      .parts = options.parts,
                                      .standard = options.standard},
                                     monitor);
    if (const std::vector<std::string> unsure = proposal.unsure_required(); !unsure.empty())
        throw Error(options.mesh.string(),
                    "a face on which the landmarks that a rig needs are found surely (risorius "
                    "landmarks proposes them for you to correct)",
                    "doubt about " + joined(unsure));
    landmarks::write_landmarks(proposal, file);
    options.landmarks = file;
    if (!proposal.usual_unit) options.metres_per_unit = proposal.metres_per_unit;
    std::size_t sure = 0;
    for (const auto& [id, landmark] : proposal.landmarks)
        sure += landmark.certainty() == landmarks::Certainty::kSure;
    options.landmarks_note =
        "the landmarks were found in pictures of the mesh, " + std::to_string(sure) + " of " +
        std::to_string(proposal.landmarks.size()) + " surely; they are in " + file.string();
}

void run(FitArguments& arguments) {
    if (!arguments.voice.empty()) {
        if (!arguments.options.mesh.empty() || !arguments.options.out.empty())
            throw Error("--voice", "no MESH and no --out beside it", "one");
        return run_voice(arguments);
    }
    require(!arguments.options.mesh.empty(), "MESH");
    require(!arguments.options.out.empty(), "--out");
    arguments.options.parts = parts_of(arguments.parts);
    if (arguments.tables != "inline" && arguments.tables != "reference")
        throw Error("--tables", "\"inline\" or \"reference\"", "\"" + arguments.tables + "\"");
    arguments.options.inline_tables = arguments.tables == "inline";
    arguments.options.calibrate = !arguments.no_calibrate;
    arguments.options.together = !arguments.muscles_apart;
    check_threads(arguments.options.threads);
    fitting::FitReport report;
    {
        ProgressBar bar(arguments.common);
        ProgressMonitor monitor = bar.monitor();
        if (arguments.options.landmarks.empty()) {
            find_landmarks(arguments.options, monitor.subrange(0, 0.1));
            monitor = monitor.subrange(0.1, 1);
        }
        report = fitting::fit_rig(arguments.options, monitor);
    }
    if (arguments.common.json)
        std::printf("%s\n", json_text(report.json(), 2).c_str());
    else if (!arguments.common.quiet)
        print(report);
}

}  // namespace

void add_fit(CLI::App& app) {
    CLI::App* command = app.add_subcommand("fit", "Fit a muscle rig to a face mesh");
    auto arguments = std::make_shared<FitArguments>();
    fitting::FitOptions& options = arguments->options;
    // Required unless there is --voice, see require().
    command->add_option("MESH", options.mesh, "The mesh of the face: OBJ, PLY, glTF, FBX, ...");
    command->add_option("--landmarks", options.landmarks,
                        "The file of its landmarks. Default: they are found in pictures "
                        "of the mesh and written beside the rig as RIG_landmarks.json, as by "
                        "`risorius landmarks`. If a required landmark is not sure, the command "
                        "stops with an error");
    command->add_option("-o,--out", options.out, "The rig to write");
    command->add_option(
        "--voice", arguments->voice,
        "A rig, instead of all other options: simulate the mouths that speech needs, "
        "for some minutes, and write them beside it as RIG.voice.json");
    command->add_option("--metres-per-unit", options.metres_per_unit,
                        "Size of one unit of the mesh in metres, 0.01 for cm. Default: estimated "
                        "from the landmarks");
    add_threads(*command, options.threads, "The rig is");
    command->add_option("--name", options.name, "Name of the rig. Default: that of the mesh file");
    command->add_option("--part", arguments->parts,
                        "ROLE=GROUP,GROUP: sets the role of groups of the mesh whose names do not "
                        "show it; repeat for several roles. docs/formats/rig.md lists the roles");
    command
        ->add_option("--tables", arguments->tables,
                     "inline: the rig contains its anatomy; reference: it names the files")
        ->capture_default_str();
    command->add_option("--standard", options.standard, "Folder of the standard anatomy");
    command->add_flag(
        "--solids", arguments->options.solids,
        "Simulate the muscles listed in standard/muscle_solids.json as volume-preserving solids");
    command->add_flag("--cut-lips", arguments->options.cut_lips,
                      "Cut lips that are joined in a scan; the cut mesh is written beside the rig");
    command->add_flag(
        "--repair", arguments->options.repair,
        "Mend the skin of a scan: take out double faces, faces without area and loose "
        "bits, turn flipped faces; the mended mesh is written beside the rig");
    command->add_option("--report", options.report,
                        "A folder for a report of the fit with pictures and numbers");
    command->add_flag("--no-calibrate", arguments->no_calibrate,
                      "Do not calibrate: keep the standard strengths of the muscles (fastest)");
    command->add_flag(
        "--muscles-apart", arguments->muscles_apart,
        "Faster (a third of the time): calibrate each muscle alone, until it shortens as it "
        "should, instead of all together until expressions match those of the standard head");
    add_common(*command, arguments->common);
    std::string required;
    for (const std::string& id : rig::required_landmarks()) required += " " + id;
    command->footer(
        "Landmarks that have to be given (rigs/standard/landmarks.json says where they lie):\n " +
        required +
        "\n\nExample:\n  risorius fit head.obj -o anna/rig.json\n  risorius fit head.obj "
        "--landmarks landmarks.json -o anna/rig.json\n"
        "  risorius fit --voice anna/rig.json");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
