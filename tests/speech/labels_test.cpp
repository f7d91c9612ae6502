// SPDX-License-Identifier: MIT
#include "risorius/speech/labels.h"

#include <gtest/gtest.h>

#include "message_of.h"
#include "speech/curve_helpers.h"
#include "temporary_folder.h"

namespace risorius::speech {
namespace {

constexpr int kRate = 48000;

/// "0-4800:a 4800-9600:p" of a tier.
std::string listed(const LabelTier& tier) {
    std::string out;
    for (const Label& label : tier.labels)
        out += (out.empty() ? "" : " ") + std::to_string(label.start) + "-" +
               std::to_string(label.end) + ":" + label.text;
    return out;
}

std::string parsed(const std::string& text, const std::string& format) {
    std::string out;
    for (const LabelTier& tier : parse_labels(text, format, "file", kRate).tiers)
        out += (out.empty() ? "" : " | ") + tier.name + " " + listed(tier);
    return out;
}

const std::string kLong =
    "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\nxmin = 0 \nxmax = 0.3 \n"
    "tiers? <exists> \nsize = 2 \nitem []: \n    item [1]:\n        class = \"IntervalTier\" \n"
    "        name = \"words\" \n        xmin = 0 \n        xmax = 0.3 \n"
    "        intervals: size = 1 \n        intervals [1]:\n            xmin = 0 \n"
    "            xmax = 0.3 \n            text = \"say \"\"ap\"\"\" \n    item [2]:\n"
    "        class = \"IntervalTier\" \n        name = \"phones\" \n        xmin = 0 \n"
    "        xmax = 0.3 \n        intervals: size = 2 \n        intervals [1]:\n"
    "            xmin = 0 \n            xmax = 0.1000104 \n            text = \"a\" \n"
    "        intervals [2]:\n            xmin = 0.1000104 \n            xmax = 0.3 \n"
    "            text = \"p\" \n";
const std::string kShort =
    "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n0.3\n<exists>\n2\n"
    "\"IntervalTier\"\n\"words\"\n0\n0.3\n1\n0\n0.3\n\"say \"\"ap\"\"\"\n\"IntervalTier\"\n"
    "\"phones\"\n0\n0.3\n2\n0\n0.1000104\n\"a\"\n0.1000104\n0.3\n\"p\"\n";

std::string utf16(const std::string& ascii, bool big_endian) {
    std::string out = big_endian ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : ascii) {
        if (big_endian) out += '\0';
        out += c;
        if (!big_endian) out += '\0';
    }
    return out;
}

TEST(Labels, TextGridsOfAllFormsGiveTheSameSamples) {
    const std::string expected = "words 0-14400:say \"ap\" | phones 0-4800:a 4800-14400:p";
    EXPECT_EQ(parsed(kLong, "textgrid"), expected);
    EXPECT_EQ(parsed(kShort, "textgrid"), expected);
    EXPECT_EQ(parsed(utf16(kLong, true), "textgrid"), expected);
    EXPECT_EQ(parsed(utf16(kShort, false), "textgrid"), expected);
    EXPECT_EQ(parsed("\xEF\xBB\xBF" + kShort, "textgrid"), expected);
}

TEST(Labels, FormatsWithALineEachAreExactToTheSample) {
    EXPECT_EQ(parsed(";; comment\nrec 1 0.1 0.05 a 0.9\nrec 1 0.15 0.1 p\n", "ctm"),
              " 4800-7200:a 7200-12000:p");
    EXPECT_EQ(parsed("0 1000000 a\n1000000 2500000 p -3.5 word\n", "lab"),
              "phones 0-4800:a 4800-12000:p | words 4800-12000:word");
    EXPECT_EQ(parsed("0.0 0.1 a\n0.1 0.25 p\n", "lab"), "phones 0-4800:a 4800-12000:p");
    EXPECT_EQ(parsed("0,000000\t0,100000\ta\r\n\\\t100\t200\r\n0.1\t0.25\tp\r\n", "audacity"),
              " 0-4800:a 4800-12000:p");
    EXPECT_EQ(parsed("; voice\na 100 0 120 50 130\np 33.3\na 33.4 ; end\n", "pho"),
              "phones 0-4800:a 4800-6398:p 6398-8002:a");
    EXPECT_EQ(parsed("signal x\n#\n 0.1 121 a\n 0.25 121 p\n", "seg"),
              "phones 0-4800:a 4800-12000:p");
}

TEST(Labels, SubtitlesAndVisemesOfServicesAreRead) {
    EXPECT_EQ(
        parsed("WEBVTT\n\n1\n00:00.100 --> 00:00:00.250 align:left\nHello <b>you</b>\nthere\n",
               "vtt"),
        "sentences 4800-12000:Hello you there");
    EXPECT_EQ(parsed("1\n00:00:00,100 --> 00:00:00,250\nHello\n", "srt"),
              "sentences 4800-12000:Hello");
    EXPECT_EQ(parsed("0.00\tX\n0.10\tA\n0.25\tX\n", "rhubarb"), "visemes 0-4800:X 4800-12000:A");
    EXPECT_EQ(
        parsed("<rhubarbResult><mouthCues><mouthCue start=\"0.00\" end=\"0.10\">X</mouthCue>"
               "<mouthCue start=\"0.10\" end=\"0.25\">A</mouthCue></mouthCues></rhubarbResult>",
               "rhubarb"),
        "visemes 0-4800:X 4800-12000:A");
    EXPECT_EQ(
        parsed("{\"mouthCues\": [{\"start\": 0, \"end\": 0.1, \"value\": \"X\"}]}", "rhubarb"),
        "visemes 0-4800:X");
    EXPECT_EQ(parsed("[{\"audioOffset\": 1000000, \"visemeId\": 21}, {\"audioOffset\": 2500000, "
                     "\"visemeId\": 0}]",
                     "azure"),
              "visemes 4800-12000:21 12000-16800:0");
    EXPECT_EQ(parsed("{\"time\":100,\"type\":\"viseme\",\"value\":\"p\"}\n"
                     "{\"time\":250,\"type\":\"viseme\",\"value\":\"sil\"}\n",
                     "polly"),
              "visemes 4800-12000:p 12000-16800:sil");
    EXPECT_EQ(parsed("{\"visemes\": [\"PP\"], \"vtimes\": [100], \"vdurations\": [150], \"words\": "
                     "[\"a\"], \"wtimes\": [0], \"wdurations\": [250]}",
                     "headtts"),
              "visemes 4800-12000:PP | words 0-12000:a");
    EXPECT_EQ(parsed("<ANNOTATION_DOCUMENT><TIME_ORDER><TIME_SLOT TIME_SLOT_ID=\"t1\" "
                     "TIME_VALUE=\"100\"/><TIME_SLOT TIME_SLOT_ID=\"t2\" TIME_VALUE=\"250\"/>"
                     "</TIME_ORDER><TIER TIER_ID=\"phones\"><ANNOTATION><ALIGNABLE_ANNOTATION "
                     "ANNOTATION_ID=\"a\" TIME_SLOT_REF1=\"t1\" TIME_SLOT_REF2=\"t2\">"
                     "<ANNOTATION_VALUE>p&amp;</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION>"
                     "</ANNOTATION></TIER></ANNOTATION_DOCUMENT>",
                     "eaf"),
              "phones 4800-12000:p&");
}

TEST(Labels, ErrorsNameFileAndLine) {
    const auto message = [](const std::string& text, const std::string& format) {
        return message_of([&] { parse_labels(text, format, "anna", kRate); });
    };
    EXPECT_EQ(message("rec 1 0.1 x a\n", "ctm"),
              "anna:1: expected a duration in seconds, found \"x\"");
    EXPECT_EQ(message("rec 1 0 0.1 a\nrec 1 0.05 0.1 p\n", "ctm"),
              "anna:2: expected a start from 0.1 s on, where the label before ends, found 0.05 s");
    EXPECT_EQ(message("rec 1 0 0.1 a\nother 1 0.1 0.1 p\n", "ctm"),
              "anna:2: expected labels of one channel of one recording, rec 1, found \"other 1\"");
    EXPECT_EQ(message("0 -5000 a\n", "lab"),
              "anna:1: expected a time in [0, 44739.242645833336] s, found -5e-04");
    EXPECT_EQ(message(kShort.substr(0, kShort.find("\"say")), "textgrid"),
              "anna:15: expected the text of a label, found the end of the file");
    std::string gap = kShort;
    gap.replace(gap.rfind("0.1000104"), 9, "0.2");
    EXPECT_EQ(message(gap, "textgrid"),
              "anna:26: expected a start at 0.1 s, where the label before ends, found 0.2 s");
    EXPECT_EQ(message("", "ctn").substr(0, 14), "anna: expected");
}

TEST(Labels, BecomeAnUtteranceWithPausesWordsAndClosures) {
    const auto made = [](const std::string& text, const std::string& format,
                         std::optional<std::int64_t> samples = {}) {
        return utterance_of_labels(parse_labels(text, format, "f", kRate), {}, standard_phones(),
                                   kRate, samples, "f");
    };
    const Utterance grid = made(kLong, "textgrid");
    ASSERT_EQ(grid.phones.size(), 2u);
    EXPECT_EQ(grid.phones[1].symbol, "p");
    EXPECT_EQ(grid.words[0].text, "say \"ap\"");
    const Utterance ctm = made("r 1 0.1 0.1 AH1\nr 1 0.3 0.1 CH\n", "ctm", 24000);
    std::string symbols;
    for (const Phone& phone : ctm.phones) symbols += phone.symbol;
    EXPECT_EQ(symbols, "_ʌ_tʃ_");
    EXPECT_EQ(ctm.phones.back().end, 24000);
    const Utterance visemes = made("0.00\tX\n0.10\tA\n0.20\tX\n0.3\tX\n", "rhubarb");
    ASSERT_TRUE(visemes.phones[1].closure);
    EXPECT_EQ(*visemes.phones[1].closure, 9600 - 2880);
    EXPECT_EQ(message_of([&] { made("r 1 0.1 0.1 a\nr 1 0.3 0.1 p\n", "ctm", 15000); }),
              "f:2: expected a label within the sound, which ends at 0.3125 s, found one that "
              "ends at 0.4 s");
    EXPECT_EQ(message_of([&] { made("WEBVTT\n\n00:00.100 --> 00:00.250\nHi\n", "vtt"); }),
              "f: expected a tier of phones, found only \"sentences\"");
}

TEST(Labels, WhatIsWrittenIsReadAgain) {
    Utterance u = utterance_of({{"m", .0837}, {"ɑ", .1511}, {"p", .0919}, {"u", .12}});
    u.words.push_back({"mapu", u.phones[1].start, u.phones[4].end});
    const Utterance again = utterance_of_labels(
        parse_labels(textgrid_text(u, standard_phones()), "textgrid", "f", kRate), {},
        standard_phones(), kRate, {}, "f");
    ASSERT_EQ(again.phones.size(), u.phones.size());
    for (std::size_t i = 0; i < u.phones.size(); ++i) {
        EXPECT_EQ(again.phones[i].start, u.phones[i].start);
        EXPECT_EQ(again.phones[i].end, u.phones[i].end);
        EXPECT_EQ(again.phones[i].symbol, u.phones[i].symbol);
    }
    EXPECT_EQ(again.words[0].text, "mapu");
    EXPECT_EQ(parse_labels(ctm_text(u), "ctm", "f", kRate).tiers[0].labels.size(), 4u);
    const LabelFile htk = parse_labels(htk_text(u), "lab", "f", kRate);
    EXPECT_EQ(htk.tiers[0].labels.front().start, u.phones.front().start);
    EXPECT_EQ(htk.tiers[0].labels.back().end, u.phones.back().end);
    EXPECT_EQ(webvtt_text(u), "WEBVTT\n\n00:00:00.400 --> 00:00:00.847\nmapu\n");
    EXPECT_EQ(parsed(rhubarb_text(u, standard_phones()), "rhubarb").substr(0, 40),
              "visemes 0-19200:X 19200-23218:A 23218-30");
}

TEST(Utterances, HaveNoMorePhonesAndMinutesThanMemoryAndTimeAllow) {
    const auto complaint = [](const Utterance& utterance) {
        return message_of([&] { check_utterance(utterance, standard_phones(), "here"); });
    };
    EXPECT_EQ(complaint(utterance_of(std::vector<Timed>(29999, {"m", 0.05}))),
              "here:/phones: expected at most 30000 phones, found 30001");
    EXPECT_EQ(complaint(utterance_of({{"_", 7 * 3600}}, 1)).substr(0, 61),
              "here:/samples: expected at most 30 minutes of sound, found 42");
    EXPECT_EQ(complaint(utterance_of({{"m", 61}})),
              "here:/phones/1/end: expected a phone of at most 60 s, found 61 s");
}

TEST(Utterances, AreWrittenAndReadWithTheSameSamples) {
    Utterance u = utterance_of({{"m", .0837}, {"ɑ", .1511}, {"p", .0919}, {"u", .12}});
    u.phones[2].length_mark = 2;
    u.phones[2].stress = 2;
    u.language = "fi";
    u.words.push_back({"mapu", u.phones[1].start, u.phones[4].end});
    u.source = {"espeak-ng", "1.51", ""};
    const TemporaryFolder folder;
    std::ofstream(folder / "a.json") << utterance_text(u);
    const Utterance again = read_utterance(folder / "a.json", standard_phones());
    EXPECT_EQ(utterance_text(again), utterance_text(u));
    EXPECT_EQ(again.phones[3].closure, u.phones[3].closure);
    u.phones[2].start += 1;
    std::ofstream(folder / "a.json") << utterance_text(u);
    EXPECT_NE(message_of([&] {
                  read_utterance(folder / "a.json", standard_phones());
              }).find("a.json:/phones/2/start: expected 23218, where the phone before ends"),
              std::string::npos);
}

}  // namespace
}  // namespace risorius::speech
