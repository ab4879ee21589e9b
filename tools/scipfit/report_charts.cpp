// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/report_charts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/formatted.h"
#include "tools/scipfit/smoothing_fit.h"
#include "tools/scipfit/svg_chart.h"

namespace scipd::tools {
namespace {

constexpr double picture_width = 960.0;

template <class X>
std::vector<ChartPoint> measured(const ReportView& view, const X& x) {
    std::vector<ChartPoint> points;
    for (const BeamNoise& beam : view.beams)
        points.push_back({x(beam), beam.sd_mm});
    return points;
}

double highest_sd_mm(const ReportView& view) {
    std::vector<double> values;
    for (const BeamNoise& beam : view.beams) {
        values.push_back(beam.sd_mm);
        values.push_back(beam.law_mm);
    }
    return reach_of(values);
}

template <class Value>
double greatest(const ReportView& view, const Value& value) {
    double most = 0.0;
    for (const BeamNoise& beam : view.beams)
        most = std::max(most, value(beam));
    return most;
}

template <class X>
std::vector<ChartPoint> told(const ReportView& view, const X& x) {
    std::vector<ChartPoint> points;
    for (const BeamNoise& beam : view.beams)
        points.push_back({x(beam), beam.law_mm});
    return points;
}

/// From metres to the drawing's units; forward is up, and left is left.
struct Plan {
    double min_x = 0.0, max_x = 0.1, min_y = 0.0, max_y = 0.1;

