// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/tools/scipfit/round_trip.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string_view>

#include "daemon/models/model_registry.h"
#include "tests/tools/scipfit/synthetic_scanner.h"

namespace scipd::tests {
namespace {

using tools::Fit;
using tools::Interval;
using tools::ScanTable;

/// What chance chooses.
class Choice {
  public:
    explicit Choice(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }

  private:
    std::mt19937_64 engine_;
};

Room some_room(Choice& choice) {
    Room room{.length_m = choice.between(4.0, 7.5), .width_m = choice.between(3.0, 5.0)};
    room.reflectances.clear();
    const int things = choice.whole(2, 5);
    for (int i = 0; i < things; ++i) {
        const double side = choice.whole(0, 1) == 0 ? -1.0 : 1.0;
        room.things.push_back({choice.between(-1.5, 1.5), side * 0.5 * (room.width_m - 0.6),
                               choice.between(0.1, 0.3)});
    }
    for (int i = 0; i < 4 + things; ++i)
        room.reflectances.push_back(choice.between(0.15, 0.9));
    return room;
}

Place some_place(Choice& choice) {
    return {choice.between(-0.8, 0.8), choice.between(-0.4, 0.4), choice.between(-3.0, 3.0)};
}

/// By intensity, as a UST; by range, as a UTM without light; by range and with medians, as a URG.
enum class Sort { light, range, median };

daemon::Model some_model(Sort sort, Choice& choice) {
    daemon::Model model = daemon::find_model(sort == Sort::median ? "URG-04LX" : "UST-10LX");
    sim::SensorSpec& optics = model.optics;
    optics.lattice_m = sort == Sort::median || choice.whole(0, 1) == 0 ? 0.0 : 0.0015;
    optics.lost_share = choice.whole(0, 2) == 0 ? 0.0 : choice.between(0.0002, 0.003);
    optics.bias = {{1.0, choice.between(-0.01, 0.01)}, {4.0, choice.between(-0.01, 0.01)}};
    optics.receiver.dark_range_m = 6.0;
    if (sort != Sort::median)
        optics.smoothing = {.next = choice.between(0.0, 0.5),
                            .after_next = choice.between(0.0, 0.15)};
    if (sort == Sort::light) {
        optics.noise_law = {choice.between(0.003, 0.008), choice.between(300.0, 1500.0)};
    } else {
        // The steps of the fit where the beams are that many, so that the truth is one number.
        optics.noise_law = {};
        optics.noise = {{0.0, choice.between(0.003, 0.006), 0.0},
                        {2.0, choice.between(0.004, 0.009), 0.0}};
    }
    return model;
}

/// Somebody walks through, before some of the beams.
void walk_through(Choice& choice, std::size_t first, ScanTable& readings) {
    const std::size_t beams = readings.beams / 12;
    const double begin = choice.between(0.0, static_cast<double>(readings.beams - 2 * beams));
    const std::size_t scans = readings.scans() - first;
    for (std::size_t i = 0; i < scans; ++i) {
        const double way = static_cast<double>(i) / static_cast<double>(scans);
        const auto from = static_cast<std::size_t>(begin + way * static_cast<double>(beams));
        for (std::size_t step = from; step < from + beams; ++step) {
            const std::size_t at = (first + i) * readings.beams + step;
            readings.codes[at] = tools::codes::distance;
            readings.ranges_mm[at] =
                static_cast<float>(std::lround(600.0 + 100.0 * way + choice.between(-8.0, 8.0)));
        }
    }
}

ScanTable some_readings(const daemon::Model& model, bool with_light, Choice& choice,
                        std::uint64_t seed) {
    SyntheticScanner scanner(model, some_room(choice), with_light, seed);
    ScanTable readings = scanner.begin();
    const int stations = choice.whole(1, 2);
    for (int i = 0; i < stations; ++i) {
        const std::size_t first = readings.scans();
        scanner.stand(some_place(choice), choice.whole(100, 250), readings);
        if (choice.whole(0, 1) == 0) walk_through(choice, first, readings);
    }
    end_recording(readings);
    return readings;
}

class Judge {
  public:
    Judge(const Fit& fit, const daemon::Model& model, RoundTrip& result)
        : fit_(fit), optics_(model.optics), result_(result) {}

