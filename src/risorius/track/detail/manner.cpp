// SPDX-License-Identifier: MIT
#include "risorius/track/detail/manner.h"

#include <algorithm>

namespace risorius::track {
namespace {

constexpr double kLargestFactor = 20;

ExpressionTimes read_times(const JsonCursor& json) {
    return {json.at("onset_s").number({0, 60}), json.at("hold_s").number({0, 3600}),
            json.at("offset_s").number({0, 60})};
}

}  // namespace

ExpressionTimes Manner::times(const std::string& expression, const ExpressionTimes& usual) const {
    if (is_factor)
        return {std::min(60.0, factor.onset_s * usual.onset_s),
                std::min(3600.0, factor.hold_s * usual.hold_s),
                std::min(60.0, factor.offset_s * usual.offset_s)};
    for (const auto& [other, own] : listed)
        if (other == expression) return own;
    return others;
}

Manner read_manner(const JsonCursor& json, const std::string& name) {
    json.allow_keys({"source", "factor", "onset_s", "hold_s", "offset_s", "expressions"});
    Manner manner;
    manner.name = name;
    manner.source = json.at("source").string();
    if (const auto factor = json.find("factor")) {
        if (json.has("onset_s") || json.has("hold_s") || json.has("offset_s") ||
            json.has("expressions"))
            json.fail("either a factor or times", "both");
        factor->allow_keys({"onset", "hold", "offset"});
        manner.is_factor = true;
        manner.factor = {factor->at("onset").number({0, kLargestFactor}),
                         factor->at("hold").number({0, kLargestFactor}),
                         factor->at("offset").number({0, kLargestFactor})};
        return manner;
    }
    manner.others = read_times(json);
    if (const auto listed = json.find("expressions"))
        for (const std::string& expression : listed->keys()) {
            const JsonCursor entry = listed->at(expression);
            entry.allow_keys({"onset_s", "hold_s", "offset_s"});
            manner.listed.emplace_back(expression, read_times(entry));
        }
    return manner;
}

}  // namespace risorius::track
