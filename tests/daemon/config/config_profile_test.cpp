// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// That every field of a model can be said, arrives where it belongs, and is refused in plain words
// where it cannot be.
#include <array>
#include <chrono>
#include <functional>
#include <map>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/config/profile.h"
#include "daemon/models/model_registry.h"
#include "tests/daemon/config/config_fixture.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using protocol::DeviceProfile;
using testing::ElementsAre;
using testing::IsEmpty;
using Profile = DeviceProfile&;

/// Stands for a value of any type in braces.
struct Anything {
    template <class Type>
    operator Type() const;  // NOLINT(google-explicit-constructor)
};

/// How many members an aggregate has: with one more in braces it does not compile.
template <class Aggregate, class... Members>
consteval std::size_t member_count() {
    if constexpr (requires { Aggregate{Members{}..., Anything{}}; }) {
        return member_count<Aggregate, Members..., Anything>();
    } else {
        return sizeof...(Members);
    }
}

TEST(ProfileKeys, LeaveNoMemberOut) {
    const std::size_t name_and_release = 2;
    EXPECT_EQ(profile_keys().size() + name_and_release, member_count<DeviceProfile>())
        << "a member of DeviceProfile is missing in daemon/config/profile.cpp";
    EXPECT_EQ(code_keys().size(), member_count<protocol::DistanceCodes>());
    EXPECT_EQ(scip1_keys().size(), member_count<protocol::Scip1Texts>());
}

/// What is written, of which model, and what becomes of the profile.
struct Case {
    const char* key;
    const char* text;
    const char* model;
    std::function<void(Profile)> change;
};

/// What it says of itself.
std::vector<Case> words() {
    return {
        {"family", "b", "UST-10LX",
         [](Profile p) { p.family = protocol::Family::ethernet_multi_echo; }},
        {"vendor", "Us", "UST-10LX", [](Profile p) { p.vendor = "Us"; }},
        {"product", "'A B: c'", "UST-10LX", [](Profile p) { p.product = "A B: c"; }},
        {"firmware", "2.30", "UST-10LX", [](Profile p) { p.firmware = "2.30"; }},
        {"protocol", "SCIP 3", "UST-10LX", [](Profile p) { p.protocol = "SCIP 3"; }},
        {"serial", "00012", "UST-10LX", [](Profile p) { p.serial = "00012"; }},
        {"scip1", "{firmware: f, protocol: p, health: h, health_failed: e}", "URG-04LX",
         [](Profile p) {
             p.scip1 = {.firmware = "f", .protocol = "p", .health = "h", .health_failed = "e"};
         }},
        {"model", "M", "UST-10LX", [](Profile p) { p.model = "M"; }},
        {"dmin_mm", "30", "UST-10LX", [](Profile p) { p.dmin_mm = 30; }},
        {"dmax_mm", "10000", "UST-10LX", [](Profile p) { p.dmax_mm = 10000; }},
        {"ares", "2880", "UST-10LX", [](Profile p) { p.ares = 2880; }},
        {"amin", "100", "UST-10LX", [](Profile p) { p.amin = 100; }},
        {"amax", "900", "UST-10LX", [](Profile p) { p.amax = 900; }},
        {"afrt", "500", "UST-10LX", [](Profile p) { p.afrt = 500; }},
        {"scan_rpm", "2401", "UST-10LX", [](Profile p) { p.scan_rpm = 2401; }},
        {"motor_speed", "fast", "UST-10LX", [](Profile p) { p.motor_speed = "fast"; }},
        {"mode_idle", "i", "UST-10LX", [](Profile p) { p.mode_idle = "i"; }},
        {"mode_measuring", "m", "UST-10LX", [](Profile p) { p.mode_measuring = "m"; }},
        {"mode_streaming", "s", "UST-10LX", [](Profile p) { p.mode_streaming = "s"; }},
        {"mode_sensitive", "s", "UST-10LX", [](Profile p) { p.mode_sensitive = "s"; }},
        {"mode_booting", "b", "UST-10LX", [](Profile p) { p.mode_booting = "b"; }},
        {"bit_rate", "1 Gbps", "UST-10LX", [](Profile p) { p.bit_rate = "1 Gbps"; }},
        {"health", "fine", "UST-10LX", [](Profile p) { p.health = "fine"; }},
        {"health_unstable", "so so", "UST-10LX", [](Profile p) { p.health_unstable = "so so"; }},
        {"health_failed", "gone", "UST-10LX", [](Profile p) { p.health_failed = "gone"; }},
        {"time_spelling", "hexadecimal", "UST-10LX",
         [](Profile p) { p.time_spelling = protocol::TimeSpelling::hexadecimal; }},
    };
}

