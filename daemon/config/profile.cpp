// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/profile.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <string>

#include "daemon/config/members.h"
#include "daemon/config/numbers.h"
#include "daemon/config/values.h"
#include "daemon/models/profile_check.h"
#include "protocol/command_table.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using protocol::DeviceProfile;
using protocol::DistanceCodes;
using protocol::RareCode;
using protocol::Scip1Texts;
using sim::Expected;
using sim::refuse;

constexpr std::size_t longest_text = 64;  // urg_library takes lines of 71: VEND: and ; and a sum
constexpr int largest_number = 1'000'000;

Expected<std::string> parse_text(std::string_view text) {
    const bool printable = std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
    if (!printable || text.size() > longest_text)
        return refuse("must be at most 64 characters of printable ASCII, not " + sim::quote(text));
    return std::string{text};
}

Expected<int> parse_number(std::string_view text) {
    return parse_whole(text, 0, largest_number);
}

/// One of several words.
template <class Value, std::size_t count>
Expected<Value> parse_word(std::string_view text,
                           const std::array<std::pair<std::string_view, Value>, count>& words) {
    std::string choices;
    for (const auto& [word, value] : words) {
        if (text == word) return value;
        choices += (choices.empty() ? "" : ", ") + std::string{word};
    }
    return refuse("must be one of " + choices + ", not " + sim::quote(text));
}

Expected<protocol::Family> parse_family(std::string_view text) {
    using enum protocol::Family;
    return parse_word<protocol::Family, 4>(
        text, {{{"a1", urg}, {"a2", utm_usb}, {"b", ethernet_multi_echo}, {"c", ust}}});
}

Expected<protocol::TimeSpelling> parse_spelling(std::string_view text) {
    using enum protocol::TimeSpelling;
    return parse_word<protocol::TimeSpelling, 2>(
        text, {{{"hexadecimal", hexadecimal}, {"encoded", encoded}}});
}

Expected<protocol::Support> parse_support(std::string_view text) {
    using enum protocol::Support;
    return parse_word<protocol::Support, 3>(
        text, {{{"never", never}, {"later_firmware", later_firmware}, {"yes", yes}}});
}

Expected<protocol::Status> parse_refusal(std::string_view text) {
    using namespace protocol::status;
    return parse_word<protocol::Status, 4>(
        text, {{{"0C", too_short}, {"0D", too_long}, {"0E", undefined}, {"0F", unsupported}}});
}

Expected<protocol::Deviation> parse_cell(std::string_view text) {
    if (const auto deviation = protocol::parse_deviation(text)) return *deviation;
    return refuse("must be a command, a state and a status or --, as in \"QT adjust 00\", not " +
                  sim::quote(text));
}

template <auto member, class Struct>
void read_text(const sim::YamlField& field, Struct& target, sim::YamlFaults& faults) {
    read_as<member, parse_text>(field, target, faults);
}

template <auto member, class Struct>
void read_number(const sim::YamlField& field, Struct& target, sim::YamlFaults& faults) {
    read_as<member, parse_number>(field, target, faults);
}

template <auto member, class Struct>
void read_flag(const sim::YamlField& field, Struct& target, sim::YamlFaults& faults) {
    read_as<member, parse_switch>(field, target, faults);
}

template <auto member, class Struct>
void read_period(const sim::YamlField& field, Struct& target, sim::YamlFaults& faults) {
    read_as<member, parse_period>(field, target, faults);
}

constexpr Member<DistanceCodes> code_members[] = {
    {"nothing", read_number<&DistanceCodes::nothing>},
    {"too_near", read_number<&DistanceCodes::too_near>},
    {"too_far", read_number<&DistanceCodes::too_far>},
    {"not_measured", read_number<&DistanceCodes::not_measured>},
    {"too_dark", read_number<&DistanceCodes::too_dark>},
    {"too_bright", read_number<&DistanceCodes::too_bright>},
    {"edge", read_number<&DistanceCodes::edge>},
    {"interference", read_number<&DistanceCodes::interference>},
    {"lost", read_number<&DistanceCodes::lost>},
};

constexpr Member<RareCode> rare_code_members[] = {
    {"code", read_number<&RareCode::code>},
    {"inside", read_as<&RareCode::inside, parse_share>},
    {"beside", read_as<&RareCode::beside, parse_share>},
    {"edge", read_as<&RareCode::edge, parse_share>},
    {"alone", read_flag<&RareCode::alone>},
};

void read_rare_codes(const sim::YamlField& field, DeviceProfile& profile, sim::YamlFaults& faults) {
    profile.rare_codes = maps_of<RareCode, rare_code_members>(field, faults, {"code"});
}

constexpr Member<Scip1Texts> scip1_members[] = {
    {"firmware", read_text<&Scip1Texts::firmware>},
    {"protocol", read_text<&Scip1Texts::protocol>},
    {"health", read_text<&Scip1Texts::health>},
    {"health_failed", read_text<&Scip1Texts::health_failed>},
};

