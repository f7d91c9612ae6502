// SPDX-License-Identifier: MIT
// A rig knows the styles of hair and the hairlines that the renderer draws, no more and no fewer.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "paths.h"
#include "risorius/core/json_cursor.h"
#include "risorius/render/garments.h"
#include "risorius/render/hair_styles.h"
#include "risorius/rig/rig_description.h"
#include "temporary_folder.h"

namespace risorius::scene {
namespace {

namespace fs = std::filesystem;

TEST(HairNames, AreTheSameInRigAndRenderer) {
    const fs::path root = RISORIUS_SOURCE_DIR;
    const TemporaryFolder folder;
    fs::create_directories(folder / "rigs/adult");
    fs::create_directory_symlink(root / "rigs/standard", folder / "rigs/standard");
    fs::create_directory_symlink(root / "models", folder / "models");
    const fs::path file = folder / "rigs/adult/rig.json";
    const auto message = [&](const char* key, const std::string& name) {
        Json rig = Json::parse(std::ifstream(root / "rigs/adult/rig.json"));
        rig["appearance"][key] = name;
        std::ofstream(file) << rig;
        return message_of([&] { rig::read_rig(file); });
    };
    for (const auto& [key, names] : {std::pair{"hair_style", render::hair_style_names()},
                                     std::pair{"hairline_form", render::hairline_form_names()},
                                     std::pair{"beard_form", render::beard_form_names()},
                                     std::pair{"garment", render::garment_names()}}) {
        for (const std::string& name : names) EXPECT_EQ(message(key, name), "no error") << name;
        // The rig lists what it knows: as many as the renderer
        const std::string refused = message(key, "mohawk");
        std::size_t listed = 0;
        for (const std::string& name : names)
            listed += refused.find("\"" + name + "\"") != std::string::npos;
        EXPECT_EQ(listed, names.size()) << refused;
        EXPECT_EQ(static_cast<std::size_t>(std::count(refused.begin(), refused.end(), '"')),
                  2 * (names.size() + 1))
            << refused;
    }
}

}  // namespace
}  // namespace risorius::scene
