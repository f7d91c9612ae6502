// SPDX-License-Identifier: MIT
// risorius shapes RIG -o DIR [--set arkit52|facs|muscles|visemes]
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/blendshapes/bake_shapes.h"
#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

struct ShapesArguments {
    Common common;
    blendshapes::ShapesOptions options;
    bool no_pictures = false;
};

std::string shown_mm(const std::optional<double>& metres) {
    char text[32];
    if (!metres) return "-";
    std::snprintf(text, sizeof text, "%.2f", 1e3 * *metres);
    return text;
}

void print(const blendshapes::ShapesReport& report, const blendshapes::ShapesOptions& options) {
    std::printf("%s, %s: %zu shapes of %d vertices, solved in %.0f s (%d nodes, %s)\n",
                report.rig.c_str(), report.set.c_str(), report.shapes.list.size(), report.vertices,
                report.solving_s, report.nodes, report.quality.c_str());
    std::printf("  %-40s %7s %8s %6s %6s %6s %6s %7s\n", "mm, volume in %, stretch a ratio", "peak",
                "volume", "lip", "eye", "lids", "sides", "stretch");
    for (const blendshapes::MadeShape& made : report.shapes.list) {
        const blendshapes::ShapeCertificate& of = made.certificate;
        std::printf("  %-40s %7s %+6.2f %% %6s %6s %6s %6s %7.2f", made.goal.name.c_str(),
                    shown_mm(of.peak_m).c_str(), 100 * of.volume_change,
                    shown_mm(of.lip_depth_m).c_str(), shown_mm(of.eye_depth_m).c_str(),
                    shown_mm(of.lid_gap_m).c_str(), shown_mm(of.asymmetry_m).c_str(),
                    of.stretch.max);
        for (const std::string& one : of.complaints()) std::printf("  %s", one.c_str());
        std::printf("\n");
    }
    for (const auto& [name, why] : report.left_out)
        std::printf("  %-40s left out: %s\n", name.c_str(), why.c_str());
    const int beyond = report.complaints();
    std::printf("%s; halves add up to their whole within %.2f mm\n",
                beyond == 0
                    ? "all within the limits of the certificate"
                    : (std::to_string(beyond) + " beyond a limit of the certificate").c_str(),
                1e3 * report.shapes.halves_error_m);
    for (const blendshapes::TrackError& track : report.tracks)
        std::printf(
            "%s, %d frames: linear rig off the simulation by %.2f mm RMS, %.2f at most; "
            "without correctives %.2f, %.2f; %.2f ms a frame\n",
            track.name.c_str(), track.frames, 1e3 * track.rms_m, 1e3 * track.max_m,
            1e3 * track.plain_rms_m, 1e3 * track.plain_max_m, 1e3 * track.play_s);
    if (!report.correctives.tried.empty())
        std::printf("%zu correctives for what %zu pairs and halves lack\n",
                    report.correctives.rig.correctives.size(), report.correctives.tried.size());
    for (const auto& [file, bytes] : report.sizes)
        if (!file.starts_with("obj/"))
            std::printf("%s: %.1f MB\n", (options.out / file).generic_string().c_str(),
                        1e-6 * static_cast<double>(bytes));
    for (const auto& [file, error] : report.levels)
        std::printf(
            "%s: %ld triangles, surface within %.2f mm, shapes within %.2f mm RMS, %.2f at most\n",
            file.c_str(), error.triangles, 1e3 * error.surface_m, 1e3 * error.shape_rms_m,
            1e3 * error.shape_max_m);
    std::printf("report: %s\n", (options.out / "index.html").generic_string().c_str());
}

void run(ShapesArguments& arguments) {
    check_threads(arguments.options.threads);
    arguments.options.pictures = !arguments.no_pictures;
    blendshapes::ShapesReport report;
    {
        ProgressBar bar(arguments.common);
        report = blendshapes::bake_shapes(arguments.options, bar.monitor());
    }
    if (arguments.common.json)
        std::printf("%s\n", json_text(report.json(), 2).c_str());
    else if (!arguments.common.quiet)
        print(report, arguments.options);
}

void add_correctives(CLI::App& command, blendshapes::ShapesOptions& options) {
    command.add_flag("!--no-correctives", options.correctives,
                     "Make only shapes, without correctives for the errors of their sums. "
                     "risorius render --shapes plays such a file with these errors");
    command.add_flag("--named-correctives", options.named_correctives,
                     "Give each pair of shapes a corrective of its own, jawOpen_mouthSmileLeft, as "
                     "artists edit them, and each quarter of the way of a shape. At the same size "
                     "they repair less than the correctives without this option");
    command
        .add_option(
            "--pairs", options.pairs,
            "Maximum number of pairs of shapes to simulate together. Chosen first: pairs that move "
            "the same skin most, or that occur together in the script. Default: 48; for facs 160")
        ->check(CLI::Range(0, 10000));
    command
        .add_option_function<double>(
            "--corrective-tolerance-mm",
            [&options](double mm) { options.corrective_tolerance_m = 1e-3 * mm; },
            "Sums of shapes whose maximum error is below this number of mm get no corrective. "
            "Default: "
            "0.3")
        ->check(CLI::Range(0.0, 100.0));
    command
        .add_option_function<double>(
            "--corrective-megabytes",
            [&options](double mb) { options.corrective_bytes = static_cast<long>(1e6 * mb); },
            "Maximum size of the correctives in shapes.glb: with less space they keep less detail. "
            "Default: 0.7; for facs 4")
        ->check(CLI::Range(0.0, 2000.0));
}

