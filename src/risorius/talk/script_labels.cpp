// SPDX-License-Identifier: MIT
#include "risorius/talk/script_labels.h"

#include <algorithm>
#include <cmath>

#include "risorius/speech/labels.h"

namespace risorius::talk {

namespace {

using speech::Phone;
using speech::Span;
using speech::Utterance;

/// Moves what one utterance says into the samples of another.
class Placer {
  public:
    Placer(const PlacedUtterance& placed, const Utterance& to)
        : placed_(placed), rate_hz_(to.rate_hz), samples_(to.samples) {}

    std::int64_t sample(std::int64_t own) const {
        const double s = placed_.start_s + placed_.utterance.seconds(own);
        return std::clamp<std::int64_t>(std::llround(s * rate_hz_), 0, samples_);
    }
    void add_spans(const std::vector<Span>& from, std::vector<Span>& to) const {
        for (const Span& span : from) {
            const Span moved{span.text,
                             std::max(sample(span.start), to.empty() ? 0 : to.back().end),
                             sample(span.end)};
            if (moved.end > moved.start) to.push_back(moved);
        }
    }

  private:
    const PlacedUtterance& placed_;
    int rate_hz_;
    std::int64_t samples_;
};

void add_pause(Utterance& out, std::int64_t end) {
    const std::int64_t start = out.phones.empty() ? 0 : out.phones.back().end;
    if (end <= start) return;
    Phone pause;
    pause.symbol = speech::kPause;
    pause.start = start;
    pause.end = end;
    out.phones.push_back(std::move(pause));
}

}  // namespace

Utterance utterance_of_script(const std::vector<PlacedUtterance>& said, double duration_s) {
    std::vector<const PlacedUtterance*> order;
    for (const PlacedUtterance& one : said) order.push_back(&one);
    std::stable_sort(order.begin(), order.end(),
                     [](const auto* a, const auto* b) { return a->start_s < b->start_s; });
    Utterance out;
    for (const PlacedUtterance* one : order)
        out.rate_hz = one == order.front() ? one->utterance.rate_hz
                                           : std::max(out.rate_hz, one->utterance.rate_hz);
    out.samples = std::llround(duration_s * out.rate_hz);
    for (const PlacedUtterance* one : order) {
        const Placer mover(*one, out);
        const auto& phones = one->utterance.phones;
        const auto first = std::find_if(phones.begin(), phones.end(),
                                        [](const Phone& phone) { return !phone.is_pause(); });
        if (first == phones.end()) continue;
        if (!out.phones.empty() && mover.sample(first->start) < out.phones.back().end) continue;
        for (Phone phone : phones) {
            if (phone.is_pause()) continue;
            phone.start = mover.sample(phone.start);
            phone.end = mover.sample(phone.end);
            for (auto* moment : {&phone.closure, &phone.release, &phone.voice_onset})
                if (*moment) **moment = mover.sample(**moment);
            if (phone.end <= phone.start) continue;
            add_pause(out, phone.start);
            out.phones.push_back(std::move(phone));
        }
        mover.add_spans(one->utterance.words, out.words);
        mover.add_spans(one->utterance.sentences, out.sentences);
        if (out.language.empty()) out.language = one->utterance.language;
    }
    if (!out.phones.empty()) add_pause(out, out.samples);
    return out;
}

std::string script_textgrid(const std::vector<PlacedUtterance>& said, double duration_s) {
    if (said.empty()) return "";
    const Utterance all = utterance_of_script(said, duration_s);
    return all.phones.empty() ? "" : speech::textgrid_text(all, speech::PhoneTable::standard());
}

}  // namespace risorius::talk
