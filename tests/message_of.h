// SPDX-License-Identifier: MIT
/// \file
/// What an Error says, for tests of messages.
#pragma once

#include <string>

#include "risorius/core/error.h"

namespace risorius {

/// The message of the Error that `call` throws, or "no error".
template <class Call>
std::string message_of(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace risorius
