// SPDX-License-Identifier: MIT
// The build for browsers reads and writes numbers by functions of its own; here they are compared with the library's.
#include "risorius/core/detail/missing_library.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <string_view>

namespace risorius::missing {
namespace {

std::string by_library(double value) {
    char text[400];
    return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

void expect_same_reading(std::string_view text) {
    double own = 7, theirs = 7;
    const auto a = from_chars(text.data(), text.data() + text.size(), own);
    const auto b = std::from_chars(text.data(), text.data() + text.size(), theirs);
    EXPECT_EQ(a.ptr - text.data(), b.ptr - text.data()) << text;
    EXPECT_EQ(a.ec, b.ec) << text;
    if (!std::isnan(theirs)) {
        EXPECT_EQ(own, theirs) << text;
    }
}

TEST(MissingLibrary, WritesAndReadsNumbersAsTheLibrary) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 60000; ++i) {
        const std::uint64_t bits = random();
        double value = std::bit_cast<double>(bits);  // any number, mostly very large or small
        if (i % 3 == 0) value = static_cast<double>(bits % 100000) / 1000;
        if (i % 3 == 1)
            value = std::ldexp(static_cast<double>(bits % 1000000007),
                               static_cast<int>(bits >> 58) - 30);
        if (std::isnan(value)) continue;
        char text[400];
        const auto end = missing::to_chars(text, text + sizeof text, value).ptr;
        ASSERT_EQ(std::string(text, end), by_library(value));
        expect_same_reading(std::string_view(text, static_cast<std::size_t>(end - text)));
    }
    for (const double value :
         {0.0, -0.0, 1e22, 1e23, 5e-324, 1.7976931348623157e308, 123456789012345680.0})
        EXPECT_EQ(shortest(value), by_library(value));
}

TEST(MissingLibrary, RefusesWhatTheLibraryRefuses) {
    for (const char* text :
         {"",       ".",    "-",        "-.",    "1e",   "1e+",       "1e5x",  "+1",
          "0x10",   " 1",   "1.",       "-.5",   "inf",  "nan",       "1e400", "1e-400",
          "0e-400", "-inf", "Infinity", "infin", "1..2", "0.000e9999"})
        expect_same_reading(text);
}

TEST(MissingLibrary, HasTheExponentialIntegral) {
    for (const double x : {0.01, 0.5, 1.0, 3.7, 6.6, 12.0, 40.0})
        EXPECT_NEAR(expint(x) / std::expint(x), 1, 1e-13) << x;
}

}  // namespace
}  // namespace risorius::missing
