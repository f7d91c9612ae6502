// SPDX-License-Identifier: MIT
#include "risorius/io/detail/mesh_scanner.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "risorius/core/error.h"
#include "risorius/core/readable_text.h"

namespace risorius::io::detail {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string quoted_word(std::string_view word) {
    return word.empty() ? "the end of the file" : "\"" + shortened_text(word, 24) + "\"";
}

template <class T>
void append(std::string_view bytes, bool swapped, std::vector<double>& out) {
    for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T)) {
        char raw[sizeof(T)];
        std::memcpy(raw, bytes.data() + at, sizeof(T));
        if (swapped) std::reverse(raw, raw + sizeof(T));
        T value;
        std::memcpy(&value, raw, sizeof(T));
        out.push_back(static_cast<double>(value));
    }
}

}  // namespace

std::size_t bytes_of(Scalar type) {
    switch (type) {
        case Scalar::kInt8:
        case Scalar::kUInt8:
            return 1;
        case Scalar::kInt16:
        case Scalar::kUInt16:
            return 2;
        case Scalar::kInt32:
        case Scalar::kUInt32:
        case Scalar::kFloat:
            return 4;
        default:
            return 8;
    }
}

std::vector<double> numbers_of(std::string_view bytes, Scalar type, bool swapped) {
    std::vector<double> out;
    out.reserve(bytes.size() / bytes_of(type));
    switch (type) {
        case Scalar::kInt8:
            append<std::int8_t>(bytes, swapped, out);
            break;
        case Scalar::kUInt8:
            append<std::uint8_t>(bytes, swapped, out);
            break;
        case Scalar::kInt16:
            append<std::int16_t>(bytes, swapped, out);
            break;
        case Scalar::kUInt16:
            append<std::uint16_t>(bytes, swapped, out);
            break;
        case Scalar::kInt32:
            append<std::int32_t>(bytes, swapped, out);
            break;
        case Scalar::kUInt32:
            append<std::uint32_t>(bytes, swapped, out);
            break;
        case Scalar::kInt64:
            append<std::int64_t>(bytes, swapped, out);
            break;
        case Scalar::kUInt64:
            append<std::uint64_t>(bytes, swapped, out);
            break;
        case Scalar::kFloat:
            append<float>(bytes, swapped, out);
            break;
        case Scalar::kDouble:
            append<double>(bytes, swapped, out);
            break;
    }
    return out;
}

void MeshScanner::fail(const std::string& expected, const std::string& found) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<long>(at_), '\n');
    throw Error(name_ + ":" + std::to_string(line), expected, found);
}

void MeshScanner::skip_blanks() {
    while (at_ < text_.size()) {
        if (is_space(text_[at_]))
            ++at_;
        else if (comment_ != 0 && text_[at_] == comment_)
            line();
        else
            return;
    }
}

std::string_view MeshScanner::word() {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
}

std::string_view MeshScanner::line() {
    const std::size_t begin = at_;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    at_ = std::min(end + 1, text_.size());
    std::string_view out = text_.substr(begin, end - begin);
    if (!out.empty() && out.back() == '\r') out.remove_suffix(1);
    return out;
}

double MeshScanner::number(std::string_view what) {
    skip_blanks();
    const std::size_t begin = at_;
    std::string_view found = word();
    const std::string_view whole = found;
    if (!found.empty() && found.front() == '+') found.remove_prefix(1);
    double value = 0;
    const auto [end, problem] = std::from_chars(found.data(), found.data() + found.size(), value);
    if (found.empty() || problem != std::errc() || end != found.data() + found.size() ||
        !std::isfinite(value)) {
        at_ = begin;
        fail("a number, " + std::string(what), quoted_word(whole));
    }
    return value;
}

long long MeshScanner::integer(std::string_view what, long long min, long long max) {
    skip_blanks();
    const std::size_t begin = at_;
    const std::string_view found = word();
    long long value = 0;
    const auto [end, problem] = std::from_chars(found.data(), found.data() + found.size(), value);
    if (found.empty() || problem != std::errc() || end != found.data() + found.size() ||
        value < min || value > max) {
        at_ = begin;
        fail(std::string(what) + ", an integer in [" + std::to_string(min) + ", " +
                 std::to_string(max) + "]",
             quoted_word(found));
    }
    return value;
}

std::size_t MeshScanner::count(std::string_view what, std::size_t bytes_each, std::size_t most) {
    const auto value = static_cast<std::size_t>(
        integer("the number of " + std::string(what), 0, static_cast<long long>(most)));
    // The break after the number may be missing behind the last item.
    if (value > (left() + 1) / std::max<std::size_t>(bytes_each, 1))
        fail("as many bytes as " + std::to_string(value) + " " + std::string(what) + " take",
             std::to_string(left()));
    return value;
}

void MeshScanner::expect(std::string_view expected) {
    skip_blanks();
    const std::size_t begin = at_;
    const std::string_view found = word();
    if (found == expected) return;
    at_ = begin;
    fail(std::string(expected), quoted_word(found));
}

std::string_view MeshScanner::bytes(std::size_t count, std::string_view what) {
    if (count > left())
        fail(std::to_string(count) + " bytes of " + std::string(what), std::to_string(left()));
    const std::string_view out = text_.substr(at_, count);
    at_ += count;
    return out;
}

std::vector<double> MeshScanner::numbers(std::size_t count, Scalar type, bool swapped,
                                         std::string_view what) {
    if (count > left() / bytes_of(type))
        fail(std::to_string(count) + " numbers of " + std::string(what) + ", " +
                 std::to_string(bytes_of(type)) + " bytes each",
             std::to_string(left()) + " bytes");
    return numbers_of(bytes(count * bytes_of(type), what), type, swapped);
}

long long MeshScanner::binary_integer(Scalar type, bool swapped, std::string_view what,
                                      long long min, long long max) {
    const double value = numbers(1, type, swapped, what).front();
    if (!(value >= static_cast<double>(min) && value <= static_cast<double>(max)) ||
        value != std::floor(value))
        fail(std::string(what) + " in [" + std::to_string(min) + ", " + std::to_string(max) + "]",
             std::to_string(value));
    return static_cast<long long>(value);
}

}  // namespace risorius::io::detail
