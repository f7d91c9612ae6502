// SPDX-License-Identifier: MIT
#include "tools/risorius/speech_files.h"

#include <array>

#include "risorius/core/read_file.h"
#include "risorius/core/text_lines.h"
#include "risorius/media/mono_sound.h"
#include "risorius/speech/labels.h"
#include "risorius/speech/visemes.h"

namespace risorius::cli {

namespace fs = std::filesystem;

namespace {

constexpr FileKind kText{"a text", kMegabyte};
constexpr std::size_t kLongestName = 4000;
constexpr std::string_view kUtterance = ".utterance.json";
constexpr std::string_view kVisemes = ".visemes.json";
constexpr std::array<std::string_view, 8> kEndings{kUtterance, ".TextGrid",   ".ctm", ".lab",
                                                   ".vtt",     ".curves.tsv", ".tsv", kVisemes};

std::string text_of(std::string_view ending, const speech::Utterance& utterance,
                    const speech::PhoneTable& table) {
    if (ending == ".TextGrid") return speech::textgrid_text(utterance, table);
    if (ending == ".ctm") return speech::ctm_text(utterance);
    if (ending == ".lab") return speech::htk_text(utterance);
    if (ending == ".vtt") return speech::webvtt_text(utterance);
    if (ending == kVisemes) return speech::visemes_text(utterance, table);
    if (ending == ".curves.tsv") return talk::curves_text(utterance, table);
    return speech::rhubarb_text(utterance, table);
}

}  // namespace

bool is_file_name(const std::string& text) {
    std::error_code ignored;
    return text.size() < kLongestName && fs::is_regular_file(text, ignored);
}

std::string text_or_file(const std::string& text) {
    return is_file_name(text) ? read_text(text, kText) : text;
}

fs::path beside(const fs::path& out, const std::string& ending) {
    fs::path base = out;
    if (!base.has_filename()) base = base.parent_path();
    return base.replace_extension().string() + ending;
}

fs::path seen_from(const fs::path& from, const fs::path& a) {
    return fs::absolute(a).lexically_relative(fs::current_path() / folder_of_output(from));
}

fs::path SpeechOutputs::add(const fs::path& file) {
    const auto [added, is_new] = added_.try_emplace(file);
    if (is_new) {
        added->second = set_.file(file);
        stand_ins_.try_emplace(file, file, added->second);
    }
    return added->second;
}

void SpeechOutputs::write_text(const fs::path& file, const std::string& text) {
    write_file(add(file), text);
}

fs::path write_utterance(talk::SpokenResult& result, const fs::path& out, SpeechOutputs& outputs) {
    if (!result.spoken.sound.empty() && result.sound_file.empty()) {
        const fs::path wav = beside(out, ".wav");
        media::write_mono_wav({result.spoken.utterance.rate_hz, result.spoken.sound},
                              outputs.add(wav));
        result.sound_file = wav;
    }
    if (!result.sound_file.empty())
        result.spoken.utterance.sound = seen_from(out, result.sound_file);
    const fs::path file = beside(out, std::string(kUtterance));
    outputs.write_text(file, speech::utterance_text(result.spoken.utterance));
    return file;
}

bool is_speech_text(const fs::path& out) {
    for (const std::string_view ending : kEndings)
        if (out.string().ends_with(ending)) return true;
    return false;
}

void write_speech_text(talk::SpokenResult& result, const fs::path& out,
                       const speech::PhoneTable& table, SpeechOutputs& outputs) {
    const std::string name = out.string();
    if (name.ends_with(kUtterance)) {
        write_utterance(result, fs::path(name.substr(0, name.size() - kUtterance.size()) + ".x"),
                        outputs);
        return;
    }
    for (const std::string_view ending : kEndings)
        if (name.ends_with(ending))
            return outputs.write_text(out, text_of(ending, result.spoken.utterance, table));
}

}  // namespace risorius::cli
