// SPDX-License-Identifier: MIT
// risorius speak TEXT -o -: pictures and sound leave the program while the rest is still simulated.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "risorius/animate/render_job.h"
#include "risorius/animate/run_render_job.h"
#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/output_set.h"
#include "risorius/media/live_stream.h"
#include "risorius/media/mono_sound.h"
#include "risorius/speech/phone_table.h"
#include "risorius/talk/script_checker.h"
#include "risorius/talk/speak_script.h"
#include "tools/risorius/render_options.h"
#include "tools/risorius/speak_arguments.h"

namespace risorius::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "standard output";
// One for each thread that draws, so that all views are made
constexpr int kReadyFrames = 8;

class LiveSpeaker {
  public:
    explicit LiveSpeaker(SpeakArguments& arguments)
        : arguments_(arguments),
          bar_(arguments.common),
          inputs_(bar_.monitor()),
          rig_(fs::absolute(arguments.render.rig.value_or(data_folder() / "rigs/adult/rig.json"))),
          fps_(arguments.render.fps.value_or(60)) {
        arguments.render.sound = false;  // it goes to the stream
        if (!arguments.render.quality && !arguments.render.draft)
            arguments.render.quality = "preview";
    }

    /// Builds the face and the view, so that the first text finds them ready.
    void get_ready() {
        const Json script = json_object({{"format", "risorius-script"},
                                         {"version", 1},
                                         {"rig", rig_.string()},
                                         {"fps", fps_},
                                         {"duration_s", (kReadyFrames - 0.5) / fps_}});
        run(script, "rest", [](const Image&) {});
        talk::voice_of_rig(inputs_.rig(rig_)->files, [this](double fraction) {
            bar_.monitor().report(fraction, "simulating mouths of this rig, once");
        });
    }

    void say() {
        OutputSet folder(fs::temp_directory_path(), OutputSet::Then::kRunGoesOn);
        talk::SpokenResult said = talk::read_spoken(arguments_.input, table_);
        speech::Utterance& utterance = said.spoken.utterance;
        if (said.spoken.sound.empty() && !said.sound_file.empty())
            said.spoken.sound = media::read_mono_sound(said.sound_file).samples;
        utterance.sound.clear();
        talk::SpeakScriptOptions options;
        options.utterance = folder.scratch_file("said.utterance.json");
        write_file(options.utterance, speech::utterance_text(utterance));
        options.rig = rig_;
        options.fps = fps_;
        options.style = arguments_.style;
        options.gestures = arguments_.gestures;
        options.blinks = arguments_.blinks;
        options.gaze = arguments_.gaze;
        options.adjust = talk::usual_changes(utterance, table_);
        const Json script = talk::speak_script(utterance, options);
        const ReadingFormerOutput own_file;
        const auto before =
            std::llround(script["events"].back()["start_s"].get<double>() * utterance.rate_hz);
        std::int64_t heard = -before;
        run(script, "speech", [&](const Image& image) {
            append(image, utterance.rate_hz, said.spoken.sound, heard);
        });
        if (!arguments_.common.quiet)
            std::fprintf(stderr, "%zu phones, %.3f s\n", utterance.phones.size(),
                         utterance.seconds(utterance.samples));
    }

    void finish() {
        if (stream_) stream_->finish();
    }

  private:
    void run(const Json& script, const std::string& name, const animate::UsePicture& use) {
        animate::RenderRequest request = arguments_.render;
        request.script = name;
        request.script_in_memory = JsonCursor::from_json(script, name);
        request.out = "live.mkv";  // names the kind of pictures; there is no such file
        const animate::RenderJob job = animate::plan_render_job(request, inputs_);
        animate::run_render_job(job, session_, use, bar_.monitor());
    }

    /// The next picture, with the samples that are heard while it is seen; `heard` is the first of them.
    void append(const Image& image, int rate_hz, std::span<const float> sound,
                std::int64_t& heard) {
        if (!stream_) {
            stream_.emplace(
                kName, media::LiveStreamOptions{image.width_px, image.height_px, fps_, rate_hz});
            rate_hz_ = rate_hz;
        }
        if (rate_hz != rate_hz_)
            throw Error(option_name("voice"),
                        "a voice of " + std::to_string(rate_hz_) + " Hz, as before",
                        std::to_string(rate_hz));
        const std::int64_t count =
            stream_->first_sample(stream_->frames() + 1) - stream_->first_sample(stream_->frames());
        std::vector<float> piece(static_cast<std::size_t>(count), 0.0F);
        for (std::int64_t i = 0; i < count; ++i)
            if (const std::int64_t at = heard + i;
                at >= 0 && at < static_cast<std::int64_t>(sound.size()))
                piece[static_cast<std::size_t>(i)] = sound[static_cast<std::size_t>(at)];
        heard += count;
        stream_->append(image, piece);
    }

    SpeakArguments& arguments_;
    ProgressBar bar_;
    animate::RenderInputs inputs_;
    animate::RenderSession session_;
    const speech::PhoneTable table_ = speech::PhoneTable::standard();
    const fs::path rig_;
    const int fps_;
    int rate_hz_ = 0;
    std::optional<media::LiveStream> stream_;
};

}  // namespace

void speak_live(SpeakArguments& arguments) {
    if (arguments.common.json)
        throw Error("--json", "an output that is a file, as the film goes to standard output",
                    std::string("--out ") + kStandard);
    if (!arguments.script.empty())
        throw Error("--script", "an output that is a file", std::string("--out ") + kStandard);
    if (::isatty(STDOUT_FILENO) == 1)
        throw Error("--out", "a pipe or a file behind standard output", "a terminal");
    finish_view(arguments.render, arguments.size);
    LiveSpeaker speaker(arguments);
    if (arguments.said != kStandard) {
        speaker.say();
        return speaker.finish();
    }
    speaker.get_ready();
    for (std::string line; std::getline(std::cin, line);) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        arguments.input.voice.text = line;
        speaker.say();
    }
    speaker.finish();
}

}  // namespace risorius::cli
