// SPDX-License-Identifier: MIT
// risorius align RECORDING --text TEXT -o OUT
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/talk/recording.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/speech_files.h"

namespace risorius::cli {

namespace {

namespace fs = std::filesystem;

struct AlignArguments {
    Common common;
    talk::VoiceRequest voice;
    std::string text;
    fs::path recording, out, report;
};

Json summary_json(const talk::AlignedRecording& aligned) {
    const speech::Utterance& utterance = aligned.alignment.utterance;
    Json out = json_object({{"phones", utterance.phones.size()},
                            {"words", utterance.words.size()},
                            {"pauses", aligned.alignment.pauses},
                            {"rate", aligned.rate},
                            {"misfit", aligned.alignment.misfit},
                            {"doubtful", Json::array()}});
    for (std::size_t i = 0; i < utterance.words.size(); ++i)
        if (aligned.alignment.words[i].doubtful())
            out["doubtful"].push_back(
                json_object({{"word", utterance.words[i].text},
                             {"start_s", utterance.seconds(utterance.words[i].start)},
                             {"misfit", aligned.alignment.words[i].misfit}}));
    return out;
}

void run_align(AlignArguments& arguments) {
    if (!is_speech_text(arguments.out))
        throw Error(option_name("out"),
                    "a file that ends in .TextGrid, .utterance.json, .ctm, .lab, .vtt, .tsv or "
                    ".curves.tsv",
                    in_quotes(arguments.out.string()));
    if (!arguments.text.empty()) arguments.voice.text = text_or_file(arguments.text);
    const speech::PhoneTable table = speech::PhoneTable::standard();
    talk::AlignedRecording aligned =
        talk::align_recording(arguments.recording, arguments.voice, table);
    const speech::Alignment& alignment = aligned.alignment;
    talk::SpokenResult result;
    result.spoken.utterance = alignment.utterance;
    result.sound_file = arguments.recording;
    SpeechOutputs outputs(arguments.out);
    write_speech_text(result, arguments.out, table, outputs);
    std::optional<SpeechOutputs> report;  // it may be in another folder
    if (!arguments.report.empty()) {
        report.emplace(arguments.report);
        report->write_text(arguments.report, talk::alignment_report(alignment));
    }
    outputs.commit();
    if (report) report->commit();
    const Json summary = summary_json(aligned);
    if (arguments.common.json) {
        std::printf("%s\n", json_text(summary, 1).c_str());
        return;
    }
    if (arguments.common.quiet) return;
    std::printf("%s: %zu phones, %zu words, %d pauses\n", arguments.out.string().c_str(),
                alignment.utterance.phones.size(), alignment.utterance.words.size(),
                alignment.pauses);
    for (const Json& word : summary.at("doubtful"))
        std::fprintf(stderr, "note: \"%s\" at %.2f s fits badly: %.1f times as badly as others\n",
                     word.at("word").get<std::string>().c_str(), word.at("start_s").get<double>(),
                     word.at("misfit").get<double>());
}

}  // namespace

void add_align(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("align", "Find when a recording says each sound of its text");
    auto arguments = std::make_shared<AlignArguments>();
    command
        ->add_option("RECORDING", arguments->recording, "The recording: WAV or FLAC, up to 120 s")
        ->required();
    command->add_option("--text", arguments->text, "What it says: a text, or a text file");
    command->add_option("--phones", arguments->voice.phones,
                        "What it says as phones, as the synthesiser spells them");
    command
        ->add_option("-o,--out", arguments->out,
                     "The file to write, by its ending: .TextGrid, .ctm, .lab, .vtt: labels; "
                     ".utterance.json: phones in samples; .tsv: mouth shapes of Rhubarb; "
                     ".curves.tsv: curves of jaw, lips and tongue")
        ->required();
    command
        ->add_option("--voice", arguments->voice.language,
                     "Language of the recording, such as fi, en-us, cs")
        ->capture_default_str();
    command->add_option("--program", arguments->voice.program,
                        "Synthesiser, a name of rigs/standard/voices.json. Default: the first one");
    command->add_option("--pitch", arguments->voice.pitch, "Pitch of the voice, 0 to 99")
        ->capture_default_str();
    command->add_option("--report", arguments->report,
                        "A table to write: how well each word fits, and the pauses");
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius align anna.wav --text \"Good morning.\" --voice en-us -o "
        "anna.TextGrid");
    command->callback([arguments] { run_align(*arguments); });
}

}  // namespace risorius::cli
