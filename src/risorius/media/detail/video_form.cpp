// SPDX-License-Identifier: MIT
#include "risorius/media/detail/video_form.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"

namespace risorius::media::detail {

namespace {

constexpr std::array<const char*, 10> kPresets = {"ultrafast", "superfast", "veryfast", "faster",
                                                  "fast",      "medium",    "slow",     "slower",
                                                  "veryslow",  "placebo"};
constexpr std::array<const char*, 2> kPixels = {"yuv420p", "yuv444p"};

template <typename Names>
void check_one_of(const std::string& place, const std::string& what, const Names& names,
                  const std::string& found) {
    if (std::find(names.begin(), names.end(), found) != names.end()) return;
    std::string expected = what + ", one of";
    for (const char* name : names) expected += std::string(" ") + name;
    throw Error(place, expected + did_you_mean(found, {names.begin(), names.end()}),
                risorius::in_quotes(found));
}

void check_range(const std::string& place, const char* what, int value, int min, int max) {
    if (value < min || value > max)
        throw Error(
            place,
            std::string(what) + " in [" + std::to_string(min) + ", " + std::to_string(max) + "]",
            std::to_string(value));
}

const char* ending_of(Form form) {
    switch (form) {
        case Form::kMp4:
            return "\".mp4\"";
        case Form::kMov:
            return "\".mov\"";
        case Form::kMatroska:
            return "\".mkv\"";
        case Form::kWebm:
            return "\".webm\"";
        case Form::kFolder:
            break;
    }
    return "a folder of PNG frames";
}

void check_quality(const std::string& place, Form form, const VideoOptions& options) {
    const bool lossy = form == Form::kMp4 || form == Form::kMov || form == Form::kWebm;
    const char* const found = ending_of(form);
    const std::string lossless = "an option that goes with " + option_name("lossless");
    const bool kept_exactly = options.lossless && lossy;
    if (options.crf) {
        if (!lossy)
            throw Error(place, "an ending whose quality (crf) can be chosen, .mp4, .mov or .webm",
                        found);
        if (kept_exactly) throw Error(place, lossless, "a quality (crf)");
        check_range(place, "a quality (crf)", *options.crf, 0, form == Form::kWebm ? 63 : 51);
    }
    if (options.preset) {
        if (form != Form::kMp4 && form != Form::kMov)
            throw Error(place, "an ending with encoder presets, .mp4 or .mov", found);
        check_one_of(place, "an encoder preset", kPresets, *options.preset);
    }
    if (options.pixels) {
        if (!lossy)
            throw Error(place, "an ending whose pixel format can be chosen, .mp4, .mov or .webm",
                        found);
        if (kept_exactly) throw Error(place, lossless, "a pixel format");
        check_one_of(place, "a pixel format", kPixels, *options.pixels);
    }
    if (options.keyframe_interval) {
        if (!lossy)
            throw Error(place,
                        "an ending whose key frames can be chosen, .mp4, .mov or .webm (in others "
                        "every frame is one)",
                        found);
        check_range(place, "frames from one key frame to the next", *options.keyframe_interval, 1,
                    100000);
    }
    if (options.bits) {
        if (form != Form::kFolder && form != Form::kMatroska)
            throw Error(place, "a folder of PNG frames (frames/) or .mkv, whose bits can be chosen",
                        found);
        if (*options.bits != 8 && *options.bits != 16)
            throw Error(place, "8 or 16 bits per channel", std::to_string(*options.bits));
    }
}

void check_transparency(const std::string& place, Form form, const VideoOptions& options) {
    if (!options.alpha) return;
    if (form == Form::kMp4)
        throw Error(place, "an ending that keeps transparency, .mkv, .mov, .webm or /", "\".mp4\"");
    if (form == Form::kWebm && options.lossless)
        throw Error(place, "an ending that keeps transparency without loss, .mkv, .mov or /",
                    "\".webm\"");
    if (form == Form::kWebm && options.pixels.value_or("yuv420p") != "yuv420p")
        throw Error(place, "yuv420p, the pixel format that has transparency in .webm",
                    risorius::in_quotes(*options.pixels));
    if (form == Form::kMov && !options.lossless)
        for (const auto& [given, what] : {std::pair{options.crf.has_value(), "a quality (crf)"},
                                          std::pair{options.preset.has_value(), "a preset"},
                                          std::pair{options.pixels.has_value(), "a pixel format"}})
            if (given)
                throw Error(
                    place,
                    "no options of H.264: transparent .mov files are ProRes 4444, or PNG with " +
                        option_name("lossless"),
                    what);
}

void check_sound(const std::string& place, Form form, const VideoOptions& options) {
    if (!options.sound) return;
    if (form == Form::kFolder)
        throw Error(place, "an ending that can hold sound, .mp4, .mov, .mkv or .webm",
                    ending_of(form));
    const int max = form == Form::kMp4 || form == Form::kWebm ? 2 : 8;
    check_range(place, "a number of sound channels", options.sound->channels, 1, max);
    check_range(place, "a sample rate of sound in Hz", options.sound->rate_hz, 8000, 384000);
}

}  // namespace

Form form_of(const std::filesystem::path& target) {
    if (!target.empty() && !target.has_filename()) return Form::kFolder;
    std::string ending = target.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".mp4") return Form::kMp4;
    if (ending == ".mov") return Form::kMov;
    if (ending == ".mkv") return Form::kMatroska;
    if (ending == ".webm") return Form::kWebm;
    throw Error(target.string(),
                "an ending of .mp4 or .mov (H.264), .mkv (lossless), .webm (VP9) or / (a folder of "
                "PNG frames)",
                ending.empty() ? "no ending" : "\"" + target.extension().string() + "\"");
}

Coding coding_of(Form form, const VideoOptions& options, bool alpha) {
    if (form == Form::kMatroska) return Coding::kFfv1;
    if (form == Form::kWebm) return options.lossless ? Coding::kVp9Rgb : Coding::kVp9;
    if (alpha) return options.lossless ? Coding::kPng : Coding::kProRes;
    return options.lossless ? Coding::kH264Rgb : Coding::kH264;
}

bool halves_colour(Coding coding, const VideoOptions& options) {
    return (coding == Coding::kH264 || coding == Coding::kVp9) &&
           options.pixels.value_or("yuv420p") == "yuv420p";
}

void check_options(const std::string& place, Form form, const VideoOptions& options) {
    const bool coded = form != Form::kMatroska && form != Form::kFolder;
    check_range(place, "a width in pixels", options.width_px, coded ? 16 : 2, coded ? 8192 : 16384);
    check_range(place, "a height in pixels", options.height_px, coded ? 16 : 2,
                coded ? 8192 : 16384);
    check_range(place, "frames per second", options.fps, 1, 1000);
    check_quality(place, form, options);
    check_transparency(place, form, options);
    check_sound(place, form, options);
    if (form != Form::kFolder && halves_colour(coding_of(form, options, options.alpha), options) &&
        (options.width_px % 2 != 0 || options.height_px % 2 != 0)) {
        std::string ending = ending_of(form);
        ending = ending.substr(1, ending.size() - 2);
        throw Error(
            place,
            "an even width and height for " + ending + " (its colour is stored at half size)",
            std::to_string(options.width_px) + " x " + std::to_string(options.height_px));
    }
}

}  // namespace risorius::media::detail
