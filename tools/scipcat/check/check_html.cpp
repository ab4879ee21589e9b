// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One page that needs nothing else, light or dark as its reader has it.
#include "tools/scipcat/check/check_report.h"

namespace scipd::tools::checks {
namespace {

constexpr std::string_view page_head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<meta name="color-scheme" content="light dark"/>
<style>
:root { --ink: #1a212b; --paper: #fff; --faint: #616d7d; --rule: #c7cfd6; --shade: #f4f6f8;
        --pass: #1a7f37; --fail: #cf222e; --differs: #9a6700; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6edf3; --paper: #0d1117; --faint: #8b949e; --rule: #30363d; --shade: #161b22;
          --pass: #3fb950; --fail: #ff7b72; --differs: #d29922; } }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
       max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
table { border-collapse: collapse; width: 100%; }
td { border-top: 1px solid var(--rule); padding: .3rem .6rem .3rem 0; vertical-align: top; }
td:nth-child(1) { width: 3rem; } td:nth-child(2) { width: 8rem; font-weight: 600; }
.pass { color: var(--pass); } .fail { color: var(--fail); } .differs { color: var(--differs); }
.not, small, summary { color: var(--faint); }
small { display: block; } summary { font-size: .8rem; }
pre { background: var(--shade); padding: .5rem; margin: .3rem 0; white-space: pre-wrap;
      overflow-wrap: anywhere; }
</style>
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
    std::string text(page_head);
    text += "<title>" + entities(report.device()) + "</title></head><body>\n<h1>" +
            entities(report.device()) + "</h1>\n<p>" + entities(report.target) + "<br/>" +
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
