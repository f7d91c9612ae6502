// SPDX-License-Identifier: MIT
#include "risorius/talk/say_event.h"

#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/existing_file.h"
#include "risorius/core/input_log.h"
#include "risorius/core/output_set.h"
#include "risorius/media/mono_sound.h"
#include "risorius/speech/trajectory.h"
#include "risorius/talk/detail/gesture_drive.h"
#include "risorius/talk/detail/speech_drive.h"
#include "risorius/talk/detail/speech_noise.h"
#include "risorius/talk/rig_voice_file.h"

namespace risorius::talk {

namespace {

constexpr double kLongestPhone_s = 10;

speech::SpeechStyle read_style(const JsonCursor& json) {
    json.allow_keys({"jaw", "lips", "anticipation", "gestures", "blinks", "gaze"});
    speech::SpeechStyle style;
    if (const auto v = json.find("jaw")) style.jaw = v->number({0, 2});
    if (const auto v = json.find("lips")) style.lips = v->number({0, 2});
    if (const auto v = json.find("anticipation")) style.anticipation = v->number({0.5, 2});
    return style;
}

void read_what(const JsonCursor& say, SayEvent& out) {
    if (say.is_string()) {
        out.input.voice.text = say.string();
        if (out.input.voice.text.empty()) say.fail("a text to say");
        return;
    }
    const std::string expected =
        "a text, or an object with one of \"phones\", \"labels\" and \"utterance\"";
    if (!say.is_object()) say.fail(expected);
    say.allow_keys({"phones", "labels", "format", "tier", "symbols", "utterance"});
    if (say.has("phones") + say.has("labels") + say.has("utterance") != 1) say.fail(expected);
    if (const auto phones = say.find("phones")) {
        for (const JsonCursor& item : phones->items()) {
            const std::vector<JsonCursor> pair = item.items();
            if (pair.size() != 2) item.fail("a pair [symbol, seconds]");
            const double seconds = pair[1].number();
            if (!(seconds > 0 && seconds <= kLongestPhone_s)) pair[1].fail("seconds in (0, 10]");
            out.timed_phones.emplace_back(pair[0].string(), seconds);
        }
        if (out.timed_phones.empty()) phones->fail("at least one phone");
    }
    if (const auto v = say.find("labels")) out.input.labels = existing_file(*v);
    if (const auto v = say.find("utterance")) out.input.utterance = existing_file(*v);
    if (const auto v = say.find("format")) out.input.label_format = v->string();
    if (const auto v = say.find("tier")) out.input.label_options.phones_tier = v->string();
    if (const auto v = say.find("symbols")) out.input.label_options.symbols = v->string();
}

/// Phones as given, without sound.
SpokenResult of_timed(const SayEvent& event, const speech::PhoneTable& table) {
    SpokenResult out;
    speech::Utterance& utterance = out.spoken.utterance;
    utterance.rate_hz = kSilentRate_hz;
    double end_s = 0;
    for (std::size_t i = 0; i < event.timed_phones.size(); ++i) {
        const auto& [symbol, seconds] = event.timed_phones[i];
        const std::string place = event.place + "/say/phones/" + std::to_string(i) + "/0";
        const auto parts = table.split(symbol, "ipa", place);
        double share = 0;
        const double begin_s = end_s;
        end_s += seconds;
        for (const speech::SplitPhone& part : parts) {
            share += part.share;
            speech::Phone phone;
            phone.symbol = part.symbol;
            phone.length_mark = part.length_mark;
            phone.stress = part.stress;
            phone.start = utterance.samples;
            phone.end = std::llround((begin_s + share * seconds) * kSilentRate_hz);
            utterance.samples = phone.end;
            if (phone.end > phone.start) utterance.phones.push_back(std::move(phone));
        }
    }
    speech::check_utterance(utterance, table, event.place);
    return out;
}

/// When the face begins to move, from the first sample of the sound.
double first_movement_s(const speech::Utterance& utterance) {
    for (const speech::Phone& phone : utterance.phones)
        if (!phone.is_pause())
            return utterance.seconds(phone.closure.value_or(phone.start)) - speech::kLead_s;
    return 0;
}

std::string note_on_unknown_mouths(const scene::RigFiles& files) {
    return "the mouths of " + files.file.string() +
           " are not simulated yet; the first run does it, once, which takes some minutes";
}

}  // namespace

SayEvent read_say(const JsonCursor& event, double duration_s) {
    event.allow_keys({"say", "voice", "program", "rate", "pitch", "start_s", "style", "face",
                      "sound", "sound_offset_samples", "adjust", "burst_s", "noise"});
    SayEvent out;
    out.place = event.place();
    read_what(event.at("say"), out);
    if (const auto v = event.find("voice")) out.input.voice.language = v->string();
    out.input.label_options.language = out.input.voice.language;
    if (const auto v = event.find("program")) out.input.voice.program = v->string();
    if (const auto v = event.find("rate")) out.input.voice.rate = v->number({0.3, 3});
    if (const auto v = event.find("pitch")) out.input.voice.pitch = v->integer(0, 99);
    if (const auto v = event.find("burst_s")) {
        if (event.has("start_s")) v->fail("no \"start_s\" with it, or no \"burst_s\"");
        out.burst_s = v->number({0, duration_s});
    } else {
        out.start_s = event.at("start_s").number({-duration_s, duration_s});
    }
    if (const auto v = event.find("noise")) {
        v->allow_keys({"snr_db", "seed"});
        out.snr_db = v->at("snr_db").number({-60, 60});
        if (const auto seed = v->find("seed"))
            out.noise_seed = static_cast<std::uint64_t>(seed->integer(0, 2147483647));
    }
    if (const auto v = event.find("style")) {
        out.style = read_style(*v);
        if (const auto g = v->find("gestures")) out.gestures = g->number({0, 2});
        if (const auto b = v->find("blinks")) out.blinks = b->number({0, 2});
        if (const auto g = v->find("gaze")) out.gaze = g->number({0, 2});
    }
    if (const auto v = event.find("adjust"))
        for (const JsonCursor& item : v->items()) {
            item.allow_keys({"phone", "deeper_mm", "earlier_s", "shorter_s", "wider_mm"});
            speech::ClosureChange change;
            change.phone = item.at("phone").integer(0, 2147483647);
            if (const auto d = item.find("deeper_mm")) change.deeper_mm = d->number({0, 20});
            if (const auto d = item.find("earlier_s")) change.earlier_s = d->number({0, 0.2});
            if (const auto d = item.find("shorter_s")) change.shorter_s = d->number({-0.1, 0.2});
            if (const auto d = item.find("wider_mm")) change.wider_mm = d->number({0, 20});
            out.adjust.push_back(change);
        }
    if (const auto v = event.find("face")) out.face = v->boolean();
    if (const auto v = event.find("sound")) {
        out.sound = v->string() != "none";
        if (out.sound) out.sound_file = existing_file(*v);
        // Closures and bursts of labels are found in their sound.
        if (!out.input.labels.empty()) out.input.audio = out.sound_file;
    }
    if (const auto v = event.find("sound_offset_samples"))
        out.sound_offset_samples = v->integer(-2147483647, 2147483647);
    return out;
}

void add_to_script(const PlannedSpeech& speech, track::ScriptDescription& script) {
    script.sources.insert(script.sources.end(), speech.sources.begin(), speech.sources.end());
    for (const track::BlinkEvent& blink : speech.blinks)
        if (blink.start_s >= 0 && blink.start_s <= script.header.duration_s)
            script.blinks.push_back(blink);
}

namespace {

/// Puts a sound into a file that is gone with `out`.
std::filesystem::path kept_sound(const media::MonoSound& sound, PlannedSpeech& out) {
    auto folder = std::make_shared<OutputSet>(std::filesystem::temp_directory_path(),
                                              OutputSet::Then::kRunGoesOn);
    std::filesystem::path file = folder->scratch_file("speech.wav");
    media::write_mono_wav(sound, file);
    out.keeps = folder;
    return file;
}

/// Noise of 15 minutes at 22 kHz takes some seconds and half a gigabyte.
constexpr std::size_t kMostNoisySamples = 20'000'000;

/// The sound of an event, its noise and its place in the script.
void plan_sound(const JsonCursor& say, const SayEvent& event, const SpokenResult& spoken,
                PlannedSpeech& out) {
    const speech::Utterance& utterance = spoken.spoken.utterance;
    std::filesystem::path sound = event.sound_file.empty() ? spoken.sound_file : event.sound_file;
    if (sound.empty() && spoken.spoken.sound.empty()) return;
    if (!out.sound_file.empty())
        say.fail("one event with a sound (\"sound\": \"none\" for the others)", "two");
    std::int64_t before = 0;
    if (event.snr_db) {
        media::MonoSound clean{utterance.rate_hz, spoken.spoken.sound};
        if (!sound.empty()) clean = media::read_mono_sound(sound);
        if (clean.rate_hz != utterance.rate_hz)
            say.at("noise").fail(
                "a sound of " + std::to_string(utterance.rate_hz) + " Hz, the rate of what is said",
                std::to_string(clean.rate_hz));
        if (clean.samples.size() > kMostNoisySamples)
            say.at("noise").fail(
                "a sound of at most " + std::to_string(kMostNoisySamples) + " samples",
                std::to_string(clean.samples.size()));
        NoisySpeech noisy = with_noise(clean.samples, utterance, *event.snr_db, event.noise_seed);
        before = noisy.before;
        if (noisy.gain < 1)
            out.notes.push_back(event.place + ": speech and noise are " +
                                format_number(std::round(-200 * std::log10(noisy.gain)) / 10) +
                                " dB quieter, because they would have been cut off");
        sound = kept_sound({utterance.rate_hz, std::move(noisy.samples)}, out);
    } else if (sound.empty()) {
        sound = kept_sound({utterance.rate_hz, spoken.spoken.sound}, out);
    }
    out.sound_file = sound;
    std::optional<ReadingFormerOutput> own_file;
    if (out.keeps) own_file.emplace();
    const int rate_hz = media::sound_rate_hz(sound);
    out.sound_offset_samples =
        std::llround(event.start_s * rate_hz) + event.sound_offset_samples - before;
}

}  // namespace

PlannedSpeech plan_speech(const std::vector<JsonCursor>& says, const track::ScriptHeader& header,
                          const scene::RigFiles& files, const MouthPoses& poses) {
    PlannedSpeech out;
    if (says.empty()) return out;
    const speech::PhoneTable table = speech::PhoneTable::standard();
    std::optional<RigVoice> voice;
    std::size_t phones = 0;
    for (const JsonCursor& say : says) {
        SayEvent event = read_say(say, header.duration_s);
        SpokenResult spoken =
            event.timed_phones.empty() ? read_spoken(event.input, table) : of_timed(event, table);
        const speech::Utterance& utterance = spoken.spoken.utterance;
        phones += utterance.phones.size();
        if (phones > speech::kMostPhones)
            say.fail("at most " + std::to_string(speech::kMostPhones) + " phones in all events",
                     std::to_string(phones));
        if (event.burst_s) {
            const std::optional<double> burst_s = speech::first_burst_s(utterance, table);
            if (!burst_s) say.at("burst_s").fail("a stop or nasal in what is said", "none");
            event.start_s = *event.burst_s - *burst_s;
        }
        for (const std::filesystem::path& file :
             {event.input.labels, event.input.utterance, spoken.sound_file, event.sound_file})
            if (!file.empty()) out.files.push_back(file);
        speech::ArticulationTargets targets = speech::targets_of(utterance, table, event.style);
        if (event.face) {
            const double begins_s = event.start_s + first_movement_s(utterance);
            if (begins_s < -1e-9)
                say.at("start_s").fail(
                    "a time from " +
                    format_number(std::ceil(1000 * (event.start_s - begins_s)) / 1000) +
                    " s on, as the face moves before the first sound");
            if (!voice && poses.may_simulate) voice = voice_of_rig(files, poses.report);
            if (!voice) voice = known_voice_of_rig(files);
            if (!voice && out.notes.empty()) out.notes.push_back(note_on_unknown_mouths(files));
        }
        if (event.face && voice) {
            speech::ArticulationTargets changed = targets;
            speech::change_closures(event.adjust, changed);
            out.sources.push_back(
                drive_of(speech::curves_of(changed), *voice, files.rig, event.start_s));
            const speech::Prosody prosody =
                speech::prosody_of(utterance, table,
                                   {event.gestures, event.blinks, event.gaze,
                                    static_cast<std::uint64_t>(header.seed)});
            if (auto gestures = gesture_drive(prosody, files.rig, event.start_s))
                out.sources.push_back(std::move(gestures));
            for (track::BlinkEvent& blink : blinks_of(prosody, files.rig, event.start_s))
                out.blinks.push_back(std::move(blink));
        }
        out.utterances.push_back({utterance, std::move(targets), event.start_s, event.face});
        if (event.sound) plan_sound(say, event, spoken, out);
    }
    return out;
}

}  // namespace risorius::talk
