// SPDX-License-Identifier: MIT
#include "risorius/motion/json_results.h"

#include <nlohmann/json.hpp>

#include "risorius/core/json_text.h"
#include "risorius/core/text_lines.h"

namespace risorius::motion {

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
    const bool by_line = first != std::string::npos && text[first] == '{' &&
                         json_or_null(line).is_object() && lines.next();
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
