// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/profile_yaml.h"

#include <cmath>
#include <ostream>

#include <nlohmann/json.hpp>

#include "sim/text/quote.h"
#include "tools/scipfit/formatted.h"

namespace scipd::tools {
namespace {

/// Writes the members of a model, each with a comment.
class Writer {
  public:
    Writer(const Fit& fit, std::ostream& out)
        : fit_(fit), out_(out), files_(sim::printable(fit.files)) {}

    void write_model() {
        const daemon::Model& model = *fit_.kind.model;
        line("like: " + model.profile.name + "@" + model.profile.release, fit_.kind.from);
        write_noise();
        write_smoothing();
        write_lattice();
        write_lost();
        write_codes();
        write_light();
        write_bias();
    }

  private:
    void line(const std::string& member, const std::string& from) {
        out_ << "    " << member << "  # " << from << '\n';
    }

    [[nodiscard]] std::string measured(const std::string& how) const {
        return "measured (" + files_ + ", " + how + ")";
    }

    [[nodiscard]] std::string size() const {
        return formatted("%zu beams, %zu scans",
                         fit_.noise ? fit_.noise->samples.size() : fit_.beams, fit_.scans);
    }

    void write_noise() {
        if (!fit_.noise) return line("# noise_law", "model: the recording does not tell");
        const NoiseFit& noise = *fit_.noise;
        if (noise.model.by_intensity) {
            const std::string from =
                formatted("%s, floor %.2f to %.2f mm, weak %.0f to %.0f", size().c_str(),
                          noise.s0_mm.low, noise.s0_mm.high, noise.i0.low, noise.i0.high);
            return line(formatted("noise_law: {floor_m: %.6f, weak: %.1f}",
                                  noise.s0_mm.value / 1000, noise.i0.value),
                        measured(from));
        }
        out_ << "    noise:\n";
        for (std::size_t i = 0; i < noise.steps.size(); ++i) {
            const Interval& step = noise.steps[i];
            line(formatted("  - {from_m: %g, sigma_m: %.6f}", noise.model.steps[i].from_mm / 1000,
                           step.value / 1000),
                 measured(formatted("%s, %.2f to %.2f mm", size().c_str(), step.low, step.high)));
        }
        out_ << formatted("    # assumed: beyond %.1f m as there\n",
                          noise.farthest.range_mm / 1000);
    }

    void write_smoothing() {
        if (!fit_.smoothing) return line("# smoothing", "model: the recording does not tell");
        const SmoothingFit& fit = *fit_.smoothing;
        const std::string from =
            measured(formatted("%zu pairs, correlations %.3f to %.3f and %.3f to %.3f, equal %.2f",
                               fit.pairs, fit.beside[0].low, fit.beside[0].high, fit.beside[1].low,
                               fit.beside[1].high, fit.equal));
        if (fit.smoothing.median_of_five) return line("smoothing: {median_of_five: true}", from);
        line(formatted("smoothing: {next: %.4f, after_next: %.4f, median_of_five: false}",
                       fit.smoothing.next, fit.smoothing.after_next),
             from);
    }

    void write_lattice() {
        const Lattice& lattice = fit_.lattice;
        if (lattice.cells == 0) return line("# lattice_m", "model: the recording does not tell");
        line(formatted("lattice_m: %.6g", lattice.spacing_mm / 1000),
             measured(formatted("%zu of %zu mm never occur", lattice.missing, lattice.cells)));
    }

    void write_lost() {
        if (fit_.lost.readings == 0.0) return;
        line(
            formatted("lost_share: %.3g", fit_.lost.share),
            measured(formatted("%.0f readings, at most %.2g", fit_.lost.readings, fit_.lost.high)));
    }

