// SPDX-License-Identifier: MIT
#include "risorius/speech/align.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "message_of.h"
#include "speech/curve_helpers.h"

namespace risorius::speech {
namespace {

/// Somebody who speaks: a train of pulses through resonances, noise, and silence.
struct Speaker {
    int rate_hz;
    double pitch_hz;
    double tract;  ///< the resonances are those of the phones times this
    double loudness;
};

struct Resonances {
    const char* symbol;
    std::array<double, 3> hz;  ///< the first is 0 for noise
};
// Peterson & Barney 1952 (vowels of men), rounded
constexpr Resonances kSounds[] = {{"ɑ", {700, 1150, 2500}}, {"i", {280, 2250, 2900}},
                                  {"u", {310, 700, 2300}},  {"e", {450, 1900, 2550}},
                                  {"m", {250, 900, 2100}},  {"l", {350, 1300, 2700}},
                                  {"s", {0, 5200, 0}},      {"p", {0, 1200, 0}}};

struct Speech {
    Utterance utterance;
    std::vector<float> samples;
    SoundView view() const { return {samples, utterance.rate_hz}; }
};

class Synthesis {
  public:
    explicit Synthesis(const Speaker& speaker) : speaker_(speaker) {
        out_.utterance.rate_hz = speaker.rate_hz;
    }

    /// "_" is a pause; a stop is silent but for its last 15 ms.
    void add(const Timed& one) {
        Phone phone;
        phone.symbol = one.symbol;
        phone.start = position();
        const Resonances* sound = nullptr;
        for (const Resonances& known : kSounds)
            if (one.symbol == known.symbol) sound = &known;
        const auto length = std::llround(one.seconds * speaker_.rate_hz);
        for (long i = 0; i < length; ++i) {
            const bool silent =
                !sound || (one.symbol == "p" && i < length - 0.015 * speaker_.rate_hz);
            out_.samples.push_back(static_cast<float>(
                speaker_.loudness * (silent ? 0 : sample(*sound)) + 1e-4 * noise()));
        }
        phone.end = position();
        out_.utterance.phones.push_back(phone);
    }
    void end_word(const std::string& text, std::int64_t from) {
        out_.utterance.words.push_back({text, from, position()});
    }
    std::int64_t position() const { return static_cast<std::int64_t>(out_.samples.size()); }
    Speech done() {
        out_.utterance.samples = position();
        return std::move(out_);
    }

  private:
    double noise() {
        state_ = state_ * 1664525u + 1013904223u;
        return static_cast<double>(state_ >> 8) * 0x1p-23 - 1;
    }
    double sample(const Resonances& sound) {
        const bool noisy = sound.hz[0] == 0;
        phase_ += speaker_.pitch_hz / speaker_.rate_hz;
        double source = noisy ? 0.7 * noise() : 0;
        if (phase_ >= 1) {
            phase_ -= 1;
            if (!noisy) source = 6;
        }
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (sound.hz[k] == 0) continue;
            const double width_hz = noisy ? 900 : 90;
            const double r = std::exp(-std::numbers::pi * width_hz / speaker_.rate_hz);
            const double turn =
                2 * std::numbers::pi * speaker_.tract * sound.hz[k] / speaker_.rate_hz;
            auto& [last, before] = memory_[k];
            const double y = source + 2 * r * std::cos(turn) * last - r * r * before;
            before = last;
            last = y;
            sum += y * (1 - r);
        }
        return sum;
    }

    Speaker speaker_;
    Speech out_;
    std::uint32_t state_ = 7;
    double phase_ = 0;
    std::array<std::array<double, 2>, 3> memory_{};
};

struct Word {
    std::string text;
    std::vector<Timed> phones;
};

const std::vector<Word> kText{
    {"mali", {{"m", 0.08}, {"ɑ", 0.12}, {"l", 0.07}, {"i", 0.11}}},
    {"sapu", {{"s", 0.10}, {"ɑ", 0.11}, {"p", 0.09}, {"u", 0.12}}},
    {"lisem", {{"l", 0.07}, {"i", 0.10}, {"s", 0.11}, {"e", 0.12}, {"m", 0.09}}},
    {"pelu", {{"p", 0.09}, {"e", 0.13}, {"l", 0.07}, {"u", 0.13}}}};

/// Says words with a pause before and after all of them, and another one before word `pause_at`.
Speech say(const Speaker& speaker, const std::vector<Word>& text, int pause_at = -1,
           double silence_s = 0.2) {
    Synthesis out(speaker);
    out.add({"_", silence_s});
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (static_cast<int>(i) == pause_at) out.add({"_", 0.4});
        const std::int64_t from = out.position();
        for (const Timed& phone : text[i].phones) out.add(phone);
        out.end_word(text[i].text, from);
    }
    out.add({"_", silence_s});
    return out.done();
}

/// The same words with other durations: some phones 1.5 times as long, some shorter.
std::vector<Word> in_other_rhythm() {
    std::vector<Word> out = kText;
    const double factors[] = {1.3, 0.8, 1.1, 1.5, 0.9};
    int k = 0;
    for (Word& word : out)
        for (Timed& phone : word.phones) phone.seconds *= factors[k++ % 5];
    return out;
}

