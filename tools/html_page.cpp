// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/html_page.h"

#include <cmath>

#include "tools/markup.h"

namespace scipd::tools {
namespace {

constexpr std::string_view head = R"(<!DOCTYPE html>
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
svg { width: 100%; height: auto; font: 13px system-ui, sans-serif; }
svg text { fill: var(--faint); } svg .right { text-anchor: end; }
svg .middle, svg .label { text-anchor: middle; }
.grid { stroke: var(--rule); } .scanner { fill: var(--ink); }
)";

}  // namespace

std::string html_head(const std::string& title, std::string_view style) {
    return std::string(head) + std::string(style) + "</style>\n<title>" + in_markup(title) +
           "</title></head><body>\n";
}

std::vector<double> round_ticks(double low, double high, int most) {
    if (!(high > low) || !std::isfinite(high - low)) return {};
    const double least = (high - low) / most;
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    const double tick = power * (least <= power       ? 1
                                 : least <= 2 * power ? 2
                                 : least <= 5 * power ? 5
                                                      : 10);
    constexpr double slack = 1e-9;
    std::vector<double> ticks;
    for (double n = std::ceil(low / tick - slack); n <= high / tick + slack; ++n)
        ticks.push_back(n == 0.0 ? 0.0 : n * tick);
    return ticks;
}

}  // namespace scipd::tools
