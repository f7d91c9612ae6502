// SPDX-License-Identifier: MIT
/// \file
/// Files of what is said, as the commands about speech read and write them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "risorius/core/output_set.h"
#include "risorius/core/stand_in.h"
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

/// The files of a command about speech, which appear together. Each can be read under its name from when it is written.
class SpeechOutputs {
  public:
    explicit SpeechOutputs(const std::filesystem::path& out) : set_(folder_of_output(out)) {}

    /// The path to write a file to.
    std::filesystem::path add(const std::filesystem::path& file);
    /// Writes a text; again, when it was written before.
    void write_text(const std::filesystem::path& file, const std::string& text);
    void commit() { set_.commit(); }

  private:
    OutputSet set_;
    std::map<std::filesystem::path, std::filesystem::path> added_;
    std::map<std::filesystem::path, StandIn> stand_ins_;
};

/// Writes the utterance beside `out`, and the sound of a voice; the utterance names its sound. Returns the utterance's path.
std::filesystem::path write_utterance(talk::SpokenResult& result, const std::filesystem::path& out,
                                      SpeechOutputs& outputs);

/// Whether a file holds what is said as text, by its ending: .utterance.json, .TextGrid, .ctm, .lab, .vtt, .curves.tsv, .tsv,
/// .visemes.json.
bool is_speech_text(const std::filesystem::path& out);
void write_speech_text(talk::SpokenResult& result, const std::filesystem::path& out,
                       const speech::PhoneTable& table, SpeechOutputs& outputs);

}  // namespace risorius::cli
