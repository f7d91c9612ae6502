// SPDX-License-Identifier: MIT
/// \file
/// Error, the exception for input that the user can correct. Its message names the place, then what was expected, then what was
/// found:
///   rigs/anna/rig.json:/muscles/3/tendon_slack_m: expected (0, inf), found -0.01
/// Messages are valid UTF-8 in one line without control characters, whatever the input holds, see readable_text().
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "risorius/core/readable_text.h"

namespace risorius {

/// Thrown for wrong input. Programs then return the exit code 2.
class Error : public std::runtime_error {
  public:
    Error(const std::string& place, const std::string& expected, const std::string& found)
        : Error(place + ": expected " + expected + ", found " + found) {}

    /// The message, in which each name of an option that option_name() has marked is replaced by `word_for(field)`.
    std::string worded(const std::function<std::string(const std::string&)>& word_for) const {
        return readable_text(put_words(marked_, word_for));
    }

  private:
    explicit Error(const std::string& marked)
        : std::runtime_error(
              readable_text(put_words(marked, [](const std::string& field) { return field; }))),
          marked_(marked) {}
    static std::string put_words(const std::string& marked,
                                 const std::function<std::string(const std::string&)>& word_for) {
        std::string out;
        for (std::size_t i = 0; i < marked.size(); ++i) {
            const std::size_t end =
                marked[i] == '\x01' ? marked.find('\x02', i) : std::string::npos;
            if (end == std::string::npos) {
                out += marked[i];
            } else {
                out += word_for(marked.substr(i + 1, end - i - 1));
                i = end;
            }
        }
        return out;
    }

    std::string marked_;
};

/// Marks the name of an option in the message of an Error. A function of the library passes the name of the field in its struct
/// of options, and what() contains this name. A program can replace it by its own word, such as a flag of its command line; see
/// Error::worded().
inline std::string option_name(const std::string& field) { return "\x01" + field + "\x02"; }

/// Thrown when a run failed although the input was correct, for instance because of a full disk or a failed encoder. Programs
/// then return the exit code 1.
class RunError : public std::runtime_error {
  public:
    explicit RunError(const std::string& message) : std::runtime_error(readable_text(message)) {}
};

/// A name in quotes, for messages.
inline std::string in_quotes(const std::string& name) { return "\"" + name + "\""; }

}  // namespace risorius
