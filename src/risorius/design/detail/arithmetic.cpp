// SPDX-License-Identifier: MIT
#include "risorius/design/detail/arithmetic.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "risorius/core/error.h"

namespace risorius::design {

namespace {

constexpr int kMaxDepth = 64;  // nesting depth of brackets and signs

class Reader {
  public:
    Reader(const std::string& text, const std::string& place,
           const std::function<double(const std::string&)>& value_of)
        : text_(text), place_(place), value_of_(value_of) {}

    double whole() {
        const double value = sum(0);
        skip_space();
        if (at_ < text_.size()) fail("an operator");
        if (!std::isfinite(value))
            throw Error(place_, "a finite value of " + risorius::in_quotes(text_), "none");
        return value;
    }

  private:
    [[noreturn]] void fail(const std::string& expected) const {
        const std::string rest = text_.substr(std::min(at_, text_.size()));
        throw Error(place_, expected + " in " + risorius::in_quotes(text_),
                    rest.empty() ? "its end" : risorius::in_quotes(rest));
    }
    void skip_space() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    }
    bool take(char c) {
        skip_space();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    void need(char c) {
        if (!take(c)) fail(risorius::in_quotes(std::string(1, c)));
    }
    double sum(int depth) {
        double value = term(depth);
        for (;;) {
            if (take('+'))
                value += term(depth);
            else if (take('-'))
                value -= term(depth);
            else
                return value;
        }
    }
    double term(int depth) {
        double value = factor(depth);
        for (;;) {
            if (take('*'))
                value *= factor(depth);
            else if (take('/'))
                value /= factor(depth);
            else
                return value;
        }
    }
    double factor(int depth) {
        if (depth > kMaxDepth) fail("fewer brackets");
        if (take('-')) return -factor(depth + 1);
        if (take('+')) return factor(depth + 1);
        if (take('(')) {
            const double value = sum(depth + 1);
            need(')');
            return value;
        }
        skip_space();
        const auto is_name = [&](std::size_t i) {
            return i < text_.size() &&
                   (std::isalnum(static_cast<unsigned char>(text_[i])) || text_[i] == '_');
        };
        if (at_ < text_.size() &&
            (std::isdigit(static_cast<unsigned char>(text_[at_])) || text_[at_] == '.')) {
            double value = 0;
            const auto [end, error] =
                std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
            if (error != std::errc()) fail("a number");
            at_ = static_cast<std::size_t>(end - text_.data());
            return value;
        }
        const std::size_t begin = at_;
        while (is_name(at_)) ++at_;
        if (at_ == begin) fail("a number, a parameter or a bracket");
        const std::string name = text_.substr(begin, at_ - begin);
        if ((name == "min" || name == "max") && take('(')) {
            const double a = sum(depth + 1);
            need(',');
            const double b = sum(depth + 1);
            need(')');
            return name == "min" ? std::min(a, b) : std::max(a, b);
        }
        return value_of_(name);
    }

    const std::string& text_;
    const std::string& place_;
    const std::function<double(const std::string&)>& value_of_;
    std::size_t at_ = 0;
};

}  // namespace

double arithmetic(const std::string& text, const std::string& place,
                  const std::function<double(const std::string&)>& value_of) {
    return Reader(text, place, value_of).whole();
}

}  // namespace risorius::design
