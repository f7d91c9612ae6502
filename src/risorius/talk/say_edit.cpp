// SPDX-License-Identifier: MIT
#include "risorius/talk/say_edit.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/output_set.h"
#include "risorius/core/read_file.h"
#include "risorius/media/mono_sound.h"
#include "risorius/speech/phone_table.h"
#include "risorius/speech/windows.h"

namespace risorius::talk {

namespace {

constexpr FileKind kOwnSound{"a sound", 1000 * kMegabyte};

std::string wav_of(const Spoken& spoken) {
    OutputSet folder(std::filesystem::temp_directory_path(), OutputSet::Then::kRunGoesOn);
    const std::filesystem::path file = folder.scratch_file("speech.wav");
    media::write_mono_wav({spoken.utterance.rate_hz, spoken.sound}, file);
    const ReadingFormerOutput own_file;
    return read_file(file, kOwnSound);
}

double rounded_up_to_ms(double s) { return std::ceil(1e3 * s - 1e-6) / 1e3; }

}  // namespace

SayEdit say_edit(const Json& script, const VoiceRequest& request, double at_s) {
    const Spoken spoken = speak(request, speech::PhoneTable::standard());
    const speech::Utterance& utterance = spoken.utterance;
    double first_s = 0;
    for (const speech::Phone& phone : utterance.phones)
        if (!phone.is_pause()) {
            first_s = utterance.seconds(std::min(phone.start, phone.closure.value_or(phone.start)));
            break;
        }
    SayEdit out;
    out.start_s = rounded_up_to_ms(std::max(at_s, at_s + speech::kLead_s - first_s));
    out.end_s =
        rounded_up_to_ms(out.start_s + utterance.seconds(utterance.samples) + speech::kTail_s);
    out.wav = wav_of(spoken);
    Json event =
        json_object({{"say", request.text}, {"voice", request.language}, {"start_s", out.start_s}});
    if (!request.program.empty()) event["program"] = request.program;
    out.edits = Json::array();
    std::size_t count = 0;
    if (script.contains("events") && script["events"].is_array()) {
        count = script["events"].size();
        for (std::size_t i = 0; i < count; ++i)
            if (const Json& one = script["events"][i]; one.is_object() && one.contains("say"))
                out.edits.push_back(json_object(
                    {{"path", "/events/" + std::to_string(i) + "/sound"}, {"value", "none"}}));
    } else {
        out.edits.push_back(json_object({{"path", "/events"}, {"value", Json::array()}}));
    }
    out.edits.push_back(
        json_object({{"path", "/events/" + std::to_string(count)}, {"value", std::move(event)}}));
    const bool known = script.contains("duration_s") && script["duration_s"].is_number();
    if (!known || script["duration_s"].get<double>() < out.end_s)
        out.edits.push_back(json_object({{"path", "/duration_s"}, {"value", out.end_s}}));
    return out;
}

}  // namespace risorius::talk