/// What it measures and which commands it has.
std::vector<Case> abilities() {
    static const std::vector<int> two_rates{9600, 19200};
    using enum protocol::Support;
    return {
        {"first_step", "44", "URG-04LX", [](Profile p) { p.first_step = 44; }},
        {"last_step", "1100", "UST-10LX", [](Profile p) { p.last_step = 1100; }},
        {"nearest_mm", "50", "UST-10LX", [](Profile p) { p.nearest_mm = 50; }},
        {"codes",
         "{nothing: 0, too_near: 1, too_far: 2, not_measured: 3, too_dark: 4, too_bright: 5, "
         "edge: 6, interference: 7, lost: 8}",
         "UST-10LX",
         [](Profile p) {
             p.codes = {.nothing = 0,
                        .too_near = 1,
                        .too_far = 2,
                        .not_measured = 3,
                        .too_dark = 4,
                        .too_bright = 5,
                        .edge = 6,
                        .interference = 7,
                        .lost = 8};
         }},
        {"rare_codes", "[{code: 7, inside: 0.02, beside: 0.1, edge: 0.03, alone: true}, {code: 6}]",
         "URG-04LX",
         [](Profile p) {
             p.rare_codes = {
                 {.code = 7, .inside = 0.02, .beside = 0.1, .edge = 0.03, .alone = true},
                 {.code = 6}};
         }},
        {"multi_echo", "true", "UTM-30LX", [](Profile p) { p.multi_echo = true; }},
        {"microseconds", "true", "UST-10LX", [](Profile p) { p.microseconds = true; }},
        {"io_lines", "true", "UST-10LX", [](Profile p) { p.io_lines = true; }},
        {"intensity_codes", "false", "URG-04LX", [](Profile p) { p.intensity_codes = false; }},
        {"bit_rates", "[9600, 19200]", "URG-04LX", [](Profile p) { p.bit_rates = two_rates; }},
        {"motor_levels", "false", "URG-04LX", [](Profile p) { p.motor_levels = false; }},
        {"sensitivity", "never", "URG-04LX", [](Profile p) { p.sensitivity = never; }},
        {"rehearsals", "yes", "URG-04LX", [](Profile p) { p.rehearsals = yes; }},
        {"unknown_command", "0E", "UST-10LX",
         [](Profile p) { p.unknown_command = protocol::status::undefined; }},
        {"answers", "[QT adjust 00, BM measuring --]", "UST-10LX",
         [](Profile p) {
             using enum protocol::State;
             p.deviations = {{"QT", adjust, protocol::status::ok}, {"BM", measuring, std::nullopt}};
         }},
    };
}

std::vector<Case> times() {
    return {
        {"scan_period_ms", "24.9", "UST-10LX", [](Profile p) { p.scan_period = 24900us; }},
        {"turns_per_reply", "2", "UST-10LX", [](Profile p) { p.turns_per_reply = 2; }},
        {"reply_tick_ms", "5", "UST-10LX", [](Profile p) { p.reply_tick = 5ms; }},
        {"time_tick_ms", "6", "UST-10LX", [](Profile p) { p.time_tick = 6ms; }},
        {"scan_tick_ms", "7.5", "UST-10LX", [](Profile p) { p.scan_tick = 7500us; }},
        {"scan_delay_ms", "2", "UST-10LX", [](Profile p) { p.scan_delay = 2ms; }},
        {"settle_time_ms", "0", "UST-10LX", [](Profile p) { p.settle_time = 0ms; }},
        {"reply_delay_ms", "0.5", "UST-10LX", [](Profile p) { p.reply_delay = 500us; }},
        {"state_report_delay_ms", "3", "UST-10LX", [](Profile p) { p.state_report_delay = 3ms; }},
        {"pause_after_scan_ms", "2", "UST-10LX", [](Profile p) { p.pause_after_scan = 2ms; }},
        {"boot_time_ms", "0", "UST-10LX", [](Profile p) { p.boot_time = 0ms; }},
        {"single_scan_is_next", "false", "UST-10LX",
         [](Profile p) { p.single_scan_is_next = false; }},
        {"answers_while_booting", "true", "UST-10LX",
         [](Profile p) { p.answers_while_booting = true; }},
        {"wake_time_ms", "600000", "UST-10LX", [](Profile p) { p.wake_time = 600s; }},
    };
}

