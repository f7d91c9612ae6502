// SPDX-License-Identifier: MIT
#include "risorius/core/json_cursor.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "risorius/core/existing_file.h"
#include "risorius/core/json_text.h"
#include "risorius/core/readable_text.h"
#include "risorius/core/text_lines.h"

namespace risorius {

namespace {

/// The value in a message. parse_json_text() limits how deep it is nested.
std::string describe(const Json& value) {
    constexpr std::size_t kLongest = 60;
    if (value.is_object()) return "an object with " + std::to_string(value.size()) + " keys";
    if (value.is_array() && value.size() > kLongest / 2)
        return "an array of " + std::to_string(value.size());
    const std::string text = json_text(value);
    if (value.is_array() && text.size() > kLongest)
        return "an array of " + std::to_string(value.size());
    return shortened_text(text, kLongest);
}

std::string describe_character(char c) {
    if (c == '\n' || c == '\r') return "a line break";
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) return "'" + std::string(1, c) + "'";
    return "a character";
}

std::string describe_range(Range range) {
    const bool low = std::isfinite(range.min), high = std::isfinite(range.max);
    if (!low && !high) return "a finite number";
    return std::string(low ? "[" : "(") + (low ? format_number(range.min) : "-inf") + ", " +
           (high ? format_number(range.max) : "inf") + (high ? "]" : ")");
}

std::string escape_pointer(std::string_view key) {
    std::string out;
    for (char c : key) {
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += c;
    }
    return out;
}

}  // namespace

Json json_or_null(std::string_view text) {
    int depth = 0, deepest = 0;  // brackets in strings count too: this refuses more than it has to
    for (const char c : text) {
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if (c == ']' || c == '}') --depth;
    }
    if (deepest > kDeepestJson) return nullptr;
    Json value = Json::parse(text, nullptr, /*allow_exceptions=*/false);
    return value.is_discarded() ? Json() : value;
}

std::string json_text(const Json& value, int indent) {
    return value.dump(indent, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace);
}

std::string format_number(double value) {
    char buffer[64];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    return std::string(buffer, result.ptr);
}

std::string nearest_name(std::string_view name, const std::vector<std::string_view>& known) {
    // Optimal string alignment: letters changed, added, left out, or swapped with a neighbour.
    std::string best;
    std::size_t best_distance = std::max<std::size_t>(2, name.size() / 3) + 1;
    for (std::string_view candidate : known) {
        std::vector<std::size_t> before, last, row(candidate.size() + 1);
        for (std::size_t j = 0; j <= candidate.size(); ++j) row[j] = j;
        for (std::size_t i = 1; i <= name.size(); ++i) {
            before = std::move(last);
            last = row;
            row[0] = i;
            for (std::size_t j = 1; j <= candidate.size(); ++j) {
                row[j] = std::min(
                    {last[j] + 1, row[j - 1] + 1, last[j - 1] + (name[i - 1] != candidate[j - 1])});
                if (i > 1 && j > 1 && name[i - 1] == candidate[j - 2] &&
                    name[i - 2] == candidate[j - 1])
                    row[j] = std::min(row[j], before[j - 2] + 1);
            }
        }
        if (row.back() < best_distance) {
            best_distance = row.back();
            best = candidate;
        }
    }
    return best;
}

JsonCursor::JsonCursor(std::shared_ptr<const Json> document, std::filesystem::path file,
                       std::string pointer, const Json* value)
    : document_(std::move(document)),
      file_(std::move(file)),
      pointer_(std::move(pointer)),
      value_(value) {}

std::string read_json_text(const std::filesystem::path& file) {
    std::string text = read_text(file, kJsonFile);
    if (text.empty()) throw Error(file.string(), std::string(kJsonFile.name), "an empty file");
    return text;
}

namespace {

/// The place of the byte `at`, "file:line:column".
std::string place_of(const std::string& text, std::size_t at, const std::filesystem::path& name) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
    const std::size_t line_start = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
    const std::size_t column = line_start == std::string::npos ? at + 1 : at - line_start;
    return name.string() + ":" + std::to_string(line) + ":" + std::to_string(column);
}

