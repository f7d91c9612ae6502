// SPDX-License-Identifier: MIT
#include "risorius/speech/visemes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "curve_helpers.h"
#include "risorius/speech/labels.h"

namespace risorius::speech {
namespace {

constexpr double kRate_hz = 100;

long index_of(std::string_view viseme) {
    const auto& names = oculus_visemes();
    return std::find(names.begin(), names.end(), viseme) - names.begin();
}

/// Weights every 10 ms from the first sample on.
Eigen::MatrixXd weights_of(const Utterance& said) {
    return viseme_weights(said, targets_of(said, standard_phones()), standard_phones(), 0, kRate_hz,
                          std::lround(kRate_hz * said.seconds(said.samples)));
}

std::string listed(const Utterance& said) {
    std::string out;
    for (const TimedViseme& one : visemes_of(said, standard_phones()))
        out += std::string(oculus_visemes()[static_cast<std::size_t>(one.viseme)]) + " ";
    return out;
}

TEST(Visemes, EveryPhoneOfTheTableHasOne) {
    for (const PhoneEntry& phone : standard_phones().phones()) {
        const bool neutral = phone.kind == PhoneClass::kNeutral;
        EXPECT_EQ(viseme_of(phone) < 0, neutral) << phone.symbol;
        if (is_vowel(phone.kind)) {
            EXPECT_GE(viseme_of(phone), index_of("aa")) << phone.symbol;
        } else if (phone.kind == PhoneClass::kClosure) {
            EXPECT_EQ(viseme_of(phone), index_of("PP")) << phone.symbol;
        } else if (!neutral && phone.symbol != kPause) {
            EXPECT_NE(viseme_of(phone), index_of("sil")) << phone.symbol;
        }
    }
}

TEST(Visemes, LastAsLongAsTheirPhonesAndClosures) {
    // p and m share one closure; h has the shape of what follows.
    const Utterance said = utterance_of(
        {{"ɑ", 0.1}, {"p", 0.1}, {"m", 0.05}, {"h", 0.04}, {"y", 0.1}, {"n", 0.06}, {"l", 0.05}});
    EXPECT_EQ(listed(said), "aa PP ou nn ");
    const std::vector<TimedViseme> list = visemes_of(said, standard_phones());
    EXPECT_EQ(list[1].start, std::lround(0.5 * said.rate_hz));
    EXPECT_EQ(list[1].end, std::lround(0.65 * said.rate_hz));
    EXPECT_EQ(list[2].start, list[1].end);
    EXPECT_EQ(list[2].end - list[2].start, std::lround(0.14 * said.rate_hz));
}

TEST(Visemes, WeightsAreThoseOfOneMouthThatClosesAndComesToRest) {
    const Utterance said =
        utterance_of({{"ɑ", 0.15}, {"p", 0.1}, {"i", 0.15}, {"f", 0.1}, {"u", 0.15}});
    const Eigen::MatrixXd w = weights_of(said);
    EXPECT_GE(w.minCoeff(), 0);
    for (long k = 0; k < w.rows(); ++k) EXPECT_NEAR(w.row(k).sum(), 1, 1e-9);
    const auto mean = [&](const char* viseme, double from_s, double to_s) {
        const long a = std::lround(kRate_hz * from_s), b = std::lround(kRate_hz * to_s);
        return w.col(index_of(viseme)).segment(a, b - a).mean();
    };
    for (long k = 55; k <= 65; ++k) EXPECT_DOUBLE_EQ(w(k, index_of("PP")), 1) << k;
    EXPECT_GT(mean("aa", 0.44, 0.49), 0.7);
    EXPECT_GT(mean("ih", 0.69, 0.75), 0.7);
    EXPECT_GT(mean("FF", 0.83, 0.87), 0.95);
    EXPECT_GT(mean("ou", 0.96, 1.02), 0.7);
    EXPECT_GT(w(0, index_of("sil")), 0.98);
    EXPECT_GT(w(w.rows() - 1, index_of("sil")), 0.9);
    // Shapes come and go within two frames at 60 per second at the fastest.
    EXPECT_LT((w.bottomRows(w.rows() - 1) - w.topRows(w.rows() - 1)).cwiseAbs().maxCoeff(), 0.65);
}

TEST(Visemes, VowelsWithoutAVisemeAreMixtures) {
    const Utterance said = utterance_of({{"æ", 0.3}, {"t", 0.08}, {"ø", 0.3}});
    const Eigen::MatrixXd w = weights_of(said);
    const Eigen::RowVectorXd ae = w.middleRows(50, 10).colwise().mean(),
                             oe = w.middleRows(90, 10).colwise().mean();
    EXPECT_GT(ae[index_of("aa")], 0.4);
    EXPECT_GT(ae[index_of("E")] + ae[index_of("ih")], 0.1);
    EXPECT_GT(oe[index_of("oh")], 0.4);
    EXPECT_GT(oe[index_of("ou")] + oe[index_of("E")] + oe[index_of("ih")], 0.1);
}

TEST(Visemes, LipsRoundBeforeTheirVowel) {
    const Utterance said = utterance_of({{"i", 0.15}, {"s", 0.08}, {"t", 0.08}, {"u", 0.15}});
    const Eigen::MatrixXd w = weights_of(said);
    const long u = std::lround(kRate_hz * (0.4 + 0.31));
    const double rounded = w(u, index_of("ou")) + w(u, index_of("oh"));
    EXPECT_GT(rounded, 0.2);
    EXPECT_LT(w(u - 20, index_of("ou")), 0.1);
}

TEST(Visemes, TheFileIsReadAgainToTheMillisecond) {
    Utterance said = utterance_of({{"ɑ", 0.1}, {"p", 0.1}, {"u", 0.1}});
    said.words.push_back({"apu", said.rate_hz * 2 / 5, said.rate_hz * 7 / 10});
    said.language = "fi";
    const std::string text = visemes_text(said, standard_phones());
    EXPECT_EQ(text, visemes_text(said, standard_phones()));
    const Json json = Json::parse(text);
    EXPECT_EQ(json["visemes"], Json({"aa", "PP", "U"}));
    EXPECT_EQ(json["vtimes"], Json({400.0, 500.0, 600.0}));
    EXPECT_EQ(json["vdurations"], Json({100.0, 100.0, 100.0}));
    EXPECT_EQ(json["words"], Json({"apu"}));
    EXPECT_EQ(json["wtimes"], Json({400.0}));
    const Json& weights = json["weights"];
    const auto dt = weights["dt"].get<std::vector<double>>();
    EXPECT_EQ(weights["vs"].size(), kVisemeCount);
    for (const auto& column : weights["vs"]) EXPECT_EQ(column.size(), dt.size());
    const double length_ms = std::accumulate(dt.begin(), dt.end(), 0.0);
    EXPECT_GT(length_ms, 1100);
    EXPECT_NEAR(length_ms, 1e3 * static_cast<double>(dt.size()) / 60, 1e-3);
    const LabelFile read = parse_labels(text, "headtts", "x.json", said.rate_hz);
    const Utterance again =
        utterance_of_labels(read, {}, standard_phones(), said.rate_hz, said.samples, "x.json");
    EXPECT_EQ(again.phones[2].symbol, "p");
    EXPECT_EQ(again.phones[2].start, said.phones[2].start);
    EXPECT_EQ(again.words[0].text, "apu");
}

}  // namespace
}  // namespace risorius::speech
