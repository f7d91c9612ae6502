// SPDX-License-Identifier: MIT
#include "risorius/rig/atlas.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace risorius::rig {

namespace {

Body read_body(JsonCursor json) {
    const std::string name = json.one_of({"skull", "mandible", "soft", "neck"});
    return name == "skull"      ? Body::kSkull
           : name == "mandible" ? Body::kMandible
           : name == "neck"     ? Body::kNeck
                                : Body::kSoft;
}

}  // namespace

bool MuscleBand::crosses_midline() const {
    return std::any_of(points.begin(), points.end(), [](const BandPoint& point) {
        return point.landmark.size() > 2 && point.landmark.ends_with("_r");
    });
}

const AtlasLandmark* Atlas::landmark(const std::string& id) const {
    for (const AtlasLandmark& candidate : landmarks)
        if (candidate.id == id) return &candidate;
    return nullptr;
}

std::string mirrored_landmark(const std::string& id) {
    if (id.ends_with("_l")) return id.substr(0, id.size() - 1) + "r";
    if (id.ends_with("_r")) return id.substr(0, id.size() - 1) + "l";
    return id;
}

MuscleBand mirrored(const MuscleBand& band) {
    MuscleBand out = band;
    for (BandPoint& point : out.points) {
        point.landmark = mirrored_landmark(point.landmark);
        point.offset.x() = -point.offset.x();
    }
    return out;
}

std::vector<AtlasLandmark> read_atlas_landmarks(JsonCursor json) {
    json.allow_keys({"source", "frame", "landmarks"});
    std::vector<AtlasLandmark> out;
    for (const JsonCursor& item : json.at("landmarks").items()) {
        item.allow_keys({"id", "name", "side", "region", "xyz_mm", "core", "definition"});
        out.push_back({item.at("id").string(), item.at("name").string(),
                       1e-3 * item.at("xyz_mm").vec3(), item.at("core").boolean(),
                       item.at("region").string()});
    }
    return out;
}

std::vector<std::string> Atlas::landmark_ids() const {
    std::vector<std::string> out;
    for (const AtlasLandmark& entry : landmarks) out.push_back(entry.id);
    return out;
}

std::vector<ThicknessSample> read_thickness(JsonCursor json) {
    json.allow_keys({"source", "sources", "frame", "points"});
    std::vector<ThicknessSample> out;
    for (const JsonCursor& item : json.at("points").items()) {
        item.allow_keys({"id", "name", "landmark", "offset_mm", "thickness_mm", "source", "note"});
        out.push_back({item.at("landmark").string(), 1e-3 * item.at("offset_mm").vec3(),
                       1e-3 * item.at("thickness_mm").number({0.1, 60})});
    }
    return out;
}

std::vector<AttachmentSample> read_attachments(JsonCursor json) {
    json.allow_keys({"source", "sources", "unit", "attachments"});
    std::vector<AttachmentSample> out;
    for (const std::string& id : json.at("attachments").keys()) {
        const std::vector<JsonCursor> pair = json.at("attachments").at(id).items();
        if (pair.size() != 2) json.at("attachments").at(id).fail("[normal, tangential]");
        out.push_back({id, pair[0].number({1e-3, 1e12}), pair[1].number({1e-3, 1e12})});
    }
    return out;
}

std::vector<MuscleBand> read_muscle_bands(JsonCursor json) {
    json.allow_keys({"source", "sources", "note", "muscles"});
    std::vector<MuscleBand> out;
    for (const std::string& muscle : json.at("muscles").keys())
        for (const JsonCursor& item : json.at("muscles").at(muscle).items()) {
            item.allow_keys({"width_mm", "F0_N", "calibration", "shortens_to", "points", "origin",
                             "insertion"});
            MuscleBand band;
            band.muscle = muscle;
            band.width_m = 1e-3 * item.at("width_mm").number({0.5, 200});
            band.force_n = item.at("F0_N").number({0, 1000});
            band.strength = item.at("calibration").number({0, 100});
            if (const auto length = item.find("shortens_to"))
                band.shortens_to = length->number({0.3, 1});
            for (const JsonCursor& point : item.at("points").items()) {
                point.allow_keys({"landmark", "offset_mm", "depth"});
                const bool on_mucosa = point.at("depth").json().is_null();
                band.points.push_back({point.at("landmark").string(),
                                       1e-3 * point.at("offset_mm").vec3(),
                                       on_mucosa ? -1.0 : point.at("depth").number({0, 1.2})});
            }
            if (band.points.size() < 2) item.at("points").fail("at least two points");
            band.origin = read_body(item.at("origin").at("body"));
            band.insertion = read_body(item.at("insertion").at("body"));
            band.origin_attach = item.at("origin").at("attach").string();
            band.insertion_attach = item.at("insertion").at("attach").string();
            out.push_back(band);
        }
    return out;
}

}  // namespace risorius::rig
