// SPDX-License-Identifier: MIT
// Chooses the form by the target's ending, and keeps everything in a private folder until finish().
#include "risorius/media/video_writer.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/core/output_set.h"
#include "risorius/media/detail/encoder.h"
#include "risorius/media/detail/video_form.h"
#include "risorius/media/image_file.h"

namespace risorius::media {

namespace fs = std::filesystem;
using detail::Form;
using detail::form_of;

namespace {

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

/// Frames of an earlier run may be replaced. A folder that contains anything else must not be removed.
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
    detail::check_options(place, form, options);
    if (form == Form::kFolder) {
        check_folder(target);
    } else if (fs::is_directory(target)) {
        throw Error(place, "a file (end it with / for a folder of PNG frames)", "a folder");
    }
}

struct VideoWriter::Impl {
    fs::path target;  ///< as users know it
    VideoOptions options;
    Form form;
    // Declared before the encoder, so that it is removed after the encoder has closed.
    std::optional<OutputSet> own;  ///< none when the target belongs to a set of the caller
    fs::path path;                 ///< what is written: a file, or a folder of frames
    // Made at the first frame, which shows whether alpha is needed.
    std::unique_ptr<detail::Encoder> encoder;
    bool alpha = false;
    int frames = 0;
    bool finished = false;

    Impl(const fs::path& target_, const VideoOptions& options_)
        : target(shown_output(target_)), options(options_), form(form_of(target_)), path(target_) {
        if (is_private_output(target_)) {
            if (form == Form::kFolder) make_folder(path);
            return;
        }
        own.emplace(folder_of_output(target_), OutputSet::Then::kRunGoesOn);
        path = form == Form::kFolder ? own->folder(target_) : own->file(target_);
    }

    /// The first failed write removes everything at once, so that a full disk has room again before the message.
    template <typename Step>
    void run(Step step) {
        try {
            step();
        } catch (...) {
            encoder.reset();
            std::error_code ignored;
            fs::remove_all(path, ignored);
            finished = true;
            throw;
        }
    }

    void append(const Image& frame) {
        const bool transparent = has_transparency(frame);
        if (form == Form::kFolder) {
            const fs::path file = path / frame_name(frames);
            if (options.bits.value_or(8) == 16)
                write_png16(frame, file);
            else
                write_png(frame, file);
            return;
        }
        if (form == Form::kMp4 && transparent)
            throw Error(target.string(),
                        "opaque frames (.mkv, .mov, .webm and PNG frames keep transparency, .mp4 "
                        "cannot)",
                        "transparent pixels in frame " + std::to_string(frames));
        if (!encoder) {
            alpha = transparent || options.alpha;
            if (alpha && !options.alpha) {
                VideoOptions told = options;
                told.alpha = true;
                detail::check_options(target.string(), form, told);
            }
            encoder =
                std::make_unique<detail::Encoder>(path, target.string(), form, options, alpha);
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
        if (impl_->own) impl_->own->commit();
        impl_->own.reset();
    });
    impl_->finished = true;
}

int VideoWriter::frames() const { return impl_->frames; }

}  // namespace risorius::media
