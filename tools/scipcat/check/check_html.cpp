// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One page that needs nothing else, light or dark as its reader has it.
#include "tools/html_page.h"
#include "tools/scipcat/check/check_report.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view style = R"(
:root { --shade: #f4f6f8; --pass: #1a7f37; --fail: #cf222e; --differs: #9a6700; }
@media (prefers-color-scheme: dark) {
  :root { --shade: #161b22; --pass: #3fb950; --fail: #ff7b72; --differs: #d29922; } }
td { vertical-align: top; }
td:nth-child(1) { width: 3rem; } td:nth-child(2) { width: 8rem; font-weight: 600; }
.pass { color: var(--pass); } .fail { color: var(--fail); } .differs { color: var(--differs); }
.not, .skipped, summary { color: var(--faint); }
small { display: block; } summary { font-size: .8rem; }
pre { background: var(--shade); padding: .5rem; margin: .3rem 0; white-space: pre-wrap;
      overflow-wrap: anywhere; }
)";

std::string html_row(const Result& result) {
    const Finding& finding = result.finding;
    const std::string verdict(name_of(finding.verdict));
    std::string text = "<tr id=\"c" + std::string(result.check->id) + "\"><td>" +
                       std::string(result.check->id) + "</td><td class=\"" + verdict + "\">" +
                       verdict + "</td><td>" + entities(result.check->title);
    if (!finding.why.empty()) text += "<br/>" + entities(finding.why);
    text += "<small>" + entities(result.check->source) + "</small>";
    if (!result.sent.empty()) {
        const bool open = finding.verdict == Verdict::fail;
        text += std::string("<details") + (open ? " open=\"open\"" : "") +
                "><summary>bytes</summary><pre>sent " + entities(result.sent) + "\ngot  " +
                entities(result.got) + "</pre></details>";
    }
    return text + "</td></tr>\n";
}

}  // namespace

std::string as_html(const CheckReport& report) {
    std::string text = html_head(in_ascii(report.device()), style);
    text += "<h1>" + entities(report.device()) + "</h1>\n<p>" + entities(report.target) + "<br/>" +
            entities(report.summary()) + "<br/>" + entities(report.nearness()) + "</p>\n";
    const Chapter* chapter = nullptr;
    for (const Result& result : report.results) {
        if (result.chapter != chapter) {
            if (chapter != nullptr) text += "</table>\n";
            chapter = result.chapter;
            text += "<h2>" + std::string(chapter_of(result.check->id)) + " " +
                    entities(chapter->title) + "</h2>\n<table>\n";
        }
        text += html_row(result);
    }
    if (chapter != nullptr) text += "</table>\n";
    return text + "</body></html>\n";
}

}  // namespace scipd::tools::checks
