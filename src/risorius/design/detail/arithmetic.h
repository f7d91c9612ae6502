// Sums that a design file writes for a number: "onset_s * 1.5 + 0.1".
//
//   sum     = term (("+" | "-") term)*
//   term    = factor (("*" | "/") factor)*
//   factor  = number | name | "(" sum ")" | ("-" | "+") factor | ("min" | "max") "(" sum "," sum ")"
#pragma once

#include <functional>
#include <string>

namespace risorius::design {

/// Value of `text`; `value_of` knows the names. Throws Error naming `place` when it cannot be read or is not finite.
double arithmetic(const std::string& text, const std::string& place,
                  const std::function<double(const std::string& name)>& value_of);

}  // namespace risorius::design
