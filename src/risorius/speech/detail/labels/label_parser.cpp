// SPDX-License-Identifier: MIT
#include "risorius/speech/detail/labels/label_parser.h"

#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/text_lines.h"
#include "risorius/speech/detail/table_lines.h"

namespace risorius::speech {

namespace {

void append_utf8(std::uint32_t code, std::string& out) {
    const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
    if (code < 0x80) {
        put(code);
    } else if (code < 0x800) {
        put(0xc0 | code >> 6);
        put(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        put(0xe0 | code >> 12);
        put(0x80 | (code >> 6 & 0x3f));
        put(0x80 | (code & 0x3f));
    } else {
        put(0xf0 | code >> 18);
        put(0x80 | (code >> 12 & 0x3f));
        put(0x80 | (code >> 6 & 0x3f));
        put(0x80 | (code & 0x3f));
    }
}

std::string utf8_of_utf16(std::string_view bytes, bool big_endian) {
    const auto unit = [&](std::size_t i) -> std::uint32_t {
        const auto a = static_cast<unsigned char>(bytes[i]),
                   b = static_cast<unsigned char>(bytes[i + 1]);
        return big_endian ? a << 8 | b : b << 8 | a;
    };
    constexpr std::uint32_t kUnknown = 0xfffd;
    std::string out;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        const std::uint32_t one = unit(i);
        if (one < 0xd800 || one > 0xdfff) {
            append_utf8(one, out);
            continue;
        }
        const std::uint32_t two = i + 3 < bytes.size() ? unit(i + 2) : 0;
        if (one > 0xdbff || two < 0xdc00 || two > 0xdfff) {
            append_utf8(kUnknown, out);
            continue;
        }
        append_utf8(0x10000 + ((one - 0xd800) << 10 | (two - 0xdc00)), out);
        i += 2;
    }
    return out;
}

}  // namespace

std::string LabelText::place(std::size_t line) const { return line_place(name, line); }

std::int64_t LabelText::sample(double time_s, const std::string& place) const {
    const double sample = std::round(time_s * rate_hz);
    if (!(sample >= 0 && sample <= static_cast<double>(kMaxSamples)))
        throw Error(
            place,
            "a time in [0, " + format_number(static_cast<double>(kMaxSamples) / rate_hz) + "] s",
            format_number(time_s));
    return static_cast<std::int64_t>(sample);
}

std::int64_t LabelText::sample(std::string_view number, double unit_s,
                               const std::string& place) const {
    return sample(number_in(number, place, "a time") * unit_s, place);
}

std::string utf8_of(const std::string& bytes, const std::string& name) {
    using namespace std::string_view_literals;
    const std::string_view text = bytes;
    if (text.starts_with("\xFF\xFE"sv) && !text.starts_with("\xFF\xFE\0\0"sv))
        return utf8_of_utf16(text.substr(2), false);
    if (text.starts_with("\xFE\xFF"sv)) return utf8_of_utf16(text.substr(2), true);
    if (text.size() > 3 && text[0] == 0 && text[1] != 0) return utf8_of_utf16(text, true);
    if (text.size() > 3 && text[0] != 0 && text[1] == 0 && text[2] != 0)
        return utf8_of_utf16(text, false);
    return text_of_bytes(bytes, name);
}

void check_tier(LabelTier& tier, int rate_hz, Gaps gaps) {
    const auto slack = static_cast<std::int64_t>(kSlack_s * rate_hz);
    const auto time = [&](std::int64_t sample) {
        return format_number(static_cast<double>(sample) / rate_hz) + " s";
    };
    std::int64_t before = 0;
    for (std::size_t i = 0; i < tier.labels.size(); ++i) {
        Label& label = tier.labels[i];
        if (label.end < label.start)
            throw Error(label.place, "an end from " + time(label.start) + " on", time(label.end));
        if (i > 0 && label.start < before) {
            if (label.start < before - slack)
                throw Error(label.place,
                            "a start from " + time(before) + " on, where the label before ends",
                            time(label.start));
            label.start = before;
            label.end = std::max(label.end, before);
        }
        if (i > 0 && label.start > before && gaps == Gaps::kErrors) {
            if (label.start > before + slack)
                throw Error(label.place,
                            "a start at " + time(before) + ", where the label before ends",
                            time(label.start));
            label.start = before;
        }
        before = label.end;
    }
    // What is shorter than half a sample is gone.
    std::erase_if(tier.labels, [](const Label& label) { return label.end == label.start; });
}

}  // namespace risorius::speech
