// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <ostream>
#include <string>

#include "sim/text/quote.h"
#include "tools/formatted.h"
#include "tools/scipfit/fit_report.h"

namespace scipd::tools {
namespace {

constexpr double degrees_of_radian = 57.29578;

std::string shown(const Interval& interval, const char* number) {
    return formatted(number, interval.value) + " (" + formatted(number, interval.low) + " to " +
           formatted(number, interval.high) + ")";
}

void line(std::ostream& out, const char* what, const std::string& text) {
    out << formatted("  %-13s", what) << text << '\n';
}

void show_noise(const NoiseFit& noise, std::ostream& out) {
    if (noise.model.by_intensity) {
        line(out, "sigma",
             "s0 sqrt(1 + (i0 / intensity)²), s0 " + shown(noise.s0_mm, "%.2f") + " mm, i0 " +
                 shown(noise.i0, "%.0f"));
        line(out, "",
             formatted("intensities %.0f to %.0f, ranges %.2f to %.2f m, %zu beams", noise.dimmest,
                       noise.brightest, noise.nearest.range_mm / 1000,
                       noise.farthest.range_mm / 1000, noise.samples.size()));
        return;
    }
    for (std::size_t i = 0; i < noise.steps.size(); ++i)
        line(out, i == 0 ? "sigma" : "",
             shown(noise.steps[i], "%.2f") +
                 formatted(" mm from %g m on", noise.model.steps[i].from_mm / 1000));
    line(out, "",
         formatted("ranges %.2f to %.2f m, %zu beams", noise.nearest.range_mm / 1000,
                   noise.farthest.range_mm / 1000, noise.samples.size()));
}

void show_smoothing(const SmoothingFit& fit, std::ostream& out) {
    line(out, "neighbours",
         shown(fit.beside[0], "%.3f") + ", then " + shown(fit.beside[1], "%.3f") +
             formatted(", %.0f %% equal", 100.0 * fit.equal));
    line(out, "smoothing",
         fit.smoothing.median_of_five ? "median of five beams"
                                      : formatted("next %.3f, after next %.3f", fit.smoothing.next,
                                                  fit.smoothing.after_next));
    line(out, "next scan", shown(fit.after, "%.3f"));
}

/// Recordings without times have a number of scans.
void show_drift(const Drift& drift, std::ostream& out) {
    const std::string time = drift.seconds > 0.0 ? formatted(" mm in %.0f s", drift.seconds)
                                                 : formatted(" mm in %zu scans", drift.scans);
    line(out, "drift", shown(drift.mm, "%.2f") + time);
}

void show_codes(const CodeShares& codes, std::ostream& out) {
    std::string text;
    for (const auto& [code, counts] : codes.codes)
        text += formatted("%s%u: %.2f %%", text.empty() ? "" : ", ", code,
                          100.0 * counts.all() / codes.all.all());
    if (!text.empty()) line(out, "codes", text);
}

void show_held_out(const HeldOut& held_out, std::ostream& out) {
    line(out, "held out",
         formatted("95 %% intervals hold %.1f %% of %zu readings", 100.0 * held_out.coverage_95,
                   held_out.readings));
    std::string nll = formatted("%.3f", held_out.nll);
    if (held_out.nll_sheet > 0.0) nll += formatted("; data sheet %.3f", held_out.nll_sheet);
    line(out, "",
         "mean negative log-likelihood " + nll +
             formatted(", one sigma %.3f, per beam %.3f", held_out.nll_constant,
                       held_out.nll_per_beam));
}

void show_calibration(const Calibration& found, std::ostream& out) {
    if (found.but_for_slope)
        line(out, "", "except a slope over the range, which is not identifiable");
    if (found.offset_mm) line(out, "offset", shown(*found.offset_mm, "%.1f") + " mm at range 0");
    if (found.scale_mm_per_m)
        line(out, "scale", shown(*found.scale_mm_per_m, "%.2f") + " mm per m");
    for (std::size_t i = 0; i < found.places.size(); ++i) {
        if (!found.places[i]) continue;
        const PlaceAt& at = *found.places[i];
        line(out, i == 0 ? "pose" : "",
             formatted("%.4f, %.4f, %.5f, within %.1f mm and %.1f mrad", at.x_mm.value / 1000,
                       at.y_mm.value / 1000, at.yaw_rad.value,
                       0.5 * std::max(at.x_mm.high - at.x_mm.low, at.y_mm.high - at.y_mm.low),
                       500.0 * (at.yaw_rad.high - at.yaw_rad.low)));
    }
    line(out, "surfaces",
         formatted("%zu beams at %zu viewpoints, residual %.1f mm", found.beams, found.stations,
                   found.spread_mm));
}

void show_face_light(const FaceLight& light, std::ostream& out) {
    for (const SurfaceLight& one : light.surfaces) {
        if (!one.intensity) continue;
        line(out, "surface",
             sim::printable(one.name) + ": intensity " + shown(*one.intensity, "%.0f") +
                 formatted(" head-on at %.2f m, %zu beams", light.reference_mm / 1000, one.beams));
    }
    for (const IncidenceAt& one : light.incidence)
        line(out, "incidence",
             shown(one.share, "%.3f") +
                 formatted(" of that at %.0f degrees", one.incidence_rad * degrees_of_radian));
}

}  // namespace

void show(const Fit& fit, std::ostream& out) {
    out << sim::printable(fit.files) << ": " << fit.kind.model->profile.name << ", "
        << sim::printable(fit.kind.from) << '\n';
    line(out, "static",
         formatted("%zu of %zu scans; %zu beams see walls; %zu duplicates dropped", fit.scans,
                   fit.all_scans, fit.beams, fit.doubles));
    if (fit.noise) show_noise(*fit.noise, out);
    if (fit.smoothing) show_smoothing(*fit.smoothing, out);
    if (fit.lattice.spacing_mm > 0.0)
        line(out, "quantization", formatted("%.4g mm", fit.lattice.spacing_mm));
    show_codes(fit.codes, out);
    if (fit.lost.readings > 0.0)
        line(out, "lost",
             formatted("%.3g %% of the readings of walls, at most %.2g %%", 100.0 * fit.lost.share,
                       100.0 * fit.lost.high));
    for (const LightNoise& one : fit.light.noise)
        line(out, &one == &fit.light.noise.front() ? "intensity" : "",
             formatted("varies by %.2f %% at %.0f", 100.0 * one.share.value, one.intensity));
    if (fit.mixed)
        line(out, "mixed beams",
             shown(fit.mixed->beams, "%.2f") +
                 formatted(" an edge, of %zu edges", fit.mixed->edges));
    if (fit.drift) show_drift(*fit.drift, out);
    for (const BiasAt& one : fit.bias)
        line(out, "bias",
             shown(one.bias_mm, "%.1f") + formatted(" mm at %.2f m", one.range_mm / 1000));
    if (fit.calibration) show_calibration(*fit.calibration, out);
    if (fit.face_light) show_face_light(*fit.face_light, out);
    if (fit.held_out) show_held_out(*fit.held_out, out);
    out << "not identifiable from this recording:\n";
    for (const Unknown& one : fit.unknown)
        line(out, one.parameter.c_str(), one.why + ". To find out: " + one.would_tell);
}

}  // namespace scipd::tools
