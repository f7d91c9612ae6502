// The one exception for input a person can mend: place first, then what was expected, then what was found.
//   rigs/anna/rig.json:/muscles/3/tendon_slack_m: expected (0, inf), found -0.01
#pragma once

#include <stdexcept>
#include <string>

namespace risorius {

class Error : public std::runtime_error {
  public:
    Error(const std::string& place, const std::string& expected, const std::string& found)
        : std::runtime_error(place + ": expected " + expected + ", found " + found) {}
};

/// The run itself failed though the input was right: a full disk, an encoder that gives up. Exit code 1.
class RunError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// For names in messages.
inline std::string quoted(const std::string& name) { return "\"" + name + "\""; }

}  // namespace risorius