// In the order of DeviceProfile. A test counts them.
constexpr Member<DeviceProfile> profile_members[] = {
    {"family", read_as<&DeviceProfile::family, parse_family>},
    {"vendor", read_text<&DeviceProfile::vendor>},
    {"product", read_text<&DeviceProfile::product>},
    {"firmware", read_text<&DeviceProfile::firmware>},
    {"protocol", read_text<&DeviceProfile::protocol>},
    {"serial", read_text<&DeviceProfile::serial>},
    {"scip1", read_map<&DeviceProfile::scip1, scip1_members>},
    {"model", read_text<&DeviceProfile::model>},
    {"dmin_mm", read_number<&DeviceProfile::dmin_mm>},
    {"dmax_mm", read_number<&DeviceProfile::dmax_mm>},
    {"ares", read_number<&DeviceProfile::ares>},
    {"amin", read_number<&DeviceProfile::amin>},
    {"amax", read_number<&DeviceProfile::amax>},
    {"afrt", read_number<&DeviceProfile::afrt>},
    {"scan_rpm", read_number<&DeviceProfile::scan_rpm>},
    {"motor_speed", read_text<&DeviceProfile::motor_speed>},
    {"mode_idle", read_text<&DeviceProfile::mode_idle>},
    {"mode_measuring", read_text<&DeviceProfile::mode_measuring>},
    {"mode_streaming", read_text<&DeviceProfile::mode_streaming>},
    {"mode_sensitive", read_text<&DeviceProfile::mode_sensitive>},
    {"mode_booting", read_text<&DeviceProfile::mode_booting>},
    {"bit_rate", read_text<&DeviceProfile::bit_rate>},
    {"health", read_text<&DeviceProfile::health>},
    {"health_unstable", read_text<&DeviceProfile::health_unstable>},
    {"health_failed", read_text<&DeviceProfile::health_failed>},
    {"time_spelling", read_as<&DeviceProfile::time_spelling, parse_spelling>},
    {"first_step", read_number<&DeviceProfile::first_step>},
    {"last_step", read_number<&DeviceProfile::last_step>},
    {"nearest_mm", read_number<&DeviceProfile::nearest_mm>},
    {"codes", read_map<&DeviceProfile::codes, code_members>},
    {"rare_codes", read_rare_codes},
    {"multi_echo", read_flag<&DeviceProfile::multi_echo>},
    {"microseconds", read_flag<&DeviceProfile::microseconds>},
    {"io_lines", read_flag<&DeviceProfile::io_lines>},
    {"intensity_codes", read_flag<&DeviceProfile::intensity_codes>},
    {"bit_rates", read_list<&DeviceProfile::bit_rates, parse_number>},
    {"motor_levels", read_flag<&DeviceProfile::motor_levels>},
    {"sensitivity", read_as<&DeviceProfile::sensitivity, parse_support>},
    {"rehearsals", read_as<&DeviceProfile::rehearsals, parse_support>},
    {"unknown_command", read_as<&DeviceProfile::unknown_command, parse_refusal>},
    {"answers", read_list<&DeviceProfile::deviations, parse_cell>},
    {"scan_period_ms", read_period<&DeviceProfile::scan_period>},
    {"turns_per_reply", read_number<&DeviceProfile::turns_per_reply>},
    {"reply_tick_ms", read_period<&DeviceProfile::reply_tick>},
    {"time_tick_ms", read_period<&DeviceProfile::time_tick>},
    {"scan_tick_ms", read_period<&DeviceProfile::scan_tick>},
    {"scan_delay_ms", read_period<&DeviceProfile::scan_delay>},
    {"settle_time_ms", read_period<&DeviceProfile::settle_time>},
    {"reply_delay_ms", read_period<&DeviceProfile::reply_delay>},
    {"state_report_delay_ms", read_period<&DeviceProfile::state_report_delay>},
    {"pause_after_scan_ms", read_period<&DeviceProfile::pause_after_scan>},
    {"boot_time_ms", read_period<&DeviceProfile::boot_time>},
    {"single_scan_is_next", read_flag<&DeviceProfile::single_scan_is_next>},
    {"answers_while_booting", read_flag<&DeviceProfile::answers_while_booting>},
    {"wake_time_ms", read_period<&DeviceProfile::wake_time>},
};

void check(const sim::YamlSection& section, const sim::YamlField& map, const DeviceProfile& profile,
           sim::YamlFaults& faults) {
    for (const ProfileFault& fault : faults_of(profile)) {
        const sim::YamlField* const given = section.find(fault.member);
        const std::string path = map.path + "." + std::string{fault.member};
        faults.add(given ? given->line : map.line, given ? given->path : path, fault.sentence);
    }
}

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

std::vector<std::string_view> profile_keys() {
    return keys_of(profile_members);
}

std::vector<std::string_view> code_keys() {
    return keys_of(code_members);
}

std::vector<std::string_view> scip1_keys() {
    return keys_of(scip1_members);
}

sim::YamlSection profile_section(const sim::YamlField& map,
                                 std::span<const std::string_view> besides,
                                 sim::YamlFaults& faults) {
    std::vector<std::string_view> keys = keys_of(profile_members, besides);
    for (const std::string_view key : optics_keys())
        keys.push_back(key);
    return {map, keys, faults, besides.empty() ? "{serial: H1234567}" : "{like: UST-10LX}"};
}

void override_model(const sim::YamlSection& section, const sim::YamlField& map,
                    std::optional<Model>& model, sim::YamlFaults& faults) {
    DeviceProfile profile = model ? model->profile : DeviceProfile{};
    sim::SensorSpec optics = model ? model->optics : sim::SensorSpec{};
    // Whoever says which code stands for a cause gets that one alone.
    if (section.find("codes") != nullptr) profile.rare_codes.clear();
    read_members(section, profile_members, profile, faults);
    override_optics(section, optics, faults);
    if (!model) return;
    check(section, map, profile, faults);
    const bool own_serial = model->own_serial || section.find("serial") != nullptr;
    const bool own_bias = model->own_bias || section.find("bias") != nullptr;
    model = make_model(profile, std::move(optics), model->sureness);
    model->own_serial = own_serial;
    model->own_bias = own_bias;
}

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
