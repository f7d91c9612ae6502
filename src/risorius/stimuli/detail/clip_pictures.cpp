// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/clip_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/media/face_filter.h"
#include "risorius/media/sync_marks.h"
#include "risorius/report/contact_sheet.h"
#include "risorius/stimuli/detail/chimera.h"
#include "risorius/stimuli/detail/mirrored_rows.h"
#include "risorius/stimuli/detail/unmatched_render.h"

namespace risorius::stimuli {

using design::ControlKind;

namespace {

constexpr int kThumb_px = 120;
constexpr int kStripFrames = 5;
constexpr int kPhotodiode_px = 64;
constexpr unsigned kNextFrame = 0x9E3779B9;
constexpr double kSeenChange = 1e-7;  // mean of squared differences of relative luminance

/// A fixed window that contains the landmarks of eyes or mouth in all frames.
Window window_around(const animate::FrameRows& rows, design::ControlKind kind,
                     const std::string& place) {
    const std::vector<std::string> ids =
        kind == design::ControlKind::kEyesOnly
            ? std::vector<std::string>{"en_l", "en_r", "ex_l", "ex_r",
                                       "ps_l", "ps_r", "pi_l", "pi_r"}
            : std::vector<std::string>{"ch_l", "ch_r", "ls", "li", "sto", "stos", "stoi"};
    double width = 0;
    Window out{1e9, 1e9, -1e9, -1e9};
    for (const std::string& id : ids) {
        const int u = rows.column(id + ".u_px"), v = rows.column(id + ".v_px");
        if (u < 0 || v < 0) continue;
        for (int r = 0; r < rows.rows(); ++r) {
            out.left = std::min(out.left, rows.number(r, u));
            out.right = std::max(out.right, rows.number(r, u));
            out.top = std::min(out.top, rows.number(r, v));
            out.bottom = std::max(out.bottom, rows.number(r, v));
        }
    }
    width = out.right - out.left;
    if (!(width > 0))
        throw Error(place, "a rig with landmarks of eyes and mouth", "none to put a window around");
    const double beside = 0.12 * width,
                 above = (kind == design::ControlKind::kEyesOnly ? 0.16 : 0.2) * width;
    return {out.left - beside, out.top - above, out.right + beside, out.bottom + above};
}

void turn_upside_down(Image& image) {
    std::vector<std::uint8_t> turned(image.rgba.size());
    const std::size_t pixels = image.rgba.size() / 4;
    for (std::size_t i = 0; i < pixels; ++i)
        std::copy_n(&image.rgba[4 * i], 4, &turned[4 * (pixels - 1 - i)]);
    image.rgba = std::move(turned);
}

void mirror(Image& image) {
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px / 2; ++x)
            std::swap_ranges(image.pixel(x, y), image.pixel(x, y) + 4,
                             image.pixel(image.width_px - 1 - x, y));
}

std::string decimal_text(double value, int decimals) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

/// The value of a column for the displayed picture; none if the column is not a measure of the picture.
std::optional<std::string> shown(const std::string& column, const media::PictureMeasures& picture) {
    if (column == "luminance_mean") return decimal_text(picture.luminance_mean, 6);
    if (column == "luminance_sd") return decimal_text(picture.luminance_sd, 6);
    if (column == "contrast_rms") return decimal_text(picture.contrast_rms, 6);
    if (column == "motion_energy") return decimal_text(picture.motion_energy, 9);
    return {};
}

}  // namespace

bool is_of_landmark(const std::string& column) {
    return column.ends_with(".x_mm") || column.ends_with(".y_mm") || column.ends_with(".z_mm") ||
           column.ends_with(".u_px") || column.ends_with(".v_px");
}

int strip_frames(const ClipPlan& plan) { return plan.clips.pictures() ? 1 : kStripFrames; }

int strip_frame(int index, int frames) { return (2 * index + 1) * frames / (2 * kStripFrames); }