using ConfigProfileTest = ConfigFixture;

TEST_F(ConfigProfileTest, ChangesEachFieldAndNoOther) {
    std::map<std::string_view, int> tried;
    std::vector<Case> cases;
    for (const auto& some : {words(), abilities(), times()})
        cases.insert(cases.end(), some.begin(), some.end());
    for (const auto& [key, text, model, change] : cases) {
        Model expected = find_model(model);
        change(expected.profile);
        expected = make_model(expected.profile, expected.optics, expected.sureness);
        expected.own_serial = key == std::string_view("serial");
        EXPECT_NE(expected, find_model(model)) << key << " changes nothing";
        const std::string line = std::string{"profile: {"} + key + ": " + text + "}";
        EXPECT_THAT(sensor_faults(line, model), IsEmpty()) << key;
        EXPECT_EQ(sensor(line, model).model, expected) << key;
        ++tried[key];
    }
    for (const auto key : profile_keys())
        EXPECT_EQ(tried[key], 1) << key;
}

TEST_F(ConfigProfileTest, OpticsFollow) {
    const Model model =
        sensor(
            "profile: {dmax_mm: 8000, ares: 720, amin: 10, amax: 400, afrt: 200, last_step: 400,"
            " scan_rpm: 1200, scan_period_ms: 50.1,"
            " noise: [{sigma_m: 0.01}, {from_m: 5, sigma_m: 0.02, share: 0.001}]}")
            .model;
    sim::SensorSpec expected = find_model("UST-10LX").optics;
    expected.steps_per_turn = 720;
    expected.first_step = 10;
    expected.last_step = 400;
    expected.front_step = 200;
    expected.scan_period = 50'100us;
    expected.max_range_m = 8.0;
    expected.noise = {{.from_range_m = 0, .sigma_m = 0.01, .sigma_share = 0},
                      {.from_range_m = 5, .sigma_m = 0.02, .sigma_share = 0.001}};
    EXPECT_EQ(model.optics, expected);
    EXPECT_EQ(model.profile.name, "UST-10LX");
    const auto quiet = sensor("profile: {noise: []}").model.optics;
    EXPECT_THAT(quiet.noise, IsEmpty());
    EXPECT_EQ(quiet.sigma_m(3.0), 0.0);
}

