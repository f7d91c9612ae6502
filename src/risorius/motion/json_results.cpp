// SPDX-License-Identifier: MIT
#include "risorius/motion/json_results.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "risorius/core/json_text.h"
#include "risorius/core/text_lines.h"

namespace risorius::motion {

namespace {

/// Whether all brackets that are opened are closed again. Without a parser, which would compare each key with all others.
bool is_whole(std::string_view line) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (in_string && c == '\\')
            ++i;
        else if (c == '"')
            in_string = !in_string;
        else if (!in_string && (c == '{' || c == '['))
            ++depth;
        else if (!in_string && (c == '}' || c == ']'))
            --depth;
    }
    return depth == 0 && !in_string;
}

}  // namespace

std::optional<JsonCursor> any_key_of(const JsonCursor& json, const std::vector<std::string>& keys) {
    for (const std::string& key : keys)
        if (const auto found = json.find(key); found && !found->json().is_null()) return found;
    return std::nullopt;
}

std::vector<JsonCursor> json_results(const std::filesystem::path& file, const FileKind& kind,
                                     const std::vector<std::string>& lists) {
    const std::string text = read_text(file, kind);
    std::vector<JsonCursor> out;
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    TextLines lines(text);
    std::string_view line;
    while (line.find_first_not_of(" \t") == std::string_view::npos && lines.next())
        line = lines.line();
    const bool by_line =
        first != std::string::npos && text[first] == '{' && is_whole(line) && lines.next();
    if (by_line) {
        for (TextLines each(text); each.next();)
            if (each.line().find_first_not_of(" \t") != std::string_view::npos)
                out.push_back(
                    parse_json_text(std::string(each.line()),
                                    file.string() + ": line " + std::to_string(each.number())));
        return out;
    }
    const JsonCursor json = parse_json_text(text, file);
    if (json.is_array()) return json.items();
    if (const auto list = any_key_of(json, lists)) return list->items();
    return {json};
}

}  // namespace risorius::motion
