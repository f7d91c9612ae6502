// SPDX-License-Identifier: MIT
#include "risorius/report/folder_name.h"

namespace risorius::report {

std::string folder_name(const std::string& name, std::set<std::string>& taken) {
    std::string out;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '_' || c == '-';
        out += plain ? c : '_';
    }
    // Some file systems ignore case.
    const auto lower = [](std::string text) {
        for (char& c : text)
            if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        return text;
    };
    std::string unique = out;
    for (int n = 2; !taken.insert(lower(unique)).second; ++n)
        unique = out + "-" + std::to_string(n);
    return unique;
}

}  // namespace risorius::report
