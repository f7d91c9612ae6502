// The named values of one condition, and a script template filled in with them.
//
// A string of a template is  "${name}"           the value itself, whatever it is: number, text, list, null
//                            "= name * 2 + 0.1"  a number, see arithmetic.h
//                            "happy_${name}.wav" text with values in it
// Values may be written like that too, of other parameters.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::design {

/// A value and where it was given, for messages.
struct Given {
    std::string name;
    JsonCursor value;
};

class Parameters {
  public:
    /// The last of a name counts. Throws Error when one of them hangs on itself or on a name that is none.
    explicit Parameters(const std::vector<Given>& given);
    ~Parameters();
    Parameters(Parameters&&) noexcept;

    bool has(const std::string& name) const;
    const Json& at(const std::string& name) const;
    std::vector<std::string> names() const;  ///< ascending
    /// As a file name or a table has it: numbers in their shortest form, text as it is.
    std::string text(const std::string& name) const;

    /// `value` with everything in it filled in. Throws Error naming the place in its file.
    Json filled(const JsonCursor& value) const;
    /// Text with ${name} in it.
    std::string filled_text(const std::string& text, const std::string& place) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// A whole number as JSON writes whole numbers.
Json json_number(double value);

/// Names that ${...} may have: letters, digits and _, a letter first.
bool is_parameter_name(const std::string& name);

}  // namespace risorius::design
