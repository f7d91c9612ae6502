// SPDX-License-Identifier: MIT
#include "risorius/talk/detail/voice_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/text_lines.h"

namespace risorius::talk {

namespace {

using speech::Phone;
using speech::SplitPhone;
using speech::Utterance;

constexpr double kShortestPhone_s = 0.003;

template <class Number>
Number integer_in(std::string_view text, const std::string& place) {
    Number value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || value < 0)
        throw Error(place, "a whole number", in_quotes(shortened_text(text, 40)));
    return value;
}

/// The characters [start, start + length) of UTF-8, from 1.
std::string characters(const std::string& text, int start, int length) {
    std::string out;
    int at = 1;
    for (std::size_t i = 0; i < text.size(); ++at) {
        const std::size_t size =
            std::max<std::size_t>(1, character_size(std::string_view(text).substr(i)));
        if (at >= start && at < start + length) out += text.substr(i, size);
        i += size;
    }
    return out;
}

/// Copies length and stress from `from` to phones that are the same in the best alignment of both lists.
void copy_marks(const std::vector<SplitPhone>& from, std::vector<Phone*>& to) {
    const std::size_t n = from.size(), m = to.size();
    std::vector<std::vector<int>> cost(n + 1, std::vector<int>(m + 1, 0));
    for (std::size_t i = 0; i <= n; ++i)
        for (std::size_t j = 0; j <= m; ++j) {
            if (i == 0 || j == 0) {
                cost[i][j] = static_cast<int>(i + j);
                continue;
            }
            const int differs = from[i - 1].symbol == to[j - 1]->symbol ? 0 : 2;
            cost[i][j] =
                std::min({cost[i - 1][j - 1] + differs, cost[i - 1][j] + 1, cost[i][j - 1] + 1});
        }
    for (std::size_t i = n, j = m; i > 0 && j > 0;) {
        const int differs = from[i - 1].symbol == to[j - 1]->symbol ? 0 : 2;
        if (cost[i][j] == cost[i - 1][j - 1] + differs) {
            --i;
            --j;
            if (differs) continue;
            to[j]->length_mark = std::max(to[j]->length_mark, from[i].length_mark);
            to[j]->stress = std::max(to[j]->stress, from[i].stress);
        } else if (cost[i][j] == cost[i - 1][j] + 1) {
            --i;
        } else {
            --j;
        }
    }
}

class Builder {
  public:
    Builder(const VoiceTable& table, const std::string& text, const VoiceSymbols& symbols,
            const speech::PhoneTable& phones)
        : table_(table), text_(text), symbols_(symbols), phones_(phones) {}

    Utterance build(int rate_hz, std::int64_t samples) {
        out_.rate_hz = rate_hz;
        out_.samples = samples;
        out_.source.program = table_.program;
        add_phones();
        add_marks();
        add_spans("word", out_.words);
        add_spans("sentence", out_.sentences);
        for (Phone& phone : out_.phones)
            if (const auto found = symbols_.replace.find(phone.symbol);
                found != symbols_.replace.end())
                phone.symbol = found->second;
        return std::move(out_);
    }

  private:
    void add_phones() {
        std::vector<const VoiceRow*> events;
        for (const VoiceRow& row : table_.rows)
            if (row.kind == "phone") events.push_back(&row);
        const auto shortest = static_cast<std::int64_t>(kShortestPhone_s * out_.rate_hz);
        for (std::size_t i = 0; i < events.size(); ++i) {
            const std::int64_t start = std::min(events[i]->sample, out_.samples);
            std::int64_t end = i + 1 < events.size() ? events[i + 1]->sample : out_.samples;
            end = std::min(end, out_.samples);
            if (end - start < shortest) {
                // Two phones at one time are one; a pause counts less than a sound.
                if (i + 1 == events.size() || end <= start) continue;
            }
            add_event(*events[i], start, end);
        }
        if (out_.phones.empty()) throw Error("voice", "a text with at least one sound", "none");
    }

