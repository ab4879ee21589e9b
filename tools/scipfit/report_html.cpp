// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <sstream>
#include <string_view>

#include "tools/formatted.h"
#include "tools/html_page.h"
#include "tools/markup.h"
#include "tools/scipfit/fit_report.h"
#include "tools/scipfit/report_charts.h"
#include "tools/scipfit/room_report.h"

namespace scipd::tools {
namespace {

/// --n0 to --n8: the colours of readings from too near to too far.
constexpr std::string_view style = R"(:root { --n0: #b2182b; --n1: #d6604d; --n2: #f4a582;
        --n3: #fddbc7; --n4: #f0f1f3; --n5: #d1e5f0; --n6: #92c5de; --n7: #4393c3; --n8: #2166ac; }
@media (prefers-color-scheme: dark) {
  :root { --n0: #ff7b72; --n1: #d1564f; --n2: #92403f; --n3: #512b30; --n4: #1c2128;
          --n5: #1f3550; --n6: #25507e; --n7: #3775b8; --n8: #58a6ff; } }
.n0 { fill: var(--n0); } .n1 { fill: var(--n1); } .n2 { fill: var(--n2); }
.n3 { fill: var(--n3); } .n4 { fill: var(--n4); } .n5 { fill: var(--n5); }
.n6 { fill: var(--n6); } .n7 { fill: var(--n7); } .n8 { fill: var(--n8); }
.real { fill: var(--a); } .told, .told-bar { fill: var(--b); } .sheet-bar { fill: var(--nearer); }
.other-bar { fill: var(--otherwise); } .told { opacity: .6; }
.law { stroke: var(--b); stroke-width: 2; fill: none; } .real-line { stroke: var(--a); }
.thick { stroke-width: 16; } .interval { stroke: var(--ink); stroke-width: 2; }
.wall { stroke: var(--b); stroke-width: 2; } .measure { stroke: var(--faint); stroke-width: 2; }
.key-real { color: var(--a); } .key-twin { color: var(--b); } p { margin: .2rem 0; }
pre { overflow-x: auto; font-size: .85rem; }
)";

constexpr auto both =
    "<span class=\"key-real\">●</span> the scanner, <span class=\"key-twin\">●</span> its twin";

std::string section(const std::string& title, const std::string& words,
                    const std::string& picture) {
    if (picture.empty()) return {};
    return "<h2>" + title + "</h2>\n<p><small>" + words + "</small></p>\n" + picture;
}

std::string rooms(const Standing& standing, const std::optional<Room>& room) {
    if (!room) return {};
    return section("The room, from above",
                   "<span class=\"key-real\">●</span> what the scanner saw, "
                   "<span class=\"key-twin\">●</span> the walls of its twin",
                   room_picture(standing, *room)) +
           "<pre>" + in_markup(as_text(*room)) + "</pre>\n";
}

std::string noises(const ReportView& view, const Fit& fit) {
    const std::string by_law = std::string(both) + ": the law that was fitted";
    return section("The noise, side by side",
                   "They should look alike: grains as strong, as wide, "
                   "and as independent from scan to scan",
                   pieces_picture(view)) +
           section("Noise by intensity: dark walls are noisier", by_law,
                   noise_by_intensity(view, fit)) +
           section("Noise by range", by_law, noise_by_range(view)) +
           section("Noise by beam", by_law + " at this beam", noise_by_beam(view)) +
           section("Is the noise normal?",
                   "On the line it is: as many small and large errors as the law says",
                   quantile_chart(view)) +
           section("What neighbours and scans share",
                   std::string(both) + "; thin lines are intervals of 95 %",
                   correlation_chart(fit));
}

std::string row(const std::string& what, const std::string& nll, const std::string& words) {
    return "<tr><td>" + what + "</td><td>" + nll + "</td><td>" + words + "</td></tr>\n";
}

std::string held_out_part(const ReportView& view, const HeldOut& held_out) {
    const auto nll = [](double value) { return value > 0.0 ? formatted("%.3f", value) : "–"; };
    std::string text = section("On readings that it was not fitted to",
                               "Lower is better, and 0 is as good as each beam's own deviation",
                               held_out_chart(held_out));
    text += "<table>\n<tr><th></th><th>mean negative log-likelihood</th><th></th></tr>\n";
    text += row("the twin's law", nll(held_out.nll),
                formatted("its intervals of 95 %% hold %.1f %% of %zu readings",
                          100.0 * held_out.coverage_95, held_out.readings));
    text += row("each beam's own deviation", nll(held_out.nll_per_beam), "no law does better");
    text += row("one deviation for all", nll(held_out.nll_constant), "");
    text += row("the data sheet", nll(held_out.nll_sheet), "its accuracy, taken as noise");
    text +=
        row("the scanner against itself", "",
            formatted("from its first half to its second, means differ by less than %.1f mm and "
                      "deviations by less than %.1f mm at 19 of 20 beams: no twin is nearer",
                      view.floor_mean_mm, view.floor_sd_mm));
    return text + "</table>\n";
}

std::string unknown_part(const Unknowns& unknown) {
    std::string text =
        "<h2>Not identifiable</h2>\n<table>\n<tr><th></th><th>why</th><th>to find out</th></tr>\n";
    for (const Unknown& one : unknown)
        text += row(in_markup(one.parameter), in_markup(one.why), in_markup(one.would_tell));
    return text + "</table>\n";
}

std::string figures(const Fit& fit) {
    std::ostringstream text;
    show(fit, text);
    return "<h2>All figures</h2>\n<pre>" + in_markup(text.str()) + "</pre>\n";
}

}  // namespace

std::string as_html(const Standing& standing, const Fit& fit, const std::optional<Room>& room) {
    const ReportView view = view_of(standing, fit);
    std::string text = html_head(fit.files + ": the twin", style);
    text += "<h1>The twin of a " + in_markup(fit.kind.model->profile.name) + "</h1>\n<p><small>" +
            in_markup(fit.files) +
            formatted(": %zu static scans of %zu</small></p>\n", fit.scans, fit.all_scans);
    text += rooms(standing, room) + noises(view, fit);
    text += section("Where there is no distance: which code", "", code_chart(fit.codes));
    if (fit.held_out) text += held_out_part(view, *fit.held_out);
    return text + unknown_part(fit.unknown) + figures(fit) + "</body></html>\n";
}

}  // namespace scipd::tools
