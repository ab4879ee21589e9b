// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <string_view>

#include "tools/markup.h"
#include "tools/scipcat/compare/comparison_report.h"
#include "tools/scipcat/compare/comparison_words.h"
#include "tools/scipcat/compare/svg_parts.h"

namespace scipd::tools::comparing {
namespace {

constexpr std::string_view head_of_page = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<meta name="color-scheme" content="light dark"/>
<style>
:root { --ink: #1a212b; --paper: #fff; --faint: #616d7d; --rule: #dde2e7; --a: #8b95a1;
        --b: #0d4a8c; --nearer: #d1242f; --farther: #8250df; --otherwise: #b35900; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6edf3; --paper: #0d1117; --faint: #8b949e; --rule: #21262d; --a: #6e7681;
          --b: #58a6ff; --nearer: #ff7b72; --farther: #bc8cff; --otherwise: #f0883e; } }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper);
       max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h2 { font-size: 1.1rem; margin: 2rem 0 .3rem; } small { color: var(--faint); }
table { border-collapse: collapse; width: 100%; }
td, th { border-top: 1px solid var(--rule); padding: .3rem .6rem .3rem 0; text-align: left; }
.key-a { color: var(--a); } .key-b { color: var(--b); }
svg { width: 100%; height: auto; font: 13px system-ui, sans-serif; }
svg text { fill: var(--faint); } svg .right { text-anchor: end; }
svg .middle, svg .label { text-anchor: middle; }
svg .label { font-weight: 600; paint-order: stroke; stroke: var(--paper); stroke-width: 4px; }
circle.a { fill: var(--a); } circle.b { fill: var(--b); }
path.a { stroke: var(--a); fill: none; } path.b { stroke: var(--b); fill: none; }
.nearer, svg text.nearer { fill: var(--nearer); }
.farther, svg text.farther { fill: var(--farther); }
.otherwise, svg text.otherwise { fill: var(--otherwise); } .scanner { fill: var(--ink); }
.grid { stroke: var(--rule); } .floor { fill: var(--a); opacity: .25; }
</style>
)";

std::string lists_of(const Comparison& comparison) {
    std::string text = "<p><strong>" + in_markup(verdict_of(comparison)) + "</strong></p>\n<ul>\n";
    for (const Difference& difference : weightiest_first(comparison.differ))
        text += "<li>" + in_markup(sentence_of(difference)) + "</li>\n";
    return text + "</ul>\n";
}

std::string table_of_both(const Comparison& comparison) {
    std::string text =
        "<table>\n<tr><th></th><th>A</th><th>B</th><th>B less A</th><th>floor</th></tr>\n";
    for (const Row& row : overview_of(comparison)) {
        if ((row.a + row.b + row.difference).empty()) continue;
        text += "<tr>";
        for (const std::string& cell : {row.what, row.a, row.b, row.difference, row.floor})
            text += "<td>" + in_markup(cell) + "</td>";
        text += "</tr>\n";
    }
    return text + "</table>\n";
}

bool any_known(const Curve& curve) {
    for (const double value : curve.a) {
        if (std::isfinite(value)) return true;
    }
    return false;
}

std::string chart_of(const std::string& title, const std::string& chart) {
    return chart.empty() ? "" : "<h2>" + title + "</h2>\n" + chart;
}

}  // namespace

std::string as_html(const Comparison& comparison) {
    const std::string both = "<span class=\"key-a\">A</span> and <span class=\"key-b\">B</span>";
    std::string text(head_of_page);
    text += "<title>" + in_markup(comparison.a.name + " and " + comparison.b.name) +
            "</title></head><body>\n<h1>" + (comparison.alike() ? "Alike" : "B differs from A") +
            "</h1>\n<p><span class=\"key-a\">A</span> " +
            in_markup(comparison.a.name + ": " + scanner_of(comparison.a)) +
            "<br/><span class=\"key-b\">B</span> " +
            in_markup(comparison.b.name + ": " + scanner_of(comparison.b)) + "<br/><small>" +
            in_markup(place_of(comparison)) + "</small></p>\n";
    text += lists_of(comparison);
    text += chart_of("From above, " + both, svg_from_above(comparison));
    text += chart_of("How much farther B is in mm, by step; the band is what A's halves differ by",
                     svg_of_differences(comparison));
    text += chart_of("Standard deviation of " + both + " in mm, by step",
                     svg_of_curves(comparison, spreads_by_step(comparison)));
    if (const Curve light = intensities_by_step(comparison); any_known(light))
        text += chart_of("Intensity of " + both + ", by step", svg_of_curves(comparison, light));
    return text + "<h2>Both</h2>\n" + table_of_both(comparison) + "</body></html>\n";
}

}  // namespace scipd::tools::comparing
