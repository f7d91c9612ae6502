// SPDX-License-Identifier: MIT
/// \file
/// Files of what is said, as the commands about speech read and write them.
#pragma once

#include <filesystem>
#include <string>

#include "risorius/talk/spoken_input.h"

namespace risorius::cli {

/// Whether a text of the command line is the name of a file.
bool is_file_name(const std::string& text);
/// The text, or what the file of this name holds.
std::string text_or_file(const std::string& text);

/// "out/hello.script.json" and the like, for "out/hello.mp4".
std::filesystem::path beside(const std::filesystem::path& out, const std::string& ending);
/// "a" as seen from the folder of `from`.
std::filesystem::path seen_from(const std::filesystem::path& from, const std::filesystem::path& a);

void write_text(const std::filesystem::path& file, const std::string& text);
/// Writes the utterance beside `out`, and the sound of a voice; the utterance names its sound. Returns the utterance's path.
std::filesystem::path write_utterance(talk::SpokenResult& result, const std::filesystem::path& out);

/// Whether a file holds what is said as text, by its ending: .utterance.json, .TextGrid, .ctm, .lab, .vtt, .curves.tsv, .tsv,
/// .visemes.json.
bool is_speech_text(const std::filesystem::path& out);
void write_speech_text(talk::SpokenResult& result, const std::filesystem::path& out,
                       const speech::PhoneTable& table);

}  // namespace risorius::cli
