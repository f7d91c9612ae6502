// SPDX-License-Identifier: MIT
/// \file
/// Small designs of smiles, and a folder for the sets that are made of them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paths.h"
#include "risorius/core/json_cursor.h"
#include "temporary_folder.h"

namespace risorius::stimuli {

namespace fs = std::filesystem;

inline std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class Batch : public testing::Test {
  protected:
    static const TemporaryFolder& folder() {
        static const TemporaryFolder one;
        return one;
    }
    static fs::path design(const std::string& name, const std::vector<double>& intensities,
                           const std::string& controls = "[]") {
        Json json = Json::parse(R"({"format": "risorius-design", "version": 1, "name": "Smiles",
            "clips": {"quality": "preview", "ending": "mkv", "photodiode": "lower_left"},
            "sets": [{"name": "smiles", "clip": "smile_${intensity}",
                "script": {"format": "risorius-script", "version": 1, "fps": 10, "duration_s": 0.5,
                    "events": [{"expression": "happiness", "intensity": "${intensity}",
                                "start_s": 0.05, "onset_s": 0.3, "hold_s": 0.1, "offset_s": 0.3}],
                    "view": {"width_px": 48, "height_px": 64, "antialiasing": 1}}}]})");
        json["sets"][0]["script"]["rig"] = kAdult;
        json["sets"][0]["factors"]["intensity"] = intensities;
        json["sets"][0]["controls"] = Json::parse(controls);
        const fs::path file = folder().path() / name;
        std::ofstream(file) << json.dump();
        return file;
    }
    static inline const std::string kAdult = RISORIUS_SOURCE_DIR "/rigs/adult/rig.json";
};

}  // namespace risorius::stimuli