/// Throws Error when arrays and objects are nested too deep. Code that walks through a value is recursive.
void check_depth(const std::string& text, const std::filesystem::path& name) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string && c == '\\')
            ++i;
        else if (c == '"')
            in_string = !in_string;
        else if (!in_string && (c == '[' || c == '{') && ++depth > kDeepestJson)
            throw Error(
                place_of(text, i, name),
                "at most " + std::to_string(kDeepestJson) + " arrays and objects in one another",
                "one more");
        else if (!in_string && (c == ']' || c == '}'))
            --depth;
    }
}

/// The first key that is given twice in an object, or empty. nlohmann keeps the last of two equal keys, but a script that sets a
/// channel twice is a mistake. The text may be malformed. Throws Error when an object has too many keys, since nlohmann compares
/// each with all others. (Its parser with a callback would find both, but takes the square of the length of an array.)
std::string duplicate_key(const std::string& text, const std::filesystem::path& name) {
    constexpr std::size_t kMostKeys = 10'000;
    struct Open {
        bool is_object;
        std::unordered_set<std::string> keys{};
    };
    std::vector<Open> open;
    std::string duplicate;
    bool expects_key = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '{' || c == '[') open.push_back({c == '{'});
        if ((c == '}' || c == ']') && !open.empty()) open.pop_back();
        if (c == '}' || c == ']') expects_key = false;
        if (c == '{' || c == ',') expects_key = !open.empty() && open.back().is_object;
        if (c != '"') continue;
        const std::size_t begin = i;
        for (++i; i < text.size() && text[i] != '"'; ++i)
            if (text[i] == '\\') ++i;
        if (!expects_key || open.empty()) continue;
        expects_key = false;
        std::string key = text.substr(begin, i - begin + 1);
        if (key.find('\\') != std::string::npos) {
            const Json read = Json::parse(key, nullptr, /*allow_exceptions=*/false);
            if (read.is_string()) key = "\"" + read.get<std::string>() + "\"";
        }
        auto& keys = open.back().keys;
        if (!keys.insert(key).second && duplicate.empty()) duplicate = key;
        if (keys.size() > kMostKeys)
            throw Error(place_of(text, begin, name),
                        "at most " + std::to_string(kMostKeys) + " keys in an object", "one more");
    }
    return duplicate;
}

}  // namespace

JsonCursor parse_json_text(const std::string& text, const std::filesystem::path& name) {
    check_depth(text, name);
    const std::string duplicate = duplicate_key(text, name);
    Json document;
    try {
        document = Json::parse(text);
    } catch (const Json::parse_error& error) {
        const std::size_t at =
            std::min<std::size_t>(error.byte > 0 ? error.byte - 1 : 0, text.size());
        const std::string found = at < text.size()
                                      ? describe_character(text[at]) + " that does not belong there"
                                      : "the end of the file";
        throw Error(place_of(text, at, name), "valid JSON", found);
    } catch (const Json::out_of_range& error) {
        // The text of the exception ends with the number in quotes: "number overflow parsing '1e999'".
        const std::string text_of_error = error.what();
        throw Error(name.string(), "numbers within +-1.8e308",
                    text_of_error.substr(std::min(text_of_error.find('\''), text_of_error.size())));
    }
    if (!duplicate.empty())
        throw Error(name.string(), "every key once in its object", duplicate + " twice");
    return JsonCursor::from_json(std::move(document), name.string());
}

JsonCursor JsonCursor::read_file(const std::filesystem::path& file) {
    return parse_json_text(read_json_text(file), file);
}

JsonCursor JsonCursor::from_json(Json json, const std::string& name) {
    auto document = std::make_shared<Json>(std::move(json));
    const Json* root = document.get();
    return JsonCursor(std::move(document), name, "", root);
}

const std::filesystem::path& JsonCursor::file() const { return file_; }

std::string JsonCursor::place() const {
    return file_.string() + ":" + (pointer_.empty() ? "/" : pointer_);
}

bool JsonCursor::is_object() const { return value_->is_object(); }
bool JsonCursor::is_array() const { return value_->is_array(); }
bool JsonCursor::is_string() const { return value_->is_string(); }
bool JsonCursor::is_number() const { return value_->is_number(); }

bool JsonCursor::has(std::string_view key) const {
    return value_->is_object() && value_->contains(key);
}

JsonCursor JsonCursor::at(std::string_view key) const {
    if (!value_->is_object()) fail("an object");
    const auto found = value_->find(key);
    if (found == value_->end()) fail("the key \"" + std::string(key) + "\"", "none");
    return JsonCursor(document_, file_, pointer_ + "/" + escape_pointer(key), &*found);
}

