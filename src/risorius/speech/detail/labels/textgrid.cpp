// SPDX-License-Identifier: MIT
// Reads and writes TextGrid files of Praat, in their long and their short form.
//
// Praat itself looks for free-standing numbers, texts in quotes and flags in angle brackets, in this order, and skips every
// other word. So one reader is enough for both forms.
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/speech/detail/labels/label_parser.h"
#include "risorius/speech/detail/table_lines.h"

namespace risorius::speech {

namespace {

constexpr double kMaxLabels = 1e7;

class Tokens {
  public:
    explicit Tokens(const LabelText& file) : file_(file), text_(file.text) {}

    std::string place() const { return file_.place(line_); }

    double number(const char* what) {
        next(what);
        if (kind_ != Kind::kNumber) throw Error(place(), what, found());
        return number_in(token_, place(), what);
    }
    std::int64_t count(const char* what) {
        const double value = number(what);
        if (!(value >= 0 && value <= kMaxLabels && value == std::floor(value)))
            throw Error(place(), what, format_number(value));
        return static_cast<std::int64_t>(value);
    }
    std::string text(const char* what) {
        next(what);
        if (kind_ != Kind::kText) throw Error(place(), what, found());
        return token_;
    }
    bool flag(const char* what) {
        next(what);
        if (kind_ != Kind::kFlag) throw Error(place(), what, found());
        return token_ == "<exists>";
    }

  private:
    enum class Kind { kNumber, kText, kFlag };

    std::string found() const { return in_quotes(shortened_text(token_, 60)); }

    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

    void next(const char* what) {
        for (;;) {
            while (at_ < text_.size() && is_space(text_[at_])) step();
            if (at_ >= text_.size()) throw Error(place(), what, "the end of the file");
            const char c = text_[at_];
            if (c == '"') return quoted();
            if (c == '!') {  // a comment
                while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
                continue;
            }
            const std::size_t begin = at_;
            while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
            token_ = std::string(text_.substr(begin, at_ - begin));
            if (c == '<' && token_.back() == '>') {
                kind_ = Kind::kFlag;
                return;
            }
            if (token_.find_first_not_of("+-.0123456789eE") == std::string::npos &&
                token_.find_first_of("0123456789") != std::string::npos) {
                kind_ = Kind::kNumber;
                return;
            }
        }
    }

    void quoted() {
        const std::string begin = place();
        token_.clear();
        kind_ = Kind::kText;
        for (++at_; at_ < text_.size(); step()) {
            if (text_[at_] != '"') {
                token_ += text_[at_];
            } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
                token_ += '"';
                ++at_;
            } else {
                ++at_;
                return;
            }
        }
        throw Error(begin, "a text that ends with a quote", "the end of the file");
    }

    void step() {
        if (text_[at_] == '\n' ||
            (text_[at_] == '\r' && !(at_ + 1 < text_.size() && text_[at_ + 1] == '\n')))
            ++line_;
        ++at_;
    }

    const LabelText& file_;
    std::string_view text_;
    std::size_t at_ = 0, line_ = 1;
    std::string token_;
    Kind kind_ = Kind::kText;
};

}  // namespace

