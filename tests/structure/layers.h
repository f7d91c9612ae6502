// SPDX-License-Identifier: MIT
/// \file
/// The declared architecture (risorius_module lines of src/CMakeLists.txt) and the includes that have to keep to it.
#pragma once

#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace risorius::structure {

/// Folder -> folders it may include, from lines such as `risorius_module(geom USES core LINKS x)  # why`.
inline std::map<std::string, std::set<std::string>> declared_uses(const std::string& cmake) {
    std::map<std::string, std::set<std::string>> uses;
    const std::regex module(R"((?:^|\n)risorius_module\(([^)]*)\))");
    for (std::sregex_iterator i(cmake.begin(), cmake.end(), module), end; i != end; ++i) {
        const std::string arguments = (*i)[1];
        const std::regex word(R"(\S+)");
        std::string folder, section;
        for (std::sregex_iterator w(arguments.begin(), arguments.end(), word); w != end; ++w) {
            const std::string text = w->str();
            if (folder.empty())
                uses[folder = text];
            else if (text == "USES" || text == "LINKS")
                section = text;
            else if (section == "USES")
                uses[folder].insert(text);
        }
    }
    return uses;
}

/// The modules named by #include "risorius/<module>/..." lines.
inline std::set<std::string> included_modules(const std::string& source) {
    std::set<std::string> modules;
    const std::regex include(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*"risorius/([^"/]+)/[^"]*")re");
    for (std::sregex_iterator i(source.begin(), source.end(), include), end; i != end; ++i)
        modules.insert((*i)[1]);
    return modules;
}

/// The headers named by #include "risorius/..." lines, as written.
inline std::set<std::string> included_headers(const std::string& source) {
    std::set<std::string> headers;
    const std::regex include(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*"(risorius/[^"]*)")re");
    for (std::sregex_iterator i(source.begin(), source.end(), include), end; i != end; ++i)
        headers.insert((*i)[1]);
    return headers;
}

/// Includes of project headers without their folder, which would get round the check above.
inline std::vector<std::string> bare_includes(const std::string& source) {
    std::vector<std::string> names;
    const std::regex include(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*"([^"/]+|\.\.?/[^"]*)")re");
    for (std::sregex_iterator i(source.begin(), source.end(), include), end; i != end; ++i)
        names.push_back((*i)[1]);
    return names;
}

}  // namespace risorius::structure
