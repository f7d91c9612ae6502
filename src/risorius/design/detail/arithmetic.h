// SPDX-License-Identifier: MIT
/// \file
/// Formulas that stand for a number in a design file: "onset_s * 1.5 + 0.1".
///
///   sum     = term (("+" | "-") term)*
///   term    = factor (("*" | "/") factor)*
///   factor  = number | name | "(" sum ")" | ("-" | "+") factor | ("min" | "max") "(" sum "," sum ")"
#pragma once

#include <functional>
#include <string>

namespace risorius::design {

/// Evaluates the formula `text`. `value_of` returns the value of a name. Throws Error when the formula is wrong or its value is
/// not finite; the message begins with `place`.
double arithmetic(const std::string& text, const std::string& place,
                  const std::function<double(const std::string& name)>& value_of);

}  // namespace risorius::design
