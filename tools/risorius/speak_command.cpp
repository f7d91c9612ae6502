// SPDX-License-Identifier: MIT
// risorius speak TEXT -o OUT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "risorius/animate/animate.h"
#include "risorius/blendshapes/live_link.h"
#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/core/text_lines.h"
#include "risorius/media/mono_sound.h"
#include "risorius/media/video_writer.h"
#include "risorius/speech/phone_table.h"
#include "risorius/talk/rig_voice_file.h"
#include "risorius/talk/script_checker.h"
#include "risorius/talk/speak_script.h"
#include "risorius/talk/spoken_input.h"
#include "risorius/talk/voice.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/render_options.h"
#include "tools/risorius/speak_arguments.h"
#include "tools/risorius/speech_files.h"

namespace risorius::cli {

namespace {

namespace fs = std::filesystem;

/// TEXT is what to say, a file of text, or an utterance.
void read_said(SpeakArguments& arguments) {
    if (arguments.said == kStandard) return;
    const fs::path file = arguments.said;
    if (is_file_name(arguments.said) && file.extension() == ".json")
        arguments.input.utterance = file;
    else if (!arguments.said.empty())
        arguments.input.voice.text = text_or_file(arguments.said);
}

bool same(const std::vector<speech::ClosureChange>& one,
          const std::vector<speech::ClosureChange>& two) {
    return std::equal(one.begin(), one.end(), two.begin(), two.end(),
                      [](const speech::ClosureChange& a, const speech::ClosureChange& b) {
                          return a.phone == b.phone && a.deeper_mm == b.deeper_mm &&
                                 a.earlier_s == b.earlier_s && a.shorter_s == b.shorter_s &&
                                 a.wider_mm == b.wider_mm;
                      });
}

/// Vowels are widened at most this often in all.
constexpr int kWidenings = 2;

/// More closures hold; of as many, fewer of them stay shut too long; then, more meet in time, and vowels open as far as planned.
bool is_better(const talk::CheckedSpeech& one, const talk::CheckedSpeech& other) {
    return std::tuple(one.held, one.opened, one.in_time, -one.missing_mm) >
           std::tuple(other.held, other.opened, other.in_time, -other.missing_mm);
}

/// Writes the utterance, the script and what the script shows. The first two appear with the last one, or not at all. Returns
/// what came of the closures of the lips.
talk::CheckedSpeech render_speech(SpeakArguments& arguments, talk::SpokenResult& result,
                                  const speech::PhoneTable& table) {
    const fs::path out = arguments.render.out;
    const bool only_script = out.extension() == ".json", live_link = out.extension() == ".csv";
    const fs::path script_file = only_script ? out : beside(out, ".script.json");
    if (!only_script && !live_link) {
        finish_view(arguments.render, arguments.size);
        media::check_target(out, {.width_px = 64, .height_px = 64});  // its ending
    }
    SpeechOutputs outputs(out);
    talk::SpeakScriptOptions options;
    // An utterance that was given stays where it is.
    const fs::path utterance_file = arguments.input.utterance.empty()
                                        ? write_utterance(result, out, outputs)
                                        : arguments.input.utterance;
    options.utterance = seen_from(out, utterance_file);
    options.style = arguments.style;
    options.gestures = arguments.gestures;
    options.blinks = arguments.blinks;
    options.gaze = arguments.gaze;
    options.fps = arguments.render.fps.value_or(60);
    if (!arguments.script.empty()) options.base = JsonCursor::read_file(arguments.script);
    if (arguments.render.rig)
        options.rig = seen_from(out, *arguments.render.rig);
    else if (options.base)
        options.rig = seen_from(out, options.base->at("rig").path());
    else
        options.rig = seen_from(out, data_folder() / "rigs/adult/rig.json");
    if (arguments.passes > 0) options.adjust = talk::usual_changes(result.spoken.utterance, table);
    Json script = talk::speak_script(result.spoken.utterance, options);
    const auto save = [&] { outputs.write_text(script_file, json_text(script, 1) + "\n"); };
    save();
    ProgressBar bar(arguments.common);
    const scene::RigFiles files =
        scene::read_rig_files(folder_of_output(script_file) / options.rig);
    talk::voice_of_rig(files, [&](double fraction) {
        bar.monitor().report(fraction, "simulating mouths of this rig, once");
    });
    // The face is simulated without pictures. Closures that leak are pressed deeper, those that come late begin earlier.
    talk::ScriptChecker checker(files, animate::quality_of(arguments.render));
    talk::CheckedSpeech best;
    std::vector<speech::ClosureChange> best_adjust;
    talk::TriedClosures tried;
    int widenings = 0;  // how often vowels were widened beside the best changes of one simulation
    for (int pass = 0;; ++pass) {
        talk::CheckedSpeech checked = checker.check(
            JsonCursor::from_json(script, script_file.string()), [&](double fraction) {
                bar.monitor().report(fraction, "checking closures of the lips");
            });
        const std::vector<talk::ClosureCheck> closures = checked.closures.back();
        const bool gained = pass == 0 || is_better(checked, best);
        if (gained) {
            best = std::move(checked);
            best_adjust = options.adjust;
            save();
        }
        tried.add(closures, options.adjust);
        std::vector<speech::ClosureChange> changes = tried.next(closures, options.adjust);
        if (pass >= arguments.passes) {
            // The best of each closure need not be good together.
            if (arguments.passes == 0 || widenings == kWidenings || (widenings > 0 && !gained))
                break;
            changes = talk::widened(best.vowels.back(), best_adjust);
            if (same(changes, best_adjust)) break;
            ++widenings;
        }
        // Closures come first: vowels are widened in the last pass, which counts only if no closure is lost.
        const bool all_held = best.held == best.total,
                   all_well = all_held && best.opened == best.total && best.in_time == best.total;
        const bool last =
            pass + 1 == arguments.passes || (pass > 0 && all_well) || same(changes, options.adjust);
        if (last && widenings == 0) {
            changes = talk::widened(best.vowels.back(), all_held ? tried.best() : changes);
            if (same(changes, options.adjust)) break;
            pass = arguments.passes - 1;
        }
        options.adjust = std::move(changes);
        script = talk::speak_script(result.spoken.utterance, options);
    }
    const talk::CheckedSpeech& checked = best;
    outputs.write_text(beside(out, ".speech.tsv"),
                       talk::speech_table(checked.track, checked.utterances, table));
    if (live_link)
        outputs.write_text(out, blendshapes::live_link_of_script(
                                    script_file, files, animate::quality_of(arguments.render)));
    if (only_script || live_link) {
        outputs.commit();
        return best;
    }
    arguments.render.script = script_file;
    arguments.render.rig.reset();
    const animate::RunRecord record = animate::animate(arguments.render, bar.monitor());
    for (const std::string& warning : record.warnings)
        std::fprintf(stderr, "note: %s\n", warning.c_str());
    outputs.commit();
    return best;
}

void print_report(const SpeakArguments& arguments, const speech::Utterance& utterance,
                  const std::optional<talk::CheckedSpeech>& checked) {
    const std::string out = arguments.render.out.string();
    const double seconds = utterance.seconds(utterance.samples);
    if (arguments.common.json) {
        Json report = json_object({{"out", out},
                                   {"phones", utterance.phones.size()},
                                   {"words", utterance.words.size()},
                                   {"seconds", seconds}});
        if (checked) {
            report["closures"] = checked->total;
            report["closures_reached"] = checked->reached;
            report["closures_held"] = checked->held;
            report["missing_mm"] = checked->missing_mm;
        }
        std::printf("%s\n", json_text(report, 1).c_str());
        return;
    }
    if (arguments.common.quiet) return;
    if (checked && checked->total > 0)
        std::printf("closures of the lips: %d, reached %d, held %d\n", checked->total,
                    checked->reached, checked->held);
    if (checked && checked->missing_mm >= 0.5)
        std::printf("vowels open %.1f mm less than planned, mean\n", checked->missing_mm);
    std::printf("%s: %zu phones, %zu words, %.3f s\n", out.c_str(), utterance.phones.size(),
                utterance.words.size(), seconds);
}

void run_speak(SpeakArguments& arguments) {
    read_said(arguments);
    const fs::path out = arguments.render.out;
    if (out == kStandard) return speak_live(arguments);
    if (arguments.said == kStandard)
        throw Error("speak TEXT", "a text, as standard input is read with --out - alone", "-");
    const speech::PhoneTable table = speech::PhoneTable::standard();
    talk::SpokenResult result = talk::read_spoken(arguments.input, table);
    std::optional<talk::CheckedSpeech> checked;
    if (is_speech_text(out)) {
        SpeechOutputs outputs(out);
        write_speech_text(result, out, table, outputs);
        outputs.commit();
    } else {
        checked = render_speech(arguments, result, table);
    }
    print_report(arguments, result.spoken.utterance, checked);
}

}  // namespace

void add_speak(CLI::App& app) {
    CLI::App* command = app.add_subcommand("speak", "Let a face say a text or a recording");
    auto arguments = std::make_shared<SpeakArguments>();
    talk::SpokenInput& input = arguments->input;
    command->add_option("TEXT", arguments->said,
                        "What to say: a text, a text file, or a file of format risorius-utterance; "
                        "-: each line of standard input as it comes, with --out -");
    command
        ->add_option(
            "-o,--out", arguments->render.out,
            "The file to write, by its ending. .mp4, .mov, .mkv, .webm, or a folder that "
            "ends in /: the talking face, with its script, utterance and sound beside "
            "it; .json: the script alone; .utterance.json: phones in samples, with "
            "the sound beside it; .TextGrid, .ctm, .lab, .vtt: labels; .tsv: mouth shapes of "
            "Rhubarb; .visemes.json: those of Oculus as a list and as weights over time; .csv: "
            "weights of the shapes of ARKit, as Live Link Face records them; .curves.tsv: curves "
            "of jaw, lips and tongue; -: the talking face on standard output while it is "
            "simulated, "
            "as Matroska with H.264 and PCM, in quality preview, with closures of the lips "
            "unchecked")
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
    command->add_option("--audio", input.audio,
                        "The recording of the text or of the labels: WAV or FLAC");
    command->add_option("--rig", arguments->render.rig, "The rig. Default: the adult");
    command->add_option("--script", arguments->script,
                        "A script to add the speech to, with its expressions, view and rig");
    command->add_option("--fps", arguments->render.fps, "Frames per second, 1 to 240");
    command
        ->add_option("--jaw", arguments->style.jaw,
                     "How far the jaw opens, 0 to 2: 0.4 mumbled, 1.3 clear, 1.8 shouted")
        ->check(CLI::Range(0.0, 2.0));
    command
        ->add_option("--lips", arguments->style.lips,
                     "How much the lips move, 0 to 2: 0.5 mumbled, 1.2 clear")
        ->check(CLI::Range(0.0, 2.0));
    command
        ->add_option("--gestures", arguments->gestures,
                     "Movements of brows and head with the stress, 0 to 2; 0: none")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 2.0));
    command
        ->add_option("--blinks", arguments->blinks,
                     "Blinks, 0 to 2: 1 is 26 a minute, most of them in pauses; 0: none")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 2.0));
    command
        ->add_option("--gaze", arguments->gaze,
                     "Turns of the eyes, 0 to 2: away as a sentence begins, then about the "
                     "listener's face; 0: none")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 2.0));
    command
        ->add_option("--passes", arguments->passes,
                     "How many times to correct lip closures that stay open, 0 to 8")
        ->capture_default_str()
        ->check(CLI::Range(0, 8));
    add_view(*command, arguments->render, arguments->size);
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius speak \"Good morning.\" --voice en-us -o out/morning.mp4\n"
        "  risorius speak \"Good morning.\" --voice en-us -o out/morning.TextGrid\n"
        "  risorius speak \"Good morning.\" --voice en-us --audio anna.wav -o out/anna.mp4\n"
        "  risorius speak \"Good morning.\" --voice en-us -o - | mpv -\n"
        "  risorius speak --labels anna.TextGrid --audio anna.wav -o out/anna.utterance.json");
    command->callback([arguments] { run_speak(*arguments); });
}

}  // namespace risorius::cli