    void judge_law(bool with_light) {
        if (!fit_.noise) return;
        if (with_light && fit_.noise->model.by_intensity) {
            hold("s0", fit_.noise->s0_mm, 1000.0 * optics_.noise_law.floor_m);
            hold("i0", fit_.noise->i0, optics_.noise_law.weak);
        }
        for (std::size_t i = 0; i < fit_.noise->steps.size() && !with_light; ++i) {
            const double from_m = 0.001 * fit_.noise->model.steps[i].from_mm;
            const bool last = i + 1 == fit_.noise->steps.size();
            const double to_m = last ? 1e3 : 0.001 * fit_.noise->model.steps[i + 1].from_mm;
            if (from_m < 2.0 && to_m > 2.0) continue;  // it has both
            const double sigma_m = optics_.noise[from_m < 2.0 ? 0 : 1].sigma_m;
            hold(optics_.smoothing.median_of_five ? "sigma, median" : "sigma", fit_.noise->steps[i],
                 1000.0 * sigma_m);
        }
    }

    void judge_rest() {
        if (fit_.smoothing) {
            const auto truth = tools::correlations_of(optics_.smoothing);
            const bool median = optics_.smoothing.median_of_five;
            if (median != fit_.smoothing->smoothing.median_of_five) ++result_.wrong_smoothing;
            for (std::size_t lag = 0; lag < tools::most_lag && !median; ++lag)
                hold("neighbours " + std::to_string(lag + 1), fit_.smoothing->beside[lag],
                     truth[lag]);
            hold("next scan", fit_.smoothing->after, 0.0);
        }
        if (std::abs(fit_.lattice.spacing_mm - 1000.0 * optics_.lattice_m) > 0.01)
            ++result_.wrong_lattice;
        if (fit_.drift) hold("drift", fit_.drift->mm, 0.0);
        judge_bias();
    }

    /// Several stations of one room may tell the bias but for a slope, and never the scale.
    void judge_bias() {
        if (!names("scale")) ++result_.unknown_told;
        const bool told = fit_.calibration && fit_.calibration->offset_mm;
        if (told == names("offset")) ++result_.unknown_told;
        if (!fit_.calibration || !fit_.calibration->but_for_slope) {
            if (!fit_.bias.empty() || told) ++result_.unknown_told;
            return;
        }
        const std::vector<double>& knots_mm = fit_.calibration->fit.knots_mm;
        std::vector<double> truth;
        for (const double knot_mm : knots_mm)
            truth.push_back(1000.0 * optics_.bias_m(knot_mm / 1000.0));
        const tools::LineThrough line = tools::line_through(knots_mm, truth);
        if (told) hold("offset", *fit_.calibration->offset_mm, line.at_zero);
        for (std::size_t i = 0; i < knots_mm.size(); ++i)
            hold("bias but for a slope", fit_.bias[i].bias_mm, line.at_zero + line.left[i]);
    }

  private:
    [[nodiscard]] bool names(std::string_view parameter) const {
        return std::ranges::any_of(
            fit_.unknown, [&](const tools::Unknown& one) { return one.parameter == parameter; });
    }

    void hold(const std::string& parameter, const Interval& interval, double truth) {
        Hits& hits = result_.parameters[parameter];
        ++hits.all;
        if (interval.low <= truth && truth <= interval.high) ++hits.inside;
        hits.off.push_back((interval.value - truth) / (0.5 * (interval.high - interval.low)));
    }

    const Fit& fit_;
    const sim::SensorSpec& optics_;
    RoundTrip& result_;
};

}  // namespace

void make_round_trip(std::uint64_t seed, RoundTrip& result) {
    Choice choice(seed);
    const auto sort = static_cast<Sort>(seed % 3);
    const bool with_light = sort == Sort::light;
    const daemon::Model model = some_model(sort, choice);
    const ScanTable readings = some_readings(model, with_light, choice, seed);
    const Fit fit = tools::fit_scanner(tools::look_at(readings), tools::kind_of(readings, ""), {});
    Judge judge(fit, model, result);
    judge.judge_law(with_light);
    judge.judge_rest();
}

}  // namespace scipd::tests