TEST_F(ConfigProfileTest, ErrorsAndLightCanBeChanged) {
    const sim::SensorSpec optics =
        sensor(
            "profile: {bias: [{range_m: 1, bias_m: -0.002}, {range_m: 4, bias_m: 0.01}],"
            " noise_law: {floor_m: 0.003, weak: 400},"
            " smoothing: {next: 0.3, after_next: 0.1, median_of_five: true},"
            " warm_up: {drift_m: -0.02, time_constant_s: 600}, lost_share: 0.01,"
            " lattice_m: 0.005, spot: {half_width_mrad: 4, half_height_mrad: 2, rays: 13},"
            " light: {wavelength_nm: 830, dark_range_m: 3, half_pulse_m: 0.6,"
            " level_below_m: 0.3, walk_m: 0.02, blinding_signal: 90, edge_share: 0.2,"
            " saturating_signal: 80, saturation_m: 0.03,"
            " aperture_m: 0.01, crosstalk: 0.05, intensity: [{range_m: 1, intensity: 900}],"
            " log_gain: 0.5, most_intensity: 1000, intensity_noise: [{intensity: 500, share: "
            "0.01}]}}")
            .model.optics;
    sim::SensorSpec expected = find_model("UST-10LX").optics;
    expected.noise_law = {.floor_m = 0.003, .weak = 400};
    expected.smoothing = {.next = 0.3, .after_next = 0.1, .median_of_five = true};
    expected.bias = {{1.0, -0.002}, {4.0, 0.01}};
    expected.warm_up = {.drift_m = -0.02, .time_constant = 600s};
    expected.lost_share = 0.01;
    expected.lattice_m = 0.005;
    expected.footprint = {.half_width_rad = 0.004, .half_height_rad = 0.002, .rays = 13};
    expected.receiver = {.wavelength_nm = 830,
                         .dark_range_m = 3,
                         .half_pulse_m = 0.6,
                         .level_below_m = 0.3,
                         .walk_m = 0.02,
                         .blinding_signal = 90,
                         .saturating_signal = 80,
                         .saturation_m = 0.03,
                         .edge_share = 0.2,
                         .aperture_m = 0.01,
                         .crosstalk = 0.05,
                         .intensity = {{1.0, 900}},
                         .log_gain = 0.5,
                         .most_intensity = 1000,
                         .intensity_noise = {{500, 0.01}}};
    EXPECT_EQ(optics, expected);
}

/// The faults of a profile with this in it, without what begins all of them.
class ConfigProfileFaults : public ConfigFixture {
  protected:
    std::vector<std::string> said(const std::string& fields,
                                  const std::string& model = "UST-10LX") const {
        const std::string start = "rig.yaml:3: robots.r.sensors.s.profile.";
        auto all = sensor_faults("profile: {" + fields + "}", model);
        for (std::string& fault : all)
            if (fault.starts_with(start)) fault.erase(0, start.size());
        return all;
    }
};

TEST_F(ConfigProfileTest, CodesThatAreGivenStandAlone) {
    EXPECT_FALSE(sensor("profile: {vendor: Us}", "URG-04LX").model.profile.rare_codes.empty());
    EXPECT_THAT(sensor("profile: {codes: {too_dark: 1}}", "URG-04LX").model.profile.rare_codes,
                IsEmpty());
    EXPECT_THAT(
        sensor("profile: {codes: {edge: 8}, rare_codes: [{code: 6, edge: 0.1}]}", "URG-04LX")
            .model.profile.rare_codes,
        ElementsAre(protocol::RareCode{.code = 6, .edge = 0.1}));
}

TEST_F(ConfigProfileFaults, OfRareCodes) {
    EXPECT_THAT(said("rare_codes: [{code: 500}]"),
                ElementsAre("rare_codes: code 500 is a distance: use one below nearest_mm or above "
                            "dmax_mm"));
    EXPECT_THAT(said("rare_codes: [{code: 1, inside: 2}]"),
                ElementsAre("rare_codes.inside: must be 0 to 1, not '2'"));
    EXPECT_THAT(
        said("rare_codes: [{code: 1, beside: 0.4}, {code: 2, beside: 0.2, alone: true}]"),
        ElementsAre("rare_codes: beside must be less than 1 in all, where a code that stands alone "
                    "counts four times: it has one step in four"));
}

TEST_F(ConfigProfileFaults, OfErrorsAndLight) {
    EXPECT_THAT(said("bias: [{range_m: 2, bias_m: 0}, {range_m: 1, bias_m: 0}]"),
                ElementsAre("bias: range_m must grow"));
    EXPECT_THAT(said("bias: [{range_m: 2}]"), ElementsAre("bias: needs bias_m"));
    EXPECT_THAT(said("rare_codes: [{inside: 0.1}]"), ElementsAre("rare_codes: needs code"));
    EXPECT_THAT(said("light: {intensity: [{range_m: 1}]}"),
                ElementsAre("light.intensity: needs intensity"));
    EXPECT_THAT(said("light: {intensity_noise: [{share: 0.1}]}"),
                ElementsAre("light.intensity_noise: needs intensity"));
    EXPECT_THAT(said("lost_share: 2"), ElementsAre("lost_share: must be 0 to 1, not '2'"));
    EXPECT_THAT(said("spot: {rays: 5}"),
                ElementsAre("spot.rays: must be 1, 7 or 13 rays for a beam, not '5'"));
    EXPECT_THAT(said("spot: {half_width_mrad: 90}"),
                ElementsAre("spot.half_width_mrad: must be 0 to 50 milliradians, not '90'"));
    EXPECT_THAT(said("light: {wavelength_nm: 10}"), testing::SizeIs(1));
    EXPECT_THAT(
        said("light: {intensity: [{range_m: 1, intensity: 9}, {range_m: 1, intensity: 9}]}"),
        ElementsAre("light.intensity: range_m must grow"));
    EXPECT_THAT(said("light: {colour: red}"),
                ElementsAre(testing::StartsWith("light.colour: unknown key")));
}

