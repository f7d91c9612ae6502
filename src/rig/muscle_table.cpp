#include "rig/muscle_table.h"

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

}  // namespace

Eigen::VectorXd MuscleTable::activation_s() const {
    return per_column(muscles, &Muscle::activation_s);
}
Eigen::VectorXd MuscleTable::deactivation_s() const {
    return per_column(muscles, &Muscle::deactivation_s);
}

MuscleTable read_muscle_table(JsonCursor json) {
    json.allow_keys({"source", "frame", "muscles"});
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
        if (const auto tonic = item.find("tonic_rest_activation"))
            muscle.tonic = tonic->number({0, 1}) > 0;
        table.muscles.push_back(muscle);
    }
    if (table.muscles.empty()) json.at("muscles").fail("at least one muscle");
    return table;
}

}  // namespace risorius::rig
