// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/exposition.h"

#include <array>
#include <charconv>

namespace scipd::daemon {
namespace {

std::string_view word(Exposition::Type type) {
    if (type == Exposition::Type::counter) return "counter";
    return type == Exposition::Type::gauge ? "gauge" : "histogram";
}

std::string escaped(std::string_view value) {
    std::string text;
    for (const char c : value) {
        if (c == '\\' || c == '"') text += '\\';
        text += c == '\n' ? std::string("\\n") : std::string(1, c);
    }
    return text;
}

}  // namespace

void Exposition::metric(std::string_view name, Type type, std::string_view help) {
    name_ = name;
    text_.append("# HELP ").append(name_).append(" ").append(help).append("\n");
    text_.append("# TYPE ").append(name_).append(" ").append(word(type)).append("\n");
}

void Exposition::sample(std::string_view suffix, const Labels& labels, std::uint64_t value) {
    line(suffix, labels, std::to_string(value));
}

void Exposition::sample(std::string_view suffix, const Labels& labels, double value) {
    line(suffix, labels, number(value));
}

void Exposition::line(std::string_view suffix, const Labels& labels, std::string_view value) {
    text_.append(name_).append(suffix);
    char before = '{';
    for (const auto& [name, said] : labels) {
        text_.append(1, before).append(name).append("=\"").append(escaped(said)).append("\"");
        before = ',';
    }
    if (!labels.empty()) text_ += '}';
    text_.append(" ").append(value).append("\n");
}

std::string Exposition::number(double value) {
    std::array<char, 32> text{};
    const auto written = std::to_chars(text.begin(), text.end(), value);
    return {text.begin(), written.ptr};
}

}  // namespace scipd::daemon
