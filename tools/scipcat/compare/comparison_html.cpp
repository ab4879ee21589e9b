// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <string_view>

#include "tools/html_page.h"
#include "tools/markup.h"
#include "tools/scipcat/compare/comparison_report.h"
#include "tools/scipcat/compare/comparison_words.h"
#include "tools/scipcat/compare/svg_parts.h"

namespace scipd::tools::comparing {
namespace {

constexpr std::string_view style = R"(.key-a { color: var(--a); } .key-b { color: var(--b); }
svg .label { font-weight: 600; paint-order: stroke; stroke: var(--paper); stroke-width: 4px; }
circle.a { fill: var(--a); } circle.b { fill: var(--b); }
path.a { stroke: var(--a); fill: none; } path.b { stroke: var(--b); fill: none; }
.nearer, svg text.nearer { fill: var(--nearer); }
.farther, svg text.farther { fill: var(--farther); }
.otherwise, svg text.otherwise { fill: var(--otherwise); }
.floor { fill: var(--a); opacity: .25; }
)";

std::string lists_of(const Comparison& comparison) {
    std::string text = "<p><strong>" + in_markup(verdict_of(comparison)) + "</strong></p>\n<ul>\n";
    for (const Difference& difference : weightiest_first(comparison.differ))
        text += "<li>" + in_markup(sentence_of(difference)) + "</li>\n";
    const std::string why = missing_floor(comparison);
    return text + "</ul>\n" + (why.empty() ? "" : "<p>" + in_markup(why) + "</p>\n");
}

std::string table_of_both(const Comparison& comparison) {
    std::string text =
        "<table>\n<tr><th></th><th>A</th><th>B</th><th>B − A</th><th>detection limit</th></tr>\n";
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
    std::string text = html_head(comparison.a.name + " and " + comparison.b.name, style);
    text += std::string("<h1>") + (comparison.alike() ? "Alike" : "B differs from A") +
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