double width_of_face(const animate::FrameRows& rows, const std::string& place) {
    const int left = rows.column("zy_l.u_px"), right = rows.column("zy_r.u_px");
    if (left < 0 || right < 0)
        throw Error(place, "a rig with the landmarks zy_l and zy_r", "none to measure the face by");
    return std::hypot(rows.number(0, left) - rows.number(0, right),
                      rows.number(0, left + 1) - rows.number(0, right + 1));
}

void Window::show(const std::array<std::uint8_t, 3>& outside, Image& image) const {
    const double soft = 0.08 * (right - left);
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x) {
            const double away = std::max({left - x, x - right, top - y, y - bottom, 0.0});
            const double fraction =
                away >= soft ? 0.0 : 0.5 * (1 + std::cos(3.14159265358979 * away / soft));
            std::uint8_t* pixel = image.pixel(x, y);
            for (int k = 0; k < 3; ++k)
                pixel[k] = static_cast<std::uint8_t>(std::lround(
                    fraction * pixel[k] + (1 - fraction) * outside[static_cast<std::size_t>(k)]));
        }
}

bool needs_all_frames(const ClipPlan& plan) {
    const ControlKind kind = plan.condition.control.kind;
    return plan.lead_frames > 0 || plan.finer() > 1 || plan.lower || shows_other_order(kind) ||
           shows_part(kind) || (plan.condition.control.changes_the_oval() && !plan.luminance);
}

bool ClipPictures::has_layers(const ClipPlan& plan) {
    return plan.luminance || plan.condition.control.changes_the_oval();
}

bool shows_other_order(design::ControlKind kind) {
    return kind == design::ControlKind::kReversed || kind == design::ControlKind::kScrambled ||
           kind == design::ControlKind::kApex;
}

bool shows_part(design::ControlKind kind) {
    return kind == design::ControlKind::kEyesOnly || kind == design::ControlKind::kMouthOnly;
}

bool shows_one_picture(design::ControlKind kind) {
    return kind == design::ControlKind::kApex || kind == design::ControlKind::kNeutral;
}

ClipPictures::ClipPictures(const ClipPlan& plan, std::function<void(const Image&)> show)
    : plan_(plan),
      kind_(plan.condition.control.kind),
      show_(std::move(show)),
      later_(needs_all_frames(plan)),
      measured_(plan.tone || plan.mapped || plan.lead_frames > 0 ||
                plan.condition.control.shows_otherwise()),
      layered_(has_layers(plan)) {
    if (plan.tone) tone_.emplace(*plan.tone);
    if (kind_ == design::ControlKind::kPhaseScrambled)
        phases_.emplace(plan.width_px, plan.height_px, plan.condition.seed);
}

void ClipPictures::add(Image image) {
    // Sixteen bits say all that bytes do.
    if (later_ && !image.deep.empty()) std::vector<std::uint8_t>().swap(image.rgba);
    if (later_)
        held_.push_back(std::move(image));
    else
        write(std::move(image), added_++);
}

void ClipPictures::finish(const std::vector<int>& order) {
    if (!later_) return;
    if (shows_part(kind_)) window_ = window_around(*rows_, kind_, plan_.condition.clip);
    for (const int frame : order) {
        Image image = held_[static_cast<std::size_t>(frame)];
        if (image.rgba.empty())
            for (const std::uint16_t value : image.deep)
                image.rgba.push_back(static_cast<std::uint8_t>((value + 128U) / 257U));
        write(std::move(image), frame);
    }
}

Image ClipPictures::strip() const {
    const Image& first = thumbs_.front();
    const int shown_frames = strip_frames(plan_);
    Image out(shown_frames * first.width_px, first.height_px);
    for (int i = 0; i < shown_frames; ++i) {
        const auto at = static_cast<std::size_t>(strip_frame(i, static_cast<int>(thumbs_.size())));
        for (int y = 0; y < first.height_px; ++y)
            std::copy_n(thumbs_[at].pixel(0, y), 4 * first.width_px,
                        out.pixel(i * first.width_px, y));
    }
    return out;
}

