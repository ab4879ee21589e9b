// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/check_report.h"

#include <algorithm>

#include "tools/markup.h"

namespace scipd::tools::checks {
namespace {

std::string row(const Result& result) {
    std::string line = "  " + std::string(result.check->id);
    line.resize(8, ' ');
    line += name_of(result.finding.verdict);
    line.resize(24, ' ');
    return line.append(result.check->title) + "\n";
}

std::string detail(const char* key, std::string_view value) {
    std::string line = std::string(24, ' ') + key;
    line.resize(32, ' ');
    return line.append(value) + "\n";
}

std::string details(const Result& result) {
    switch (result.finding.verdict) {
        case Verdict::pass:
            return "";
        case Verdict::not_applicable:
            return detail("because", result.finding.why);
        case Verdict::differs:
            return detail("known", result.finding.why);
        case Verdict::fail:
            return detail("but", result.finding.why) + detail("source", result.check->source) +
                   detail("sent", result.sent) + detail("got", result.got);
    }
    return "";
}

}  // namespace

std::size_t CheckReport::count(Verdict verdict) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        results, [&](const Result& result) { return result.finding.verdict == verdict; }));
}

std::string CheckReport::device() const {
    std::string model = facts.text("MODL");
    model = model.substr(0, model.find('('));
    if (model.empty()) return "a scanner that does not say what it is";
    return model + " " + facts.text("FIRM") + ", " + facts.text("SERI");
}

std::string CheckReport::summary() const {
    const auto number = [&](Verdict verdict) { return std::to_string(count(verdict)); };
    return std::to_string(results.size()) + " checks: " + number(Verdict::pass) + " pass, " +
           number(Verdict::fail) + " fail, " + number(Verdict::differs) + " differ as is known, " +
           number(Verdict::not_applicable) + " not applicable";
}

std::string CheckReport::nearness() const {
    if (!nearest) return "";
    return "nearest firmware: " + nearest->model + ": " + std::to_string(nearest->alike) + " of " +
           std::to_string(nearest->of) + " answers alike";
}

std::string as_text(const CheckReport& report) {
    std::string text = report.device() + "\n";
    const Chapter* chapter = nullptr;
    for (const Result& result : report.results) {
        if (result.chapter != chapter) {
            chapter = result.chapter;
            text.append("\n").append(chapter_of(result.check->id)).append("  ");
            text.append(chapter->title).append("\n");
        }
        text += row(result) + details(result);
    }
    text += "\n" + report.summary() + "\n";
    if (report.nearest) text += report.nearness() + "\n";
    return text;
}

std::string in_ascii(std::string_view text) {
    std::string readable(text);
    std::ranges::replace_if(
        readable, [](char c) { return c < ' ' || c > '~'; }, '?');
    return readable;
}

std::string entities(std::string_view text) {
    return in_markup(in_ascii(text));
}

}  // namespace scipd::tools::checks
