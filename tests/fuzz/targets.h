// SPDX-License-Identifier: MIT
/// \file
/// One function for each reader, which gives it the bytes of a file. A reader accepts the bytes or throws Error. Any other
/// exception, a crash, a report of a sanitizer, or work without end is a finding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace risorius::fuzz {

struct Target {
    std::string name;  ///< also the name of its folder in tests/fuzz/seeds
    std::function<void(const std::uint8_t* data, std::size_t size)> read;
};

const std::vector<Target>& targets();

/// Gives the bytes to the reader. Errors of input are caught, everything else escapes.
void run(const Target& target, const std::uint8_t* data, std::size_t size);

}  // namespace risorius::fuzz
