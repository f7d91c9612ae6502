// SPDX-License-Identifier: MIT
/// \file
/// What the readers of labels share: times in samples, checks of their order, and text in UTF-16.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "risorius/speech/labels.h"

namespace risorius::speech {

/// The file that a reader parses.
struct LabelText {
    std::string text;  ///< UTF-8, without a byte-order mark
    std::string name;  ///< for messages
    int rate_hz = 48000;

    std::string place(std::size_t line) const;
    /// The sample at a time, s. Throws Error with `place` when it is negative or beyond kMaxSamples.
    std::int64_t sample(double time_s, const std::string& place) const;
    /// The same for a number in the file. `unit_s`: its unit, s.
    std::int64_t sample(std::string_view number, double unit_s, const std::string& place) const;
};

/// Overlaps of labels up to this are rounding, and are cut.
inline constexpr double kSlack_s = 0.001;

/// How gaps between labels are taken.
enum class Gaps { kPauses, kErrors };

/// Checks that labels rise and do not overlap. Cuts overlaps of up to a millisecond. Throws Error with the place of the label.
void check_tier(LabelTier& tier, int rate_hz, Gaps gaps);

/// Bytes in UTF-8 or UTF-16 (with a byte-order mark, or told by its zeros) as UTF-8 without a mark. Lone surrogates become U+FFFD.
std::string utf8_of(const std::string& bytes, const std::string& name);

// The readers, one for each format. The result is not yet checked by check_tier().
LabelFile parse_textgrid(const LabelText& file);
LabelFile parse_ctm(const LabelText& file);
LabelFile parse_lab(const LabelText& file);
LabelFile parse_audacity(const LabelText& file);
LabelFile parse_pho(const LabelText& file);
LabelFile parse_seg(const LabelText& file);
LabelFile parse_subtitles(const LabelText& file);
LabelFile parse_rhubarb(const LabelText& file);
LabelFile parse_viseme_json(const LabelText& file);
LabelFile parse_eaf(const LabelText& file);

}  // namespace risorius::speech
