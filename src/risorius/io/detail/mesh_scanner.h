// SPDX-License-Identifier: MIT
/// \file
/// Goes through the bytes of a mesh file that mixes text and binary numbers. Every count that it returns is one that the bytes can hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace risorius::io::detail {

/// Types of binary numbers.
enum class Scalar {
    kInt8,
    kUInt8,
    kInt16,
    kUInt16,
    kInt32,
    kUInt32,
    kInt64,
    kUInt64,
    kFloat,
    kDouble
};
std::size_t bytes_of(Scalar type);

/// The numbers of a block of bytes, `bytes.size()` / bytes_of(type) of them. `swapped`: whether their bytes are in the other order than
/// this machine's.
std::vector<double> numbers_of(std::string_view bytes, Scalar type, bool swapped);

class MeshScanner {
  public:
    /// `comment`: a letter that begins a comment to the end of its line; 0: none. The text must outlive this object.
    MeshScanner(std::string_view text, std::string name, char comment = 0)
        : text_(text), name_(std::move(name)), comment_(comment) {}

    /// The next word; empty at the end of the file.
    std::string_view word();
    /// The rest of this line, without the line break.
    std::string_view line();
    double number(std::string_view what);
    long long integer(std::string_view what, long long min, long long max);
    /// A count of things that take so many bytes at least.
    std::size_t count(std::string_view what, std::size_t bytes_each, std::size_t most);
    void expect(std::string_view word);
    /// The next bytes. Throws Error when there are fewer.
    std::string_view bytes(std::size_t count, std::string_view what);
    std::vector<double> numbers(std::size_t count, Scalar type, bool swapped,
                                std::string_view what);
    /// The next binary number, which must be an integer from min to max.
    long long binary_integer(Scalar type, bool swapped, std::string_view what, long long min,
                             long long max);

    std::size_t left() const { return text_.size() - at_; }
    std::size_t position() const { return at_; }
    void go_to(std::size_t position) { at_ = position; }
    [[noreturn]] void fail(const std::string& expected, const std::string& found) const;

  private:
    void skip_blanks();

    std::string_view text_;
    std::string name_;
    char comment_;
    std::size_t at_ = 0;
};

}  // namespace risorius::io::detail
