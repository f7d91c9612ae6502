// SPDX-License-Identifier: MIT
#include "risorius/talk/speech_columns.h"

#include <cmath>
#include <cstdio>

namespace risorius::talk {

SpeechColumns::SpeechColumns(std::vector<PlacedUtterance> utterances, const rig::Head& head,
                             const rig::RigDescription& rig)
    : utterances_(std::move(utterances)),
      table_(speech::PhoneTable::standard()),
      measures_(head, rig) {}

std::string SpeechColumns::names() {
    return "\tphone\tword\tviseme\tlip_gap_mm\tlip_width_change_mm\tlip_area_mm2\t"
           "lip_protrusion_upper_mm\tlip_protrusion_lower_mm\tlip_contact_mm\tlip_teeth_mm";
}

std::string SpeechColumns::cells(double t_s, const face::FacePose& pose) const {
    std::string phone(speech::kPause), word, viseme = table_.phone(phone, "pause").viseme;
    for (const PlacedUtterance& placed : utterances_) {
        const speech::Utterance& u = placed.utterance;
        const auto sample =
            static_cast<std::int64_t>(std::floor((t_s - placed.start_s) * u.rate_hz + 1e-6));
        for (const speech::Phone& one : u.phones)
            if (sample >= one.start && sample < one.end && !one.is_pause()) {
                phone = one.text();
                viseme = table_.phone(one.symbol, "phone").viseme;
            }
        if (const int index = u.word_at(sample); index >= 0)
            word = u.words[static_cast<std::size_t>(index)].text;
    }
    for (char& c : word)
        if (c == '\t' || c == '\n' || c == '\r') c = ' ';
    std::string out = "\t" + phone + "\t" + word + "\t" + viseme;
    const Mouth mouth = measures_.at(pose);
    for (const double value : {mouth.gap, mouth.width, mouth.area_mm2, mouth.upper_protrusion,
                               mouth.lower_protrusion, mouth.contact_mm, mouth.teeth}) {
        char text[48];
        std::snprintf(text, sizeof text, "\t%.4f", value + 0.0);
        out += text;
    }
    return out;
}

}  // namespace risorius::talk
