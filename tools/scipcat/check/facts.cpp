// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/facts.h"

#include <algorithm>
#include <charconv>
#include <cstddef>

namespace scipd::tools::checks {
namespace {

int number(const std::string& text) {
    int value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return std::clamp(value, 0, 9999);
}

Line line_of(std::string_view product) {
    const auto says = [&](std::string_view word) { return product.find(word) != product.npos; };
    if (says("UST-")) return Line::ust;
    if (says("-EW")) return Line::ethernet_multi_echo;
    if (says("UTM-") || says("UXM-")) return Line::utm_usb;
    if (says("URG-04") || says("UBG-") || says("UHG-")) return Line::urg;
    return Line::other;
}

}  // namespace

std::string Facts::text(const std::string& key) const {
    const auto found = texts.find(key);
    return found == texts.end() ? "" : found->second;
}

double Facts::period_ms() const {
    constexpr double minute_ms = 60'000.0;
    return scan_rpm > 0 ? minute_ms / scan_rpm : 100.0;
}

void take_texts(Facts& facts, std::string_view reply) {
    while (!reply.empty()) {
        const std::string_view line = reply.substr(0, reply.find('\n'));
        reply.remove_prefix(std::min(line.size() + 1, reply.size()));
        const std::size_t colon = line.find(':');
        // TIME of a UST and the sum may be semicolons themselves.
        const bool whole = line.size() >= 2 && line[line.size() - 2] == ';';
        const std::size_t end = whole ? line.size() - 2 : line.rfind(';');
        if (colon == line.npos || end == line.npos || end < colon) continue;
        facts.texts[std::string(line.substr(0, colon))] =
            std::string(line.substr(colon + 1, end - colon - 1));
    }
}

void conclude(Facts& facts) {
    facts.line = line_of(facts.text("PROD") + " " + facts.text("MODL"));
    facts.amin = number(facts.text("AMIN"));
    facts.amax = std::max(number(facts.text("AMAX")), facts.amin);
    facts.afrt = std::clamp(number(facts.text("AFRT")), facts.amin, facts.amax);
    facts.ares = number(facts.text("ARES"));
    facts.scan_rpm = number(facts.text("SCAN"));
}

}  // namespace scipd::tools::checks