void ClipPictures::look_for_change(const Image& image) {
    if (pixel_onset_) return;
    const std::size_t pixels = image.rgba.size() / 4;
    if (first_.empty()) {
        for (std::size_t i = 0; i < pixels; ++i) {
            const std::uint8_t* pixel = &image.rgba[4 * i];
            const bool behind = std::equal(plan_.background.begin(), plan_.background.end(), pixel);
            first_.push_back(behind ? -1 : media::relative_luminance(pixel));
        }
        return;
    }
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (first_[i] < 0) continue;
        const double change = media::relative_luminance(&image.rgba[4 * i]) - first_[i];
        sum += change * change;
        ++count;
    }
    if (count > 0 && sum / count > kSeenChange) pixel_onset_ = written_;
}

void ClipPictures::pass(const std::vector<float>& oval, Image& image) {
    const design::Control& control = plan_.condition.control;
    const bool band = kind_ == ControlKind::kBandPass;
    // clip_checks.h has refused a face that is too small.
    const double face_px = width_of_face(*rows_, plan_.condition.clip);
    media::PassFilter filter{.high = kind_ != ControlKind::kLowPass,
                             .cut_cycles_per_px = control.cycles_per_face / face_px,
                             .order = control.order,
                             .keep_sd = control.keep_contrast};
    if (band) filter.low_cut_cycles_per_px = control.upper_cycles_per_face / face_px;
    media::filter(filter, oval, image);
}

/// Draws the pattern of a frame, with mean and deviation of luminance of the face in the first frame.
void ClipPictures::draw_mask(const std::vector<float>& oval, Image& image) {
    const design::Control& control = plan_.condition.control;
    if (written_ == 0) {
        media::LuminanceSums face;
        face.add(image, oval);
        mask_ = {.face_px = width_of_face(*rows_, plan_.condition.clip),
                 .grey = control.grey,
                 .mean = face.mean(),
                 .sd = face.sd()};
    }
    const auto pattern = static_cast<unsigned>(
        written_ / static_cast<int>(std::lround(plan_.fps / control.rate_hz)));
    mask_.seed = plan_.condition.seed + kNextFrame * pattern;
    media::draw(mask_, image);
}

void ClipPictures::change_oval(const std::vector<float>& oval, int frame, Image& image) {
    const design::Control& control = plan_.condition.control;
    switch (kind_) {
        case ControlKind::kPhaseScrambled:
            phases_->scramble(image, oval);
            break;
        case ControlKind::kLowPass:
        case ControlKind::kHighPass:
        case ControlKind::kBandPass:
            pass(oval, image);
            break;
        case ControlKind::kPointLight:
            if (!dots_)
                dots_.emplace(*rows_, control.dots,
                              control.radius * width_of_face(*rows_, plan_.condition.clip),
                              control.scattered, plan_.condition.seed);
            std::fill(image.rgba.begin(), image.rgba.end(), std::uint8_t{255});
            media::keep_weighted(dots_->covered(frame, plan_.width_px, plan_.height_px),
                                 plan_.background, image);
            break;
        case ControlKind::kMondrian:
            draw_mask(oval, image);
            break;
        case ControlKind::kNoise:
            media::add_noise(control.snr_db,
                             plan_.condition.seed + kNextFrame * static_cast<unsigned>(written_),
                             oval, image);
            break;
        default:  // the oval alone
            media::keep_weighted(oval, plan_.background, image);
            break;
    }
}

/// What is done before the picture is put over its background: the map, and grey.
void ClipPictures::match(const std::vector<float>& measured, Image& image) {
    if (plan_.mapped) {
        media::LuminancePlane plane = media::luminance_plane(image, measured);
        if (!map_report_)
            map_report_.emplace(
                plan_.mapped.get(),
                plan_.luminance->spectrum ? width_of_face(*rows_, plan_.condition.clip) : 1);
        map_report_->add_before(plane);
        plan_.mapped->map.apply(plane);
        media::set_luminance(plane.y, plan_.luminance->grey, image);
        return;
    }
    if (tone_) cut_off_ += tone_->cut_off(image, measured);
    if (plan_.luminance->grey) media::make_grey(image);
}

