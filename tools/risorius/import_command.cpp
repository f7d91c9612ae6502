// SPDX-License-Identifier: MIT
// risorius import FILE -o SCRIPT
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/motion/import_motion.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

std::array<double, 2> read_span(const std::string& option, const std::string& text) {
    std::array<double, 2> out{};
    char end = 0;
    if (std::sscanf(text.c_str(), "%lf-%lf%c", &out[0], &out[1], &end) != 2 ||
        !std::isfinite(out[0]) || !std::isfinite(out[1]))
        throw Error(option, "begin and end in seconds, as 0-0.5", in_quotes(text));
    return out;
}

namespace {

struct ImportArguments {
    Common common;
    motion::ImportOptions options;
    std::string neutral, motion = "quasi_static";
};

void print(const motion::ImportReport& report) {
    std::printf("%s: %s, %d samples in %.2f s, %.4g a second\n", report.file.c_str(),
                report.format.c_str(), report.samples, report.duration_s, report.fps);
    if (report.lost > 0) std::printf("  %d frames are missing in the file\n", report.lost);
    if (report.unseen > 0)
        std::printf("  %d samples without a face: %d held, %d faded to rest\n", report.unseen,
                    report.unseen - report.faded, report.faded);
    std::printf("  %-24s %9s %9s %6s\n", "channel", "least", "most", "keys");
    for (const motion::ImportedChannel& channel : report.channels)
        std::printf("  %-24s %9.3f %9.3f %6d\n", channel.name.c_str(), channel.min, channel.max,
                    channel.keys);
    if (report.still > 0) std::printf("  %d more channels stay at rest\n", report.still);
    for (const std::string& name : report.unmapped)
        std::printf("  not mapped: %s\n", readable_text(name).c_str());
    for (const std::string& note : report.notes)
        std::printf("  note: %s\n", readable_text(note).c_str());
    std::printf("%s: %ld values became %ld keys\n", report.script.c_str(), report.values(),
                report.keys());
}

void run(ImportArguments& arguments) {
    motion::ImportOptions& options = arguments.options;
    if (options.rig.empty()) options.rig = data_folder() / "rigs/adult/rig.json";
    if (!arguments.neutral.empty())
        options.neutral_s = read_span("import --neutral", arguments.neutral);
    options.motion =
        arguments.motion == "dynamic" ? track::Motion::kDynamic : track::Motion::kQuasiStatic;
    const motion::ImportReport report = motion::import_motion(options);
    if (arguments.common.json)
        std::printf("%s\n", json_text(report.json(), 2).c_str());
    else if (!arguments.common.quiet)
        print(report);
}

}  // namespace

void add_import(CLI::App& app) {
    CLI::App* command = app.add_subcommand("import", "Make a script of recorded face motion");
    auto arguments = std::make_shared<ImportArguments>();
    motion::ImportOptions& options = arguments->options;
    command
        ->add_option("FILE", options.file,
                     "The recording: a table of Live Link Face, OpenFace 2 or py-feat, JSON of "
                     "MediaPipe FaceLandmarker or ARKit, glTF or VRMA with an animation, a dump of "
                     "VMC packets, BVH (the head alone), or activations of OpenSim (.sto, .mot)")
        ->required();
    command->add_option("-o,--out", options.out, "The script to write")->required();
    command->add_option(
        "--as", options.read.as,
        "Format of the file, if the program cannot recognise it: livelink, mediapipe, "
        "openface, pyfeat, arkit, gltf, vmc, bvh or storage");
    command->add_option("--rig", options.rig,
                        "The rig that the script names; without it, the adult rig");
    command->add_option("--fps", options.read.fps,
                        "Frames per second of a recording that does not say it (Live Link Face, "
                        "py-feat)");
    command->add_flag("--mirror", options.mirror,
                      "Exchange left and right, for mirrored pictures of selfie cameras");
    command
        ->add_option("--invert", options.invert,
                     "Angles of head and eyes whose sign is wrong, separated by commas: yaw, "
                     "pitch, roll")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option("--neutral", arguments->neutral,
                        "A time in which the face is neutral and looks ahead, in seconds, as "
                        "0-0.5. What is measured there becomes 0");
    command
        ->add_option("--smooth", options.smooth_hz,
                     "Low-pass frequency, Hz, without delay; 6 to 8 suits webcams. Lids keep 15 "
                     "Hz, and the eyes are not smoothed. 0: none")
        ->capture_default_str();
    command
        ->add_option("--tolerance", options.tolerance,
                     "Largest error of a weight when keys are left out; of an angle, ten times as "
                     "many degrees")
        ->capture_default_str();
    command
        ->add_option("--motion", arguments->motion,
                     "How the script moves the tissue: quasi_static (when the recording says) or "
                     "dynamic (renders about nine times as fast; tissue is up to 50 ms late)")
        ->check(CLI::IsMember({"quasi_static", "dynamic"}))
        ->capture_default_str();
    add_common(*command, arguments->common);
    command->footer(
        "Examples:\n"
        "  risorius import take.csv --rig anna/rig.json -o anna/take.json\n"
        "  risorius import webcam.jsonl --mirror --neutral 0-0.5 --smooth 7 -o mine/take.json\n"
        "  risorius render mine/take.json -o take.mp4");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
