// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/check_report.h"

#include <algorithm>
#include <cstdio>

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
        case Verdict::skipped:
            return detail("because", result.finding.why);
        case Verdict::differs:
            return detail("known", result.finding.why);
        case Verdict::fail:
            return detail("but", result.finding.why) + detail("source", result.check->source) +
                   detail("sent", result.sent) + detail("got", result.got);
    }
    return "";
}

// JUnit: a suite for each chapter, a case for each check.

std::string attribute(const char* name, std::string_view value) {
    return std::string(" ") + name + "=\"" + entities(value) + "\"";
}

std::string bytes_of(const Result& result) {
    return entities("source: " + std::string(result.check->source)) + "\n" +
           entities("sent: " + result.sent) + "\n" + entities("got: " + result.got);
}

std::string case_of(const Result& result) {
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%.3f", result.seconds);
    std::string text =
        "    <testcase" +
        attribute("classname", "scipcat.check." + std::string(chapter_of(result.check->id))) +
        attribute("name", std::string(result.check->id) + " " + std::string(result.check->title)) +
        attribute("time", seconds) + ">";
    const Finding& finding = result.finding;
    if (finding.verdict == Verdict::not_applicable || finding.verdict == Verdict::skipped)
        return text + "<skipped" + attribute("message", finding.why) + "/></testcase>\n";
    if (finding.verdict == Verdict::fail)
        text +=
            "<failure" + attribute("message", finding.why) + ">" + bytes_of(result) + "</failure>";
    text += "<system-out>" + entities(finding.why) + "\n" + bytes_of(result) + "</system-out>";
    return text + "</testcase>\n";
}

std::string suite_of(const CheckReport& report, const Chapter& chapter) {
    CheckReport part;
    for (const Result& result : report.results) {
        if (result.chapter == &chapter) part.results.push_back(result);
    }
    if (part.results.empty()) return "";
    std::string text = "  <testsuite" + attribute("name", chapter.title) +
                       attribute("tests", std::to_string(part.results.size())) +
                       attribute("failures", std::to_string(part.count(Verdict::fail))) +
                       attribute("errors", "0") +
                       attribute("skipped", std::to_string(part.count(Verdict::not_applicable) +
                                                           part.count(Verdict::skipped))) +
                       ">\n";
    for (const Result& result : part.results)
        text += case_of(result);
    return text + "  </testsuite>\n";
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
           number(Verdict::not_applicable) + " not applicable, " + number(Verdict::skipped) +
           " skipped";
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

std::string as_junit(const CheckReport& report) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
                       attribute("name", "scipcat check, " + report.device()) + ">\n";
    for (const Chapter& chapter : chapters())
        text += suite_of(report, chapter);
    return text + "</testsuites>\n";
}

std::string in_ascii(std::string_view text) {
    std::string readable(text);
    const auto is_other = [](char c) { return c < ' ' || c > '~'; };
    std::ranges::replace_if(readable, is_other, '?');
    return readable;
}

std::string entities(std::string_view text) {
    return in_markup(in_ascii(text));
}

}  // namespace scipd::tools::checks
