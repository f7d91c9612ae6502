// Chooses the form by the target's ending and keeps everything under a temporary name until
// finish().
#include "media/video_writer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <optional>

#include "core/error.h"
#include "media/detail/encoder.h"
#include "media/detail/temporary_file.h"
#include "media/image_file.h"

namespace risorius::media {

namespace fs = std::filesystem;

namespace {

enum class Form { kMp4, kMatroska, kFolder };

constexpr std::array<const char*, 10> kPresets = {"ultrafast", "superfast", "veryfast", "faster",
                                                  "fast",      "medium",    "slow",     "slower",
                                                  "veryslow",  "placebo"};

Form form_of(const fs::path& target) {
    if (!target.empty() && !target.has_filename()) return Form::kFolder;
    std::string ending = target.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".mp4") return Form::kMp4;
    if (ending == ".mkv") return Form::kMatroska;
    throw Error(target.string(),
                "an ending of .mp4 (H.264), .mkv (lossless) or / (a folder of PNG frames)",
                ending.empty() ? "no ending" : "\"" + target.extension().string() + "\"");
}

std::string frame_name(int frame) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%06d.png", frame);
    return name;
}

bool is_frame_name(const std::string& name) {
    return name.size() == 16 && name.starts_with("frame_") && name.ends_with(".png") &&
           std::all_of(name.begin() + 6, name.begin() + 12,
                       [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Frames of an earlier run may be replaced; a folder with anything else in it is not ours to
/// remove.
void check_folder(const fs::path& target) {
    const fs::path folder = target.parent_path();
    std::error_code failure;
    const fs::path name = folder.lexically_normal().filename();
    if (name.empty() || name == "." || name == "..")
        throw Error(target.string(), "a folder with a name of its own, such as frames/",
                    "\"" + target.string() + "\"");
    if (!fs::exists(folder, failure)) return;
    if (!fs::is_directory(folder, failure)) throw Error(target.string(), "a folder", "a file");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (!is_frame_name(entry.path().filename().string()))
            throw Error(target.string(),
                        "an empty folder or one that holds only frame_000000.png and so on",
                        "\"" + entry.path().filename().string() + "\" in it");
}

std::string size_text(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

void check_target(const fs::path& target, const VideoOptions& options) {
    const Form form = form_of(target);
    const std::string place = target.string();
    const auto check_range = [&](const char* what, int value, int min, int max) {
        if (value < min || value > max)
            throw Error(place,
                        std::string(what) + " in [" + std::to_string(min) + ", " +
                            std::to_string(max) + "]",
                        std::to_string(value));
    };
    const int smallest = form == Form::kMp4 ? 16 : 2;
    const int largest = form == Form::kMp4 ? 8192 : 16384;
    check_range("a width in pixels", options.width_px, smallest, largest);
    check_range("a height in pixels", options.height_px, smallest, largest);
    check_range("frames per second", options.fps, 1, 1000);
    if (form == Form::kMp4) {
        if (options.width_px % 2 != 0 || options.height_px % 2 != 0)
            throw Error(place,
                        "an even width and height for .mp4 (its colour is stored at half size)",
                        size_text(options.width_px, options.height_px));
        check_range("a quality (crf)", options.crf, 0, 51);
        if (std::find(kPresets.begin(), kPresets.end(), options.preset) == kPresets.end()) {
            std::string expected = "an encoder preset, one of";
            for (const char* preset : kPresets) expected += std::string(" ") + preset;
            throw Error(place, expected, "\"" + options.preset + "\"");
        }
    }
    if (form == Form::kFolder) {
        check_folder(target);
    } else if (fs::is_directory(target)) {
        throw Error(place, "a file (end it with / for a folder of PNG frames)", "a folder");
    }
}

struct VideoWriter::Impl {
    fs::path target;
    VideoOptions options;
    Form form;
    detail::TemporaryFile temporary;  // declared before the encoder, so removed after it has closed
    std::unique_ptr<detail::Encoder>
        encoder;  // made by the first frame, which tells whether alpha is needed
    bool alpha = false;
    int frames = 0;
    bool finished = false;

    Impl(const fs::path& target_, const VideoOptions& options_)
        : target(target_), options(options_), form(form_of(target_)), temporary(target_) {}

    /// The first failed write removes everything at once: a full disk gets its room back before the
    /// message.
    template <typename Step>
    void run(Step step) {
        try {
            step();
        } catch (...) {
            encoder.reset();
            std::error_code ignored;
            fs::remove_all(temporary.path(), ignored);
            finished = true;
            throw;
        }
    }

    void append(const Image& frame) {
        const bool transparent = has_transparency(frame);
        if (form == Form::kFolder) {
            write_png(frame, temporary.path() / frame_name(frames));
            return;
        }
        if (form == Form::kMp4 && transparent)
            throw Error(target.string(),
                        "opaque frames (.mkv and PNG frames keep transparency, .mp4 cannot)",
                        "transparent pixels in frame " + std::to_string(frames));
        if (!encoder) {
            alpha = transparent;
            encoder = std::make_unique<detail::Encoder>(
                temporary.path(), target.string(),
                form == Form::kMp4 ? detail::Container::kMp4 : detail::Container::kMatroska,
                options, alpha);
        }
        if (transparent && !alpha)
            throw Error(target.string(), "opaque frames, as the first one was",
                        "transparent pixels in frame " + std::to_string(frames));
        encoder->append(frame);
    }
};

VideoWriter::VideoWriter(const fs::path& target, const VideoOptions& options) {
    check_target(target, options);
    impl_ = std::make_unique<Impl>(target, options);
    if (impl_->form != Form::kFolder) return;
    std::error_code failure;
    fs::create_directory(impl_->temporary.path(), failure);
    if (failure)
        throw RunError(target.string() + ": the folder cannot be made: " + failure.message());
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::append(const Image& frame) {
    if (impl_->finished) throw RunError(impl_->target.string() + ": already finished");
    if (frame.width_px != impl_->options.width_px || frame.height_px != impl_->options.height_px)
        throw RunError(impl_->target.string() + ": frame " + std::to_string(impl_->frames) +
                       " is " + size_text(frame.width_px, frame.height_px) + " pixels, the video " +
                       size_text(impl_->options.width_px, impl_->options.height_px));
    impl_->run([&] { impl_->append(frame); });
    ++impl_->frames;
}

void VideoWriter::finish() {
    if (impl_->finished) throw RunError(impl_->target.string() + ": already finished");
    if (impl_->frames == 0) throw RunError(impl_->target.string() + ": a video without frames");
    impl_->run([&] {
        if (impl_->encoder) impl_->encoder->finish();
        impl_->temporary.replace_target();
    });
    impl_->finished = true;
}

int VideoWriter::frames() const { return impl_->frames; }

}  // namespace risorius::media