LabelFile parse_textgrid(const LabelText& file) {
    Tokens tokens(file);
    if (tokens.text("\"ooTextFile\"") != "ooTextFile")
        throw Error(tokens.place(), "\"ooTextFile\"", "another kind of file");
    if (const std::string kind = tokens.text("\"TextGrid\""); kind != "TextGrid")
        throw Error(tokens.place(), "\"TextGrid\"", in_quotes(shortened_text(kind, 60)));
    LabelFile out;
    const double begin_s = tokens.number("the time at which the grid begins");
    const double end_s = tokens.number("the time at which the grid ends");
    out.samples = file.sample(end_s - begin_s, tokens.place());
    if (!tokens.flag("<exists>")) return out;
    const std::int64_t tiers = tokens.count("the number of tiers");
    for (std::int64_t t = 0; t < tiers; ++t) {
        const std::string kind = tokens.text("\"IntervalTier\" or \"TextTier\"");
        const bool points = kind == "TextTier";
        if (!points && kind != "IntervalTier")
            throw Error(tokens.place(), "\"IntervalTier\" or \"TextTier\"",
                        in_quotes(shortened_text(kind, 60)));
        LabelTier tier;
        tier.name = tokens.text("the name of a tier");
        tokens.number("the time at which the tier begins");
        tokens.number("the time at which the tier ends");
        const std::int64_t count = tokens.count("the number of labels");
        for (std::int64_t i = 0; i < count; ++i) {
            Label label;
            const auto time = [&](const char* what) {
                const double time_s = tokens.number(what) - begin_s;
                return file.sample(time_s, tokens.place());
            };
            label.start = time("the time at which a label begins");
            label.end = points ? label.start : time("the time at which a label ends");
            label.text = tokens.text("the text of a label");
            label.place = tokens.place();
            if (!points) tier.labels.push_back(std::move(label));
        }
        if (!points) out.tiers.push_back(std::move(tier));
    }
    return out;
}

namespace {

std::string in_praat_quotes(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

struct WrittenTier {
    std::string name;
    std::vector<Span> spans;  ///< without pauses
};

/// Fills the time between spans with empty ones: tiers of intervals have no gaps.
std::vector<Span> filled(const std::vector<Span>& spans, std::int64_t samples) {
    std::vector<Span> out;
    std::int64_t at = 0;
    for (const Span& span : spans) {
        if (span.end <= span.start) continue;
        if (span.start > at) out.push_back({"", at, span.start});
        out.push_back(span);
        at = span.end;
    }
    if (at < samples) out.push_back({"", at, samples});
    return out;
}

}  // namespace

std::string textgrid_text(const Utterance& utterance, const PhoneTable& table) {
    const auto time = [&](std::int64_t sample) { return format_number(utterance.seconds(sample)); };
    std::vector<WrittenTier> tiers;
    if (!utterance.sentences.empty()) tiers.push_back({"sentences", utterance.sentences});
    if (!utterance.words.empty()) tiers.push_back({"words", utterance.words});
    WrittenTier phones{"phones", {}}, visemes{"visemes", {}}, closures{"closures", {}};
    std::int64_t closed_until = 0;
    for (const Phone& phone : utterance.phones) {
        if (phone.is_pause()) continue;
        phones.spans.push_back({phone.text(), phone.start, phone.end});
        visemes.spans.push_back(
            {table.phone(phone.symbol, "phone").viseme, phone.start, phone.end});
        if (!phone.closure || !phone.release) continue;
        const std::int64_t from = std::max(*phone.closure, closed_until),
                           to = std::min(*phone.release, utterance.samples);
        if (to <= from) continue;
        closures.spans.push_back({phone.symbol, from, to});
        closed_until = to;
    }
    tiers.push_back(std::move(phones));
    tiers.push_back(std::move(visemes));
    if (!closures.spans.empty()) tiers.push_back(std::move(closures));
    const std::string end = time(utterance.samples);
    std::string out =
        "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\nxmin = 0\nxmax = " + end +
        "\ntiers? <exists>\nsize = " + std::to_string(tiers.size()) + "\nitem []:\n";
    for (std::size_t t = 0; t < tiers.size(); ++t) {
        const std::vector<Span> spans = filled(tiers[t].spans, utterance.samples);
        out += "    item [" + std::to_string(t + 1) + "]:\n        class = \"IntervalTier\"\n" +
               "        name = " + in_praat_quotes(tiers[t].name) +
               "\n        xmin = 0\n        xmax = " + end +
               "\n        intervals: size = " + std::to_string(spans.size()) + "\n";
        for (std::size_t i = 0; i < spans.size(); ++i)
            out += "        intervals [" + std::to_string(i + 1) +
                   "]:\n            xmin = " + time(spans[i].start) +
                   "\n            xmax = " + time(spans[i].end) +
                   "\n            text = " + in_praat_quotes(spans[i].text) + "\n";
    }
    return out;
}

}  // namespace risorius::speech
