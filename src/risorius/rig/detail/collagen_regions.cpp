// SPDX-License-Identifier: MIT
#include "risorius/rig/detail/collagen_regions.h"

#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/rig/detail/known_landmark.h"

namespace risorius::rig {

std::vector<CollagenRegion> read_collagen_regions(const JsonCursor& json,
                                                  const std::vector<std::string>& landmarks) {
    // Each looks at all of the tissue.
    constexpr std::size_t kMostRegions = 100;
    const std::vector<JsonCursor> items = json.items();
    if (items.size() > kMostRegions) json.fail("at most 100 regions", std::to_string(items.size()));
    std::vector<CollagenRegion> out;
    for (const JsonCursor& item : items) {
        item.allow_keys({"at", "radius_mm", "layer", "from", "to", "k1_pa", "k2"});
        CollagenRegion region;
        region.at = known_landmark(item.at("at"), landmarks);
        region.radius_mm = item.at("radius_mm").number({1, 200});
        if (const auto layer = item.find("layer"))
            region.layer = layer->one_of({"deep", "superficial", "both"});
        region.from = known_landmark(item.at("from"), landmarks);
        region.to = known_landmark(item.at("to"), landmarks);
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
