// SPDX-License-Identifier: MIT
#include "risorius/speech/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "speech/curve_helpers.h"

namespace risorius::speech {
namespace {

ArticulationCurves curves(const std::vector<Timed>& phones, const SpeechStyle& style = {}) {
    return curves_of(targets_of(utterance_of(phones), standard_phones(), style));
}

/// Pimean metsan puro solisi hiljaa, as espeak-ng times it to 10 ms.
const std::vector<Timed> kForest = {
    {"p", .08}, {"i", .06}, {"m", .06}, {"e", .06}, {"æ", .08}, {"n", .06}, {"m", .06},
    {"e", .06}, {"t", .06}, {"s", .08}, {"æ", .07}, {"m", .06}, {"p", .09}, {"u", .09},
    {"r", .05}, {"o", .10}, {"s", .10}, {"o", .07}, {"l", .06}, {"i", .06}, {"s", .09},
    {"i", .06}, {"h", .06}, {"i", .05}, {"l", .06}, {"j", .05}, {"ɑ", .17}};

TEST(Trajectory, OfManyPhonesTakesNoLongerThanItsLength) {
    constexpr int kPhones = 80000;
    constexpr double kPhone_s = 0.001;
    ArticulationTargets targets{.start_s = 0,
                                .end_s = kPhones * kPhone_s,
                                .windows = {},
                                .bounds = {},
                                .closures = {},
                                .contacts = {}};
    for (int i = 0; i < kPhones; ++i) {
        const double from_s = i * kPhone_s, to_s = from_s + kPhone_s / 2;
        targets.windows.push_back({.parameter = Parameter::kProtrusion,
                                   .from_s = from_s,
                                   .to_s = to_s,
                                   .target = i % 3 * 1.0,
                                   .tau_s = 0.03,
                                   .weak = i % 2 == 1});
        targets.closures.push_back({i, i, from_s, to_s});
        targets.contacts.push_back({from_s, to_s, 1, i});
    }
    const std::clock_t begin = std::clock();
    const ArticulationCurves curves = curves_of(targets);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 2);
    EXPECT_GT(curves.labiodental.minCoeff(), 0.99);
}

TEST(Trajectory, EveryClosureIsClosed) {
    const Utterance utterance = utterance_of(kForest);
    const ArticulationTargets targets = targets_of(utterance, standard_phones());
    const ArticulationCurves c = curves_of(targets);
    EXPECT_TRUE(c.converged);
    ASSERT_EQ(targets.closures.size(), 4u);  // n m is not one, m p is
    for (const LipClosure& closure : targets.closures)
        for (double t = closure.closure_s + kAfterClosure_s + kCurveStep_s;
             t <= closure.release_s - kBeforeRelease_s - kCurveStep_s; t += 0.001)
            EXPECT_LE(c.at(Parameter::kGap, t), kClosedGap_mm + 0.02) << t;
}

TEST(Trajectory, LipsMoveSmoothlyAndNoFasterThanPeople) {
    const ArticulationCurves c = curves(kForest);
    double fastest = 0;
    for (double t = c.start_s; t < c.time_s(c.size() - 1); t += 0.001)
        fastest = std::max(fastest, std::abs(c.speed_at(Parameter::kGap, t)));
    // A cubic between grid points may be a little faster than the step that was bounded.
    EXPECT_LE(fastest, 1.02 * kMaxLipSpeed_mm_s);
    EXPECT_GT(fastest, 100);
    // A frame at 60 Hz
    for (double t = c.start_s; t < c.time_s(c.size() - 1); t += 1.0 / 60)
        EXPECT_LT(std::abs(c.speed_at(Parameter::kProtrusion, t + 1.0 / 60) -
                           c.speed_at(Parameter::kProtrusion, t)),
                  60);
}

TEST(Trajectory, RoundingIsAnticipatedThroughConsonantsButNotWithoutARoundVowel) {
    // Times at which protrusion passes half of what the u reaches, before the u begins.
    const auto lead = [](const std::vector<Timed>& phones, double u_begins_s) {
        const ArticulationCurves c = curves(phones);
        double peak = 0;
        for (double t = 0; t < 2; t += 0.001)
            peak = std::max(peak, c.at(Parameter::kProtrusion, t));
        double t = u_begins_s + 0.1;
        while (t > 0 && c.at(Parameter::kProtrusion, t) > peak / 2) t -= 0.001;
        return u_begins_s - t;
    };
    const double one = lead({{"i", .09}, {"s", .10}, {"t", .08}, {"u", .12}}, 0.4 + 0.27);
    const double two = lead({{"i", .09}, {"k", .09}, {"t", .08}, {"u", .12}}, 0.4 + 0.26);
    EXPECT_GE(one, 0.060);
    EXPECT_GE(two, 0.060);
    const ArticulationCurves none = curves({{"i", .09}, {"s", .10}, {"t", .08}, {"i", .12}});
    for (double t = 0; t < 1.2; t += 0.005) EXPECT_LT(none.at(Parameter::kProtrusion, t), 1) << t;
}

TEST(Trajectory, TheFaceMovesBeforeTheFirstSoundAndIsStillInSilence) {
    const ArticulationCurves c = curves({{"ɑ", .15}, {"m", .09}, {"ɑ", .15}});
    double begins = 0;
    while (std::abs(c.at(Parameter::kGap, begins)) < 0.3) begins += 0.001;
    EXPECT_GT(0.4 - begins, 0.05);
    EXPECT_LT(0.4 - begins, 0.30);
    const ArticulationCurves paused =
        curves({{"ɑ", .15}, {"s", .1}, {"_", .6}, {"ɑ", .15}, {"m", .09}, {"ɑ", .15}});
    for (double t = 0.4 + 0.25 + 0.25; t < 0.4 + 0.25 + 0.4; t += 0.005) {
        EXPECT_LT(std::abs(paused.at(Parameter::kGap, t)), 0.1);
        EXPECT_LT(std::abs(paused.speed_at(Parameter::kGap, t)), 2);
    }
}

/// The jaw rises most in s and t, less in l, least in k (Keating et al. 1994). Lips do not stay as far apart as in the vowels: what
/// they add to the opening of the jaw is at most twice what they add in a.
TEST(Trajectory, TheJawRisesBetweenOpenVowelsAndTheLipsFollowIt) {
    constexpr double kLipsInA_mm = 3, kGapOfJaw = 0.9;
    const auto middle = [](const char* consonant, Parameter parameter) {
        return curves({{"ɑ", .14}, {consonant, .09}, {"ɑ", .14}}).at(parameter, 0.4 + 0.14 + 0.045);
    };
    const auto jaw = [&](const char* consonant) { return middle(consonant, Parameter::kJaw); };
    EXPECT_LT(jaw("s"), jaw("t"));
    EXPECT_LT(jaw("t"), 8.5);
    EXPECT_LT(jaw("t"), jaw("l"));
    EXPECT_LT(jaw("l"), jaw("k") - 1);
    EXPECT_LT(jaw("j"), 8.5);
    for (const char* consonant : {"t", "d", "n", "l", "s", "ʃ", "j", "k", "r", "θ"})
        EXPECT_LT(middle(consonant, Parameter::kGap) - kGapOfJaw * jaw(consonant), 2 * kLipsInA_mm)
            << consonant;
}

TEST(Trajectory, CurvesStayWithinTheirTargets) {
    const ArticulationCurves c = curves({{"i", .09}, {"s", .10}, {"t", .08}, {"u", .12}});
    for (double t = c.start_s; t < 1.5; t += 0.001) {
        EXPECT_LT(c.at(Parameter::kProtrusion, t), 5.75 + 0.2);
        EXPECT_GT(c.at(Parameter::kProtrusion, t), -0.65 - 0.2);
    }
}

TEST(Trajectory, AGeminateIsClosedLongerButClosesNoFaster) {
    const auto measure = [](double length_s) {
        const Utterance u = utterance_of({{"r", .06}, {"ɑ", .09}, {"p", length_s}, {"u", .1}});
        const ArticulationCurves c = curves_of(targets_of(u, standard_phones()));
        double contact = 0, fastest = 0;
        for (double t = 0.4 + 0.09; t < 0.4 + 0.15 + length_s + 0.02; t += 0.0005)
            if (c.at(Parameter::kGap, t) <= 0) contact += 0.0005;
        for (double t = 0.4 + 0.08; t < 0.4 + 0.15 + length_s / 2; t += 0.0005)
            fastest = std::max(fastest, -c.speed_at(Parameter::kGap, t));
        return std::pair(contact, fastest);
    };
    const auto [single, single_speed] = measure(0.084);
    const auto [twice, twice_speed] = measure(0.158);
    EXPECT_GT(twice / single, 1.7);
    EXPECT_LT(twice / single, 2.8);
    EXPECT_NEAR(twice_speed / single_speed, 1, 0.15);
}

TEST(Trajectory, StyleScalesVowelsButNeverAClosure) {
    const std::vector<Timed> phones = {{"m", .09}, {"i", .12}, {"p", .09}, {"ɑ", .15}};
    const ArticulationCurves mumbled = curves(phones, {.jaw = 0.1, .lips = 0});
    const ArticulationCurves clear = curves(phones, {.jaw = 1.3, .lips = 2});
    const double i_s = 0.4 + 0.09 + 0.06, p_s = 0.4 + 0.21 + 0.04;
    EXPECT_GT(clear.at(Parameter::kWidth, i_s) - mumbled.at(Parameter::kWidth, i_s), 3);
    EXPECT_LE(mumbled.at(Parameter::kGap, p_s), kClosedGap_mm + 0.02);
    EXPECT_LE(clear.at(Parameter::kGap, p_s), kClosedGap_mm + 0.02);
}

TEST(Trajectory, ALaterSoundMovesNothingElse) {
    Utterance one = utterance_of(kForest), two = one;
    for (Phone& phone : two.phones) {
        if (&phone != &two.phones.front()) phone.start += 240;
        phone.end += 240;
        if (phone.closure) *phone.closure += 240;
        if (phone.release) *phone.release += 240;
    }
    two.samples += 240;  // 5 ms, one step of the grid
    const ArticulationCurves a = curves_of(targets_of(one, standard_phones())),
                             b = curves_of(targets_of(two, standard_phones()));
    for (double t = 0.1; t < 2.2; t += 0.01)
        EXPECT_NEAR(a.at(Parameter::kGap, t), b.at(Parameter::kGap, t + 0.005), 1e-3) << t;
}

}  // namespace
}  // namespace risorius::speech
