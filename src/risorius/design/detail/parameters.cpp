// SPDX-License-Identifier: MIT
#include "risorius/design/detail/parameters.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/design/detail/arithmetic.h"

namespace risorius::design {

namespace {

std::string text_of(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number()) return format_number(value.get<double>());
    if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
    if (value.is_null()) return "none";
    return json_text(value);
}

using ValueOf = std::function<const Json&(const std::string& name, const std::string& place)>;

// References may double what they refer to again and again: some lines would fill the memory.
constexpr std::size_t kLargest = 1000000;  // letters and values of one value
constexpr int kDeepest = 200;              // lists and objects in one another, as in any JSON
constexpr std::size_t kLongestChain = 100;

/// Adds the letters and values of a value. Throws Error when they, or the lists and objects in one another, become too many.
void measure(const Json& value, const std::string& place, std::size_t& used, int depth = 0) {
    if (depth > kDeepest)
        throw Error(place,
                    "at most " + std::to_string(kDeepest) + " lists and objects in one another",
                    "more with the values of parameters");
    used += 1 + (value.is_string() ? value.get_ref<const std::string&>().size() : 0);
    if (used > kLargest)
        throw Error(place, "at most " + std::to_string(kLargest) + " letters and values",
                    "more with the values of parameters");
    for (const auto& item : value.items())
        if (value.is_structured()) measure(item.value(), place, used, depth + 1);
}

/// The name in a text that is exactly "${name}"; otherwise empty.
std::string whole_reference(const std::string& text) {
    if (text.size() < 4 || text.compare(0, 2, "${") != 0 || text.back() != '}') return {};
    const std::string name = text.substr(2, text.size() - 3);
    return is_parameter_name(name) ? name : std::string();
}

/// `known`: a map whose keys are the valid names.
[[noreturn]] void fail_unknown(const std::string& name, const std::string& place,
                               const auto& known) {
    std::vector<std::string> names;
    for (const auto& [one, value] : known) names.push_back(one);
    throw Error(place, "a parameter of the design" + did_you_mean(name, names),
                risorius::in_quotes(name));
}

std::string fill_text(const std::string& text, const std::string& place, const ValueOf& value_of) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        if (text.compare(i, 2, "${") != 0) {
            out += text[i++];
            continue;
        }
        const std::size_t end = text.find('}', i);
        const std::string name = end == std::string::npos ? "" : text.substr(i + 2, end - i - 2);
        if (!is_parameter_name(name))
            throw Error(place, "${name of a parameter}", risorius::in_quotes(text.substr(i)));
        const Json& value = value_of(name, place);
        std::size_t used = out.size();
        measure(value, place, used);
        out += text_of(value);
        i = end + 1;
    }
    return out;
}

/// `used`: what has been filled in so far, see measure().
Json fill(const JsonCursor& value, const ValueOf& value_of, std::size_t& used) {
    if (value.is_object()) {
        Json out = Json::object();
        for (const std::string& key : value.keys()) {
            const std::string filled = fill_text(key, value.at(key).place(), value_of);
            if (out.contains(filled))
                value.at(key).fail("every key once", risorius::in_quotes(filled) + " again");
            out[filled] = fill(value.at(key), value_of, used);
        }
        return out;
    }
    if (value.is_array()) {
        Json out = Json::array();
        for (const JsonCursor& item : value.items()) out.push_back(fill(item, value_of, used));
        return out;
    }
    if (!value.is_string()) return value.json();
    const std::string text = value.string();
    if (const std::string name = whole_reference(text); !name.empty()) {
        const Json& found = value_of(name, value.place());
        measure(found, value.place(), used);
        return found;
    }
    if (!text.empty() && text[0] == '=')
        return json_number(arithmetic(text.substr(1), value.place(), [&](const std::string& name) {
            const Json& found = value_of(name, value.place());
            if (!found.is_number())
                throw Error(value.place(), "a number for " + risorius::in_quotes(name),
                            json_text(found));
            return found.get<double>();
        }));
    std::string filled = fill_text(text, value.place(), value_of);
    used += filled.size() - std::min(filled.size(), text.size());
    return filled;
}

Json filled_within_limits(const JsonCursor& value, const ValueOf& value_of) {
    std::size_t used = 0;
    Json out = fill(value, value_of, used);
    used = 0;
    measure(out, value.place(), used);
    return out;
}

}  // namespace

Json json_number(double value) {
    constexpr double kExact = 9007199254740992.0;
    if (value == std::round(value) && std::abs(value) <= kExact)
        return static_cast<std::int64_t>(value);
    return value;
}

bool is_parameter_name(const std::string& name) {
    return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
           std::all_of(name.begin(), name.end(), [](char c) {
               return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
           });
}

struct Parameters::Impl {
    std::map<std::string, Json> values;

    const Json& at(const std::string& name, const std::string& place) const {
        const auto found = values.find(name);
        if (found == values.end()) fail_unknown(name, place, values);
        return found->second;
    }
};

Parameters::Parameters(const std::vector<Given>& given) : impl_(std::make_unique<Impl>()) {
    std::map<std::string, const JsonCursor*> open;
    for (const Given& one : given) open.insert_or_assign(one.name, &one.value);
    std::vector<std::string> chain;  // names that depend on each other, outermost first
    const std::function<const Json&(const std::string&, const std::string&)> resolve =
        [&](const std::string& name, const std::string& place) -> const Json& {
        const auto known = impl_->values.find(name);
        if (known != impl_->values.end()) return known->second;
        const auto source = open.find(name);
        if (source == open.end()) fail_unknown(name, place, open);
        if (std::find(chain.begin(), chain.end(), name) != chain.end()) {
            std::string circle;
            for (const std::string& step : chain) circle += step + " -> ";
            throw Error(source->second->place(), "a value that does not depend on itself",
                        circle + name);
        }
        if (chain.size() == kLongestChain)
            throw Error(source->second->place(),
                        "a chain of at most " + std::to_string(kLongestChain) +
                            " parameters that depend on one another",
                        "a longer one");
        chain.push_back(name);
        Json value = filled_within_limits(*source->second, resolve);
        chain.pop_back();
        return impl_->values.emplace(name, std::move(value)).first->second;
    };
    for (const auto& [name, value] : open) resolve(name, value->place());
}

Parameters::~Parameters() = default;
Parameters::Parameters(Parameters&&) noexcept = default;

bool Parameters::has(const std::string& name) const { return impl_->values.count(name) > 0; }
const Json& Parameters::at(const std::string& name) const { return impl_->at(name, name); }

std::vector<std::string> Parameters::names() const {
    std::vector<std::string> out;
    for (const auto& [name, value] : impl_->values) out.push_back(name);
    return out;
}

std::string Parameters::text(const std::string& name) const { return text_of(at(name)); }

Json Parameters::filled(const JsonCursor& value) const {
    std::size_t used = 0;
    return fill(
        value,
        [this](const std::string& name, const std::string& place) -> const Json& {
            return impl_->at(name, place);
        },
        used);
}

std::string Parameters::filled_text(const std::string& text, const std::string& place) const {
    return fill_text(text, place,
                     [this](const std::string& name, const std::string& where) -> const Json& {
                         return impl_->at(name, where);
                     });
}

}  // namespace risorius::design
