// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/methods.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "risorius/core/json_text.h"
#include "risorius/core/version.h"
#include "risorius/media/tone.h"
#include "risorius/stimuli/detail/catalogue.h"
#include "risorius/stimuli/detail/methods_sources.h"
#include "risorius/stimuli/detail/unmatched_render.h"

namespace risorius::stimuli {

namespace {

using design::ControlKind;

constexpr std::size_t kMostLevels = 12;

std::string number(double value, int decimals) {
    const double unit = std::pow(10.0, decimals);
    return format_number(std::round(unit * value) / unit);
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string joined(const std::vector<std::string>& words) {
    std::string out;
    for (std::size_t i = 0; i < words.size(); ++i)
        out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    return out;
}

/// "0.5", or "0.5 to 0.7 (mean 0.61)".
std::string range_of(const std::vector<double>& values, int decimals) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const std::string least = number(*low, decimals), most = number(*high, decimals);
    if (least == most) return least;
    double sum = 0;
    for (const double value : values) sum += value;
    return least + " to " + most + " (mean " +
           number(sum / static_cast<double>(values.size()), decimals) + ")";
}

/// A measure of what is seen to move, of all conditions that have it. Frames become seconds.
std::vector<double> seen(const std::vector<Json>& records, const char* key, bool in_frames) {
    std::vector<double> out;
    for (const Json& record : records) {
        const Json& motion = record.at("motion");
        if (!record.at("control").get<std::string>().empty() || !motion.contains(key) ||
            motion.at(key).is_null())
            continue;
        out.push_back(motion.at(key).get<double>() /
                      (in_frames ? record.at("fps").get<double>() : 1));
    }
    return out;
}

/// GCC says its version alone.
std::string compiler() {
    const std::string version = __VERSION__;
    return version.find_first_of("0123456789") == 0 ? "GCC " + version : version;
}

std::string clips_text(const BatchPlan& plan, const std::vector<Json>& records) {
    std::size_t conditions = 0;
    std::set<std::string> heads, sizes;
    std::vector<double> seconds;
    std::set<int> rates;
    for (const ClipPlan& clip : plan.clips) {
        conditions += clip.is_control() ? 0 : 1;
        heads.insert(clip.condition.script.value("rig", ""));
        sizes.insert(std::to_string(clip.width_px) + " x " + std::to_string(clip.height_px));
        rates.insert(clip.fps);
        seconds.push_back(clip.duration_s());
    }
    std::vector<std::string> rate_words;
    for (const int rate : rates) rate_words.push_back(std::to_string(rate));
    const ClipPlan& first = plan.clips.front();
    const bool pictures = first.clips.pictures();
    std::string out = "The stimuli were " +
                      (pictures ? counted(plan.clips.size(), "picture", "pictures")
                                : counted(plan.clips.size(), "video clip", "video clips")) +
                      " (" + counted(conditions, "condition", "conditions") + ", " +
                      counted(plan.clips.size() - conditions, "control", "controls") + ") of " +
                      counted(heads.size(), "synthetic head", "synthetic heads") +
                      " [sex and age of the heads]. No person is shown. The faces were simulated "
                      "and rendered by Risorius " +
                      std::string(kVersion) + " (compiled with " + compiler() +
                      "): muscles move a soft skin over a skull in steps of 1/" +
                      number(1 / records.front().at("run").value("step_s", 1.0 / 60), 0) + " s. ";
    const std::string size = joined({sizes.begin(), sizes.end()}) + " pixels";
    if (pictures)
        out += "The pictures had " + size +
               ", were stored as png without loss, and show the face " +
               (first.clips.still_s ? format_number(*first.clips.still_s) + " s after the start"
                                    : std::string("at the apex")) +
               " of a simulated movement. An experiment shows each for " + range_of(seconds, 3) +
               " s.";
    else
        out +=
            "The clips had " + size + " at " + joined(rate_words) + " frames per second, lasted " +
            range_of(seconds, 3) + " s, and were stored as " + first.clips.ending +
            (first.clips.lossless || first.clips.ending == "mkv" ? " without loss" : "") +
            (first.clips.crf ? " with a constant rate factor of " + std::to_string(*first.clips.crf)
                             : "") +
            ".";
    out += " The same design gives the same bytes.\n";
    return out;
}

/// The areas that are told for eye tracking.
std::string aois_text(const design::ClipOptions& clips) {
    if (clips.aois.empty()) return {};
    return "Areas of interest (" + joined(clips.aois) +
           ") followed landmarks of the face in every frame, and were grown by " +
           number(100 * clips.aoi_margin, 1) + " % of the width of the face.\n";
}

/// The levels of every value that varies.
std::string factors_text(const BatchPlan& plan) {
    std::vector<std::string> names;
    std::map<std::string, std::vector<std::string>> levels;
    for (const ClipPlan& clip : plan.clips) {
        if (clip.is_control()) continue;
        for (const auto& [name, value] : clip.condition.values) {
            if (name == "set" || name == "trial") continue;
            std::vector<std::string>& known = levels[name];
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
            const std::string text = catalogue_cell(value);
            if (std::find(known.begin(), known.end(), text) == known.end()) known.push_back(text);
        }
    }
    std::string out;
    for (const std::string& name : names) {
        const std::vector<std::string>& of = levels.at(name);
        if (of.size() < 2) continue;
        out += "- `" + name + "`: " +
               (of.size() <= kMostLevels ? joined(of) : std::to_string(of.size()) + " values") +
               "\n";
    }
    for (const auto& [set, sample] : plan.samples)
        out += "- random facial movements (" + set + "): " + sample.text() + "\n";
    return out.empty() ? out : "What varied:\n\n" + out;
}

/// What match/motion has made equal.
std::string matched_motion_text(const BatchPlan& plan) {
    if (!plan.match.motion) return {};
    const design::MotionMatch& motion = *plan.match.motion;
    std::string out;
    if (!motion.share.empty()) {
        std::vector<std::string> shares;
        for (const JsonCursor& share : motion.share) shares.push_back(catalogue_cell(share.json()));
        out += "`" + motion.of +
               "` was searched for each head and expression, so that what is seen is " +
               joined(shares) + " of what full intensity shows. ";
    }
    if (motion.apex_s)
        out += "`" + motion.apex_of + "` was searched so that every movement is at its apex at " +
               format_number(*motion.apex_s) + " s. ";
    return out;
}

std::string motion_text(const BatchPlan& plan, const std::vector<Json>& records) {
    const std::vector<double> onset = seen(records, "seen_onset_frame", true),
                              mm = seen(records, "seen_mm", false);
    if (mm.empty()) return {};
    std::string out =
        "Movement was measured on landmarks of the shown frames, without head movement, blinks and "
        "idle motion. ";
    if (!onset.empty())
        out += "It was seen to begin at " + range_of(onset, 3) +
               " s (a landmark 0.3 mm, or 5 % of its way, from where it was) and to be at its apex "
               "at " +
               range_of(seen(records, "seen_apex_frame", true), 3) + " s";
    if (const auto offset = seen(records, "seen_offset_frame", true); !offset.empty())
        out += ", and had ended at " + range_of(offset, 3) + " s";
    if (!onset.empty()) out += ". ";
    out += matched_motion_text(plan) + "The farthest landmark moved by " + range_of(mm, 1) + " mm";
    std::vector<double> shares;
    for (const Json& record : records) {
        const Json& motion = record.at("motion");
        if (record.at("control").get<std::string>().empty() && !motion.at("full_mm").is_null() &&
            motion.at("full_mm").get<double>() > 0 && !motion.at("seen_mm").is_null())
            shares.push_back(motion.at("seen_mm").get<double>() /
                             motion.at("full_mm").get<double>());
    }
    if (!shares.empty())
        out += ", which is " + range_of(shares, 2) +
               " of its way in the same expression at full intensity on the same head";
    return out + ".\n";
}

std::string luminance_part(const BatchPlan& plan, const std::vector<Json>& records) {
    if (!plan.match.luminance) return "Luminance was not matched.\n";
    const design::LuminanceMatch& match = *plan.match.luminance;
    media::LuminanceSums before, after;
    double cut = 0;
    std::vector<double> histogram_errors;
    for (const Json& record : records) {
        if (!record.at("control").get<std::string>().empty()) continue;
        const Json& luminance = record.at("luminance");
        if (match.has_maps())
            histogram_errors.push_back(100 * luminance.at("histogram_error").get<double>());
        before.add(sums_of(luminance.at("before")));
        after.add(sums_of(luminance.at("after")));
        cut = std::max(cut, luminance.at("cut_off").get<double>());
    }
    const auto one_for = match.one_for;
    std::string out = "Luminance was measured in linear light (0 black, 1 white) ";
    out += match.within_face ? "within the oval of the face with a soft rim" : "of the whole head";
    out += ", and matched by one map for ";
    out += one_for == design::LuminanceMatch::OneFor::kAll        ? "all clips"
           : one_for == design::LuminanceMatch::OneFor::kIdentity ? "each head and view"
                                                                  : "each clip and its controls";
    out += ". Its mean was " + number(before.mean(), 3) + " before and " + number(after.mean(), 3) +
           " after, its standard deviation " + number(before.sd(), 3) + " before and " +
           number(after.sd(), 3) + " after";
    if (!match.has_maps())
        out += "; at most " + number(100 * cut, 2) + " % of the values of a clip were cut off";
    out += ". The background stayed as it was.";
    if (match.has_maps()) {
        out += match.spectrum
                   ? " The histogram of luminance and the amplitude at each spatial frequency were"
                   : " The histogram of luminance was";
        out +=
            " made the same for all of them (as in Willenbockel et al., 2010, here within a soft "
            "oval)";
        if (match.spectrum) out += ", in " + std::to_string(match.rounds) + " rounds";
        out += "; before coding, the histogram of a clip missed it by " +
               range_of(histogram_errors, 2) + " % of the standard deviation.";
    }
    if (match.grey) out += " The faces were shown in grey.";
    return out + "\n";
}

std::string sound_text(const std::vector<Json>& records) {
    std::vector<double> loudness;
    for (const Json& record : records)
        if (record.contains("audio") && record.at("audio").at("loudness_lufs").is_number())
            loudness.push_back(record.at("audio").at("loudness_lufs").get<double>());
    if (loudness.empty()) return {};
    return counted(loudness.size(), "clip", "clips") + " had sound, with a loudness of " +
           range_of(loudness, 1) + " LUFS (EBU R 128) [level at the ear].\n";
}

std::string codes_text(const BatchPlan& plan) {
    std::string out =
        plan.codes.table.empty() ? "1 clip on" : "10 to 250 clip on, as codes.tsv has them";
    out += plan.clips.front().clips.pictures() ? ", 4 clip off"
                                               : ", 2 movement onset, 3 apex, 4 clip off";
    if (std::any_of(plan.clips.begin(), plan.clips.end(),
                    [](const ClipPlan& clip) { return clip.sound.has_value(); }))
        out += ", 5 sound onset";
    if (plan.triggers.response) out += ", 6 response";
    if (plan.experiment->catch_share > 0) out += ", 253 red dot of a catch trial";
    if (!plan.triggers.wait_for.empty()) out += ", 255 pulse of the scanner that begins the run";
    return out;
}

std::string experiment_text(const BatchPlan& plan) {
    if (!plan.experiment) return {};
    const design::ExperimentOptions& experiment = *plan.experiment;
    std::vector<std::string> answers;
    for (const auto& [key, answer] : experiment.answers)
        answers.push_back("\"" + answer + "\" (" + key + ")");
    std::string course = course_text(plan);
    if (experiment.blocks > 1) course += ", in " + std::to_string(experiment.blocks) + " blocks";
    if (experiment.practice > 0)
        course += ", after " + counted(experiment.practice, "practice trial", "practice trials");
    if (experiment.catch_share > 0)
        course += ", with " + format_number(100 * experiment.catch_share) + " % of catch trials";
    return course + ". A fixation cross of " + format_number(experiment.fixation_s) +
           " s came before each. The question was \"" + experiment.question +
           "\", and the answers were " + joined(answers) +
           ". Codes of moments lasted whole refreshes of the screen, " +
           format_number(plan.triggers.pulse_ms) + " ms at least: " + codes_text(plan) + ".\n";
}

}  // namespace

std::string methods_text(const BatchPlan& plan, const std::vector<Json>& records) {
    std::string out =
        "# Methods\n\nWritten from what was made. What only you know stands in "
        "[square brackets]; numbers of each clip are in stimuli/stimuli.tsv.\n\n"
        "[Participants: number, age, sex. Ethics approval and consent.]\n\n"
        "## Stimuli\n\n";
    for (const std::string& part :
         {clips_text(plan, records), factors_text(plan), motion_text(plan, records),
          luminance_part(plan, records), controls_text(plan), aois_text(plan.clips.front().clips),
          sound_text(records)})
        if (!part.empty()) out += part + "\n";
    if (plan.experiment) out += "## Procedure\n\n" + experiment_text(plan) + "\n";
    out +=
        "[Screen: model, size, distance, refresh rate, luminance of white, calibration.]\n\n"
        "## References\n\n```bibtex\n@software{risorius, title = {Risorius}, version = {" +
        std::string(kVersion) + "}, note = {Simulated faces as stimuli}}\n";
    return out + sources_text(plan) + "```\n";
}

std::string hed_tags(const ClipPlan& plan) {
    static const std::map<std::string, std::string> kStates{{"happiness", "Happy"},
                                                            {"fear", "Fearful"},
                                                            {"anger", "Angry"},
                                                            {"sadness", "Sad"},
                                                            {"disgust", "Disgusted"},
                                                            {"surprise", "Label/Surprise"},
                                                            {"contempt", "Label/Contempt"}};
    const design::Control& control = plan.condition.control;
    std::string out = "Sensory-event, Experimental-stimulus, Visual-presentation, ";
    if (plan.sound) out += "Auditory-presentation, ";
    const bool picture = plan.clips.pictures();
    const std::string clip = picture ? "Image" : plan.sound ? "Audiovisual-clip" : "Video-clip";
    if (control.kind == ControlKind::kMondrian || control.kind == ControlKind::kPhaseScrambled)
        return out + (picture ? clip : "(" + clip + ", Animation)");
    std::string face = "Face";
    if (control.kind == ControlKind::kNeutral) {
        face += ", Emotionally-neutral";
    } else if (plan.condition.script.contains("events")) {
        std::set<std::string> tags;
        for (const Json& event : plan.condition.script.at("events"))
            if (event.contains("expression") && event.at("expression").is_string()) {
                const auto state = kStates.find(event.at("expression").get<std::string>());
                if (state != kStates.end()) tags.insert(state->second);
            }
        for (const std::string& tag : tags) face += ", " + tag;
    }
    return out + "(" + clip + (picture ? ", (" + face + "))" : ", (Animation, (" + face + ")))");
}

}  // namespace risorius::stimuli
