// SPDX-License-Identifier: MIT
/// \file
/// A value in a JSON file with its place. It is read through a cursor, which also reports errors: the file, the place in it
/// (JSON pointer), what was expected and what was found. Unknown keys are errors, so every function that reads an object lists
/// the keys it knows.
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

/// A JSON value, whose keys keep the order of the file. The type is only declared here. Files that use its members must include
/// <nlohmann/json.hpp>, which takes seconds to compile.
using Json = nlohmann::ordered_json;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Closed interval; the ends may be infinite.
struct Range {
    double min;
    double max;
};

/// A value of a JSON document with its place. Copies share the document.
class JsonCursor {
  public:
    /// Reads and parses a file. Throws Error when the file is missing, when the JSON is malformed (with line and column), or
    /// when a key is given twice.
    static JsonCursor read_file(const std::filesystem::path& file);

    /// Makes a cursor for JSON in memory, for tests and tables. `name` replaces the path of the file in messages.
    static JsonCursor from_json(Json json, const std::string& name);

    /// The path of the file with this value, as it was passed to read_file().
    const std::filesystem::path& file() const;
    std::filesystem::path folder() const { return file().parent_path(); }
    /// The place of this value, "file:/json/pointer".
    std::string place() const;
    const Json& json() const { return *value_; }

    bool has(std::string_view key) const;
    JsonCursor at(std::string_view key) const;  ///< throws Error when the key is missing
    std::optional<JsonCursor> find(std::string_view key) const;  ///< empty when the key is missing

    /// Throws Error when this is not an object, or when it has a key outside the list. The message contains the known key that
    /// is most similar.
    void allow_keys(const std::vector<std::string_view>& known) const;
    std::vector<std::string> keys() const;  ///< throws Error when this is not an object
    std::vector<JsonCursor> items() const;  ///< throws Error when this is not an array
    bool is_object() const;
    bool is_array() const;
    bool is_string() const;
    bool is_number() const;

    /// The readers below throw Error when the value has another type, is outside its range or is not one of the choices.
    double number() const;  ///< finite
    double number(Range range) const;
    int integer(int min, int max) const;
    bool boolean() const;
    std::string string() const;
    std::string one_of(const std::vector<std::string_view>& choices) const;
    Vec3 vec3() const;

    /// The path in this string, which is relative to the folder of this file.
    std::filesystem::path path() const;

    /// Throws Error with this place.
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

/// Returns a table that may be in another file. When `table` is a string, it is the path of a JSON file, relative to the folder
/// of its own file, and the result is the content of that file. Otherwise the result is `table` itself.
JsonCursor follow_table(const JsonCursor& table);

/// The name in `known` with the smallest edit distance from `name`, or empty when none is similar. For "did you mean" in
/// messages.
std::string nearest_name(std::string_view name, const std::vector<std::string_view>& known);

/// The shortest decimal form of a number from which the same number is read again.
std::string format_number(double value);

}  // namespace risorius
