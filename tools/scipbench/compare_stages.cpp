// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/compare_stages.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <stdexcept>
#include <utility>

#include "sim/backends/registry.h"
#include "sim/sensor/scanner.h"
#include "tools/scipbench/free_poses.h"
#include "tools/scipbench/spread.h"

namespace scipd::tools {
namespace {

/// Reorders the numbers.
std::array<double, 2> median_and_p99(std::vector<double>& off) {
    std::ranges::sort(off);
    return {at_share(off, 0.5), at_share(off, 0.99)};
}

class Stages {
  public:
    explicit Stages(StageComparison& it) : it_(it) {}

    void compare(const sim::Scan& scan, const sim::Scan& truth) {
        for (std::size_t beam = 0; beam < truth.beams(); ++beam) {
            ++it_.beams;
            compare(scan.readings[beam], truth.readings[beam]);
            const auto echoes = scan.echoes[beam];
            const auto true_echoes = truth.echoes[beam];
            if (echoes.size() != true_echoes.size()) {
                ++it_.other_count;
                continue;
            }
            for (std::size_t i = 0; i < echoes.size(); ++i) {
                echoes_.push_back(std::abs(echoes[i].range_m - true_echoes[i].range_m));
                powers_.push_back(std::abs(echoes[i].power / true_echoes[i].power - 1.0));
            }
        }
    }

    void finish() {
        it_.echo_off_m = median_and_p99(echoes_);
        it_.power_off = median_and_p99(powers_);
        it_.reading_off_m = median_and_p99(readings_);
    }

  private:
    void compare(const sim::Reading& reading, const sim::Reading& truth) {
        if (reading.cause != truth.cause) {
            ++it_.other_cause;
        } else if (truth.cause == sim::Cause::measured) {
            readings_.push_back(std::abs(reading.range_m - truth.range_m));
        }
    }

    StageComparison& it_;
    std::vector<double> echoes_;
    std::vector<double> powers_;
    std::vector<double> readings_;
};

}  // namespace

std::vector<StageComparison> compare_stages(const sim::SharedScene& scene,
                                            const sim::SensorSpec& optics,
                                            const sim::MaterialLibrary& materials,
                                            std::size_t poses, double height_m) {
    std::vector<sim::Surface> surfaces;
    for (const sim::Material& material : scene->materials)
        surfaces.push_back(materials.surface(material, optics.receiver.wavelength_nm));
    const sim::LitWorld lit(surfaces, {});
    const sim::Scanner scanner(optics, {.accuracy = sim::Accuracy::material, .seed = 1});
    const auto rays = sim::preferred_backend().make(scene, {});
    const auto places = free_poses(*rays, poses, height_m);
    const auto scan = [&](sim::RangeBackend& backend, std::size_t i) {
        return scanner.measure(backend, static_cast<std::int64_t>(i), {}, {places[i]},
                               {.lit = &lit});
    };
    std::vector<StageComparison> all;
    for (const sim::BackendRow& row : sim::backends()) {
        StageComparison& it = all.emplace_back(StageComparison{.backend = std::string(row.name)});
        try {
            const auto backend = row.make(scene, {});
            it.follows_light = backend->follows_light();
            Stages stages(it);
            for (std::size_t i = 0; i < places.size(); ++i)
                stages.compare(*scan(*backend, i), *scan(*rays, i));
            stages.finish();
        } catch (const std::runtime_error& error) {
            it.missing = error.what();
        }
    }
    return all;
}

void print_stages(const std::vector<StageComparison>& backends, std::ostream& out) {
    out << "\nwith light and materials, against " << sim::preferred_backend().name
        << "        median and 99 % of                            beams in %\n"
        << "backend     echoes, mm        power, %        readings, mm    other echoes   other "
           "cause\n"
        << std::fixed;
    for (const StageComparison& it : backends) {
        out << std::left << std::setw(10) << it.backend << std::right << std::setprecision(3);
        if (!it.missing.empty()) {
            out << "  " << it.missing << "\n";
            continue;
        }
        for (const auto& [off, unit] :
             {std::pair{it.echo_off_m, 1e3}, {it.power_off, 1e2}, {it.reading_off_m, 1e3}}) {
            out << std::setw(8) << unit * off[0] << std::setw(9) << unit * off[1];
        }
        for (const std::size_t beams : {it.other_count, it.other_cause})
            out << std::setw(14) << 100.0 * double(beams) / double(it.beams);
        out << (it.follows_light ? "" : "   sees nothing behind glass or in mirrors") << "\n";
    }
}

}  // namespace scipd::tools
