// SPDX-License-Identifier: MIT
// src/CMakeLists.txt is the architecture; these tests hold the include lines to it.
#include "structure/layers.h"

#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <map>

#include "structure/source_tree.h"

namespace risorius::structure {
namespace {

using Names = std::set<std::string>;

TEST(Layers, DeclarationIsReadWithoutLinksAndComments) {
    const auto uses = declared_uses(
        "function(risorius_module folder)\n# risorius_module(ghost USES core)\n"
        "risorius_module(core   LINKS Eigen3::Eigen)\n"
        "risorius_module(geom   USES core\n    LINKS x y)  # why\nrisorius_module(rig USES core "
        "geom)\n");
    ASSERT_EQ(uses.size(), 3u);
    EXPECT_EQ(uses.at("core"), Names{});
    EXPECT_EQ(uses.at("geom"), Names{"core"});
    EXPECT_EQ(uses.at("rig"), (Names{"core", "geom"}));
}

TEST(Layers, IncludesAreReadWithTheirModule) {
    const std::string source =
        "#include \"risorius/core/error.h\"\n// #include \"risorius/face/face.h\"\n"
        "  #  include \"risorius/geom/detail/a.h\"\n#include <rig/none.h>\n"
        "#include \"bare.h\"\n#include \"../io/up.h\"\n";
    EXPECT_EQ(included_modules(source), (Names{"core", "geom"}));
    EXPECT_EQ(included_headers(source),
              (Names{"risorius/core/error.h", "risorius/geom/detail/a.h"}));
    EXPECT_EQ(bare_includes(source), (std::vector<std::string>{"bare.h", "../io/up.h"}));
}

/// The module of a file below src/risorius.
std::string module_of(const std::filesystem::path& file) {
    return *file.lexically_relative(source_dir() / "src/risorius").begin();
}

TEST(Layers, EveryModuleIncludesOnlyWhatItDeclares) {
    const auto uses = declared_uses(text_of(source_dir() / "src/CMakeLists.txt"));
    ASSERT_GE(uses.size(), 5u);
    for (const auto& file : files_below("src/risorius", {".h", ".cpp"})) {
        const std::string module = module_of(file);
        ASSERT_TRUE(uses.contains(module))
            << shown(file) << ": src/risorius/" << module << " is not declared";
        const std::string source = text_of(file);
        for (const std::string& used : included_modules(source))
            EXPECT_TRUE(used == module || uses.at(module).contains(used))
                << shown(file) << " includes " << used << "/, but src/CMakeLists.txt does not let "
                << module << " use it";
        for (const std::string& header : included_headers(source))
            EXPECT_TRUE(std::filesystem::exists(source_dir() / "src" / header))
                << shown(file) << " includes " << header << ", which is not there";
        for (const std::string& name : bare_includes(source))
            ADD_FAILURE() << shown(file) << " includes \"" << name << "\" without its module";
    }
}

TEST(Layers, NoHeaderIncludesItself) {
    std::map<std::string, Names> includes;
    for (const auto& file : files_below("src/risorius", {".h"}))
        includes[file.lexically_relative(source_dir() / "src").generic_string()] =
            included_headers(text_of(file));
    // Depth first; a header that is met while it is still open closes a cycle.
    std::map<std::string, int> state;
    const std::function<void(const std::string&, const std::string&)> visit =
        [&](const std::string& header, const std::string& way) {
            state[header] = 1;
            for (const std::string& next : includes[header]) {
                EXPECT_NE(state[next], 1) << "a cycle of includes: " << way << " -> " << next;
                if (state[next] == 0) visit(next, way + " -> " + next);
            }
            state[header] = 2;
        };
    for (const auto& [header, ignored] : std::map(includes))
        if (state[header] == 0) visit(header, header);
    EXPECT_GT(includes.size(), 100u);
}

// A header is public when another module or a program includes it, and private, in a folder `detail`, when none does.
TEST(Layers, PrivateHeadersStayInTheirModuleAndPublicOnesAreIncludedFromOutside) {
    std::map<std::string, Names> used_by;
    for (const char* folder : {"src/risorius", "src/python", "tools", "samples"})
        for (const auto& file : files_below(folder, {".h", ".cpp"}))
            for (const std::string& header : included_headers(text_of(file)))
                used_by[header].insert(folder == std::string("src/risorius") ? module_of(file)
                                                                             : folder);
    for (const auto& file : files_below("src/risorius", {".h"})) {
        const std::string module = module_of(file);
        const std::string header = file.lexically_relative(source_dir() / "src").generic_string();
        Names outside = used_by[header];
        outside.erase(module);
        if (header.find("/detail/") != std::string::npos)
            EXPECT_TRUE(outside.empty())
                << header << " is private, but " << *outside.begin() << " includes it";
        else
            EXPECT_FALSE(outside.empty())
                << header << " is included by no other module and belongs into detail/";
    }
}

TEST(Layers, DeclarationsPointUpwardsOnly) {
    // Order in the file, not in the map: declared_uses of a growing beginning of the file.
    const std::vector<std::string> lines = lines_of(text_of(source_dir() / "src/CMakeLists.txt"));
    std::string above;
    int declared = 0;
    for (const std::string& line : lines) {
        const Names before = [&] {
            Names names;
            for (const auto& [folder, ignored] : declared_uses(above)) names.insert(folder);
            return names;
        }();
        for (const auto& [folder, used] : declared_uses(line)) {
            ++declared;
            for (const std::string& name : used)
                EXPECT_TRUE(before.contains(name))
                    << folder << " uses " << name << ", declared below it";
        }
        above += line + "\n";
    }
    EXPECT_GE(declared, 5);
}

TEST(Layers, FoldersDeclaredButNotIncludedAreNamed) {
    // A folder may be on its way, so this prints and fails only when the list has nothing to do with the sources.
    const auto uses = declared_uses(text_of(source_dir() / "src/CMakeLists.txt"));
    std::map<std::string, Names> included;
    for (const auto& file : files_below("src/risorius", {".h", ".cpp"}))
        included[module_of(file)].merge(included_modules(text_of(file)));
    int used_uses = 0;
    for (const auto& [folder, used] : uses)
        for (const std::string& name : used) {
            if (included[folder].contains(name))
                ++used_uses;
            else
                std::cout << "warning: src/CMakeLists.txt lets " << folder << " use " << name
                          << ", which it does not include\n";
        }
    EXPECT_GT(used_uses, 0);
}

}  // namespace
}  // namespace risorius::structure
