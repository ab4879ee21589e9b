// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The form that servers for builds read: a suite for each chapter, a case for each check.
#include <cstdio>

#include "tools/scipcat/check/check_report.h"

namespace scipd::tools::checks {
namespace {

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
    if (finding.verdict == Verdict::not_applicable)
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
                       attribute("skipped", std::to_string(part.count(Verdict::not_applicable))) +
                       ">\n";
    for (const Result& result : part.results)
        text += case_of(result);
    return text + "  </testsuite>\n";
}

}  // namespace

std::string as_junit(const CheckReport& report) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" +
                       attribute("name", "scipcat check, " + report.device()) + ">\n";
    for (const Chapter& chapter : chapters())
        text += suite_of(report, chapter);
    return text + "</testsuites>\n";
}

}  // namespace scipd::tools::checks
