// SPDX-License-Identifier: MIT
/// \file
/// The named values of a condition, which are filled into the template of a script.
///
/// A string of a template may be
///
///   "${name}"            the value itself, of any type: number, text, list, null
///   "= name * 2 + 0.1"   a number, see arithmetic.h
///   "happy_${name}.wav"  text with values in it
///
/// Values of parameters may use the same forms, with the names of other parameters.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::design {

/// A named value, with its position in the file.
struct Given {
    std::string name;
    JsonCursor value;
};

/// Parameters with their references resolved.
class Parameters {
  public:
    /// If a name is given several times, the last value is used. Throws Error when a value depends on itself or on an unknown
    /// name.
    explicit Parameters(const std::vector<Given>& given);
    ~Parameters();
    Parameters(Parameters&&) noexcept;

    bool has(const std::string& name) const;
    const Json& at(const std::string& name) const;
    std::vector<std::string> names() const;  ///< ascending
    /// Returns the value as text for file names and tables: numbers in their shortest form, text unchanged.
    std::string text(const std::string& name) const;

    /// Returns `value` with all names replaced by their values. Throws Error that names the position in its file.
    Json filled(const JsonCursor& value) const;
    /// Does the same for text that contains ${name}.
    std::string filled_text(const std::string& text, const std::string& place) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Returns a number as JSON; an integer is written without a decimal point.
Json json_number(double value);

/// Returns whether a name is valid in ${name}: letters, digits and _, starting with a letter.
bool is_parameter_name(const std::string& name);

}  // namespace risorius::design