TEST_F(ConfigProfileFaults, OfOneValue) {
    EXPECT_THAT(said("seriel: x"), ElementsAre("seriel: unknown key; did you mean serial?"));
    EXPECT_THAT(said("name: x"),
                ElementsAre(testing::AllOf(
                    testing::StartsWith("name: unknown key; known here are family, vendor"),
                    testing::EndsWith("wake_time_ms, noise, noise_law, smoothing, bias, "
                                      "warm_up, lost_share, lattice_m, spot, light"))));
    EXPECT_THAT(said("codes: {none: 1}"),
                ElementsAre("codes.none: unknown key; known here are nothing, too_near, too_far, "
                            "not_measured, too_dark, too_bright, edge, interference, lost"));
    EXPECT_THAT(said("serial: \"" + std::string(65, 'x') + "\""),
                ElementsAre(testing::StartsWith(
                    "serial: must be at most 64 characters of printable ASCII, not 'xxx")));
    EXPECT_THAT(said("serial: \"a\\nb\""),
                ElementsAre("serial: must be at most 64 characters of printable ASCII, not 'a?b'"));
    EXPECT_THAT(said("dmax_mm: 5.5"),
                ElementsAre("dmax_mm: must be a whole number from 0 to 1000000, not '5.5'"));
    EXPECT_THAT(said("multi_echo: maybe"),
                ElementsAre("multi_echo: must be true or false, not 'maybe'"));
    EXPECT_THAT(said("family: d"), ElementsAre("family: must be one of a1, a2, b, c, not 'd'"));
    EXPECT_THAT(said("time_spelling: roman"),
                ElementsAre("time_spelling: must be one of hexadecimal, encoded, not 'roman'"));
    EXPECT_THAT(said("sensitivity: no"),
                ElementsAre("sensitivity: must be one of never, later_firmware, yes, not 'no'"));
    EXPECT_THAT(said("unknown_command: 00"),
                ElementsAre("unknown_command: must be one of 0C, 0D, 0E, 0F, not '00'"));
    EXPECT_THAT(said("boot_time_ms: 600001"),
                ElementsAre("boot_time_ms: must be 0 to 600000 ms, not '600001'"));
    EXPECT_THAT(said("answers: [QT adjust]"),
                ElementsAre("answers: must be a command, a state and a status or --, as in "
                            "\"QT adjust 00\", not 'QT adjust'"));
    EXPECT_THAT(said("bit_rates: 9600"),
                ElementsAre("bit_rates: must be a list of at most 64, in brackets"));
    EXPECT_THAT(said("bit_rates: '19200, 38400'"),
                ElementsAre("bit_rates: must be a list of at most 64, in brackets: write [19200, "
                            "38400]"));
    EXPECT_THAT(said("bit_rates: [x]"),
                ElementsAre("bit_rates: must be a whole number from 0 to 1000000, not 'x'"));
    EXPECT_THAT(said("serial: {a: b}"), ElementsAre("serial: must be a single value, not a map"));
    EXPECT_THAT(sensor_faults("profile: x"),
                ElementsAre("rig.yaml:3: robots.r.sensors.s.profile: must be a map of keys and "
                            "values, such as {serial: H1234567}"));
}

