// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/report_view.h"

#include <algorithm>
#include <cmath>

namespace scipd::tools {
namespace {

/// Where this share of the standard normal distribution lies below.
double normal_quantile(double share) {
    double low = -10.0;
    double high = 10.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (0.5 * std::erfc(-middle / std::sqrt(2.0)) < share ? low : high) = middle;
    }
    return low;
}

/// That nineteen of twenty do not reach; 0 where there are none.
double nineteen_of_twenty(std::vector<double>& values) {
    if (values.empty()) return 0.0;
    const std::size_t at = values.size() * 19 / 20;
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(at));
    return values[at];
}

/// Moments of some scans of one beam.
struct Moments {
    double count = 0.0, sum = 0.0, squares = 0.0;

    void add(double value) {
        count += 1.0;
        sum += value;
        squares += value * value;
    }
    [[nodiscard]] double mean() const { return sum / count; }
    [[nodiscard]] double sd() const {
        return std::sqrt(std::max(0.0, squares / count - mean() * mean()));
    }
};

/// What is gathered while all beams are looked at.
struct Gathered {
    ReportView view;
    std::vector<double> residuals;  ///< in deviations
    std::vector<double> between_means_mm;
    std::vector<double> between_sds_mm;
};

void look_at_beam(const Standing& standing, const Station& station, std::size_t step, double law_mm,
                  Gathered& gathered) {
    const ScanTable& readings = *standing.readings;
    const Beam& beam = station.beams[step];
    Moments halves[2];
    for (std::size_t scan = station.first; scan < station.end; ++scan) {
        const float mm = readings.range_mm(scan, step);
        if (!is_distance(mm)) continue;
        gathered.residuals.push_back(station.residual_mm(mm, scan, beam) / law_mm);
        halves[2 * (scan - station.first) >= station.scans() ? 1 : 0].add(mm - beam.mean_mm);
    }
    if (halves[0].count < 2.0 || halves[1].count < 2.0) return;
    gathered.between_means_mm.push_back(std::abs(halves[1].mean() - halves[0].mean()));
    gathered.between_sds_mm.push_back(std::abs(halves[1].sd() - halves[0].sd()));
}

void look_at_beams(const Standing& standing, const Fit& fit, Gathered& gathered) {
    const ScanTable& readings = *standing.readings;
    for (const Station& station : standing.stations) {
        for (std::size_t step = 0; step < station.beams.size(); ++step) {
            const Beam& beam = station.beams[step];
            if (!tells_noise(beam, readings.beam_rad(), fit.noise->model.by_intensity)) continue;
            const LawSample sample{beam.mean_mm, beam.intensity, beam.slope_mm, 0.0, 0.0};
            const double law_mm = fit.noise->model.told_mm(sample);
            gathered.view.beams.push_back({readings.step_of(step),
                                           &station == &standing.stations[0], beam.mean_mm,
                                           beam.intensity, std::sqrt(beam.variance_mm2), law_mm,
                                           sheet_mm(fit.kind.model->optics, beam.mean_mm)});
            look_at_beam(standing, station, step, law_mm, gathered);
        }
    }
}

std::vector<Quantile> quantiles_of(std::vector<double> residuals) {
    constexpr std::size_t most = 200;
    std::vector<Quantile> quantiles;
    std::ranges::sort(residuals);
    const std::size_t count = std::min(most, residuals.size());
    for (std::size_t i = 0; i < count; ++i) {
        // As many in each: the outermost are those of half a part.
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        const auto at = static_cast<std::size_t>(share * static_cast<double>(residuals.size()));
        quantiles.push_back({normal_quantile(share), residuals[at]});
    }
    return quantiles;
}

}  // namespace

ReportView view_of(const Standing& standing, const Fit& fit) {
    Gathered gathered;
    if (!fit.noise) return {};
    look_at_beams(standing, fit, gathered);
    gathered.view.quantiles = quantiles_of(std::move(gathered.residuals));
    gathered.view.floor_mean_mm = nineteen_of_twenty(gathered.between_means_mm);
    gathered.view.floor_sd_mm = nineteen_of_twenty(gathered.between_sds_mm);
    gathered.view.piece = noise_piece(standing, fit);
    return std::move(gathered.view);
}

}  // namespace scipd::tools