void add_parts(CLI::App& command, blendshapes::ShapesOptions& options) {
    command
        .add_option("--eyes", options.eyes,
                    "What turns the eyeballs in shapes.glb: \"morph\", their shapes eyeLook...; "
                    "\"bone\", the nodes LeftEye and RightEye; \"both\", and the animation turns "
                    "the nodes")
        ->capture_default_str();
    command
        .add_option("--hair", options.hair,
                    "Hair on the scalp in shapes.glb and shapes.usda. \"own\": the hair of the "
                    "rig, as cards with a picture; \"none\": no hair")
        ->capture_default_str();
    command
        .add_option("--levels", options.levels,
                    "Number of coarser levels of detail to write, 0 to 4: shapes_lod1.glb and so "
                    "on, each with half the triangles of the one before, and the same shapes")
        ->check(CLI::Range(0, blendshapes::kMaxLevels))
        ->capture_default_str();
}

}  // namespace

void add_shapes(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "shapes", "Make blend shapes from the simulation, with a report of their accuracy");
    auto arguments = std::make_shared<ShapesArguments>();
    blendshapes::ShapesOptions& options = arguments->options;
    command->add_option("RIG", options.rig, "The rig of the face")->required();
    command
        ->add_option("-o,--out", options.out,
                     "The folder to write: shapes.glb, obj/, shapes.json with shapes.f32 (see "
                     "--formats), and always the accuracy report as index.html and results.json")
        ->required();
    command
        ->add_option(
            "--set", options.set,
            "\"arkit52\": the names of ARKit face tracking; \"facs\": every action unit, "
            "left and right; \"muscles\": every muscle; \"visemes\": mouth shapes of speech")
        ->capture_default_str();
    command
        ->add_option("--only", options.only,
                     "Names of shapes of the set, separated by commas; mouthSmile means both "
                     "sides. Default: all")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option(
            "--formats", options.formats,
            "Any of glb, obj, table (shapes.json with shapes.f32), usda (blend shapes of UsdSkel) "
            "and, "
            "with --script, csv "
            "(live_link.csv) and cache, pc2 or mdd (vertices of every frame), separated by "
            "commas. Default: glb, obj, table and csv")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--quality", options.quality,
                     "Quality of the simulation: \"preview\", \"video\" or \"fine\"")
        ->capture_default_str();
    command->add_option("--script", options.script,
                        "A script to convert to weights: an animation in shapes.glb, live_link.csv "
                        "(for arkit52) and, with --formats cache, the vertices in every frame");
    command->add_flag("--head-turns", options.head_turns,
                      "Let cache, pc2 and mdd have the motion of head and eyes too, as in a video. "
                      "Without it, they have what shapes.glb does with its shapes alone");
    add_correctives(*command, options);
    command
        ->add_option("--test-frames", options.test_frames,
                     "Number of frames of random weights, and of the script, for which blend "
                     "shapes are compared with the simulation; 0: none")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    command->add_flag(
        "--compact", options.compact,
        "Write 16-bit integers instead of floats into shapes.glb. It becomes smaller, "
        "but needs KHR_mesh_quantization and has a scale of its node");
    command
        ->add_flag_callback("--floats",
                            [] { std::fprintf(stderr, "note: --floats is the default now\n"); })
        ->group("");  // of earlier versions
    command
        ->add_option("--texture", options.texture_px,
                     "Side of the picture of the skin in shapes.glb, in pixels (256 to 4096); "
                     "those of the other parts have half of it. Parts with pictures of the mesh "
                     "keep those. 0: plain colours")
        ->capture_default_str();
    add_parts(*command, options);
    command
        ->add_option("--maps", options.maps_px,
                     "Side in pixels (256 to 4096) of the maps of each shape on the texture of the "
                     "skin: maps/NAME_compression.png and NAME_stretch.png, grey, and the wrinkles "
                     "as NAME_normal.png. 0: none")
        ->capture_default_str();
    command->add_flag("--no-pictures", arguments->no_pictures,
                      "Write the accuracy report without pictures");
    add_threads(*command, options.threads, "The files are");
    add_common(*command, arguments->common);
    command->footer(
        "Every shape is the face at rest under the muscles that the rig's tables give it, on the "
        "mesh as "
        "imported: its vertices,\nin its order. Left and right halves add up to the whole; "
        "mouthClose lies on top of jawOpen.\n\n"
        "Examples:\n"
        "  risorius shapes rigs/adult/rig.json -o out/arkit\n"
        "  risorius shapes anna/rig.json --set facs --formats glb -o anna/facs\n"
        "  risorius shapes anna/rig.json --only mouthSmile,jawOpen -o anna/look");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
