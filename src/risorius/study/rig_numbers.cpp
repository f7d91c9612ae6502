// SPDX-License-Identifier: MIT
#include "risorius/study/rig_numbers.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <span>

#include "risorius/core/error.h"
#include "risorius/core/readable_text.h"

namespace risorius::study {

namespace {

std::vector<std::string> steps_of(const std::string& path) {
    std::vector<std::string> out{""};
    for (const char c : path)
        if (c == '/')
            out.emplace_back();
        else
            out.back() += c;
    return out;
}

std::string escaped(std::string_view key) {
    std::string out;
    for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return out;
}

/// How an entry of a list can be named; empty: by its index alone.
std::string name_of(const Json& entry) {
    if (!entry.is_object()) return "";
    for (const char* key : {"id", "landmark"})
        if (const auto found = entry.find(key); found != entry.end() && found->is_string())
            return found->get<std::string>();
    return "";
}

/// An entry of an object or a list: its key or index, its other name if it has one, and its value.
struct Entry {
    std::string key, name;
    const Json* value;
};

std::vector<Entry> entries_of(const Json& value) {
    std::vector<Entry> out;
    if (value.is_object())
        for (const auto& [key, entry] : value.items()) out.push_back({key, "", &entry});
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i)
            out.push_back({std::to_string(i), name_of(value[i]), &value[i]});
    return out;
}

struct Search {
    const std::string &path, &place;
    std::vector<std::string> found;

    [[noreturn]] void fail(const std::string& pointer, const std::string& step,
                           const std::vector<Entry>& entries) const {
        std::vector<std::string_view> names;
        for (const Entry& entry : entries)
            names.push_back(entry.name.empty() ? entry.key : entry.name);
        const std::string near = nearest_name(step, names);
        std::string expected = "a number of the rig; ";
        if (entries.empty())
            expected += "\"" + pointer + "\" has no parts";
        else if (!near.empty())
            expected += "\"" + pointer + "\" has \"" + near + "\" (did you mean it?)";
        else {
            expected += "\"" + pointer + "\" has";
            for (std::size_t i = 0; i < names.size() && i < 20; ++i)
                expected += " " + std::string(names[i]);
            if (names.size() > 20) expected += " ...";
        }
        throw Error(place, expected, in_quotes(path));
    }

    void follow(const Json& value, const std::string& pointer, std::span<const std::string> steps) {
        if (steps.empty()) {
            if (!value.is_number())
                throw Error(place, "the path of a number",
                            in_quotes(path) + ", which is " +
                                (value.is_array()    ? "a list; end it with \"/*\" or an index"
                                 : value.is_object() ? "an object; end it with \"/*\" or a key"
                                                     : "no number"));
            found.push_back(pointer);
            return;
        }
        const std::vector<Entry> entries = entries_of(value);
        bool any = false;
        for (const Entry& entry : entries) {
            if (steps.front() != "*" && steps.front() != entry.key && steps.front() != entry.name)
                continue;
            // "*" means all numbers: a text beside them, such as the kind of the bundles, is passed over.
            if (steps.front() == "*" && steps.size() == 1 &&
                (entry.value->is_string() || entry.value->is_boolean()))
                continue;
            any = true;
            follow(*entry.value, pointer + "/" + escaped(entry.key), steps.subspan(1));
        }
        if (!any) fail(pointer.empty() ? "/" : pointer.substr(1), steps.front(), entries);
    }
};

}  // namespace

std::vector<std::string> rig_numbers(const Json& rig, const std::string& path,
                                     const std::string& place) {
    Search search{path, place, {}};
    const std::vector<std::string> steps = steps_of(path);
    search.follow(rig, "", steps);
    return std::move(search.found);
}

}  // namespace risorius::study