TEST_F(ConfigProfileFaults, OfNoise) {
    EXPECT_THAT(said("noise: 3"), ElementsAre("noise: must be a list of at most 64, in brackets"));
    EXPECT_THAT(said("noise: [3]"),
                ElementsAre(testing::StartsWith("noise: must be a map of keys and values")));
    EXPECT_THAT(said("noise: [{sigma: 1}]"),
                ElementsAre("noise.sigma: unknown key; did you mean sigma_m?"));
    EXPECT_THAT(said("noise: [{sigma_m: -1, share: 2, from_m: x}]"),
                ElementsAre("noise.from_m: must be a number, not 'x'",
                            "noise.sigma_m: must be 0 or more, not '-1'",
                            "noise.share: must be 0 to 1, not '2'"));
    EXPECT_THAT(said("noise: [{from_m: 1}]"),
                ElementsAre("noise: from_m must begin with 0 and grow"));
    EXPECT_THAT(said("noise: [{}, {from_m: 2}, {from_m: 2}]"),
                ElementsAre("noise: from_m must begin with 0 and grow"));
}

TEST_F(ConfigProfileFaults, OfWhatDoesNotGoTogether) {
    EXPECT_THAT(said("dmin_mm: 30000, nearest_mm: 30001"),
                ElementsAre("dmin_mm: must be at most 29999, below dmax_mm, not 30000",
                            "nearest_mm: must be at most 29999, below dmax_mm, not 30001"));
    EXPECT_THAT(said("dmax_mm: 262144, codes: {nothing: 0, too_far: 0, not_measured: 0}"),
                ElementsAre("dmax_mm: must be at most 262143, the largest that SCIP can say, not "
                            "262144"));
    EXPECT_THAT(said("dmax_mm: 0"), ElementsAre("dmax_mm: must be at least 2"));
    EXPECT_THAT(said("amin: 541, afrt: 1081"),
                ElementsAre("afrt: must be at most 1080, amax, not 1081"));
    EXPECT_THAT(said("amin: 541"), ElementsAre("amin: must be at most 540, afrt, not 541"));
    EXPECT_THAT(said("amax: 1440"), ElementsAre("amax: must be at most 1439, below ares, not 1440",
                                                "amax: must be at most 1080, last_step, not 1440"));
    EXPECT_THAT(said("last_step: 10000, ares: 20000"),
                ElementsAre("last_step: must be at most 9999, the largest that SCIP can say, not "
                            "10000"));
    EXPECT_THAT(said("ares: 0"), ElementsAre("ares: must be at least 2"));
    EXPECT_THAT(said("scan_rpm: 0"), ElementsAre("scan_rpm: must be at least 1"));
    EXPECT_THAT(said("scan_rpm: 1200"),
                ElementsAre("scan_period_ms: must be within 5 % of what scan_rpm says, 50 ms"));
    EXPECT_THAT(said("scan_rpm: 100000, scan_period_ms: 0.6"),
                ElementsAre("scan_period_ms: must be 1 to 10000 ms"));
    EXPECT_THAT(said("turns_per_reply: 101"),
                ElementsAre("turns_per_reply: must be at most 100, not 101"));
    EXPECT_THAT(said("codes: {too_near: 5000, nothing: 262144}"),
                ElementsAre("codes: nothing must be at most 262143, the largest that SCIP can say",
                            "codes: too_near 5000 is a distance: use one below nearest_mm or above "
                            "dmax_mm"));
    EXPECT_THAT(said("bit_rates: [19200, 299, 1000000, 19200]", "URG-04LX"),
                ElementsAre("bit_rates: 299 must be 300 to 999999",
                            "bit_rates: 1000000 must be 300 to 999999",
                            "bit_rates: 19200 is there twice; keep one"));
    EXPECT_THAT(said("sensitivity: yes", "URG-04LX"),
                ElementsAre("mode_sensitive: must be given where sensitivity is yes"));
}