    void write_codes() {
        if (fit_.codes.codes.empty()) return;
        const std::uint32_t usual = fit_.codes.usual();
        const std::string of = formatted("%.0f readings without a distance", fit_.codes.all.all());
        line(formatted("codes: {nothing: %u, too_far: %u}", usual, usual), measured(of));
        bool first = true;
        for (const auto& [code, counts] : fit_.codes.codes) {
            if (code == usual || !is_rare_code(code, counts)) continue;
            if (first) out_ << "    rare_codes:\n";
            first = false;
            line(formatted("  - {code: %u, inside: %.2g, beside: %.2g, edge: %.2g, alone: %s}",
                           code, share(counts.inside, fit_.codes.all.inside),
                           share(counts.beside, fit_.codes.all.beside),
                           share(counts.edge, edges_without(usual)),
                           alone(counts) ? "true" : "false"),
                 measured(formatted("%.0f times", counts.all())));
        }
    }

    [[nodiscard]] bool is_rare_code(std::uint32_t code, const CodeCounts& counts) const {
        constexpr double least = 5.0;
        return counts.all() >= least && code != fit_.kind.model->profile.codes.not_measured;
    }

    /// It is never beside itself, though it occurs so often.
    [[nodiscard]] bool alone(const CodeCounts& counts) const {
        constexpr double often = 50.0;
        constexpr double most_share = 0.2;
        return counts.all() >= often && counts.pairs == 0.0 &&
               counts.inside <= most_share * fit_.codes.all.inside &&
               counts.beside <= most_share * fit_.codes.all.beside;
    }

    [[nodiscard]] double edges_without(std::uint32_t usual) const {
        return fit_.codes.all.edge - fit_.codes.codes.at(usual).edge;
    }

    static double share(double part, double all) { return all > 0.0 ? part / all : 0.0; }

    void write_light() {
        if (fit_.light.noise.empty()) return;
        out_ << "    light:\n";
        out_ << "      intensity:\n";
        for (const LightAt& one : fit_.light.by_range)
            line(formatted("    - {range_m: %.3f, intensity: %.0f}", one.range_mm / 1000,
                           one.intensity),
                 measured(formatted(fit_.light.walls_told_apart
                                        ? "%zu beams, of walls that are bright among these"
                                        : "%zu beams, as if all walls were white",
                                    one.beams)));
        out_ << "      intensity_noise:\n";
        for (const LightNoise& one : fit_.light.noise)
            line(formatted("    - {intensity: %.1f, share: %.4f}", one.intensity, one.share.value),
                 measured(formatted("%zu beams, %.4f to %.4f", one.beams, one.share.low,
                                    one.share.high)));
    }

    void write_bias() {
        if (fit_.bias.empty())
            return line("# bias", "unknown: the recording has no length that was measured");
        out_ << "    bias:\n";
        for (const BiasAt& one : fit_.bias)
            line(formatted("  - {range_m: %.3f, bias_m: %.5f}", one.range_mm / 1000,
                           one.bias_mm.value / 1000),
                 measured(formatted("%.3f m from step %d to step %d, %.1f to %.1f mm",
                                    one.length.metres, one.length.from_step, one.length.to_step,
                                    one.bias_mm.low, one.bias_mm.high)));
    }

    const Fit& fit_;
    std::ostream& out_;
    std::string files_;
};

}  // namespace

void write_profile(const Fit& fit, const std::string& scene, std::ostream& out) {
    out << "# Made by scipfit from " << sim::printable(fit.files) << ": " << fit.scans
        << " scans that stand still, of " << fit.all_scans << ".\n"
        << "# Run it: scipd --config FILE. Or copy `models` into a configuration of your own.\n";
    for (const Unknown& one : fit.unknown)
        out << "# unknown: " << one.parameter << ": " << one.why
            << ". Would tell: " << one.would_tell << ".\n";
    if (!scene.empty()) out << "scene: " << nlohmann::json(scene).dump() << '\n';
    out << "models:\n  fitted:\n";
    Writer(fit, out).write_model();
    out << "robots:\n  robot:\n    sensors:\n      scanner:\n"
        << "        model: fitted\n"
        << "        tcp: 127.0.0.1:10940\n"
        << "        accuracy: " << (fit.light.noise.empty() ? "sensor" : "material") << '\n';
    if (scene.empty()) return;
    out << "        # assumed: what it reads too far is in the room, which is as it sees it\n"
        << "        bias: none\n";
    if (!fit.light.noise.empty()) out << "        profile: {light: {walk_m: 0, saturation_m: 0}}\n";
}

}  // namespace scipd::tools