const Speaker kVoice{22050, 110, 1, 0.05}, kPerson{44100, 190, 1.12, 0.02};

Alignment aligned(const Speech& recording, const Speech& voice) {
    return align(recording.view(), {voice.utterance, voice.view()}, standard_phones(), "anna.wav");
}

TEST(Align, FindsThePhonesOfAnotherSpeakerWithAnotherRhythmAndAPause) {
    const Speech voice = say(kVoice, kText);
    const Speech recording = say(kPerson, in_other_rhythm(), 2, 0.5);
    const Alignment found = aligned(recording, voice);
    const std::vector<Phone>&truth = recording.utterance.phones, &phones = found.utterance.phones;
    const auto listed = [](const std::vector<Phone>& all) {
        std::string out;
        for (const Phone& phone : all) out += phone.symbol;
        return out;
    };
    ASSERT_EQ(listed(phones), listed(truth));
    std::vector<double> errors_ms;
    for (std::size_t i = 1; i < phones.size(); ++i) {
        errors_ms.push_back(1e3 *
                            std::abs(found.utterance.seconds(phones[i].start - truth[i].start)));
        // The border of silence and a stop cannot be heard.
        if (phones[i].symbol != "p" && phones[i - 1].symbol != "p") {
            EXPECT_LT(errors_ms.back(), 25) << i << " " << phones[i].symbol;
        }
    }
    std::sort(errors_ms.begin(), errors_ms.end());
    EXPECT_LT(errors_ms[errors_ms.size() / 2], 10);
    EXPECT_EQ(found.pauses, 1);
    ASSERT_EQ(found.utterance.words.size(), 4u);
    EXPECT_EQ(found.utterance.words[2].text, "lisem");
    EXPECT_NEAR(found.utterance.seconds(found.utterance.words[2].start -
                                        recording.utterance.words[2].start),
                0, 0.02);
    EXPECT_LT(found.misfit, 0.9);
    for (const WordFit& word : found.words) EXPECT_FALSE(word.doubtful());
    check_utterance(found.utterance, standard_phones(), "found");
}

TEST(Align, APauseOfTheVoiceThatTheRecordingLacksIsLeftOut) {
    const Speech voice = say(kVoice, kText, 1);
    const Speech recording = say(kPerson, in_other_rhythm());
    const Alignment found = aligned(recording, voice);
    EXPECT_EQ(found.pauses, 0);
    EXPECT_EQ(found.utterance.phones.size(), recording.utterance.phones.size());
}

TEST(Align, IsTheSameTwiceAndForALouderRecording) {
    const Speech voice = say(kVoice, kText);
    Speech recording = say(kPerson, in_other_rhythm(), 2);
    const Alignment one = aligned(recording, voice), two = aligned(recording, voice);
    EXPECT_EQ(utterance_text(one.utterance), utterance_text(two.utterance));
    for (float& sample : recording.samples) sample *= 8;
    const Alignment louder = aligned(recording, voice);
    ASSERT_EQ(louder.utterance.phones.size(), one.utterance.phones.size());
    for (std::size_t i = 0; i < one.utterance.phones.size(); ++i)
        EXPECT_NEAR(louder.utterance.seconds(louder.utterance.phones[i].start),
                    one.utterance.seconds(one.utterance.phones[i].start), 0.005);
}

TEST(Align, RefusesRecordingsThatCannotBeThatText) {
    const Speech voice = say(kVoice, kText);
    const auto message = [&](const Speech& recording) {
        return message_of([&] { aligned(recording, voice); });
    };
    Synthesis silence(kPerson);
    silence.add({"_", 3});
    EXPECT_EQ(message(silence.done()),
              "anna.wav: expected a recording of speech, found silence: its loudest part is at -85 "
              "dB of full scale");
    EXPECT_NE(message(say(kPerson, {kText[0]})).find("s of speech for this text, found 0."),
              std::string::npos);
    Synthesis click(kPerson);
    click.add({"ɑ", 0.05});
    EXPECT_EQ(message(click.done()),
              "anna.wav: expected a recording of 0.1 to 120 s, found 0.050 s");
    // As many words and as long, but none of them is in the text.
    const std::vector<Word> other{
        {"uuss", {{"u", 0.2}, {"s", 0.2}}},
        {"ee", {{"e", 0.25}}},
        {"sispi", {{"s", 0.15}, {"i", 0.12}, {"s", 0.15}, {"p", 0.1}, {"i", 0.15}}},
        {"ɑɑm", {{"ɑ", 0.2}, {"m", 0.2}}}};
    EXPECT_NE(message(say(kPerson, other)).find("expected a recording of this text"),
              std::string::npos);
}

TEST(Align, AWordThatTheRecordingHasInsteadOfAnotherIsDoubtful) {
    std::vector<Word> said = in_other_rhythm();
    said[2].phones = {{"p", 0.1}, {"u", 0.15}, {"p", 0.1}, {"u", 0.15}};
    const Alignment found = aligned(say(kPerson, said), say(kVoice, kText));
    std::size_t worst = 0;
    for (std::size_t i = 0; i < found.words.size(); ++i)
        if (found.words[i].misfit > found.words[worst].misfit) worst = i;
    EXPECT_EQ(worst, 2u);
}

}  // namespace
}  // namespace risorius::speech
