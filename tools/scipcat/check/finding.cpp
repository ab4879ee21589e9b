// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/finding.h"

#include <cstddef>
#include <cstdio>
#include <utility>

namespace scipd::tools::checks {
namespace {

constexpr std::size_t head_size = 240;
constexpr std::size_t tail_size = 80;

std::string escaped(std::string_view bytes) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string text;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\n') {
            text += "\\n";
        } else if (c == '\r') {
            text += "\\r";
        } else if (c == '\\') {
            text += "\\\\";
        } else if (byte >= ' ' && byte <= '~') {
            text.push_back(c);
        } else {
            text.append("\\x").append(1, digits[byte >> 4U]).append(1, digits[byte & 0xFU]);
        }
    }
    return text;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::pass:
            return "pass";
        case Verdict::fail:
            return "fail";
        case Verdict::differs:
            return "differs";
        case Verdict::not_applicable:
            return "not applicable";
        case Verdict::skipped:
            return "skipped";
    }
    return "";
}

Finding pass() {
    return {};
}

Finding fail(std::string why) {
    return {Verdict::fail, std::move(why), ""};
}

Finding not_applicable(std::string why) {
    return {Verdict::not_applicable, std::move(why), ""};
}

Finding skipped(std::string why) {
    return {Verdict::skipped, std::move(why), ""};
}

Finding require(bool good, std::string why) {
    return good ? pass() : fail(std::move(why));
}

std::string printable(std::string_view bytes) {
    if (bytes.size() <= head_size + tail_size) return escaped(bytes);
    return escaped(bytes.substr(0, head_size)) + " ... " +
           escaped(bytes.substr(bytes.size() - tail_size)) + " (" + std::to_string(bytes.size()) +
           " bytes)";
}

std::string tenths(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

}  // namespace scipd::tools::checks
