// SPDX-License-Identifier: MIT
#include "risorius/render/detail/lock_style.h"

#include <algorithm>

#include "risorius/core/known_names.h"
#include "risorius/render/detail/names_of.h"
#include "risorius/render/hair_styles.h"

namespace risorius::render {
namespace {

// Own starting values, set by eye.
constexpr LockStyle kStyles[] = {
    {.name = "shaven"},
    {.name = "crop",
     .locks = 1700,
     .segments = 2,
     .across = 2,
     .top_mm = 13,
     .side_mm = 5,
     .back_mm = 8,
     .flow = HairFlow::kWhorl,
     .lift = 0.35,
     .width_mm = 2.2,
     .cap_mm = 1.8,
     .layers_mm = 1.2,
     .loft_mm = 1.6,
     .lit_cap = 0.85},
    {.name = "short_parted",
     .locks = 270,
     .segments = 9,
     .across = 2,
     .top_mm = 80,
     .side_mm = 24,
     .back_mm = 24,
     .flow = HairFlow::kParting,
     .lift = 0.4,
     .fall = 0.4,
     .width_mm = 11,
     .cap_mm = 7,
     .layers_mm = 4,
     .loft_mm = 2,
     .fray_mm = 9,
     .tip = 0.3,
     .curl_mm = 1.2,
     .pitch_mm = 45,
     .parting_mm = 32,
     .lit_cap = 0.85},
    {.name = "curly_short",
     .locks = 950,
     .segments = 9,
     .across = 2,
     .top_mm = 22,
     .side_mm = 16,
     .back_mm = 15,
     .flow = HairFlow::kRadial,
     .lift = 0.3,
     .width_mm = 3.2,
     .cap_mm = 14,
     .layers_mm = 7,
     .loft_mm = 5,
     .tip = 0.3,
     .curl_mm = 2.6,
     .pitch_mm = 12,
     .lit_cap = 0.36},
    {.name = "afro",
     .locks = 1600,
     .segments = 6,
     .across = 2,
     .top_mm = 15,
     .side_mm = 15,
     .back_mm = 14,
     .flow = HairFlow::kRadial,
     .lift = 0.25,
     .width_mm = 2.5,
     .cap_mm = 25,
     .layers_mm = 6,
     .loft_mm = 3,
     .tip = 0.35,
     .curl_mm = 2,
     .pitch_mm = 9,
     .lit_cap = 0.36,
     .over_ears = false},
    {.name = "bob",
     .locks = 220,
     .segments = 24,
     .across = 2,
     .top_mm = 280,
     .side_mm = 230,
     .back_mm = 230,
     .flow = HairFlow::kParting,
     .lift = 0.15,
     .fall = 0.5,
     .width_mm = 15,
     .cap_mm = 4,
     .layers_mm = 3,
     .loft_mm = 1,
     .fray_mm = 6,
     .tip = 0.7,
     .curl_mm = 1.5,
     .pitch_mm = 90,
     .parting_mm = 12,
     .lit_cap = 0.92,
     .over_ears = true,
     .hangs = true},
    {.name = "long_tied",
     .locks = 300,
     .segments = 22,
     .across = 3,
     .top_mm = 260,
     .side_mm = 200,
     .back_mm = 150,
     .flow = HairFlow::kKnot,
     .lift = 0,
     .width_mm = 9,
     .cap_mm = 3,
     .layers_mm = 0.8,
     .loft_mm = 0.3,
     .sunk_mm = 1.8,
     .fray_mm = 10,
     .lit_cap = 0.75,
     .tail = true},
    {.name = "bald_fringe",
     .locks = 560,
     .segments = 4,
     .across = 2,
     .top_mm = 20,
     .side_mm = 18,
     .back_mm = 20,
     .flow = HairFlow::kDown,
     .lift = 0.2,
     .fall = 0.5,
     .width_mm = 6,
     .cap_mm = 1.5,
     .layers_mm = 3,
     .loft_mm = 2,
     .lit_cap = 0.5,
     .ring = true},
};

constexpr HairlineForm kForms[] = {
    {"even"},
    {.name = "round", .middle_mm = 3, .bay_mm = -9},
    {.name = "widows_peak", .middle_mm = -9, .bay_mm = 3},
    {.name = "m", .middle_mm = -2, .bay_mm = 10, .temples_mm = 10},
    {.name = "high", .higher_mm = 12},
    {.name = "receding", .higher_mm = 22, .bay_mm = 4, .temples_mm = 22},
};

}  // namespace

const std::vector<std::string>& hair_style_names() {
    static const std::vector<std::string> names = names_of(kStyles);
    return names;
}

const std::vector<std::string>& hairline_form_names() {
    static const std::vector<std::string> names = names_of(kForms);
    return names;
}

const LockStyle* lock_style(const std::string& name) {
    const std::size_t at = index_of_name("hair_style", name, hair_style_names());
    return at == 0 ? nullptr : &kStyles[at];
}

LockStyle varied_style(LockStyle style, const LockChange& change) {
    constexpr double kHanging_mm = 90;  // from the ears to the tips
    constexpr double kWave_mm = 5, kWavePitch_mm = 42;
    double length = change.length;
    if (style.hangs) {
        style.cut_mm = kHanging_mm * (1 - length);
        length = std::max(length, 1.0);
    }
    style.top_mm *= length;
    style.side_mm *= length;
    style.back_mm *= length;
    if (style.flow == HairFlow::kRadial) {
        style.cap_mm *= length;
    } else if (style.flow == HairFlow::kParting) {
        style.curl_mm += kWave_mm * change.wave;
        style.pitch_mm += change.wave * (kWavePitch_mm - style.pitch_mm);
        style.fringe = change.fringe;
    }
    style.parting_mm *= change.parting;
    return style;
}

const HairlineForm& hairline_form(const std::string& name) {
    return kForms[index_of_name("hairline_form", name, hairline_form_names())];
}

}  // namespace risorius::render
