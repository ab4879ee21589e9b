// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mvsim/formula.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

constexpr int deepest_formula = 64;
constexpr std::size_t longest_substituted = 1 << 16;

[[noreturn]] void refuse_formula(const std::string& why) {
    throw std::invalid_argument(why);
}

using Arguments = std::vector<double>;

double call(const std::string& name, const Arguments& x) {
    using Unary = double (*)(double);
    static const std::map<std::string, Unary, std::less<>> unary{
        {"sin", std::sin},     {"cos", std::cos},   {"tan", std::tan},     {"asin", std::asin},
        {"acos", std::acos},   {"atan", std::atan}, {"sqrt", std::sqrt},   {"abs", std::fabs},
        {"floor", std::floor}, {"ceil", std::ceil}, {"round", std::round}, {"exp", std::exp},
        {"log", std::log}};
    const auto known = unary.find(name);
    if (known != unary.end() && x.size() == 1) return known->second(x[0]);
    if (name == "deg2rad" && x.size() == 1) return x[0] * std::numbers::pi / 180.0;
    if (name == "rad2deg" && x.size() == 1) return x[0] * 180.0 / std::numbers::pi;
    if (name == "if" && x.size() == 3) return x[0] != 0.0 ? x[1] : x[2];
    if (name == "min" && !x.empty()) return std::ranges::min(x);
    if (name == "max" && !x.empty()) return std::ranges::max(x);
    if (name == "pow" && x.size() == 2) return std::pow(x[0], x[1]);
    if (name == "mod" && x.size() == 2) return std::fmod(x[0], x[1]);
    if (name == "atan2" && x.size() == 2) return std::atan2(x[0], x[1]);
    refuse_formula("the function " + quote(name) + " is not known here");
}

/// Calculates by recursive descent: or, and, comparison, sum, product, power, sign, atom.
class Calculator {
  public:
    Calculator(std::string_view text, const Variables& variables)
        : rest_(text), variables_(variables) {}

    double all() {
        const double value = either();
        skip_blanks();
        if (!rest_.empty()) refuse_formula("a formula cannot go on with " + quote(rest_));
        return value;
    }

  private:
    double either() {
        double value = both();
        while (take_word("or") || take("||")) {
            const double other = both();
            value = value != 0.0 || other != 0.0 ? 1.0 : 0.0;
        }
        return value;
    }
    double both() {
        double value = comparison();
        while (take_word("and") || take("&&")) {
            const double other = comparison();
            value = value != 0.0 && other != 0.0 ? 1.0 : 0.0;
        }
        return value;
    }
    double comparison() {
        const double value = sum();
        const auto truth = [](bool holds) { return holds ? 1.0 : 0.0; };
        if (take("<=")) return truth(value <= sum());
        if (take(">=")) return truth(value >= sum());
        if (take("==")) return truth(value == sum());
        if (take("!=")) return truth(value != sum());
        if (take("<")) return truth(value < sum());
        if (take(">")) return truth(value > sum());
        return value;
    }
    double sum() {
        double value = product();
        while (true) {
            if (take("+")) {
                value += product();
            } else if (take("-")) {
                value -= product();
            } else {
                return value;
            }
        }
    }
    double product() {
        double value = power();
        while (true) {
            if (take("*")) {
                value *= power();
            } else if (take("/")) {
                value /= power();
            } else if (take("%")) {
                value = std::fmod(value, power());
            } else {
                return value;
            }
        }
    }
    double power() {
        if (++depth_ > deepest_formula) refuse_formula("a formula is nested too deeply");
        double value = 0.0;
        if (take("-")) {
            value = -power();
        } else if (take("+")) {
            value = power();
        } else {
            value = atom();
            if (take("^")) value = std::pow(value, power());
        }
        --depth_;
        return value;
    }
    double atom() {
        if (take("(")) {
            const double value = either();
            if (!take(")")) refuse_formula("a bracket of a formula is not closed");
            return value;
        }
        skip_blanks();
        double value = 0.0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (error == std::errc{} && !is_letter(rest_.front())) {
            rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
            return value;
        }
        return named();
    }
    double named() {
        const std::string name = word();
        if (name.empty()) refuse_formula("a formula wants a number where " + quote(rest_) + " is");
        if (take("(")) return call(name, arguments());
        const auto variable = variables_.find(name);
        if (variable == variables_.end() && name == "pi") return std::numbers::pi;
        if (variable == variables_.end()) refuse_formula("there is no variable " + quote(name));
        const auto value = parse_number(variable->second);
        if (!value) refuse_formula(quote(name) + " is no number: " + quote(variable->second));
        return *value;
    }
    Arguments arguments() {
        Arguments all;
        if (take(")")) return all;
        do
            all.push_back(either());
        while (take(","));
        if (!take(")")) refuse_formula("a bracket of a formula is not closed");
        return all;
    }

    static bool is_letter(char c) {
        return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    }
    static bool is_of_word(char c) {
        return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
    }
    std::string word() {
        skip_blanks();
        if (rest_.empty() || !is_letter(rest_.front())) return {};
        const auto end = std::ranges::find_if_not(rest_, is_of_word);
        const std::string name(rest_.begin(), end);
        rest_.remove_prefix(name.size());
        return name;
    }
    void skip_blanks() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
    }
    bool take(std::string_view sign) {
        skip_blanks();
        if (!rest_.starts_with(sign)) return false;
        rest_.remove_prefix(sign.size());
        return true;
    }
    bool take_word(std::string_view wanted) {
        const std::string_view before = rest_;
        if (word() == wanted) return true;
        rest_ = before;
        return false;
    }

    std::string_view rest_;
    const Variables& variables_;
    int depth_ = 0;
};

std::string value_of(std::string_view asked, const Variables& variables) {
    const auto bar = asked.find('|');
    const auto known = variables.find(asked.substr(0, bar));
    if (known != variables.end()) return known->second;
    if (bar == asked.npos) refuse_formula("there is no variable " + quote(asked));
    return std::string(asked.substr(bar + 1));
}

/// Replaces the last expression that begins so, which has no other one inside; false if there is
/// none.
bool replace_last(std::string& text, std::string_view begins, const auto& value) {
    const auto begin = text.rfind(begins);
    if (begin == text.npos) return false;
    const auto end = text.find('}', begin);
    if (end == text.npos) refuse_formula(quote(begins) + " is not closed");
    const auto first = begin + begins.size();
    text.replace(begin, end + 1 - begin, value(std::string_view(text).substr(first, end - first)));
    if (text.size() > longest_substituted) refuse_formula("a text grows too long");
    return true;
}

std::string number_text(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return {digits.data(), end};
}

}  // namespace

double formula(std::string_view text, const Variables& variables) {
    const double value = Calculator{text, variables}.all();
    if (!std::isfinite(value)) refuse_formula("a formula has no finite value");
    return value;
}

std::string substituted(std::string_view given, const Variables& variables) {
    constexpr int most_replaced = 1000;
    if (given.size() > longest_substituted) refuse_formula("a text is too long");
    std::string text(given);
    const auto variable = [&](std::string_view asked) { return value_of(asked, variables); };
    const auto result = [&](std::string_view asked) {
        return number_text(formula(asked, variables));
    };
    int replaced = 0;
    while (replace_last(text, "${", variable) || replace_last(text, "$f{", result)) {
        if (++replaced > most_replaced) refuse_formula("a text has too many variables");
    }
    if (text.find("$(") != text.npos || text.find("$env{") != text.npos) {
        refuse_formula("uses a command or the environment, which scipd does not read: " +
                       quote(text));
    }
    return text;
}

}  // namespace scipd::sim
