// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/catalogue.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/stimuli/detail/methods.h"

namespace risorius::stimuli {

namespace {

/// The names of values of all clips, in the order of their first occurrence.
std::vector<std::string> value_names(const std::vector<Json>& records) {
    std::vector<std::string> out;
    for (const Json& record : records)
        for (const auto& [name, value] : record.at("values").items())
            if (name != "set" && std::find(out.begin(), out.end(), name) == out.end())
                out.push_back(name);
    return out;
}

bool has_sound(const std::vector<ClipPlan>& clips) {
    return std::any_of(clips.begin(), clips.end(),
                       [](const ClipPlan& clip) { return clip.sound.has_value(); });
}

/// A column of the catalogue.
struct Column {
    std::string name;
    Json description;
    std::function<Json(std::size_t clip)> cell;
};

/// The column of tags of HED 8.3.0 for what a clip shows
constexpr const char* kTags = "HED";

Json described(const char* text, const char* units = "") {
    Json out = json_object({{"Description", text}});
    if (*units) out["Units"] = units;
    return out;
}

/// A measure as the catalogue has it: six decimals.
Json rounded_json(double value) { return Json(std::round(1e6 * value) / 1e6); }

/// The columns for what is seen to move.
void add_motion(const std::vector<Json>& records, std::vector<Column>& columns) {
    const auto at_time = [&](const char* key) {
        return [&records, key](std::size_t i) {
            const Json& frame = records[i].at("motion").at(key);
            return frame.is_null()
                       ? Json()
                       : rounded_json(frame.get<double>() / records[i].at("fps").get<double>());
        };
    };
    const auto measure = [&](const char* key) {
        return [&records, key](std::size_t i) {
            const Json& value = records[i].at("motion").at(key);
            return value.is_number() ? rounded_json(value.get<double>()) : value;
        };
    };
    columns.push_back({"seen_mm",
                       described("Farthest way of a landmark of the face from where it is in the "
                                 "first frame, without head movement, blinks and idle motion",
                                 "mm"),
                       measure("seen_mm")});
    columns.push_back({"seen_landmark", described("Whose way that is"), measure("seen_landmark")});
    columns.push_back(
        {"seen_share",
         described("seen_mm / the same of this expression on this head, settled at full intensity"),
         [&records](std::size_t i) {
             const Json& motion = records[i].at("motion");
             const Json &seen = motion.at("seen_mm"), &full = motion.at("full_mm");
             return seen.is_null() || full.is_null() || !(full.get<double>() > 0)
                        ? Json()
                        : rounded_json(seen.get<double>() / full.get<double>());
         }});
    columns.push_back(
        {"full_mm", described("What seen_share is a share of", "mm"), measure("full_mm")});
    columns.push_back({"seen_onset_s",
                       described("Start of the first shown frame in which a landmark is farther "
                                 "away than 0.3 mm, or than 5 % of seen_mm if that is less",
                                 "s"),
                       at_time("seen_onset_frame")});
    columns.push_back({"seen_apex_s",
                       described("Start of the first shown frame with 99 % of seen_mm", "s"),
                       at_time("seen_apex_frame")});
    columns.push_back({"seen_offset_s",
                       described("Start of the first shown frame after the apex in which no "
                                 "landmark is farther away than at the onset",
                                 "s"),
                       at_time("seen_offset_frame")});
    columns.push_back({"velocity_peak_mm_s",
                       described("Largest rise of the way from one frame to the next", "mm/s"),
                       measure("velocity_peak_mm_s")});
    columns.push_back(
        {"pixel_onset_s",
         described("Start of the first shown frame whose pixels differ from the first "
                   "one, whatever the cause",
                   "s"),
         at_time("pixel_onset_frame")});
    columns.push_back({"head_onset_s",
                       described("Start of the first shown frame in which the head has moved by "
                                 "0.3 mm",
                                 "s"),
                       at_time("head_onset_frame")});
    columns.push_back(
        {"blink_onset_s",
         described("Start of the first shown frame in which a blink has closed a pair "
                   "of lids below 80 % of their aperture in the first frame",
                   "s"),
         at_time("blink_onset_frame")});
    columns.push_back({"gaze_onset_s",
                       described("Start of the first shown frame in which an eye has turned by 1 "
                                 "degree",
                                 "s"),
                       at_time("gaze_onset_frame")});
    columns.push_back({"commanded_onset_s",
                       described("When the script tells the first expression to begin", "s"),
                       measure("commanded_onset_s")});
    columns.push_back(
        {"commanded_apex_s",
         described("When the script tells the strongest expression to be complete", "s"),
         measure("commanded_apex_s")});
}

/// The columns of norms.
void add_norms(const BatchPlan& plan, const Norms& norms, std::vector<Column>& columns) {
    const auto of_clip = [&](std::function<Json(const Norms::OfClip&)> cell) {
        return [&plan, &norms, cell = std::move(cell)](std::size_t i) {
            const auto clip = norms.clips.find(plan.clips[i].condition.clip);
            return clip == norms.clips.end() ? Json() : cell(clip->second);
        };
    };
    const auto share = [&](double (Share::*value)() const) {
        return of_clip([value](const Norms::OfClip& clip) {
            return clip.hits.count > 0 ? rounded_json((clip.hits.*value)()) : Json();
        });
    };
    columns.push_back({"norm_ratings", described("Answers of raters"),
                       of_clip([](const Norms::OfClip& clip) { return Json(clip.ratings); })});
    columns.push_back({"norm_answer", described("The most frequent of them"),
                       of_clip([](const Norms::OfClip& clip) { return Json(clip.answer); })});
    columns.push_back({"norm_hit_rate", described("Share of right answers"), share(&Share::value)});
    columns.push_back({"norm_hit_low", described("Lower end of its interval of 95 % (Wilson)"),
                       share(&Share::low)});
    columns.push_back({"norm_hit_high", described("Upper end of its interval of 95 % (Wilson)"),
                       share(&Share::high)});
    for (const std::string& scale : design::rating_scales()) {
        const bool any = std::any_of(norms.clips.begin(), norms.clips.end(), [&](const auto& clip) {
            return clip.second.means.count(scale) > 0;
        });
        if (any)
            columns.push_back({"norm_" + scale, described("Mean rating"),
                               of_clip([scale](const Norms::OfClip& clip) {
                                   const auto mean = clip.means.find(scale);
                                   return mean == clip.means.end() ? Json()
                                                                   : rounded_json(mean->second);
                               })});
    }
}

/// The columns for what is seen to move in the halves of chimeric clips.
void add_halves(const std::vector<Json>& records, std::vector<Column>& columns) {
    for (const char* half : {"upper", "lower"}) {
        const auto measure = [&records, half](std::size_t i, const char* key) {
            const Json& motion = records[i].at("motion");
            return motion.contains(half) ? motion.at(half).at(key) : Json();
        };
        const std::string name = std::string("seen_") + half;
        columns.push_back(
            {name + "_mm",
             described("Of a chimeric clip: farthest way of a landmark of this half", "mm"),
             [measure](std::size_t i) {
                 const Json mm = measure(i, "seen_mm");
                 return mm.is_null() ? mm : rounded_json(mm.get<double>());
             }});
        columns.push_back(
            {name + "_share",
             described("That / the same of this half's own expression, of the landmarks of this "
                       "half, settled at full intensity on its head"),
             [measure](std::size_t i) {
                 const Json mm = measure(i, "seen_mm"), full = measure(i, "full_mm");
                 return mm.is_null() || full.is_null() || !(full.get<double>() > 0)
                            ? Json()
                            : rounded_json(mm.get<double>() / full.get<double>());
             }});
    }
}

/// The columns for what is said; none in a set without speech.
void add_speech(const std::vector<Json>& records, std::vector<Column>& columns) {
    if (std::none_of(records.begin(), records.end(),
                     [](const Json& one) { return one.contains("speech"); }))
        return;
    const auto of_speech = [&](const char* key) {
        return [&records, key](std::size_t i) {
            return records[i].contains("speech") ? records[i].at("speech").at(key) : Json();
        };
    };
    columns.push_back({"lip_onset_s",
                       described("When gap or opening of the lips have changed by 5 % of their "
                                 "range, between frames",
                                 "s"),
                       of_speech("lip_onset_s")});
    columns.push_back({"closure_s",
                       described("When the first stop or nasal that is seen is closed", "s"),
                       of_speech("closure_s")});
    columns.push_back({"release_s", described("When it is released", "s"), of_speech("release_s")});
    columns.push_back(
        {"burst_s",
         described("When the first stop or nasal that is heard is released in the sound", "s"),
         of_speech("burst_s")});
    columns.push_back(
        {"soa_measured_ms", described("burst_s - release_s", "ms"), of_speech("soa_ms")});
}

std::vector<Column> columns_of(const BatchPlan& plan, const std::vector<Json>& records) {
    const std::vector<ClipPlan>& clips = plan.clips;
    const auto of_record = [&](const char* key) {
        return [&records, key](std::size_t i) { return records[i].at(key); };
    };
    const auto of_control = [&](const char* key) {
        return [&records, key](std::size_t i) {
            return records[i].at("control").get<std::string>().empty() ? Json()
                                                                       : records[i].at(key);
        };
    };
    const auto same = [](const std::string& text) {
        return [text](std::size_t) { return Json(text); };
    };
    std::vector<Column> out{
        {"stimulus_id", described("Name of the clip, with the prefix of its files"),
         [&records](std::size_t i) {
             return Json("stim-" + records[i].at("stim_id").get<std::string>());
         }},
        {"type", described("Kind of the file"),
         [&clips](std::size_t i) { return Json(clip_type(clips[i])); }},
        {"filename", described("The file, in this folder or below"),
         [&clips](std::size_t i) { return Json(file_in_stimuli(clips[i])); }},
        {"license", described("Licence of the file"), same(plan.dataset.license)},
        {"copyright", described("Who holds the rights"), same(plan.dataset.copyright)},
        {"description", described("What it shows"),
         [&records](std::size_t i) {
             std::string text = "A synthetic face";
             for (const auto& [name, value] : records[i].at("values").items())
                 if (name != "set") text += ", " + name + " " + catalogue_cell(value);
             const std::string control = records[i].at("control").get<std::string>();
             return Json(text + (control.empty() ? "" : ", control " + control));
         }},
        {kTags, Json(), [&clips](std::size_t i) { return Json(hed_tags(clips[i])); }},
        {"present", described("Whether the file is in this data set"), same("true")},
        {"set", described("Set of conditions of the design"), of_record("set")},
        {"control", described("What differs from the clip it is a control of"),
         of_control("control")},
        {"control_of", described("stimulus_id of that clip"),
         [&records](std::size_t i) {
             return records[i].at("control").get<std::string>().empty()
                        ? Json()
                        : Json("stim-" + records[i].at("of").get<std::string>());
         }},
        {"frames", described("Number of frames"), of_record("frames")},
        {"fps", described("Frames per second, constant", "Hz"), of_record("fps")},
        {"duration_s", described("Frames over frame rate", "s"), of_record("duration_s")}};
    add_motion(records, out);
    out.push_back({"pictures_sha256",
                   described("Of the RGBA bytes of all frames before they were encoded"),
                   of_record("pictures_sha256")});
    const auto of_sound = [&](const char* key) {
        return [&records, key](std::size_t i) {
            return records[i].contains("audio") ? records[i].at("audio").at(key) : Json();
        };
    };
    if (has_sound(clips)) {
        out.push_back(
            {"sound_onset_s",
             described("First millisecond of the recording above a hundredth of its peak", "s"),
             of_sound("onset_s")});
        out.push_back({"loudness_lufs",
                       described("Integrated loudness of the whole recording by EBU R 128", "LUFS"),
                       of_sound("loudness_lufs")});
        out.push_back({"true_peak_dbtp",
                       described("Highest peak of the whole recording by EBU R 128", "dBTP"),
                       of_sound("true_peak_dbtp")});
    }
    add_speech(records, out);
    const bool chimeric = std::any_of(records.begin(), records.end(),
                                      [](const Json& one) { return one.contains("seam"); });
    const auto of_seam = [&](const char* key) {
        return [&records, key](std::size_t i) {
            return records[i].contains("seam")
                       ? rounded_json(records[i].at("seam").at(key).get<double>())
                       : Json();
        };
    };
    if (chimeric) {
        out.push_back({"seam_row_px",
                       described("Height of the seam of a chimeric clip, from the top", "px"),
                       of_seam("row_px")});
        out.push_back({"seam_difference",
                       described("Root mean square difference of relative luminance between the "
                                 "two faces of a chimeric clip at the seam, mean of the frames"),
                       of_seam("difference_mean")});
        add_halves(records, out);
    }
    for (const std::string& name : value_names(records))
        out.push_back({name, described("Parameter of the design, see code/design.json"),
                       [&records, name](std::size_t i) {
                           const Json& values = records[i].at("values");
                           return values.contains(name) ? values.at(name) : Json();
                       }});
    return out;
}

}  // namespace

std::string catalogue_cell(const Json& value) {
    if (value.is_null()) return kMissingCell;
    std::string text = value.is_string()   ? value.get<std::string>()
                       : value.is_number() ? format_number(value.get<double>())
                                           : json_text(value);
    for (char& c : text)
        if (c == '\t' || c == '\n' || c == '\r') c = ' ';
    return text.empty() ? kMissingCell : text;
}

Catalogue catalogue_of(const BatchPlan& plan, const std::vector<Json>& records,
                       const std::optional<Norms>& norms) {
    Catalogue out{.table = {}, .columns = Json::object()};
    std::vector<Column> columns = columns_of(plan, records);
    if (norms) add_norms(plan, *norms, columns);
    for (const Column& column : columns) {
        out.table += (out.table.empty() ? "" : "\t") + column.name;
        // BIDS forbids this key: the meaning of a column of tags is fixed.
        if (column.name != kTags) out.columns[column.name] = column.description;
    }
    out.table += "\n";
    for (std::size_t i = 0; i < records.size(); ++i) {
        for (const Column& column : columns)
            out.table += (&column == &columns.front() ? "" : "\t") + catalogue_cell(column.cell(i));
        out.table += "\n";
    }
    return out;
}

Catalogue sample_of(const BatchPlan& plan, const std::vector<Json>& records) {
    Catalogue out{.table = "trial\tstimulus_id\tunit", .columns = Json::object()};
    for (const std::string& name : design::course_parameters()) out.table += "\t" + name;
    out.table += "\tseen_mm\n";
    for (std::size_t i = 0; i < records.size(); ++i) {
        const ClipPlan& clip = plan.clips[i];
        if (clip.is_control()) continue;
        for (const design::UnitCourse& unit : clip.condition.units) {
            out.table += catalogue_cell(records[i].at("values").at("trial")) + "\tstim-" +
                         clip.condition.clip + "\t" + unit.unit;
            for (std::size_t k = 0; k < design::course_parameters().size(); ++k)
                out.table += "\t" + format_number(design::parameter(unit, k));
            const Json& seen = records[i].at("motion").at("seen_mm");
            out.table += "\t" + catalogue_cell(seen.is_null() ? seen : rounded_json(seen)) + "\n";
        }
    }
    out.columns = json_object(
        {{"trial", described("Number of the trial; heads and other factors show the same ones")},
         {"stimulus_id", described("The clip, as in stimuli/stimuli.tsv")},
         {"unit", described("An action unit that moves in it, of one side with .l or .r")},
         {"amplitude", described("Its intensity at the peak, 0 to 1")},
         {"onset_latency_s", described("When it begins", "s")},
         {"peak_latency_s", described("When it is at its peak", "s")},
         {"offset_latency_s", described("When it is back at rest, or the clip ends", "s")},
         {"acceleration", described("Exponent p of the rise: its largest speed is amplitude p / "
                                    "(peak_latency_s - onset_latency_s)")},
         {"deceleration", described("The same of the fall")},
         {"seen_mm",
          described("Farthest way of a landmark in the clip, of all units together", "mm")}});
    return out;
}

}  // namespace risorius::stimuli