TEST_F(ConfigProfileFaults, OfWhatTheFamilyCannot) {
    const std::string rest = ": is nothing that this family can do; leave it out";
    EXPECT_THAT(said("multi_echo: true, bit_rates: [19200], motor_levels: true, "
                     "sensitivity: later_firmware, rehearsals: yes, intensity_codes: true"),
                ElementsAre("multi_echo" + rest, "intensity_codes" + rest, "bit_rates" + rest,
                            "motor_levels" + rest, "sensitivity" + rest, "rehearsals" + rest));
    EXPECT_THAT(said("multi_echo: true, microseconds: true, io_lines: true", "URG-04LX"),
                ElementsAre("multi_echo" + rest, "microseconds" + rest, "io_lines" + rest));
}

TEST_F(ConfigProfileFaults, AreToldWithoutAModelAsFarAsTheyCanBe) {
    EXPECT_THAT(said("amin: 541, afrt: x", "UST-99"),
                ElementsAre(testing::HasSubstr("there is no model \"UST-99\""),
                            "afrt: must be a whole number from 0 to 1000000, not 'x'"));
}

using ConfigModelsTest = ConfigFixture;

TEST_F(ConfigModelsTest, StandWhereverTheFilePutsThem) {
    const std::string models =
        "models:\n  MINE: {like: UST-20LX, serial: X1, dmax_mm: 9000, noise: []}\n";
    const std::string robots =
        "robots: {r: {sensors: {a: {pty: auto, model: MINE},"
        " b: {pty: auto, model: MINE, profile: {serial: X2}}}}}\n";
    const Config config = parse("scene: room.sdf\n" + models + robots);
    EXPECT_EQ(config.robots, parse("scene: room.sdf\n" + robots + models).robots);

    Model expected = find_model("UST-20LX");
    expected.profile.name = "MINE";
    expected.profile.serial = "X1";
    expected.profile.dmax_mm = 9000;
    expected.optics.max_range_m = 9.0;
    expected.optics.noise_law = {};
    expected.own_serial = true;
    EXPECT_EQ(config.robots[0].sensors[0].model, expected);
    expected.profile.serial = "X2";
    EXPECT_EQ(config.robots[0].sensors[1].model, expected);
}

TEST_F(ConfigModelsTest, ToldWithAllTheirFaults) {
    const auto told = faults(R"(scene: room.sdf
models:
  UST-10LX: {like: UST-20LX}
  a/b: {like: UST-20LX}
  EMPTY: {}
  LIKE-MINE: {like: EMPTY}
  WRONG: {like: UST-20LX@2.23.0000, amin: 700, serial: [a], dmax: 3}
  NONE:
robots:
  r:
    sensors:
      a: {pty: auto, model: WRONG, profile: {amin: 800}, power_up: scip1.1}
      b: {pty: auto, model: MINE}
)");
    ASSERT_EQ(told.size(), 9u) << testing::PrintToString(told);
    EXPECT_EQ(told[0], "rig.yaml:3: models.UST-10LX: is a model of scipd's own; use another name");
    EXPECT_EQ(told[1],
              "rig.yaml:4: models.a/b: 'a/b' is no name: use up to 64 letters, digits, _ - and "
              "., not beginning with a dot");
    EXPECT_EQ(told[2],
              "rig.yaml:5: models.EMPTY: needs like, the model that all else is taken from, such "
              "as `like: UST-10LX`");
    EXPECT_THAT(told[3], testing::StartsWith(
                             "rig.yaml:6: models.LIKE-MINE.like: there is no model \"EMPTY\""));
    EXPECT_EQ(told[4], "rig.yaml:7: models.WRONG.dmax: unknown key; did you mean amax?");
    EXPECT_EQ(told[5], "rig.yaml:7: models.WRONG.serial: must be a single value, not a list");
    EXPECT_EQ(told[6], "rig.yaml:7: models.WRONG.amin: must be at most 540, afrt, not 700");
    EXPECT_EQ(
        told[7],
        "rig.yaml:8: models.NONE: must be a map of keys and values, such as {like: UST-10LX}");
    EXPECT_THAT(told[8],
                testing::AllOf(testing::StartsWith("rig.yaml:13: robots.r.sensors.b.model: there "
                                                   "is no model \"MINE\""),
                               testing::EndsWith("; this file defines EMPTY, LIKE-MINE, NONE, "
                                                 "UST-10LX, WRONG, a/b")));
}

}  // namespace
}  // namespace scipd::daemon
