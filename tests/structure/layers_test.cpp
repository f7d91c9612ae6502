// src/CMakeLists.txt is the architecture; these tests hold the include lines to it.
#include "structure/layers.h"

#include <gtest/gtest.h>

#include <iostream>

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

TEST(Layers, IncludesAreReadWithTheirFolder) {
    const std::string source =
        "#include \"core/error.h\"\n// #include \"sim/face.h\"\n  #  include \"geom/detail/a.h\"\n"
        "#include <rig/none.h>\n#include \"bare.h\"\n#include \"../io/up.h\"\n";
    EXPECT_EQ(included_folders(source), (Names{"..", "core", "geom"}));
    EXPECT_EQ(bare_includes(source), (std::vector<std::string>{"bare.h", "../io/up.h"}));
}

TEST(Layers, EveryFolderIncludesOnlyWhatItDeclares) {
    const auto uses = declared_uses(text_of(source_dir() / "src/CMakeLists.txt"));
    ASSERT_GE(uses.size(), 5u);
    for (const auto& file : files_below("src", {".h", ".cpp"})) {
        const std::string folder = *file.lexically_relative(source_dir() / "src").begin();
        ASSERT_TRUE(uses.contains(folder))
            << shown(file) << ": src/" << folder << " is not declared";
        const std::string source = text_of(file);
        for (const std::string& used : included_folders(source)) {
            if (!uses.contains(used)) continue;  // a system header in quotes, or caught below
            EXPECT_TRUE(used == folder || uses.at(folder).contains(used))
                << shown(file) << " includes " << used << "/, but src/CMakeLists.txt does not let "
                << folder << " use it";
        }
        for (const std::string& name : bare_includes(source))
            ADD_FAILURE() << shown(file) << " includes \"" << name << "\" without its folder";
    }
}

TEST(Layers, PrivateHeadersStayInTheirFolder) {
    for (const auto& file : files_below("src", {".h", ".cpp"})) {
        const std::string folder = *file.lexically_relative(source_dir() / "src").begin();
        const std::string source = text_of(file);
        const std::regex include(R"re(#include "([^"/]+)/detail/)re");
        for (std::sregex_iterator i(source.begin(), source.end(), include), end; i != end; ++i)
            EXPECT_EQ((*i)[1], folder)
                << shown(file) << " includes a private header of " << (*i)[1];
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
    for (const auto& file : files_below("src", {".h", ".cpp"}))
        included[*file.lexically_relative(source_dir() / "src").begin()].merge(
            included_folders(text_of(file)));
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
