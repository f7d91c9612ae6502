// SPDX-License-Identifier: MIT
// risorius info FILE: of a rig or of blend shapes
#include <cstdio>
#include <nlohmann/json.hpp>

#include "risorius/core/json_text.h"
#include "tools/risorius/commands.h"
#include "tools/risorius/rig_info.h"
#include "tools/risorius/shapes_info.h"

namespace risorius::cli {

namespace {

struct InfoArguments {
    Common common;
    std::filesystem::path file;
};

/// In lines that end near column 100.
void print_names(const char* title, const Json& names) {
    std::printf("\n%s\n", title);
    std::string line;
    for (const Json& entry : names) {
        const auto name = entry.get<std::string>();
        if (line.size() + name.size() > 98) {
            std::printf(" %s\n", line.c_str());
            line.clear();
        }
        line += " " + name;
    }
    std::printf(" %s\n", line.c_str());
}

void print_rig(const Json& info) {
    const auto text = [](const Json& value) { return value.get<std::string>(); };
    std::printf("%s: %s, %d vertices, %d faces, %g m per unit, %.3f of the average adult\n",
                text(info["name"]).c_str(), text(info["mesh"]["file"]).c_str(),
                info["mesh"]["vertices"].get<int>(), info["mesh"]["faces"].get<int>(),
                info["mesh"]["metres_per_unit"].get<double>(), info["size"].get<double>());
    std::printf("\nParts (faces)\n");
    for (const auto& [role, groups] : info["parts"].items()) {
        std::printf("  %-12s", role.c_str());
        for (const auto& [group, faces] : groups.items())
            std::printf(" %s (%d)", group.c_str(), faces.get<int>());
        std::printf("\n");
    }
    std::printf(
        "\nMuscles (.l and .r where paired), excitation 0 to 1; greatest force of one side as it "
        "is "
        "simulated (in N = force in the table x strength x common factor x size^2); simulated as "
        "bundles, solid or line of action; what the muscle does\n");
    for (const Json& muscle : info["muscles"]) {
        std::printf("  %-36s %-5s", text(muscle["id"]).c_str(),
                    muscle["paired"].get<bool>() ? ".l .r" : "");
        if (muscle.contains("greatest_force_n"))
            std::printf("  %7.2f = %6.2f x %.2f x %.2f  %-7s",
                        muscle["greatest_force_n"].get<double>(), muscle["table_n"].get<double>(),
                        muscle["strength"].get<double>(), muscle["factor"].get<double>(),
                        text(muscle["simulated_as"]).c_str());
        else
            std::printf("%42s", "");
        std::printf("  %s%s%s\n", text(muscle["action"]).c_str(),
                    muscle["min"].get<double>() < 0 ? "; from -1" : "",
                    muscle.contains("moves_jaw") ? " (in scripts with \"jaw\": \"muscles\")" : "");
    }
    if (!info["beside_solids"].empty())
        std::printf(
            "\nShear modulus of the tissue around relaxed volume muscles, mean and softest, over "
            "that of the muscle (Pa)\n");
    for (const Json& solid : info["beside_solids"]) {
        std::printf("  %-34s .%s  ", text(solid["muscle"]).c_str(), text(solid["side"]).c_str());
        if (solid["tissue_shear_pa"].get<double>() > 0)
            std::printf("%5.0f (%4.0f) / %5.0f = %.2f\n", solid["tissue_shear_pa"].get<double>(),
                        solid["softest_pa"].get<double>(), solid["muscle_shear_pa"].get<double>(),
                        solid["beside_solids_ratio"].get<double>());
        else
            std::printf("none: no simulated tissue touches it\n");
    }
    std::printf("\nAction units\n");
    for (const Json& unit : info["action_units"])
        std::printf("  %-12s %-5s  %s\n", text(unit["id"]).c_str(),
                    unit["sided"].get<bool>() ? ".l .r" : "", text(unit["name"]).c_str());
    print_names("ARKit shapes", info["arkit"]);
    print_names("Expressions", info["expressions"]);
    std::printf("\nOther channels\n");
    for (const Json& channel : info["kinematic"])
        std::printf("  %-20s %g to %g\n", text(channel["name"]).c_str(),
                    channel["min"].get<double>(), channel["max"].get<double>());
}

void print_shape_list(const Json& info) {
    std::printf("%s: %d vertices, %d shapes\n\n%-32s %10s %10s\n",
                info["file"].get<std::string>().c_str(), info["vertices"].get<int>(),
                static_cast<int>(info["shapes"].size()), "Shape", "vertices", "at most");
    for (const Json& shape : info["shapes"])
        std::printf("%-32s %10d %7.2f mm\n", shape["name"].get<std::string>().c_str(),
                    shape["vertices"].get<int>(), shape["largest_mm"].get<double>());
}

void run(const InfoArguments& arguments) {
    const bool shapes =
        arguments.file.extension() == ".glb" || arguments.file.extension() == ".gltf";
    const Json info = shapes ? shapes_info(arguments.file) : rig_info(arguments.file);
    if (arguments.common.json)
        std::printf("%s\n", json_text(info, 2).c_str());
    else if (!arguments.common.quiet)
        shapes ? print_shape_list(info) : print_rig(info);
}

}  // namespace

void add_info(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "info", "Print channels, muscles, parts and sizes of a rig, or the blend shapes of a .glb");
    auto arguments = std::make_shared<InfoArguments>();
    command->add_option("FILE", arguments->file, "A rig, or a glTF file with blend shapes")
        ->required();
    add_common(*command, arguments->common);
    command->footer(
        "Example:\n  risorius info rigs/adult/rig.json\n  risorius info adult/shapes.glb");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace risorius::cli