std::optional<JsonCursor> JsonCursor::find(std::string_view key) const {
    if (!value_->is_object()) fail("an object");
    if (!value_->contains(key)) return std::nullopt;
    return at(key);
}

// A "$schema" at the top names the schema from which an editor shows help. Readers ignore it.
static bool is_for_editors(const std::string& pointer, const std::string& key) {
    return pointer.empty() && key == "$schema";
}

void JsonCursor::allow_keys(const std::vector<std::string_view>& known) const {
    if (!value_->is_object()) fail("an object");
    for (const auto& [key, ignored] : value_->items()) {
        if (is_for_editors(pointer_, key)) continue;
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        const std::string near = nearest_name(key, known);
        std::string expected =
            near.empty() ? "one of" : "a known key (did you mean \"" + near + "\"?)";
        if (near.empty())
            for (std::string_view k : known) expected += " " + std::string(k);
        at(key).fail(expected, "unknown key \"" + key + "\"");
    }
}

std::vector<std::string> JsonCursor::keys() const {
    if (!value_->is_object()) fail("an object");
    std::vector<std::string> out;
    for (const auto& [key, ignored] : value_->items())
        if (!is_for_editors(pointer_, key)) out.push_back(key);
    return out;
}

/// A cursor takes half a kilobyte, with its path and place.
static constexpr std::size_t kMostItems = 1000000;

std::vector<JsonCursor> JsonCursor::items() const {
    if (!value_->is_array()) fail("an array");
    if (value_->size() > kMostItems)
        fail("an array of at most " + std::to_string(kMostItems),
             "one of " + std::to_string(value_->size()));
    std::vector<JsonCursor> out;
    out.reserve(value_->size());
    for (std::size_t i = 0; i < value_->size(); ++i)
        out.push_back(
            JsonCursor(document_, file_, pointer_ + "/" + std::to_string(i), &(*value_)[i]));
    return out;
}

double JsonCursor::number() const {
    if (!value_->is_number()) fail("a number");
    const double value = value_->get<double>();
    if (!std::isfinite(value)) fail("a finite number");
    return value;
}

double JsonCursor::number(Range range) const {
    if (!value_->is_number()) fail("a number in " + describe_range(range));
    const double value = value_->get<double>();
    if (!(value >= range.min && value <= range.max)) fail(describe_range(range));
    return value;
}

int JsonCursor::integer(int min, int max) const {
    const std::string expected =
        "an integer in [" + std::to_string(min) + ", " + std::to_string(max) + "]";
    if (!value_->is_number_integer()) fail(expected);
    const auto value = value_->get<long long>();
    if (value < min || value > max) fail(expected);
    return static_cast<int>(value);
}

bool JsonCursor::boolean() const {
    if (!value_->is_boolean()) fail("true or false");
    return value_->get<bool>();
}

std::string JsonCursor::string() const {
    if (!value_->is_string()) fail("a string");
    return value_->get<std::string>();
}

std::string JsonCursor::one_of(const std::vector<std::string_view>& choices) const {
    std::string expected = "one of";
    for (std::string_view choice : choices) expected += " \"" + std::string(choice) + "\"";
    if (!value_->is_string()) fail(expected);
    const std::string value = value_->get<std::string>();
    if (std::find(choices.begin(), choices.end(), value) == choices.end()) fail(expected);
    return value;
}

Vec3 JsonCursor::vec3() const {
    if (!value_->is_array() || value_->size() != 3) fail("three numbers");
    const auto parts = items();
    return Vec3(parts[0].number(), parts[1].number(), parts[2].number());
}

std::filesystem::path JsonCursor::path() const {
    const std::string text = string();
    // The system would take what stands before it for the name of another file.
    if (text.find('\0') != std::string::npos) fail("a path without a zero byte");
    const std::filesystem::path written = text;
    return written.is_absolute() ? written : (folder() / written).lexically_normal();
}

void JsonCursor::fail(const std::string& expected, const std::string& found) const {
    throw Error(place(), expected, found);
}

void JsonCursor::fail(const std::string& expected) const { fail(expected, describe(*value_)); }

JsonCursor follow_table(const JsonCursor& table) {
    if (!table.is_string()) return table;
    const std::filesystem::path file = existing_file(table);
    return JsonCursor::read_file(file);
}

}  // namespace risorius
