// SPDX-License-Identifier: MIT
/// \file
/// A place in a JSON file: reads values and, when something is wrong, says which file, where in it (JSON pointer),
/// what was expected and what was found. Unknown keys are errors, so every reader lists the keys it knows.
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/core/error.h"
#include "risorius/core/types.h"

namespace risorius {

/// Keys keep the order of the file. Declared only: who looks into one includes <nlohmann/json.hpp>, which costs seconds.
using Json = nlohmann::ordered_json;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Closed interval; the ends may be infinite.
struct Range {
    double min;
    double max;
};

class JsonCursor {
  public:
    /// Reads and parses a file. Throws Error on a missing file, malformed JSON (with line and column) or a key given twice.
    static JsonCursor read_file(const std::filesystem::path& file);

    /// For tests and tables already in memory; `name` stands where the file's path would.
    static JsonCursor from_json(Json json, const std::string& name);

    /// The file this value came from (as given), its folder, and its place "file:/json/pointer".
    const std::filesystem::path& file() const;
    std::filesystem::path folder() const { return file().parent_path(); }
    std::string place() const;
    const Json& json() const { return *value_; }

    bool has(std::string_view key) const;
    JsonCursor at(std::string_view key) const;  ///< throws when the key is missing
    std::optional<JsonCursor> find(std::string_view key) const;

    /// Throws when this is not an object or has a key outside the list (naming the nearest known one).
    void allow_keys(const std::vector<std::string_view>& known) const;
    std::vector<std::string> keys() const;  ///< throws when this is not an object
    std::vector<JsonCursor> items() const;  ///< throws when this is not an array
    bool is_object() const;
    bool is_array() const;
    bool is_string() const;
    bool is_number() const;

    double number() const;  ///< finite
    double number(Range range) const;
    int integer(int min, int max) const;
    bool boolean() const;
    std::string string() const;
    std::string one_of(const std::vector<std::string_view>& choices) const;
    Vec3 vec3() const;

    /// A path written in this file, made relative to the file's folder.
    std::filesystem::path path() const;

    [[noreturn]] void fail(const std::string& expected, const std::string& found) const;
    [[noreturn]] void fail(const std::string& expected) const;  ///< found: this value, shortened

  private:
    JsonCursor(std::shared_ptr<const Json> document, std::filesystem::path file,
               std::string pointer, const Json* value);

    std::shared_ptr<const Json> document_;
    std::filesystem::path file_;
    std::string pointer_;
    const Json* value_;
};

/// If `table` is a string it names another JSON file, relative to the file it stands in; otherwise it is the table itself.
JsonCursor follow_table(const JsonCursor& table);

/// "a.json" + nearest of `known` by edit distance, or empty when nothing is near. For "did you mean" in messages.
std::string nearest_name(std::string_view name, const std::vector<std::string_view>& known);

/// Shortest decimal form of a number that reads back the same.
std::string format_number(double value);

}  // namespace risorius
