// SPDX-License-Identifier: MIT
// risorius solve RIG --shapes FILE | --mesh FILE | --landmarks FILE -o DIR
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/inverse/solve_activations.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct SolveArguments {
    Common common;
    inverse::SolveOptions options;
    std::string neutral, picture;
};

// Width and height, as 1280x720.
std::array<int, 2> read_picture(const std::string& text) {
    std::array<int, 2> out{};
    char rest = 0;
    constexpr int kMost_px = 100000;
    if (std::sscanf(text.c_str(), "%dx%d%c", &out[0], &out[1], &rest) != 2 || out[0] < 1 ||
        out[1] < 1 || out[0] > kMost_px || out[1] > kMost_px)
        throw Error("solve --picture", "width and height in pixels, as 1280x720", in_quotes(text));
    return out;
}

void print(const inverse::SolveReport& report, const inverse::SolveOptions& options) {
    std::printf("%s: %zu %s of %s, %d points\n", report.rig.c_str(), report.solved.size(),
                report.sequence ? "frames" : "shapes", report.given.c_str(), report.points);
    std::printf("  %-24s %9s %9s %9s %8s\n", "mm", "given rms", "left rms", "left max", "highest");
    for (const inverse::SolvedDrive& one : report.solved)
        std::printf("  %-24s %9.3f %9.3f %9.3f %8.2f\n", one.name.c_str(), 1e3 * one.given_rms_m,
                    1e3 * one.rms_m, 1e3 * one.max_m, one.highest);
    for (const inverse::UnitCurve& curve : report.curves)
        std::printf("  %-24s %zu keys\n", curve.channel.c_str(), curve.keys.size());
    for (const std::string& note : report.notes) std::printf("  note: %s\n", note.c_str());
    std::printf("all: %.3f mm RMS left; script: %s\n", 1e3 * report.rms_m(),
                (options.out / "script.json").generic_string().c_str());
}

void run(SolveArguments& arguments) {
    check_threads(arguments.options.threads);
    if (!arguments.neutral.empty())
        arguments.options.neutral_s = read_span("solve --neutral", arguments.neutral);
    if (!arguments.picture.empty()) arguments.options.picture_px = read_picture(arguments.picture);
    inverse::SolveReport report;
    {
        ProgressBar bar(arguments.common);
        report = inverse::solve_activations(arguments.options, bar.monitor());
    }
    if (arguments.common.json)
        std::printf("%s\n", json_text(report.json(), 2).c_str());
    else if (!arguments.common.quiet)
        print(report, arguments.options);
}

// Adds an option of an earlier version. It is hidden, and works with a note that names the new option.
void add_old_name(CLI::App& command, const std::string& old_name, const std::string& new_name,
                  double& value) {
    command
        .add_option_function<double>(old_name,
                                     [old_name, new_name, &value](const double& given) {
                                         std::fprintf(stderr, "note: %s is now named %s\n",
                                                      old_name.c_str(), new_name.c_str());
                                         value = given;
                                     })
        ->group("");
}

}  // namespace

void add_solve(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "solve", "Find muscle activations from shapes, or from landmarks over time");
    auto arguments = std::make_shared<SolveArguments>();
    inverse::SolveOptions& options = arguments->options;
    command->add_option("RIG", options.rig, "The rig whose activations are sought")->required();
    command
        ->add_option("-o,--out", options.out,
                     "The folder to write: script.json, which render plays, and results.json")
        ->required();
    command->add_option(
        "--shapes", options.shapes,
        "Blend shapes on the rig's mesh: a table (.json, see "
        "docs/formats/measured-shapes.md), or glTF of risorius shapes or of another "
        "program, which has the mesh in the rest position");
    command
        ->add_option("--mesh", options.meshes,
                     "Instead of --shapes: the rig's mesh with displaced vertices, OBJ; separate "
                     "several with commas")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option(
        "--landmarks", options.landmarks,
        "Instead of --shapes: a table with the columns time_s and ID.x_mm, ID.y_mm, ID.z_mm of "
        "some landmarks, as from render --landmarks; or points of another face: a table with "
        "mediapipe_N.x, .y, .z or face68_N.x, .y, .z, that of OpenFace, or JSON of MediaPipe "
        "FaceLandmarker (docs/howto/motion.md). The first row must show the neutral face");
    command->add_option("--neutral", arguments->neutral,
                        "Of --landmarks: a time in which the face is neutral, in seconds, as "
                        "0-0.5: its mean stands for the first row");
    command->add_option("--picture", arguments->picture,
                        "Of MediaPipe's JSON: width and height of the picture, as 1280x720");
    command->add_option(
        "--as", options.as,
        "What to find: \"units\" (few action units with few keys, single muscles only "
        "for what no unit explains; of --landmarks) or \"muscles\". Default: units for "
        "--landmarks, else muscles");
    command
        ->add_option(
            "--with", options.with,
            "Units that are used only if they are named here: pressure (in the mouth), tongue")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option("--only", options.only, "Names of shapes, separated by commas")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--quality", options.quality,
                     "Quality of the simulation: \"preview\", \"video\" or \"fine\"")
        ->capture_default_str();
    command
        ->add_option("--l1-weight", options.l1_weight,
                     "Penalty on activations: the cost of an activation of 1, relative to half the "
                     "squared norm of the displacements to match")
        ->capture_default_str();
    command
        ->add_option("--l2-weight", options.l2_weight,
                     "Penalty on half the square of each activation, relative to the same norm as "
                     "--l1-weight")
        ->capture_default_str();
    command
        ->add_option("--temporal-weight", options.temporal_weight,
                     "Penalty on half the squared change of each activation from frame to frame, "
                     "relative to the same norm as --l1-weight")
        ->capture_default_str();
    add_old_name(*command, "--price", "--l1-weight", options.l1_weight);
    add_old_name(*command, "--ridge", "--l2-weight", options.l2_weight);
    add_old_name(*command, "--smooth", "--temporal-weight", options.temporal_weight);
    command->add_option("--fps", options.fps, "Maximum number of frames per second that are solved")
        ->capture_default_str();
    add_threads(*command, options.threads, "The result is");
    add_common(*command, arguments->common);
    command->footer(
        "Examples:\n"
        "  risorius solve anna/rig.json --shapes anna/arkit.json -o anna/solved\n"
        "  risorius solve anna/rig.json --mesh anna/smile.obj,anna/frown.obj -o anna/solved\n"
        "  risorius solve anna/rig.json --landmarks anna/track.tsv -o anna/solved\n"
        "  risorius render anna/solved/script.json -o anna/solved.mp4");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
