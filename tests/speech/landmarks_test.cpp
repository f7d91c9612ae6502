// SPDX-License-Identifier: MIT
#include "risorius/speech/landmarks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "speech/curve_helpers.h"

namespace risorius::speech {
namespace {

constexpr int kSoundRate = 22050;

/// A voiceless stop between two vowels as espeak-ng makes it: the event of the stop is at its burst.
struct Stop {
    Utterance utterance;
    std::vector<float> sound;
    std::int64_t closure = 0, burst = 0;
};

Stop stop_of(double closure_s) {
    Stop out;
    out.utterance.rate_hz = kSoundRate;
    const auto voiced = [&](double seconds) {
        for (int i = 0; i < seconds * kSoundRate; ++i)
            out.sound.push_back(
                0.5f *
                static_cast<float>(std::sin(2 * std::numbers::pi * 150 * i / kSoundRate) +
                                   0.3 * std::sin(2 * std::numbers::pi * 900 * i / kSoundRate)));
    };
    voiced(0.165);
    out.closure = static_cast<std::int64_t>(out.sound.size());
    out.sound.resize(out.sound.size() + static_cast<std::size_t>(closure_s * kSoundRate), 0.0f);
    out.burst = static_cast<std::int64_t>(out.sound.size());
    std::uint32_t noise = 1;
    for (int i = 0; i < 0.03 * kSoundRate; ++i) {
        noise = noise * 1664525u + 1013904223u;
        out.sound.push_back(0.2f * (static_cast<float>(noise >> 8) * 0x1p-23f - 1));
    }
    const auto voice = static_cast<std::int64_t>(out.sound.size());
    voiced(0.2);
    out.utterance.samples = static_cast<std::int64_t>(out.sound.size());
    const auto add = [&](const char* symbol, std::int64_t start, std::int64_t end) {
        Phone phone;
        phone.symbol = symbol;
        phone.start = start;
        phone.end = end;
        out.utterance.phones.push_back(phone);
    };
    add("ɑ", 0, out.burst);
    add("p", out.burst, voice);
    add("ɑ", voice, out.utterance.samples);
    return out;
}

TEST(Landmarks, AClosureThatIsCountedToTheVowelBeforeIsFoundInTheSound) {
    for (const double closure_s : {0.046, 0.179}) {
        Stop stop = stop_of(closure_s);
        find_landmarks(stop.utterance, stop.sound, standard_phones(), StopMark::kBurst);
        const Phone& p = stop.utterance.phones[1];
        ASSERT_TRUE(p.closure && p.release);
        EXPECT_EQ(*p.release, stop.burst);
        // The design asks for 5 ms.
        EXPECT_NEAR(static_cast<double>(*p.closure - stop.closure) / kSoundRate, 0, 0.005);
        EXPECT_EQ(stop.utterance.phones[0].end, p.start);
        EXPECT_EQ(p.start, *p.closure);
        check_utterance(stop.utterance, standard_phones(), "here");
    }
}

TEST(Landmarks, TheBurstOfALabelledStopIsFoundByItsRise) {
    Stop stop = stop_of(0.08);
    // As a person labels it: from the closure to the voice.
    stop.utterance.phones[0].end = stop.utterance.phones[1].start = stop.closure;
    find_landmarks(stop.utterance, stop.sound, standard_phones(), StopMark::kClosure);
    const Phone& p = stop.utterance.phones[1];
    EXPECT_EQ(*p.closure, stop.closure);
    EXPECT_NEAR(static_cast<double>(*p.release - stop.burst) / kSoundRate, 0, 0.005);
    EXPECT_EQ(*p.voice_onset, p.end);
}

TEST(Landmarks, AStopThatBeginsTheUtteranceIsClosedBeforeItsSound) {
    Stop stop = stop_of(0.08);
    stop.utterance.phones.erase(stop.utterance.phones.begin());
    find_landmarks(stop.utterance, stop.sound, standard_phones(), StopMark::kBurst);
    EXPECT_NEAR(static_cast<double>(stop.burst - *stop.utterance.phones[0].closure) / kSoundRate,
                0.080, 1e-4);
}

}  // namespace
}  // namespace risorius::speech