Json ClipPictures::map_report() const { return map_report_->json(); }

void ClipPictures::write(Image image, int frame) {
    std::vector<float> measured, oval;
    if (chimera_) chimera_->combine(frame, image);
    if (plan_.luminance) measured = measured_weights(plan_, *rows_, frame, image);
    if (plan_.condition.control.changes_the_oval())
        oval = weights_in_oval(plan_, *rows_, frame, image);
    if (plan_.luminance) match(measured, image);
    if (layered_) {
        const media::ToneCurve curve = tone_.value_or(media::ToneCurve(media::Tone{}));
        if (plan_.transparent)
            curve.apply(image);
        else
            curve.apply_over(plan_.background, image);
    }
    if (!oval.empty()) change_oval(oval, frame, image);
    if (window_) window_->show(plan_.background, image);
    if (plan_.luminance) luminance_.add(image, measured);
    if (map_report_) map_report_->add_shown(media::luminance_plane(image, measured));
    if (kind_ == ControlKind::kUpsideDown) turn_upside_down(image);
    if (kind_ == ControlKind::kMirrored) mirror(image);
    look_for_change(image);
    if (measured_) measures_.push_back(meter_.measure(image));
    const int height = std::min(kThumb_px, image.height_px);
    thumbs_.push_back(
        report::shrunk(image, std::max(1, image.width_px * height / image.height_px), height));
    if (plan_.clips.photodiode)
        media::draw_photodiode(media::corner_named(*plan_.clips.photodiode, "photodiode"),
                               std::min(kPhotodiode_px, image.width_px / 8), written_ % 2 == 0,
                               image);
    ++written_;
    hash_.add(image.rgba.data(), image.rgba.size());
    show_(image);
}

std::string events_table(const animate::FrameRows& source, const std::vector<int>& order,
                         int first_source, const std::vector<media::PictureMeasures>& measures,
                         const ClipPlan& plan) {
    const ControlKind kind = plan.condition.control.kind;
    const animate::FrameRows rows =
        kind == ControlKind::kMirrored ? mirrored(source, plan.width_px) : source;
    const bool landmarks = plan.clips.landmarks && kind != ControlKind::kMondrian;
    std::string out = "onset\tduration\tframe\tsource_frame";
    std::vector<std::size_t> columns;
    for (std::size_t c = 2; c < rows.names.size(); ++c)
        if (landmarks || !is_of_landmark(rows.names[c])) columns.push_back(c);
    for (const std::size_t c : columns) out += "\t" + rows.names[c];
    if (plan.clips.photodiode) out += "\tphotodiode";
    out += "\n";
    const bool turned = kind == ControlKind::kUpsideDown;
    const double frame_s = plan.clips.pictures() ? plan.duration_s() : 1.0 / plan.fps;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto& cells = rows.cells[static_cast<std::size_t>(order[i])];
        out += decimal_text(static_cast<double>(i) / plan.fps, 6) + "\t" +
               decimal_text(frame_s, 6) + "\t" + std::to_string(i) + "\t" +
               std::to_string(first_source + order[i]);
        for (const std::size_t c : columns) {
            const std::string& name = rows.names[c];
            const auto ends = [&](const char* end) {
                return name.size() > 5 && name.compare(name.size() - 5, 5, end) == 0;
            };
            if (turned && (ends(".u_px") || ends(".v_px")))
                out += "\t" + decimal_text((ends(".u_px") ? plan.width_px : plan.height_px) -
                                               rows.number(order[i], static_cast<int>(c)),
                                           3);
            else if (const auto now = measures.empty() ? std::nullopt : shown(name, measures[i]))
                out += "\t" + *now;
            else
                out += "\t" + cells[c];
        }
        if (plan.clips.photodiode) out += i % 2 == 0 ? "\t1" : "\t0";
        out += "\n";
    }
    return out;
}

}  // namespace risorius::stimuli
