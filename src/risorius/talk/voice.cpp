// SPDX-License-Identifier: MIT
#include "risorius/talk/voice.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/input_log.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/read_file.h"
#include "risorius/media/mono_sound.h"
#include "risorius/report/run_program.h"
#include "risorius/speech/landmarks.h"
#include "risorius/talk/detail/voice_table.h"

namespace risorius::talk {

namespace fs = std::filesystem;

namespace {

constexpr FileKind kVoiceTable{"the table of a voice", 100 * kMegabyte};
// What run_program() returns when there is no such program, and what a voice does when its synthesiser is missing
constexpr int kNoProgram = 127, kNotInstalled = 3;
constexpr int kMinWords = 40, kMaxWords = 450;

struct VoiceProgram {
    std::string name, program, needs;
    VoiceSymbols symbols;
    speech::StopMark stops = speech::StopMark::kBurst;
    double words_per_minute = 150;
    double late_s = 0;
};

/// "fi" of "fi-FI"
std::string base_of(const std::string& language) { return language.substr(0, language.find('-')); }

/// The voices of voices.json that speak a language, or the one that is named.
std::vector<VoiceProgram> voices_for(const std::string& name, const std::string& language) {
    const JsonCursor json = JsonCursor::read_file(data_folder() / "rigs/standard/voices.json");
    json.allow_keys({"source", "voices"});
    std::vector<VoiceProgram> out;
    std::string listed;
    for (const JsonCursor& voice : json.at("voices").items()) {
        voice.allow_keys({"name", "program", "symbols", "stops", "needs", "words_per_minute",
                          "replace", "languages", "late_ms"});
        VoiceProgram one;
        one.name = voice.at("name").string();
        listed += " " + in_quotes(one.name);
        if (!name.empty() && one.name != name) continue;
        bool speaks = !voice.has("languages");
        if (!speaks)
            for (const JsonCursor& item : voice.at("languages").items())
                speaks = speaks || item.string() == base_of(language);
        if (!speaks && !name.empty())
            throw Error(option_name("voice"), "a language of the voice " + in_quotes(name),
                        in_quotes(language));
        if (!speaks) continue;
        one.program = voice.at("program").string();
        one.needs = voice.at("needs").string();
        one.symbols.set = voice.at("symbols").string();
        one.stops = voice.at("stops").one_of({"burst", "closure"}) == "burst"
                        ? speech::StopMark::kBurst
                        : speech::StopMark::kClosure;
        if (const auto late = voice.find("late_ms")) one.late_s = 1e-3 * late->number({0, 50});
        const JsonCursor rates = voice.at("words_per_minute");
        for (const std::string& key : {std::string(), base_of(language), language})
            if (const auto rate = rates.find(key)) one.words_per_minute = rate->number({20, 450});
        if (const auto replace = voice.at("replace").find(base_of(language)))
            for (const std::string& symbol : replace->keys())
                one.symbols.replace[symbol] = replace->at(symbol).string();
        out.push_back(std::move(one));
    }
    if (out.empty())
        throw Error(option_name("program"), "a voice of rigs/standard/voices.json, one of" + listed,
                    in_quotes(name));
    return out;
}

/// Beside this program, where an installation has it, or in PATH.
std::string path_of(const std::string& program) {
    for (const fs::path& folder :
         {code_folder(), code_folder().parent_path(), code_folder() / "../libexec/risorius"}) {
        std::error_code ignored;
        if (fs::exists(folder / program, ignored)) return (folder / program).string();
    }
    return program;
}

/// A word begins and ends with its phones, whose borders the landmarks have moved.
void snap(std::vector<speech::Span>& spans, const std::vector<speech::Phone>& phones) {
    for (speech::Span& span : spans)
        for (std::int64_t* at : {&span.start, &span.end}) {
            std::int64_t best = *at;
            std::int64_t apart = -1;
            for (const speech::Phone& phone : phones) {
                const std::int64_t border = at == &span.start ? phone.start : phone.end;
                if (at == &span.start && phone.is_pause()) continue;
                if (at == &span.end && phone.is_pause()) continue;
                const std::int64_t distance = std::abs(border - *at);
                if (apart >= 0 && distance >= apart) continue;
                apart = distance;
                best = border;
            }
            *at = best;
        }
    std::erase_if(spans, [](const speech::Span& span) { return span.end <= span.start; });
    for (std::size_t i = 1; i < spans.size(); ++i)
        spans[i].start = std::max(spans[i].start, spans[i - 1].end);
    std::erase_if(spans, [](const speech::Span& span) { return span.end <= span.start; });
}

}  // namespace

Spoken speak(const VoiceRequest& request, const speech::PhoneTable& table) {
    if (!(request.rate >= 0.3 && request.rate <= 3))
        throw Error(option_name("rate"), "a number in [0.3, 3]", format_number(request.rate));
    if (request.pitch < 0 || request.pitch > 99)
        throw Error(option_name("pitch"), "an integer in [0, 99]", std::to_string(request.pitch));
    if (request.text.empty() == request.phones.empty())
        throw Error(option_name("text"), "a text or phones",
                    request.text.empty() ? "none" : "both");
    OutputSet folder(fs::temp_directory_path(), OutputSet::Then::kRunGoesOn);
    const fs::path request_file = folder.scratch_file("request.json"),
                   wav = folder.scratch_file("voice.wav"), tsv = folder.scratch_file("voice.tsv");
    const std::vector<VoiceProgram> voices = voices_for(request.program, request.language);
    std::string needs;
    const VoiceProgram* spoke = nullptr;
    for (const VoiceProgram& voice : voices) {
        // Mnemonics are those of a program: never those of another one.
        if (!request.phones.empty() && voice.symbols.set != "espeak") continue;
        const int words = std::clamp(static_cast<int>(voice.words_per_minute * request.rate + 0.5),
                                     kMinWords, kMaxWords);
        Json json = json_object({{"language", request.language},
                                 {"words_per_minute", words},
                                 {"pitch", request.pitch}});
        json[request.phones.empty() ? "text" : "phones"] =
            request.phones.empty() ? request.text : request.phones;
        write_file(request_file, json_text(json));
        const report::ProgramResult result = report::run_program(
            {path_of(voice.program), request_file.string(), wav.string(), tsv.string()});
        if (result.exit_code == kNoProgram || result.exit_code == kNotInstalled) {
            needs += (needs.empty() ? "" : ", or the program ") + voice.program + ", which needs " +
                     voice.needs;
            continue;
        }
        if (result.exit_code != 0)
            throw Error(option_name("voice"), "a request that " + voice.program + " can speak",
                        readable_text(result.output.substr(0, result.output.find('\n'))));
        spoke = &voice;
        break;
    }
    if (!spoke)
        throw Error(option_name("voice"),
                    needs.empty() ? "a voice that speaks phones" : "the program " + needs,
                    "none on this machine (label files and utterances need none)");
    const VoiceProgram& voice = *spoke;
    // The files are gone soon, and other ones may get their numbers.
    const ReadingFormerOutput own_files;
    const media::MonoSound sound = media::read_mono_sound(wav);
    Spoken out;
    out.utterance = utterance_of_voice(
        parse_voice_table(read_file(tsv, kVoiceTable), voice.program), request.text, voice.symbols,
        sound.rate_hz, static_cast<std::int64_t>(sound.samples.size()), table);
    out.utterance.language = request.language;
    speech::find_landmarks(out.utterance, sound.samples, table, voice.stops);
    snap(out.utterance.words, out.utterance.phones);
    snap(out.utterance.sentences, out.utterance.phones);
    out.sound = sound.samples;
    out.late_s = voice.late_s;
    return out;
}

}  // namespace risorius::talk
