// SPDX-License-Identifier: MIT
// risorius speak TEXT -o OUT
#include <cstdio>
#include <filesystem>

#include "risorius/core/output_set.h"
#include "risorius/core/text_lines.h"
#include "risorius/media/mono_sound.h"
#include "risorius/speech/phone_table.h"
#include "risorius/talk/spoken_input.h"
#include "risorius/talk/voice.h"
#include "tools/risorius/commands.h"

namespace risorius::cli {

namespace {

namespace fs = std::filesystem;

constexpr FileKind kText{"a text", kMegabyte};

struct SpeakArguments {
    Common common;
    talk::SpokenInput input;
    std::string said;
    fs::path out;
};

/// "out/hello.utterance.json" and the like, for "out/hello.mp4".
fs::path beside(const fs::path& out, const std::string& ending) {
    fs::path base = out;
    if (!base.has_filename()) base = base.parent_path();
    return base.replace_extension().string() + ending;
}

/// TEXT is what to say, a file of text, or an utterance.
void read_said(SpeakArguments& arguments) {
    if (arguments.said.empty()) return;
    const fs::path file = arguments.said;
    std::error_code ignored;
    if (arguments.said.size() < 4000 && fs::is_regular_file(file, ignored)) {
        if (file.extension() == ".json")
            arguments.input.utterance = file;
        else
            arguments.input.voice.text = read_text(file, kText);
        return;
    }
    arguments.input.voice.text = arguments.said;
}

bool ends_with(const fs::path& file, std::string_view ending) {
    return file.string().ends_with(ending);
}

/// The text of an output that holds no pictures; empty for others.
std::string text_output(const fs::path& out, const speech::Utterance& utterance,
                        const speech::PhoneTable& table) {
    if (ends_with(out, ".utterance.json")) return speech::utterance_text(utterance);
    if (ends_with(out, ".TextGrid")) return speech::textgrid_text(utterance, table);
    if (ends_with(out, ".ctm")) return speech::ctm_text(utterance);
    if (ends_with(out, ".vtt")) return speech::webvtt_text(utterance);
    if (ends_with(out, ".curves.tsv")) return talk::curves_text(utterance, table);
    if (ends_with(out, ".tsv")) return speech::rhubarb_text(utterance, table);
    return "";
}

/// Writes the utterance and the sound of a voice; the utterance names its sound.
void write_speech(talk::SpokenResult& result, const fs::path& out, OutputSet& outputs) {
    if (!result.spoken.sound.empty() && result.sound_file.empty()) {
        const fs::path wav = beside(out, ".wav");
        media::write_mono_wav({result.spoken.utterance.rate_hz, result.spoken.sound},
                              outputs.file(wav));
        result.sound_file = wav;
        result.spoken.utterance.sound = wav.filename();
    } else if (!result.sound_file.empty()) {
        result.spoken.utterance.sound =
            fs::absolute(result.sound_file).lexically_relative(fs::absolute(folder_of_output(out)));
    }
}

void run_speak(SpeakArguments& arguments) {
    read_said(arguments);
    const speech::PhoneTable table = speech::PhoneTable::standard();
    talk::SpokenResult result = talk::read_spoken(arguments.input, table);
    OutputSet outputs(folder_of_output(arguments.out));
    if (ends_with(arguments.out, ".utterance.json")) write_speech(result, arguments.out, outputs);
    const std::string text = text_output(arguments.out, result.spoken.utterance, table);
    if (text.empty())
        throw Error(arguments.out.string(),
                    "an ending of .utterance.json, .TextGrid, .ctm, .vtt, .tsv or .curves.tsv",
                    in_quotes(arguments.out.extension().string()));
    write_file(outputs.file(arguments.out), text);
    outputs.commit();
    if (arguments.common.quiet) return;
    const speech::Utterance& utterance = result.spoken.utterance;
    std::printf("%s: %zu phones, %zu words, %.3f s\n", arguments.out.string().c_str(),
                utterance.phones.size(), utterance.words.size(),
                utterance.seconds(utterance.samples));
}

}  // namespace

void add_speak(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("speak", "Let a face say a text, or what the labels of a recording say");
    auto arguments = std::make_shared<SpeakArguments>();
    talk::SpokenInput& input = arguments->input;
    command->add_option("TEXT", arguments->said,
                        "What to say: a text, a text file, or a file of format risorius-utterance");
    command
        ->add_option("-o,--out", arguments->out,
                     "The file to write, by its ending. .utterance.json: phones in samples, with "
                     "the sound beside it; .TextGrid, .ctm, .vtt: labels; .tsv: mouth shapes of "
                     "Rhubarb; .curves.tsv: curves of jaw, lips and tongue")
        ->required();
    command
        ->add_option("--voice", input.voice.language,
                     "Language of the voice, such as fi, en-us, cs")
        ->capture_default_str();
    command->add_option("--program", input.voice.program,
                        "Synthesiser, a name of rigs/standard/voices.json. Default: the first one");
    command->add_option("--rate", input.voice.rate, "Speed of speech, 0.3 to 3")
        ->capture_default_str();
    command->add_option("--pitch", input.voice.pitch, "Pitch of the voice, 0 to 99")
        ->capture_default_str();
    command->add_option("--phones", input.voice.phones,
                        "Phones instead of a text, as the synthesiser spells them");
    command->add_option("--labels", input.labels,
                        "A file of labels: TextGrid, CTM, .lab, .pho and others");
    command->add_option("--label-format", input.label_format,
                        "Format of the labels, if their file does not tell");
    command->add_option("--tier", input.label_options.phones_tier,
                        "Tier of the labels with the phones. Default: phones, phone, MAU, visemes");
    command->add_option("--symbols", input.label_options.symbols,
                        "How the labels spell phones: ipa, espeak, arpabet, xsampa, finnish");
    command->add_option("--audio", input.audio, "The recording of the labels: WAV or FLAC");
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius speak \"Good morning.\" --voice en-us -o out/morning.TextGrid\n"
        "  risorius speak --labels anna.TextGrid --audio anna.wav -o out/anna.utterance.json");
    command->callback([arguments] { run_speak(*arguments); });
}

}  // namespace risorius::cli
