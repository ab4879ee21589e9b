// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/optics.h"

#include <array>
#include <chrono>

#include "daemon/config/members.h"
#include "daemon/config/numbers.h"

namespace scipd::daemon {
namespace {

using sim::BiasPoint;
using sim::Footprint;
using sim::IntensityNoisePoint;
using sim::IntensityPoint;
using sim::NoiseLaw;
using sim::NoiseStep;
using sim::Receiver;
using sim::SensorSpec;
using sim::Smoothing;
using sim::WarmUp;

sim::Expected<int> parse_wavelength(std::string_view text) {
    return parse_whole(text, 300, 2000);
}

sim::Expected<int> parse_rays(std::string_view text) {
    if (text == "1") return 1;
    if (text == "7") return 7;
    if (text == "13") return 13;
    return sim::refuse("must be 1, 7 or 13 rays for a beam, not '" + std::string(text) + "'");
}

sim::Expected<double> parse_milliradians(std::string_view text) {
    return parse_length(text).and_then([&](double mrad) -> sim::Expected<double> {
        if (mrad > 50.0)
            return sim::refuse("must be 0 to 50 milliradians, not '" + std::string(text) + "'");
        return mrad * 1e-3;
    });
}

constexpr Member<NoiseStep> noise_members[] = {
    {"from_m", read_as<&NoiseStep::from_range_m, parse_length>},
    {"sigma_m", read_as<&NoiseStep::sigma_m, parse_length>},
    {"share", read_as<&NoiseStep::sigma_share, parse_share>},
};

constexpr Member<BiasPoint> bias_members[] = {
    {"range_m", read_as<&BiasPoint::range_m, parse_length>},
    {"bias_m", read_as<&BiasPoint::bias_m, parse_metres>},
};

constexpr Member<IntensityPoint> intensity_members[] = {
    {"range_m", read_as<&IntensityPoint::range_m, parse_length>},
    {"intensity", read_as<&IntensityPoint::intensity, parse_length>},
};

void read_noise(const sim::YamlField& field, SensorSpec& optics, sim::YamlFaults& faults) {
    optics.noise = maps_of<NoiseStep, noise_members>(field, faults);
    if (optics.noise.empty()) optics.noise_law = {};
    for (std::size_t i = 0; i < optics.noise.size(); ++i) {
        const double from_m = optics.noise[i].from_range_m;
        const bool in_order = i == 0 ? from_m == 0.0 : from_m > optics.noise[i - 1].from_range_m;
        if (!in_order) faults.add(field, "from_m must begin with 0 and grow");
    }
}

template <class Point>
void require_growing(const sim::YamlField& field, const std::vector<Point>& curve,
                     sim::YamlFaults& faults) {
    for (std::size_t i = 1; i < curve.size(); ++i) {
        if (curve[i].range_m <= curve[i - 1].range_m) faults.add(field, "range_m must grow");
    }
}

void read_bias(const sim::YamlField& field, SensorSpec& optics, sim::YamlFaults& faults) {
    optics.bias = maps_of<BiasPoint, bias_members>(field, faults, {"range_m", "bias_m"});
    require_growing(field, optics.bias, faults);
}

void read_intensity(const sim::YamlField& field, Receiver& receiver, sim::YamlFaults& faults) {
    receiver.intensity =
        maps_of<IntensityPoint, intensity_members>(field, faults, {"range_m", "intensity"});
    require_growing(field, receiver.intensity, faults);
}

constexpr Member<NoiseLaw> noise_law_members[] = {
    {"floor_m", read_as<&NoiseLaw::floor_m, parse_length>},
    {"weak", read_as<&NoiseLaw::weak, parse_length>},
};

constexpr Member<Smoothing> smoothing_members[] = {
    {"next", read_as<&Smoothing::next, parse_share>},
    {"after_next", read_as<&Smoothing::after_next, parse_share>},
    {"median_of_five", read_as<&Smoothing::median_of_five, parse_switch>},
};

/// In place of the model's: half of a median and half of a mix are neither.
void read_smoothing(const sim::YamlField& field, SensorSpec& optics, sim::YamlFaults& faults) {
    optics.smoothing = {};
    read_map<&SensorSpec::smoothing, smoothing_members>(field, optics, faults);
}

constexpr Member<IntensityNoisePoint> intensity_noise_members[] = {
    {"intensity", read_as<&IntensityNoisePoint::intensity, parse_length>},
    {"share", read_as<&IntensityNoisePoint::share, parse_share>},
};

void read_intensity_noise(const sim::YamlField& field, Receiver& receiver,
                          sim::YamlFaults& faults) {
    receiver.intensity_noise = maps_of<IntensityNoisePoint, intensity_noise_members>(
        field, faults, {"intensity", "share"});
    for (std::size_t i = 1; i < receiver.intensity_noise.size(); ++i) {
        if (receiver.intensity_noise[i].intensity <= receiver.intensity_noise[i - 1].intensity)
            faults.add(field, "intensity must grow");
    }
}

constexpr Member<WarmUp> warm_up_members[] = {
    {"drift_m", read_as<&WarmUp::drift_m, parse_metres>},
    {"time_constant_s", read_as<&WarmUp::time_constant, parse_stale>},
};

constexpr Member<Footprint> spot_members[] = {
    {"half_width_mrad", read_as<&Footprint::half_width_rad, parse_milliradians>},
    {"half_height_mrad", read_as<&Footprint::half_height_rad, parse_milliradians>},
    {"rays", read_as<&Footprint::rays, parse_rays>},
};

constexpr Member<Receiver> light_members[] = {
    {"wavelength_nm", read_as<&Receiver::wavelength_nm, parse_wavelength>},
    {"dark_range_m", read_as<&Receiver::dark_range_m, parse_length>},
    {"half_pulse_m", read_as<&Receiver::half_pulse_m, parse_length>},
    {"level_below_m", read_as<&Receiver::level_below_m, parse_length>},
    {"walk_m", read_as<&Receiver::walk_m, parse_metres>},
    {"blinding_signal", read_as<&Receiver::blinding_signal, parse_length>},
    {"saturating_signal", read_as<&Receiver::saturating_signal, parse_length>},
    {"saturation_m", read_as<&Receiver::saturation_m, parse_metres>},
    {"edge_share", read_as<&Receiver::edge_share, parse_share>},
    {"aperture_m", read_as<&Receiver::aperture_m, parse_length>},
    {"crosstalk", read_as<&Receiver::crosstalk, parse_share>},
    {"intensity", read_intensity},
    {"intensity_noise", read_intensity_noise},
    {"log_gain", read_as<&Receiver::log_gain, parse_length>},
    {"most_intensity", read_as<&Receiver::most_intensity, parse_length>},
};

constexpr Member<SensorSpec> optics_members[] = {
    {"noise", read_noise},
    {"noise_law", read_map<&SensorSpec::noise_law, noise_law_members>},
    {"smoothing", read_smoothing},
    {"bias", read_bias},
    {"warm_up", read_map<&SensorSpec::warm_up, warm_up_members>},
    {"lost_share", read_as<&SensorSpec::lost_share, parse_share>},
    {"lattice_m", read_as<&SensorSpec::lattice_m, parse_length>},
    {"spot", read_map<&SensorSpec::footprint, spot_members>},
    {"light", read_map<&SensorSpec::receiver, light_members>},
};

}  // namespace

bool read_bias_choice(const sim::YamlField& field, SensorSpec& optics, sim::YamlFaults& faults) {
    optics.bias.clear();
    if (field.value.IsSequence()) {
        read_bias(field, optics, faults);
        return true;
    }
    const std::string word = field.value.IsScalar() ? field.value.Scalar() : "";
    if (word != "none" && word != "unit")
        faults.add(field, "must be none, unit, or a list of {range_m, bias_m}");
    return word != "unit";
}

std::vector<std::string_view> optics_keys() {
    return keys_of(optics_members);
}

void override_optics(const sim::YamlSection& section, SensorSpec& optics, sim::YamlFaults& faults) {
    read_members(section, optics_members, optics, faults);
}

}  // namespace scipd::daemon
