// SPDX-License-Identifier: MIT
#include "risorius/sensitivity/distribution.h"

#include <array>
#include <cmath>
#include <numbers>

namespace risorius::sensitivity {

namespace {

using Kind = Distribution::Kind;

struct KindName {
    Kind kind;
    const char* name;
};
constexpr std::array<KindName, 4> kKinds{{{Kind::kUniform, "uniform"},
                                          {Kind::kLogUniform, "log_uniform"},
                                          {Kind::kNormal, "normal"},
                                          {Kind::kLogNormal, "log_normal"}}};

}  // namespace

double normal_quantile(double u) {
    if (u > 0.5) return -normal_quantile(1 - u);
    // Abramowitz & Stegun 1964, eq. 26.2.22, to 3e-3; then Halley's method, which triples the digits.
    const double t = std::sqrt(-2 * std::log(u));
    double z = (2.30753 + 0.27061 * t) / (1 + t * (0.99229 + 0.04481 * t)) - t;
    for (int i = 0; i < 3; ++i) {
        const double density = std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
        const double step = (0.5 * std::erfc(-z / std::numbers::sqrt2) - u) / density;
        z -= step / (1 + 0.5 * z * step);
    }
    return z;
}

double Distribution::quantile(double u) const {
    switch (kind) {
        case Kind::kUniform:
            return first + (second - first) * u;
        case Kind::kLogUniform:
            return first * std::pow(second / first, u);
        case Kind::kNormal:
            return first + second * normal_quantile(u);
        case Kind::kLogNormal:
            return first * std::pow(second, normal_quantile(u));
    }
    return first;
}

std::string Distribution::text() const {
    std::string name;
    for (const KindName& known : kKinds)
        if (known.kind == kind) name = known.name;
    return name + " " + format_number(first) + ", " + format_number(second);
}

Distribution read_distribution(const JsonCursor& json) {
    const std::vector<std::string> keys = json.keys();
    json.allow_keys({"uniform", "log_uniform", "normal", "log_normal"});
    if (keys.size() != 1)
        json.fail("one of \"uniform\", \"log_uniform\", \"normal\" and \"log_normal\"",
                  std::to_string(keys.size()) + " keys");
    Distribution out;
    for (const KindName& known : kKinds)
        if (keys.front() == known.name) out.kind = known.kind;
    const JsonCursor numbers = json.at(keys.front());
    const std::vector<JsonCursor> items = numbers.items();
    if (items.size() != 2) numbers.fail("two numbers", std::to_string(items.size()));
    out.first = items[0].number();
    out.second = items[1].number();
    const bool logarithmic = out.kind == Kind::kLogUniform || out.kind == Kind::kLogNormal;
    if (logarithmic && !(out.first > 0)) items[0].fail("a number above 0");
    if (out.kind == Kind::kUniform || out.kind == Kind::kLogUniform) {
        if (!(out.first < out.second)) numbers.fail("[low, high] with low < high");
    } else if (!(out.second > (logarithmic ? 1 : 0))) {
        items[1].fail(logarithmic ? "a factor above 1" : "a standard deviation above 0");
    }
    return out;
}

}  // namespace risorius::sensitivity
