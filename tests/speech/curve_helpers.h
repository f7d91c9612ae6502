// SPDX-License-Identifier: MIT
/// \file
/// Utterances from phones and durations, for tests without a voice.
#pragma once

#include <string>
#include <vector>

#include "paths.h"
#include "risorius/speech/utterance.h"

namespace risorius::speech {

inline const PhoneTable& standard_phones() {
    static const PhoneTable one =
        PhoneTable::read_folder(std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs/standard");
    return one;
}

struct Timed {
    std::string symbol;
    double seconds;
};

/// An utterance at 48 kHz with 0.4 s of silence before and after. The stops are closed for all of their time but 10 ms.
inline Utterance utterance_of(const std::vector<Timed>& phones, double silence_s = 0.4) {
    Utterance out;
    out.rate_hz = 48000;
    const auto add = [&](const std::string& symbol, double seconds) {
        Phone phone;
        phone.symbol = symbol;
        phone.start = out.samples;
        phone.end = out.samples + std::llround(seconds * out.rate_hz);
        if (standard_phones().phone(symbol, "here").kind == PhoneClass::kClosure) {
            phone.closure = phone.start;
            phone.release = phone.end;
        }
        out.samples = phone.end;
        out.phones.push_back(phone);
    };
    add("_", silence_s);
    for (const Timed& one : phones) add(one.symbol, one.seconds);
    add("_", silence_s);
    return out;
}

}  // namespace risorius::speech