    void include(double x, double y) {
        min_x = std::min(min_x, x);
        max_x = std::max(max_x, x);
        min_y = std::min(min_y, y);
        max_y = std::max(max_y, y);
    }
    [[nodiscard]] double scale() const {
        constexpr double tallest = 560.0;
        return std::min((picture_width - 40.0) / (max_y - min_y), tallest / (max_x - min_x));
    }
    [[nodiscard]] double across(double y) const {
        return 0.5 * picture_width - scale() * (y - 0.5 * (min_y + max_y));
    }
    [[nodiscard]] double down(double x) const { return 20.0 + scale() * (max_x - x); }
};

/// One of nine classes of colour, from far too near to far too far.
int shade_of(double mm, double reach_mm) {
    return static_cast<int>(std::clamp(std::round(4.0 * mm / reach_mm), -4.0, 4.0)) + 4;
}

std::string piece_at(const NoisePiece& piece, const std::vector<double>& mm, double reach_mm,
                     double left) {
    constexpr double wide = 460.0;
    constexpr double cell_height = 6.0;
    const double cell = wide / static_cast<double>(piece.beams);
    std::string text;
    for (std::size_t i = 0; i < mm.size(); ++i) {
        if (!std::isfinite(mm[i])) continue;
        text += formatted(
            "<rect class=\"n%d\" x=\"%.1f\" y=\"%.0f\" width=\"%.2f\" height=\"%.1f\"/>\n",
            shade_of(mm[i], reach_mm), left + cell * static_cast<double>(i % piece.beams),
            cell_height * static_cast<double>(i / piece.beams), cell + 0.1, cell_height + 0.1);
    }
    return text;
}

}  // namespace

std::string room_picture(const Standing& standing, const Room& room) {
    const ScanTable& readings = *standing.readings;
    const Station& station = *std::ranges::min_element(standing.stations, {}, &Station::first);
    Plan plan;
    std::vector<Point> seen;
    for (std::size_t step = 0; step < station.beams.size(); ++step) {
        const Beam& beam = station.beams[step];
        if (!beam.still) continue;
        const double range_m = beam.mean_mm / 1000.0;
        const double angle = readings.angle_rad(step);
        seen.push_back({range_m * std::cos(angle), range_m * std::sin(angle)});
        plan.include(seen.back().x_m, seen.back().y_m);
    }
    std::string text = formatted("<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\">\n", picture_width,
                                 plan.down(plan.min_x) + 20.0);
    for (const Wall& wall : room.walls)
        text +=
            formatted("<line class=\"wall\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>\n",
                      plan.across(wall.begin.y_m), plan.down(wall.begin.x_m),
                      plan.across(wall.end.y_m), plan.down(wall.end.x_m));
    for (const Point& point : seen)
        text += formatted("<circle class=\"real\" cx=\"%.1f\" cy=\"%.1f\" r=\"1.5\"/>\n",
                          plan.across(point.y_m), plan.down(point.x_m));
    text += formatted("<path class=\"scanner\" d=\"M%.1f %.1fl7 17l-7 -4l-7 4z\"/>\n",
                      plan.across(0.0), plan.down(0.0) - 9.0);
    const double metre = plan.scale();
    text += formatted("<path class=\"measure\" d=\"M20 %.1fh%.1f\"/>\n",
                      plan.down(plan.min_x) + 12.0, metre);
    return text + formatted("<text x=\"20\" y=\"%.1f\">1 m</text>\n", plan.down(plan.min_x) + 6.0) +
           "</svg>\n";
}

std::string pieces_picture(const ReportView& view) {
    if (!view.piece) return {};
    const NoisePiece& piece = *view.piece;
    std::vector<double> sizes;
    for (const double mm : piece.real_mm)
        sizes.push_back(std::abs(mm));
    const double reach_mm = reach_of(sizes);
    const double height = 6.0 * static_cast<double>(piece.scans);
    std::string text =
        formatted("<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\">\n", picture_width, height + 46.0);
    text += piece_at(piece, piece.real_mm, reach_mm, 0.0) +
            piece_at(piece, piece.simulated_mm, reach_mm, 500.0);
    text +=
        formatted("<text class=\"middle\" x=\"230\" y=\"%.0f\">the scanner</text>", height + 18.0);
    text +=
        formatted("<text class=\"middle\" x=\"730\" y=\"%.0f\">its twin</text>\n", height + 18.0);
    text += formatted(
        "<text x=\"0\" y=\"%.0f\">across: steps %d to %d; down: %zu scans; from %.1f mm too near "
        "(red) to as much too far (blue)</text>\n",
        height + 40.0, piece.first_step, piece.first_step + static_cast<int>(piece.beams) - 1,
        piece.scans, reach_mm);
    return text + "</svg>\n";
}

std::string noise_by_intensity(const ReportView& view, const Fit& fit) {
    const auto light = [](const BeamNoise& beam) { return beam.intensity; };
    const double most = greatest(view, light);
    if (view.beams.empty() || most <= 0.0) return {};
    SvgChart chart({"intensity", 0.0, 1.05 * most},
                   {"standard deviation (mm)", 0.0, highest_sd_mm(view)});
    chart.dots(measured(view, light), "real");
    std::vector<ChartPoint> law;
    if (fit.noise->model.by_intensity) {
        for (double intensity = fit.noise->dimmest; intensity <= most; intensity += most / 200.0)
            law.push_back({intensity, fit.noise->model.sigma_mm(0.0, intensity)});
    }
    chart.line(law, "law");
    return chart.svg();
}

std::string noise_by_range(const ReportView& view) {
    if (view.beams.empty()) return {};
    const auto range_m = [](const BeamNoise& beam) { return beam.range_mm / 1000.0; };
    SvgChart chart({"range (m)", 0.0, 1.05 * greatest(view, range_m)},
                   {"standard deviation (mm)", 0.0, highest_sd_mm(view)});
    chart.dots(measured(view, range_m), "real");
    chart.dots(told(view, range_m), "told");
    return chart.svg();
}

std::string noise_by_beam(const ReportView& view) {
    if (view.beams.empty()) return {};
    std::vector<ChartPoint> real;
    std::vector<ChartPoint> law;
    for (const BeamNoise& beam : view.beams) {
        if (!beam.of_longest) continue;
        real.push_back({static_cast<double>(beam.step), beam.sd_mm});
        law.push_back({static_cast<double>(beam.step), beam.law_mm});
    }
    SvgChart chart({"step", real.front().x - 1.0, real.back().x + 1.0},
                   {"standard deviation (mm)", 0.0, highest_sd_mm(view)});
    chart.dots(real, "real");
    chart.dots(law, "told");
    return chart.svg();
}

std::string quantile_chart(const ReportView& view) {
    if (view.quantiles.empty()) return {};
    constexpr double reach = 3.5;
    SvgChart chart({"normal quantiles (standard deviations)", -reach, reach},
                   {"quantiles of the readings (standard deviations)", -reach, reach}, 360.0);
    chart.line({{-reach, -reach}, {reach, reach}}, "law");
    std::vector<ChartPoint> points;
    for (const Quantile& quantile : view.quantiles)
        points.push_back({quantile.normal, quantile.seen});
    chart.dots(points, "real");
    return chart.svg();
}

std::string correlation_chart(const Fit& fit) {
    if (!fit.smoothing) return {};
    constexpr std::array<const char*, most_lag> names{"next beam", "second", "third", "fourth"};
    const auto twin = correlations_of(fit.smoothing->smoothing);
    double least = 0.0;
    double most = 0.1;
    for (std::size_t lag = 0; lag < most_lag; ++lag) {
        least = std::min({least, fit.smoothing->beside[lag].low, twin[lag]});
        most = std::max({most, fit.smoothing->beside[lag].high, twin[lag]});
    }
    SvgChart chart({"neighbour of the reading", 0.0, 6.0},
                   {"correlation", std::min(least, -0.05), 1.1 * most});
    const auto pair = [&](double x, const Interval& real, double simulated, const char* name) {
        chart.line({{x - 0.1, 0.0}, {x - 0.1, real.value}}, "thick real-line");
        chart.line({{x + 0.1, 0.0}, {x + 0.1, simulated}}, "thick law");
        chart.interval(x - 0.1, real.low, real.high, "interval");
        chart.name(x, name);
    };
    for (std::size_t lag = 0; lag < most_lag; ++lag)
        pair(static_cast<double>(lag) + 0.8, fit.smoothing->beside[lag], twin[lag], names[lag]);
    pair(5.2, fit.smoothing->after, 0.0, "next scan");
    return chart.svg();
}

std::string code_chart(const CodeShares& codes) {
    if (codes.codes.empty()) return {};
    // Shares go over four powers of ten, so the axis has their logarithms.
    const double places = std::max(5.0, static_cast<double>(codes.codes.size()));
    SvgChart chart({"error code", 0.0, places}, {"share of all codes (log10 of %)", -3.0, 2.5});
    double place = 0.5;
    for (const auto& [code, counts] : codes.codes) {
        const double percent = 100.0 * counts.all() / codes.all.all();
        const ChartPoint top{place, std::log10(percent)};
        chart.bar(top, 0.6, "told-bar");
        chart.text(top, formatted("%.3g %%", percent), "middle");
        chart.name(place, std::to_string(code));
        place += 1.0;
    }
    return chart.svg();
}

std::string held_out_chart(const HeldOut& held_out) {
    struct Way {
        const char* name;
        double nll;
        const char* style;
    };
    const std::array<Way, 3> ways{{{"the twin's law", held_out.nll, "told-bar"},
                                   {"one deviation for all", held_out.nll_constant, "other-bar"},
                                   {"the data sheet", held_out.nll_sheet, "sheet-bar"}}};
    double most = 0.05;
    for (const Way& way : ways)
        most = std::max(most, 1.2 * (way.nll - held_out.nll_per_beam));
    SvgChart chart({"noise model", 0.0, 3.0}, {"excess over a per-beam model (nats)", 0.0, most});
    double place = 0.5;
    for (const Way& way : ways) {
        if (way.nll != 0.0) {
            const ChartPoint top{place, std::max(0.0, way.nll - held_out.nll_per_beam)};
            chart.bar(top, 0.5, way.style);
            chart.text(top, formatted("%.3f", top.y), "middle");
        }
        chart.name(place, way.name);
        place += 1.0;
    }
    return chart.svg();
}

}  // namespace scipd::tools
