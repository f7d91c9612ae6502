// SPDX-License-Identifier: MIT
#include "risorius/view/document.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "risorius/core/json_text.h"

namespace risorius::view {

namespace {

using Pointer = Json::json_pointer;

Pointer pointer_of(const std::string& text) {
    try {
        Pointer pointer(text);
        if (!pointer.empty()) return pointer;
    } catch (const Json::exception&) {
    }
    throw Error("edit", "a JSON pointer to a part of the script", in_quotes(text));
}

/// Whether a value has such a place. The library throws where it should say no: for an index without digits, or beyond 2^64.
bool has_place(const Json& value, const Pointer& pointer) {
    try {
        return value.contains(pointer);
    } catch (const Json::exception&) {
        return false;
    }
}

/// The number of an entry of an array, or its size for one that is to be appended.
std::size_t index_of(const std::string& text, const Json& array, const std::string& pointer) {
    const bool digits = !text.empty() && text.size() < 9 &&
                        text.find_first_not_of("0123456789") == std::string::npos;
    const std::size_t index = digits ? std::stoul(text) : array.size() + 1;
    if (index <= array.size()) return index;
    throw Error("edit " + pointer, "an index in [0, " + std::to_string(array.size()) + "]",
                in_quotes(text));
}

/// Puts a new key before the entry with the number `place`: objects of ordered JSON can only grow at their end.
void insert_key(Json& object, const std::string& key, const Json& value, std::size_t place) {
    Json grown = Json::object();
    std::size_t at = 0;
    for (auto entry = object.begin(); entry != object.end(); ++entry, ++at) {
        if (at == place) grown[key] = value;
        grown[entry.key()] = std::move(entry.value());
    }
    if (at <= place) grown[key] = value;
    object = std::move(grown);
}

bool has_structure(const Json& value) {
    return std::any_of(value.begin(), value.end(),
                       [](const Json& item) { return item.is_structured(); });
}

/// Lists of numbers stand on one line, and so do keys [time_s, value].
void write(const Json& value, int indent, std::string& out) {
    const bool flat = value.is_array() && !has_structure(value);
    if (!value.is_structured() || value.empty() || flat) {
        std::string text = json_text(value);
        if (flat)
            for (std::size_t i = 0; (i = text.find(',', i)) != std::string::npos; i += 2)
                text.replace(i, 1, ", ");
        out += text;
        return;
    }
    const std::string margin(static_cast<std::size_t>(indent) + 2, ' ');
    out += value.is_array() ? "[\n" : "{\n";
    bool first = true;
    for (auto entry = value.begin(); entry != value.end(); ++entry) {
        if (!first) out += ",\n";
        first = false;
        out += margin;
        if (value.is_object()) out += json_text(Json(entry.key())) + ": ";
        write(entry.value(), indent + 2, out);
    }
    out +=
        "\n" + std::string(static_cast<std::size_t>(indent), ' ') + (value.is_array() ? "]" : "}");
}

}  // namespace

Document::Document(Json script) : json_(std::make_shared<Json>(std::move(script))) {}

std::string Document::text() const {
    std::string out;
    write(*json_, 0, out);
    return out + "\n";
}

Operation Document::make(const Operation& operation) {
    const Pointer pointer = pointer_of(operation.pointer);
    const Pointer above = pointer.parent_pointer();
    if (!above.empty() && !has_place(*json_, above))
        throw Error("edit " + operation.pointer, "a place in the script", "none");
    Json& parent = above.empty() ? *json_ : (*json_)[above];
    const std::string& key = pointer.back();
    Operation inverse{operation.pointer, nullptr, std::nullopt};
    if (parent.is_object()) {
        const auto found = parent.find(key);
        if (found != parent.end()) {
            inverse.value = std::make_shared<Json>(*found);
            if (operation.value) {
                *found = *operation.value;
            } else {
                inverse.place = static_cast<std::size_t>(std::distance(parent.begin(), found));
                parent.erase(key);
            }
        } else if (operation.value) {
            insert_key(parent, key, *operation.value, operation.place.value_or(parent.size()));
        }
        return inverse;
    }
    if (!parent.is_array())
        throw Error("edit " + operation.pointer, "a place in an object or a list", "a plain value");
    const std::size_t index = index_of(key, parent, operation.pointer);
    const auto at = parent.begin() + static_cast<std::ptrdiff_t>(index);
    if (operation.place) {  // an entry that had been removed comes back
        parent.insert(at, *operation.value);
    } else if (index == parent.size()) {
        if (operation.value) parent.push_back(*operation.value);
    } else {
        inverse.value = std::make_shared<Json>(*at);
        if (operation.value) {
            *at = *operation.value;
        } else {
            inverse.place = index;
            parent.erase(at);
        }
    }
    return inverse;
}

std::vector<Operation> Document::make_all(const std::vector<Operation>& operations) {
    std::vector<Operation> inverse;
    try {
        for (const Operation& operation : operations) inverse.push_back(make(operation));
    } catch (const Error&) {
        for (auto back = inverse.rbegin(); back != inverse.rend(); ++back) make(*back);
        throw;
    }
    ++revision_;
    return inverse;
}

void Document::edit(const std::vector<Operation>& operations, const std::string& gesture) {
    last_ = make_all(operations);
    last_joined_ = !gesture.empty() && !undo_.empty() && undo_.back().gesture == gesture;
    redo_before_ = std::exchange(redo_, {});
    if (!last_joined_) undo_.push_back({gesture, {}});
    std::vector<Operation>& inverse = undo_.back().inverse;
    kept_before_ = inverse.size();
    for (const Operation& one : last_) {
        // A drag changes the same value again and again; the first value is the one to go back to.
        if (last_joined_ && !inverse.empty() && inverse.back().pointer == one.pointer &&
            inverse.back().value && one.value && !one.place)
            continue;
        inverse.push_back(one);
    }
    if (undo_.size() > kDeepestUndo) undo_.erase(undo_.begin());
}

void Document::reject() {
    for (auto back = last_.rbegin(); back != last_.rend(); ++back) make(*back);
    last_.clear();
    if (undo_.empty()) return;
    if (last_joined_)
        undo_.back().inverse.resize(kept_before_);
    else
        undo_.pop_back();
    redo_ = std::exchange(redo_before_, {});
    --revision_;
}

bool Document::undo() {
    if (undo_.empty()) return false;
    Step step = std::move(undo_.back());
    undo_.pop_back();
    std::reverse(step.inverse.begin(), step.inverse.end());
    redo_.push_back({step.gesture, make_all(step.inverse)});
    return true;
}

bool Document::redo() {
    if (redo_.empty()) return false;
    Step step = std::move(redo_.back());
    redo_.pop_back();
    std::reverse(step.inverse.begin(), step.inverse.end());
    // What is made again is not joined with what follows.
    undo_.push_back({"", make_all(step.inverse)});
    return true;
}

Operation read_operation(const JsonCursor& json) {
    json.allow_keys({"path", "value"});
    Operation operation{json.at("path").string(), nullptr, std::nullopt};
    if (const auto value = json.find("value"))
        operation.value = std::make_shared<Json>(value->json());
    return operation;
}

}  // namespace risorius::view