    void add_event(const VoiceRow& event, std::int64_t start, std::int64_t end) {
        const auto parts = phones_.split(event.symbol, symbols_.set, "voice: " + event.symbol);
        for (Phone& phone : speech::timed_phones(parts, start, end)) {
            if (phone.is_pause() && !out_.phones.empty() && out_.phones.back().is_pause())
                out_.phones.back().end = phone.end;
            else
                out_.phones.push_back(std::move(phone));
        }
        // Phones touch each other, also where an event was left out.
        for (std::size_t i = 1; i < out_.phones.size(); ++i)
            out_.phones[i - 1].end = out_.phones[i].start;
    }

    void add_marks() {
        std::vector<SplitPhone> marked;
        for (const VoiceRow& row : table_.rows) {
            if (row.kind != "ipa") continue;
            std::string_view rest = row.symbol;
            while (!rest.empty()) {
                const std::size_t end = std::min(rest.find(' '), rest.size());
                const std::string word(rest.substr(0, end));
                rest.remove_prefix(std::min(end + 1, rest.size()));
                if (word.empty()) continue;
                for (const SplitPhone& part : phones_.split(word, symbols_.set, "voice: " + word))
                    if (part.symbol != speech::kPause) marked.push_back(part);
            }
        }
        // The mark of stress stands before the syllable; it is the vowel that is stressed.
        for (std::size_t i = 0; i < marked.size(); ++i) {
            if (marked[i].stress == 0 || is_vowel(marked[i].symbol)) continue;
            for (std::size_t k = i + 1; k < marked.size(); ++k)
                if (is_vowel(marked[k].symbol)) {
                    std::swap(marked[k].stress, marked[i].stress);
                    break;
                }
        }
        std::vector<Phone*> spoken;
        for (Phone& phone : out_.phones)
            if (!phone.is_pause()) spoken.push_back(&phone);
        copy_marks(marked, spoken);
    }

    bool is_vowel(const std::string& symbol) const {
        return speech::is_vowel(phones_.phone(symbol, "voice").kind);
    }

    void add_spans(const std::string& kind, std::vector<speech::Span>& spans) {
        std::vector<const VoiceRow*> rows;
        for (const VoiceRow& row : table_.rows)
            if (row.kind == kind) rows.push_back(&row);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const int next = i + 1 < rows.size() ? rows[i + 1]->char_start : 1 << 30;
            const int length = kind == "word" ? rows[i]->char_length : next - rows[i]->char_start;
            speech::Span span{characters(text_, rows[i]->char_start, length), rows[i]->sample,
                              i + 1 < rows.size() ? rows[i + 1]->sample : out_.samples};
            // A word ends where a pause begins.
            for (const Phone& phone : out_.phones)
                if (phone.is_pause() && phone.start > span.start && phone.start < span.end) {
                    span.end = phone.start;
                    break;
                }
            while (!span.text.empty() && span.text.back() == ' ') span.text.pop_back();
            if (span.end > span.start) spans.push_back(std::move(span));
        }
    }

    const VoiceTable& table_;
    const std::string& text_;
    const VoiceSymbols& symbols_;
    const speech::PhoneTable& phones_;
    Utterance out_;
};

}  // namespace

VoiceTable parse_voice_table(const std::string& text, const std::string& name) {
    VoiceTable out;
    bool named = false;
    for (TextLines lines(text); lines.next();) {
        std::string_view line = lines.line();
        const std::string place = name + ":" + std::to_string(lines.number());
        if (line.starts_with("# ")) {
            out.program = readable_text(line.substr(2));
            continue;
        }
        std::vector<std::string> cells(1);
        for (const char c : line) {
            if (c == '\t')
                cells.emplace_back();
            else
                cells.back() += c;
        }
        if (cells.size() != 5)
            throw Error(place, "kind, sample, char_start, char_length and symbol",
                        in_quotes(shortened_text(line, 60)));
        if (!named) {
            named = true;
            continue;
        }
        out.rows.push_back({cells[0], integer_in<std::int64_t>(cells[1], place),
                            integer_in<int>(cells[2], place), integer_in<int>(cells[3], place),
                            cells[4]});
    }
    return out;
}

Utterance utterance_of_voice(const VoiceTable& table, const std::string& text,
                             const VoiceSymbols& symbols, int rate_hz, std::int64_t samples,
                             const speech::PhoneTable& phones) {
    return Builder(table, text, symbols, phones).build(rate_hz, samples);
}

}  // namespace risorius::talk
