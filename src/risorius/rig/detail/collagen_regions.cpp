// SPDX-License-Identifier: MIT
#include "risorius/rig/detail/collagen_regions.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"

namespace risorius::rig {

std::vector<CollagenRegion> read_collagen_regions(const JsonCursor& json,
                                                  const std::vector<std::string>& landmarks) {
    const std::vector<std::string_view> names(landmarks.begin(), landmarks.end());
    const auto landmark = [&](const JsonCursor& named) {
        const std::string id = named.string(), near = nearest_name(id, names);
        if (std::find(names.begin(), names.end(), id) == names.end())
            named.fail(near.empty() ? "a landmark of the atlas"
                                    : "a landmark of the atlas (did you mean \"" + near + "\"?)");
        return id;
    };
    // Each looks at all of the tissue.
    constexpr std::size_t kMostRegions = 100;
    const std::vector<JsonCursor> items = json.items();
    if (items.size() > kMostRegions) json.fail("at most 100 regions", std::to_string(items.size()));
    std::vector<CollagenRegion> out;
    for (const JsonCursor& item : items) {
        item.allow_keys({"at", "radius_mm", "layer", "from", "to", "k1_pa", "k2"});
        CollagenRegion region;
        region.at = landmark(item.at("at"));
        region.radius_mm = item.at("radius_mm").number({1, 200});
        if (const auto layer = item.find("layer"))
            region.layer = layer->one_of({"deep", "superficial", "both"});
        region.from = landmark(item.at("from"));
        region.to = landmark(item.at("to"));
        if (region.from == region.to) item.at("to").fail("another landmark than \"from\"");
        region.k1_pa = item.at("k1_pa").number({1, 1e7});
        if (const auto k2 = item.find("k2")) region.k2 = k2->number({0, 1000});
        out.push_back(region);
    }
    return out;
}

Json collagen_regions_json(const std::vector<CollagenRegion>& regions) {
    Json out = Json::array();
    for (const CollagenRegion& region : regions)
        out.push_back(json_object({{"at", region.at},
                                   {"radius_mm", region.radius_mm},
                                   {"layer", region.layer},
                                   {"from", region.from},
                                   {"to", region.to},
                                   {"k1_pa", region.k1_pa},
                                   {"k2", region.k2}}));
    return out;
}

}  // namespace risorius::rig
