// SPDX-License-Identifier: MIT
#include "risorius/rig/calibration.h"

namespace risorius::rig {

std::vector<std::string> read_calibration(const JsonCursor& json) {
    if (json.is_string()) return read_calibration(follow_table(json));
    std::vector<std::string> out;
    if (json.is_array()) {
        for (const JsonCursor& name : json.items()) out.push_back(name.string());
        return out;
    }
    json.at("format").one_of({"risorius-calibration"});
    json.allow_keys({"format", "version", "source", "expressions"});
    json.at("version").integer(1, 1);
    json.at("source").string();
    for (const JsonCursor& name : json.at("expressions").items()) out.push_back(name.string());
    return out;
}

std::vector<std::string> calibrated_on(const std::filesystem::path& rig_file) {
    const JsonCursor json = JsonCursor::read_file(rig_file);
    const auto found = json.find("calibrated_on");
    return found ? read_calibration(*found) : std::vector<std::string>();
}

}  // namespace risorius::rig
