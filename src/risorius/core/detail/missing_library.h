// SPDX-License-Identifier: MIT
/// \file
/// What the C++ library of Debian's Emscripten 3.1.6 lacks of C++20, for the WebAssembly build alone, which includes this file before
/// any other: numbers from and to characters, the order of arrays, the exponential integral, and threads that join. Native builds never
/// see it.
///
/// Numbers are read and written as the native library does: to_chars() gives the shortest text that reads back as the same number.
/// tests/core/missing_library_test.cpp compares both.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <compare>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace risorius::missing {

/// How many characters at the start are a number as from_chars() takes it: no blanks, no plus, no hexadecimal digits.
inline std::ptrdiff_t length_of_number(const char* first, const char* last) {
    const char* at = first;
    const auto digits = [&] {
        const char* const begin = at;
        while (at != last && *at >= '0' && *at <= '9') ++at;
        return at - begin;
    };
    if (at != last && *at == '-') ++at;
    const auto word = [&](const char* lower) {
        const auto size = static_cast<std::ptrdiff_t>(std::strlen(lower));
        if (last - at < size) return false;
        for (std::ptrdiff_t i = 0; i < size; ++i)
            if ((at[i] | 0x20) != lower[i]) return false;
        at += size;
        return true;
    };
    if (word("infinity") || word("inf") || word("nan")) return at - first;
    std::ptrdiff_t found = digits();
    if (at != last && *at == '.') {
        ++at;
        found += digits();
        if (found == 0) return 0;
    }
    if (found == 0) return 0;
    const char* const end = at;
    if (at != last && (*at | 0x20) == 'e') {
        ++at;
        if (at != last && (*at == '-' || *at == '+')) ++at;
        if (digits() == 0) at = end;
    }
    return at - first;
}

inline std::from_chars_result from_chars(const char* first, const char* last, double& value) {
    const std::ptrdiff_t length = length_of_number(first, last);
    if (length == 0) return {first, std::errc::invalid_argument};
    const std::string text(first, first + length);
    const double read = std::strtod(text.c_str(), nullptr);
    const bool named = text.find_first_of("nN") != std::string::npos;  // "inf", "nan"
    const bool zero =
        text.substr(0, text.find_first_of("eE")).find_first_of("123456789") == std::string::npos;
    if (!named && (std::isinf(read) || (read == 0 && !zero)))
        return {first + length, std::errc::result_out_of_range};
    value = read;
    return {first + length, std::errc()};
}

/// The shortest digits that read back as the number, the first one before the point, and the exponent of ten.
inline std::pair<std::string, int> shortest_digits(double magnitude) {
    char text[40];
    for (int places = 0;; ++places) {
        std::snprintf(text, sizeof text, "%.*e", places, magnitude);
        if (places == 16 || std::strtod(text, nullptr) == magnitude) break;
    }
    char* const exponent = std::strchr(text, 'e');
    std::string digits(text, exponent);
    if (digits.size() > 1) digits.erase(1, 1);
    return {digits, std::atoi(exponent + 1)};
}

/// The whole number that a large double is: more digits than tell it apart.
inline std::string whole_number(double magnitude) {
    char text[400];
    std::snprintf(text, sizeof text, "%.0f", magnitude);
    return text;
}

/// The shorter one of the plain and the scientific form; the plain one where they are equally long.
inline std::string shortest(double value) {
    const std::string sign = std::signbit(value) ? "-" : "";
    if (std::isnan(value)) return sign + "nan";
    if (std::isinf(value)) return sign + "inf";
    if (value == 0) return sign + "0";
    const auto [digits, power] = shortest_digits(std::fabs(value));
    std::string scientific = digits.substr(0, 1);
    if (digits.size() > 1) scientific += "." + digits.substr(1);
    const std::string size = std::to_string(std::abs(power));
    scientific += (power < 0 ? "e-" : "e+") + std::string(size.size() < 2 ? "0" : "") + size;
    std::string plain;
    const auto count = static_cast<int>(digits.size());
    if (power < 0)
        plain = "0." + std::string(static_cast<std::size_t>(-power - 1), '0') + digits;
    else if (power + 1 < count)
        plain = digits.substr(0, static_cast<std::size_t>(power) + 1) + "." +
                digits.substr(static_cast<std::size_t>(power) + 1);
    else
        plain = digits + std::string(static_cast<std::size_t>(power + 1 - count), '0');
    if (plain.size() > scientific.size()) return sign + scientific;
    return sign + (power + 1 > count ? whole_number(std::fabs(value)) : plain);
}

inline std::to_chars_result to_chars(char* first, char* last, double value) {
    const std::string text = shortest(value);
    if (last - first < static_cast<std::ptrdiff_t>(text.size()))
        return {last, std::errc::value_too_large};
    return {std::copy(text.begin(), text.end(), first), std::errc()};
}

/// The exponential integral Ei of a positive number, by its series: gamma + ln x + sum x^k / (k k!).
inline double expint(double x) {
    constexpr double kEuler = 0.57721566490153286061;
    if (!(x > 0)) return std::nan("");
    double sum = 0, term = 1;
    for (int k = 1; k < 2000; ++k) {
        term *= x / k;
        sum += term / k;
        if (k > x && term / k < 1e-17 * sum) break;
    }
    return kEuler + std::log(x) + sum;
}

/// A thread that is joined with the object.
class JoiningThread {
  public:
    JoiningThread() = default;
    template <class Work>
    explicit JoiningThread(Work&& work) : thread_(std::forward<Work>(work)) {}
    JoiningThread(JoiningThread&&) = default;
    JoiningThread& operator=(JoiningThread&& other) {
        if (thread_.joinable()) thread_.join();
        thread_ = std::move(other.thread_);
        return *this;
    }
    ~JoiningThread() {
        if (thread_.joinable()) thread_.join();
    }
    void join() { thread_.join(); }

  private:
    std::thread thread_;
};

}  // namespace risorius::missing

#ifdef __EMSCRIPTEN__
namespace std {
using risorius::missing::expint;
using risorius::missing::from_chars;
using risorius::missing::to_chars;
using jthread = risorius::missing::JoiningThread;
template <class T, size_t N>
constexpr strong_ordering operator<=>(const array<T, N>& a, const array<T, N>& b) {
    for (size_t i = 0; i < N; ++i)
        if (const auto order = a[i] <=> b[i]; order != 0) return order;
    return strong_ordering::equal;
}
}  // namespace std
#endif
