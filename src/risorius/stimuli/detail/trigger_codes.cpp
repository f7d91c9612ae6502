// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/trigger_codes.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/stimuli/detail/catalogue.h"

namespace risorius::stimuli {

namespace {

constexpr int kFirstCode = 10, kLastCode = 250;

/// The value of a parameter of a clip; null when it has none.
Json value_of(const design::Condition& condition, const std::string& name) {
    if (name == "stim_id") return condition.clip;
    if (name == "control") return condition.control.name();
    for (const auto& [key, value] : condition.values)
        if (key == name) return value;
    return {};
}

}  // namespace

CodesOfClips codes_of_clips(const std::vector<ClipPlan>& clips, const design::Design& design) {
    CodesOfClips out;
    if (design.triggers.code_by.empty()) return out;
    const std::string place = design.file.string() + ":/triggers";
    out.table = "code";
    for (const std::string& name : design.triggers.code_by) {
        out.table += "\t" + name;
        bool known = false;
        for (const ClipPlan& clip : clips)
            known = known || !value_of(clip.condition, name).is_null();
        if (!known)
            throw Error(place + "/code_by", "names of parameters, or \"control\"",
                        "\"" + name + "\"");
    }
    out.table += "\n";
    std::map<std::string, int> code_of_values;
    for (const ClipPlan& clip : clips) {
        std::string values;
        for (const std::string& name : design.triggers.code_by) {
            const Json value = value_of(clip.condition, name);
            const std::string text = value.is_string() ? value.get<std::string>()
                                     : value.is_null() ? ""
                                                       : json_text(value);
            values += "\t" + (text.empty() ? kMissingCell : text);
        }
        const int next = kFirstCode + static_cast<int>(code_of_values.size());
        const auto [known, is_new] = code_of_values.emplace(values, next);
        if (is_new && next > kLastCode)
            throw Error(place,
                        std::to_string(kLastCode - kFirstCode + 1) +
                            " codes at most; \"code_by\" names the parameters that they tell",
                        "more");
        if (is_new) out.table += std::to_string(next) + values + "\n";
        out.code_of[clip.condition.clip] = known->second;
    }
    return out;
}

std::vector<Trigger> triggers_of(const Json& record, const CodesOfClips& codes) {
    std::vector<Trigger> out;
    const double fps = record.at("fps").get<double>();
    const int frames = record.at("frames").get<int>();
    std::map<int, std::string> taken;
    const auto add = [&](const char* event, int code, const Json& at) {
        if (at.is_null()) return;
        const int frame = at.get<int>();
        // A picture is one frame that is shown for longer.
        const double time_s = frame == frames ? record.at("duration_s").get<double>() : frame / fps;
        const auto [first, is_new] = taken.emplace(frame, event);
        out.push_back({event, code, frame, time_s, is_new ? "" : first->second});
    };
    const auto own = codes.code_of.find(record.at("stim_id").get<std::string>());
    add("clip_on", own == codes.code_of.end() ? 1 : own->second, 0);
    if (record.contains("audio") && !record.at("audio").value("onset_s", Json()).is_null())
        if (const int frame =
                static_cast<int>(std::lround(record.at("audio").at("onset_s").get<double>() * fps));
            frame >= 0 && frame < frames)
            add("sound_onset", 5, frame);
    add("movement_onset", 2, record.at("movement_onset_frame"));
    add("apex", 3, record.at("apex_frame"));
    add("clip_off", 4, record.at("frames"));
    return out;
}

std::string triggers(const std::vector<Json>& records, const CodesOfClips& codes) {
    std::string out = "stim_id\tevent\tcode\tframe\ttime_s\tmerged_into\n";
    for (const Json& one : records)
        for (const Trigger& trigger : triggers_of(one, codes))
            out += one.at("stim_id").get<std::string>() + "\t" + trigger.event + "\t" +
                   std::to_string(trigger.code) + "\t" + std::to_string(trigger.frame) + "\t" +
                   format_number(trigger.time_s) + "\t" +
                   (trigger.merged_into.empty() ? kMissingCell : trigger.merged_into) + "\n";
    return out;
}

}  // namespace risorius::stimuli
