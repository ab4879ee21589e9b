// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <ostream>
#include <vector>

#include <nlohmann/json.hpp>

#include "sim/text/quote.h"
#include "tools/formatted.h"
#include "tools/scipfit/fit_report.h"

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
        if (!fit_.noise) return line("# noise_law", "model: not in the recording");
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
        if (!fit_.smoothing) return line("# smoothing", "model: not in the recording");
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
        if (!lattice.known) return line("# lattice_m", "model: not in the recording");
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
        const std::vector<RareCodeAt> rare = rare_codes(usual);
        if (!rare.empty()) out_ << "    rare_codes:\n";
        for (const auto& [code, times, inside, beside, edge, alone] : rare)
            line(formatted("  - {code: %u, inside: %.3g, beside: %.3g, edge: %.3g, alone: %s}",
                           code, inside, beside, edge, alone ? "true" : "false"),
                 measured(formatted("%.0f times", times)));
    }

    struct RareCodeAt {
        std::uint32_t code;
        double times;
        double inside, beside, edge;  ///< shares
        bool alone;
    };

    /// The most frequent ones, as far as a configuration takes them: their shares leave some for
    /// the usual code, also where a scanner that drives saw hardly anything else at edges.
    [[nodiscard]] std::vector<RareCodeAt> rare_codes(std::uint32_t usual) const {
        constexpr std::size_t most_codes = 64;
        constexpr double most_share = 0.95;
        constexpr double apart = 4.0;  // one step in four
        std::vector<RareCodeAt> rare;
        for (const auto& [code, counts] : fit_.codes.codes) {
            if (code == usual || !is_rare_code(code, counts)) continue;
            rare.push_back({code, counts.all(), share(counts.inside, fit_.codes.all.inside),
                            share(counts.beside, fit_.codes.all.beside),
                            share(counts.edge, edges_without(usual)), alone(counts)});
        }
        std::ranges::stable_sort(rare, std::greater{}, &RareCodeAt::times);
        rare.resize(std::min(rare.size(), most_codes));
        for (const auto member : {&RareCodeAt::inside, &RareCodeAt::beside, &RareCodeAt::edge}) {
            double all = 0.0;
            for (const RareCodeAt& one : rare)
                all += one.*member * (one.alone ? apart : 1.0);
            for (RareCodeAt& one : rare)
                one.*member *= std::min(1.0, most_share / std::max(all, most_share));
        }
        return rare;
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
                 measured(formatted("%zu beams, %s", one.beams, fit_.light.of_what.c_str())));
        out_ << "      intensity_noise:\n";
        for (const LightNoise& one : fit_.light.noise)
            line(formatted("    - {intensity: %.1f, share: %.4f}", one.intensity, one.share.value),
                 measured(formatted("%zu beams, %.4f to %.4f", one.beams, one.share.low,
                                    one.share.high)));
    }

    void write_bias() {
        if (fit_.bias.empty()) return line("# bias", "unknown: no reference for the true ranges");
        out_ << "    bias:\n";
        for (const BiasAt& one : fit_.bias)
            line(formatted("  - {range_m: %.3f, bias_m: %.5f}", one.range_mm / 1000,
                           one.bias_mm.value / 1000),
                 measured(formatted("%s, %.1f to %.1f mm", one.how.c_str(), one.bias_mm.low,
                                    one.bias_mm.high)));
        out_ << formatted("    # assumed: nearer than %.1f m and beyond %.1f m as there\n",
                          fit_.bias.front().range_mm / 1000, fit_.bias.back().range_mm / 1000);
    }

    const Fit& fit_;
    std::ostream& out_;
    std::string files_;
};

void write_pose(const FlatPose& place, std::ostream& out) {
    out << formatted("    pose: {xyz: [%.4f, %.4f, %.4f], rpy: [0, 0, %.5f]}  # --pose, refined\n",
                     place.x_mm / 1000, place.y_mm / 1000, place.z_mm / 1000, place.yaw_rad);
}

}  // namespace

void write_profile(const Fit& fit, const Surroundings& surroundings, std::ostream& out) {
    out << "# Made by scipfit from " << sim::printable(fit.files) << ": " << fit.scans
        << " static scans of " << fit.all_scans << ".\n"
        << "# Run it: scipd --config FILE. Or copy `models` into a configuration of your own.\n";
    for (const Unknown& one : fit.unknown)
        out << "# unknown: " << one.parameter << ": " << one.why
            << ". Would tell: " << one.would_tell << ".\n";
    const std::string& scene = surroundings.scene;
    if (!scene.empty()) out << "scene: " << nlohmann::json(scene).dump() << '\n';
    out << "models:\n  fitted:\n";
    Writer(fit, out).write_model();
    out << "robots:\n  robot:\n";
    if (surroundings.place) write_pose(*surroundings.place, out);
    out << "    sensors:\n      scanner:\n"
        << "        model: fitted\n"
        << "        tcp: 127.0.0.1:10940\n"
        << "        accuracy: " << (fit.light.noise.empty() ? "sensor" : "material") << '\n';
    if (scene.empty()) return;
    if (!surroundings.place)
        out << "        # assumed: what it reads too far is in the room, which is as it sees it\n"
            << "        bias: none\n";
    if (!fit.light.noise.empty()) {
        if (surroundings.place)
            out << "        # assumed: what it reads too far does not depend on the light\n";
        out << "        profile: {light: {walk_m: 0, saturation_m: 0}}\n";
    }
}

}  // namespace scipd::tools
