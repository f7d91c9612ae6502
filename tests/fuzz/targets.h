// SPDX-License-Identifier: MIT
/// \file
/// One function for each reader, which gives it the bytes of a file. A reader accepts the bytes or throws Error. Any other
/// exception, a crash, a report of a sanitizer, or work without end is a finding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace risorius::fuzz {

/// A number of what was read: two results that differ have, almost surely, two digests.
class Digest {
  public:
    void add(const void* bytes, std::size_t size);
    void add(const std::string& text) { add(text.data(), text.size() + 1); }
    template <typename Value>
    requires std::is_arithmetic_v<Value>
    void add(Value value) { add(&value, sizeof value); }
    template <typename Values>
    requires requires(const Values& values) { values.data(), values.size(); }
    void add(const Values& values) {
        add(static_cast<std::int64_t>(values.size()));
        add(values.data(), static_cast<std::size_t>(values.size()) * sizeof *values.data());
    }
    std::uint64_t value() const { return sum_; }

  private:
    std::uint64_t sum_ = 14695981039346656037U;  // FNV-1a
};

struct Target {
    std::string name;  ///< also the name of its folder in tests/fuzz/seeds
    std::function<void(const std::uint8_t* data, std::size_t size, Digest& digest)> read;
};

const std::vector<Target>& targets();

/// Gives the bytes to the reader. Errors of input are caught, everything else escapes. Returns the digest of what was read; 0 when
/// the reader refuses.
std::uint64_t run(const Target& target, const std::uint8_t* data, std::size_t size);

}  // namespace risorius::fuzz
