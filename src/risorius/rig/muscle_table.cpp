// SPDX-License-Identifier: MIT
#include "risorius/rig/muscle_table.h"

#include <cmath>

#include "risorius/rig/atlas.h"

namespace risorius::rig {

track::ChannelTable MuscleTable::channels() const {
    track::ChannelTable table;
    for (const Muscle& muscle : muscles)
        table.muscles.push_back({muscle.id, muscle.paired, muscle.tonic ? -1.0 : 0.0});
    return table;
}

namespace {

Eigen::VectorXd per_column(const std::vector<Muscle>& muscles, double Muscle::*value) {
    std::vector<double> out;
    for (const Muscle& muscle : muscles)
        for (int side = 0; side < (muscle.paired ? 2 : 1); ++side) out.push_back(muscle.*value);
    return Eigen::Map<Eigen::VectorXd>(out.data(), static_cast<long>(out.size()));
}

PathPoint::Body read_path_body(const JsonCursor& json) {
    using enum PathPoint::Body;
    const std::string name = json.one_of({"skull", "mandible", "hyoid", "eyelid", "neck", "soft"});
    return name == "skull"      ? kSkull
           : name == "mandible" ? kMandible
           : name == "hyoid"    ? kHyoid
           : name == "eyelid"   ? kEyelid
           : name == "neck"     ? kNeck
                                : kSoft;
}

PathPoint read_path_point(const JsonCursor& json) {
    json.allow_keys(
        {"xyz_mm", "skin_mm", "normal", "depth_frac", "tissue_mm", "body", "attach", "retarget"});
    PathPoint point;
    point.atlas = 1e-3 * json.at("xyz_mm").vec3();
    point.body = read_path_body(json.at("body"));
    point.attach = json.at("attach").string();
    if (const auto depth = json.find("depth_frac")) point.depth = depth->number({0, 1.2});
    const JsonCursor retarget = json.at("retarget");
    retarget.allow_keys({"lm", "w", "offset_mm"});
    point.offset = 1e-3 * retarget.at("offset_mm").vec3();
    const std::vector<JsonCursor> ids = retarget.at("lm").items(),
                                  weights = retarget.at("w").items();
    if (ids.empty() || ids.size() != weights.size())
        retarget.at("w").fail("one weight for each of " + std::to_string(ids.size()) +
                              " landmarks");
    double sum = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        point.landmarks.emplace_back(ids[i].string(), weights[i].number({-10, 10}));
        sum += point.landmarks.back().second;
    }
    // The table has three digits; the remainder is distributed evenly.
    if (std::abs(sum - 1) > 0.01) retarget.at("w").fail("weights that add up to 1");
    for (auto& [id, weight] : point.landmarks) weight /= sum;
    return point;
}

MusclePath read_path(const JsonCursor& json) {
    MusclePath path;
    for (const JsonCursor& point : json.items()) path.push_back(read_path_point(point));
    if (path.size() < 2) json.fail("at least two points");
    return path;
}

// Bundles of mimetic muscles do not need these values; muscles of the jaw do.
void read_line(const JsonCursor& item, Muscle& muscle) {
    const bool moves_bone = muscle.group == "jaw" || muscle.group == "hyoid";
    const auto take = [&](std::string_view key, double unit, Range range, double& value) {
        if (moves_bone || item.has(key)) value = unit * item.at(key).number(range);
    };
    take("width_mm", 1e-3, {0.5, 200}, muscle.width_m);
    take("thickness_mm", 1e-3, {0.1, 50}, muscle.thickness_m);
    take("l0_mm", 1e-3, {0.5, 500}, muscle.optimal_length_m);
    take("tendon_slack_mm", 1e-3, {0, 500}, muscle.tendon_slack_m);
    take("pennation_deg", 1, {0, 89}, muscle.pennation_deg);
    take("vmax_l0_per_s", 1, {0.1, 100}, muscle.max_speed_hz);
    take("rest_norm_fibre_length", 1, {0.3, 2}, muscle.rest_stretch);
    take("max_shortening_frac", 1, {0, 0.9}, muscle.max_shortening);
    if (!moves_bone && !item.has("paths")) return;
    for (const JsonCursor& path : item.at("paths").items()) muscle.paths.push_back(read_path(path));
    if (moves_bone && muscle.paths.empty()) item.at("paths").fail("at least one path");
}

}  // namespace

MusclePath mirrored(const MusclePath& path) {
    MusclePath out = path;
    for (PathPoint& point : out) {
        point.atlas.x() = -point.atlas.x();
        point.offset.x() = -point.offset.x();
        for (auto& [id, weight] : point.landmarks) id = mirrored_landmark(id);
    }
    return out;
}

Eigen::VectorXd MuscleTable::activation_s() const {
    return per_column(muscles, &Muscle::activation_s);
}
Eigen::VectorXd MuscleTable::deactivation_s() const {
    return per_column(muscles, &Muscle::deactivation_s);
}

MuscleTable read_muscle_table(JsonCursor json) {
    json.allow_keys({"source", "sources", "frame", "muscles"});
    MuscleTable table;
    for (const JsonCursor& item : json.at("muscles").items()) {
        item.allow_keys({"id",
                         "name",
                         "group",
                         "type",
                         "paired",
                         "width_mm",
                         "thickness_mm",
                         "csa_mm2",
                         "F0_N",
                         "F0_range_N",
                         "l0_mm",
                         "tendon_slack_mm",
                         "rest_norm_fibre_length",
                         "pennation_deg",
                         "max_shortening_frac",
                         "vmax_l0_per_s",
                         "t_act_ms",
                         "t_deact_ms",
                         "tonic_rest_activation",
                         "action",
                         "action_units",
                         "sources",
                         "confidence",
                         "paths"});
        Muscle muscle;
        muscle.id = item.at("id").string();
        muscle.name = item.at("name").string();
        muscle.group = item.at("group").one_of({"mimetic", "lid", "jaw", "hyoid"});
        muscle.action = item.at("action").string();
        muscle.paired = item.at("paired").boolean();
        muscle.activation_s = 1e-3 * item.at("t_act_ms").number({1, 1000});
        muscle.deactivation_s = 1e-3 * item.at("t_deact_ms").number({1, 1000});
        muscle.force_n = item.at("F0_N").number({0, 1e4});
        if (const auto area = item.find("csa_mm2"))
            muscle.area_m2 = 1e-6 * area->number({0.1, 1e5});
        read_line(item, muscle);
        if (const auto tonic = item.find("tonic_rest_activation"))
            muscle.tonic = tonic->number({0, 1}) > 0;
        table.muscles.push_back(muscle);
    }
    if (table.muscles.empty()) json.at("muscles").fail("at least one muscle");
    return table;
}

}  // namespace risorius::rig
