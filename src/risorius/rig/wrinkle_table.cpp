// SPDX-License-Identifier: MIT
#include "risorius/rig/wrinkle_table.h"

#include <algorithm>
#include <array>
#include <utility>

#include "risorius/rig/detail/known_landmark.h"

namespace risorius::rig {

namespace {

using Of = WrinkleFactor::Of;
constexpr std::array<std::pair<std::string_view, Of>, 10> kQuantities{
    {{"height", Of::kHeight},
     {"outward", Of::kOutward},
     {"from_middle", Of::kFromMiddle},
     {"over_line", Of::kOverLine},
     {"under_line", Of::kUnderLine},
     {"from_crease", Of::kFromCrease},
     {"from_point", Of::kFromPoint},
     {"beyond_point", Of::kBeyondPoint},
     {"around_point", Of::kAroundPoint},
     {"turn_about", Of::kTurnAbout}}};
constexpr Range kLength_mm{-500, 500};

void read_optional(const JsonCursor& json, const char* key, Range range, double& out) {
    if (const auto found = json.find(key)) out = found->number(range);
}
void read_optional(const JsonCursor& json, const char* key, bool& out) {
    if (const auto found = json.find(key)) out = found->boolean();
}

using Ids = std::vector<std::string>;

// A plain number is a length in mm, or an angle.
WrinkleBound read_bound(const JsonCursor& json, const Ids& known) {
    WrinkleBound out;
    if (json.is_number()) {
        out.plus_mm = {json.number(kLength_mm)};
        return out;
    }
    json.allow_keys({"landmark", "less", "crease", "axis", "fraction", "plus_mm"});
    if (json.has("landmark") == json.has("crease"))
        json.fail("a number, or either \"landmark\" or \"crease\"");
    if (const auto landmark = json.find("landmark"))
        out.landmark = known_landmark(*landmark, known);
    if (const auto less = json.find("less")) out.less = known_landmark(*less, known);
    if (const auto crease = json.find("crease"))
        out.crease_end = crease->one_of({"first", "last"}) == "last" ? 1 : 0;
    out.axis = json.at("axis").one_of({"x", "y"}) == "y" ? 1 : 0;
    read_optional(json, "fraction", {0, 10}, out.fraction);
    if (const auto plus = json.find("plus_mm"))
        for (const JsonCursor& length : plus->items())
            out.plus_mm.push_back(length.number(kLength_mm));
    return out;
}

WrinkleFactor read_factor(const JsonCursor& json, const Ids& known) {
    json.allow_keys({"of", "line", "point", "stretch", "behind_mm", "rises", "falls"});
    WrinkleFactor out;
    std::vector<std::string_view> names;
    for (const auto& [name, of] : kQuantities) names.push_back(name);
    const std::string name = json.at("of").one_of(names);
    for (const auto& [quantity, of] : kQuantities)
        if (quantity == name) out.of = of;
    if (out.of == Of::kOverLine || out.of == Of::kUnderLine) {
        for (const JsonCursor& id : json.at("line").items())
            out.line.push_back(known_landmark(id, known));
        if (out.line.size() < 2) json.at("line").fail("two landmarks or more");
    }
    if (out.of >= Of::kFromPoint) out.point = known_landmark(json.at("point"), known);
    read_optional(json, "stretch", {0.01, 100}, out.stretch);
    read_optional(json, "behind_mm", kLength_mm, out.behind_mm);
    if (json.has("rises") == json.has("falls")) json.fail("either \"rises\" or \"falls\"");
    out.falls = json.has("falls");
    const JsonCursor step = json.at(out.falls ? "falls" : "rises");
    const std::vector<JsonCursor> ends = step.items();
    if (ends.size() != 2) step.fail("[from, to]");
    out.from = read_bound(ends[0], known);
    out.to = read_bound(ends[1], known);
    for (const JsonCursor& end : ends)
        if (out.of == Of::kTurnAbout && !end.is_number()) end.fail("an angle, rad");
    return out;
}

WrinklePattern read_pattern(const JsonCursor& json, const Ids& known) {
    json.allow_keys({"name", "each_side", "aged", "slot", "wavelength_mm", "fraction", "onset",
                     "permanence", "jitter", "jitter_spacing", "anchor", "anchor_phase",
                     "along_fibres", "fibres", "crease", "front_only", "min_outward_mm", "window"});
    WrinklePattern out;
    out.name = json.at("name").string();
    read_optional(json, "each_side", out.each_side);
    read_optional(json, "aged", out.aged);
    out.slot = json.at("slot").integer(0, 2);
    out.wavelength_mm = json.at("wavelength_mm").number({0.1, 100});
    out.fraction = json.at("fraction").number({0, 1});
    read_optional(json, "onset", {0, 0.5}, out.onset);
    read_optional(json, "permanence", {0, 1}, out.permanence);
    read_optional(json, "jitter", {0, 10}, out.jitter);
    read_optional(json, "jitter_spacing", {0.01, 100}, out.jitter_spacing);
    if (const auto anchor = json.find("anchor")) out.anchor = known_landmark(*anchor, known);
    read_optional(json, "anchor_phase", {0, 1}, out.anchor_phase);
    read_optional(json, "along_fibres", out.along_fibres);
    if (json.has("fibres") == json.has("crease")) json.fail("either \"fibres\" or \"crease\"");
    if (const auto fibres = json.find("fibres"))
        for (const JsonCursor& item : fibres->items()) {
            item.allow_keys({"muscle", "left", "right"});
            WrinkleFibres one{.muscle = item.at("muscle").string()};
            read_optional(item, "left", {-1, 1}, one.left);
            read_optional(item, "right", {-1, 1}, one.right);
            out.fibres.push_back(one);
        }
    if (const auto crease = json.find("crease")) {
        for (const JsonCursor& item : crease->items()) {
            item.allow_keys({"landmark", "offset_mm"});
            CreasePoint point{.landmark = known_landmark(item.at("landmark"), known)};
            if (const auto offset = item.find("offset_mm")) point.offset_mm = offset->vec3();
            out.crease.push_back(point);
        }
        if (out.crease.size() < 2) crease->fail("two points or more");
    }
    const bool has_crease = !out.crease.empty();
    read_optional(json, "front_only", out.front_only);
    read_optional(json, "min_outward_mm", kLength_mm, out.min_outward_mm);
    for (const JsonCursor& factor : json.at("window").items())
        out.window.push_back(read_factor(factor, known));
    for (const WrinkleFactor& factor : out.window)
        if (!has_crease && (factor.of == Of::kFromCrease || factor.from.crease_end >= 0 ||
                            factor.to.crease_end >= 0))
            json.fail("a crease, which its window names");
    return out;
}

}  // namespace

std::vector<WrinklePattern> read_wrinkles(JsonCursor json, const std::vector<std::string>& known) {
    json.at("format").one_of({"risorius-wrinkles"});
    json.allow_keys({"format", "version", "source", "patterns"});
    json.at("version").integer(1, 1);
    std::vector<WrinklePattern> out;
    for (const JsonCursor& item : json.at("patterns").items())
        out.push_back(read_pattern(item, known));
    return out;
}

}  // namespace risorius::rig
