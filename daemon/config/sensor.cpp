// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/sensor.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "daemon/config/mount.h"
#include "daemon/config/numbers.h"
#include "daemon/config/profile.h"
#include "daemon/config/run_directory.h"
#include "daemon/config/values.h"
#include "sim/backends/registry.h"
#include "sim/loaders/mesh/mesh_file.h"
#include "sim/loaders/yaml/yaml_section.h"
#include "sim/sensor/staring.h"
#include "sim/text/likely_unit.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::daemon {
namespace {

using sim::quote;
using Keys = std::initializer_list<std::string_view>;

// `camera` or `ranger` in place of `model`: the optics of a sensor that speaks no SCIP.
constexpr std::array<std::string_view, 6> camera_keys{"columns", "rows",    "fov_deg",
                                                      "rate_hz", "range_m", "noise"};
constexpr std::array<std::string_view, 6> ranger_keys{"cone_deg", "beams",   "aggregate",
                                                      "rate_hz",  "range_m", "noise"};
constexpr std::array<std::string_view, 2> noise_keys{"sigma_m", "share"};
constexpr std::array<std::string_view, 11> wire_keys{"tcp",          "pty",   "timing",  "power_up",
                                                     "clock",        "link",  "profile", "echo",
                                                     "interference", "noise", "bias"};
/// The thread that serves all sensors writes the numbers of a picture. So many take a tenth of a
/// second.
constexpr int most_pixels = 640 * 480;
constexpr int most_beams = 100'000;

sim::Expected<sim::Aggregate> parse_aggregate(std::string_view text) {
    if (text == "nearest") return sim::Aggregate::nearest;
    if (text == "weighted") return sim::Aggregate::weighted;
    return sim::refuse("must be nearest or weighted, not " + quote(text));
}

sim::Expected<int> parse_pixels(std::string_view text) {
    return parse_whole(text, 1, most_pixels);
}

sim::Expected<int> parse_beams(std::string_view text) {
    return parse_whole(text, 1, most_beams);
}

void require(const sim::YamlSection& section, const sim::YamlField& map, Keys keys,
             sim::YamlFaults& faults) {
    if (!map.value.IsMap()) return;
    for (const std::string_view key : keys) {
        if (!section.find(key)) faults.add(map, "needs " + std::string{key});
    }
}

void read_noise(const sim::YamlField& field, sim::StaringSpec& spec, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, noise_keys, faults, "noise: {sigma_m: 0.01}"};
    sim::NoiseStep step{};
    section.read("sigma_m", step.sigma_m, parse_length);
    section.read("share", step.sigma_share, parse_share);
    const bool none = step.sigma_m == 0.0 && step.sigma_share == 0.0;
    if (!none) spec.noise = {step};
}

/// The keys that cameras and rangers share.
void read_rest(const sim::YamlSection& section, sim::StaringSpec& spec, sim::YamlFaults& faults) {
    section.read("rate_hz", spec.period, parse_rate);
    std::array<double, 2> range_m{0.0, 1.0};
    section.read_pair("range_m", range_m, parse_length);
    if (range_m[0] >= range_m[1]) {
        faults.add(*section.find("range_m"),
                   "must be [NEAREST, FARTHEST] in metres, such as [0.1, 7.5]");
    }
    constexpr double nearest_of_any_m = 10.0;
    if (range_m[0] >= nearest_of_any_m && sim::could_be_millimetres(range_m))
        faults.warn(*section.find("range_m"), sim::millimetres_for_metres(range_m));
    spec.min_range_m = range_m[0];
    spec.max_range_m = range_m[1];
    if (const sim::YamlField* noise = section.find("noise")) read_noise(*noise, spec, faults);
}

sim::StaringSpec read_camera(const sim::YamlField& field, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, camera_keys, faults};
    require(section, field, {"columns", "rows", "fov_deg", "rate_hz", "range_m"}, faults);
    sim::PinholeGrid grid{1, 1, 1.0, 1.0};
    section.read("columns", grid.columns, parse_pixels);
    section.read("rows", grid.rows, parse_pixels);
    if (std::int64_t{grid.columns} * grid.rows > most_pixels) {
        faults.add(field, "columns times rows must not exceed 307200");
    }
    std::array<double, 2> fov_rad{1.0, 1.0};
    section.read_pair("fov_deg", fov_rad, parse_view);
    grid.width_rad = fov_rad[0];
    grid.height_rad = fov_rad[1];
    sim::StaringSpec spec{.optics = grid};
    read_rest(section, spec, faults);
    return spec;
}

sim::StaringSpec read_ranger(const sim::YamlField& field, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, ranger_keys, faults};
    require(section, field, {"cone_deg", "beams", "rate_hz", "range_m"}, faults);
    sim::RangerOptics optics{.cone = {1.0, 1}};
    section.read("cone_deg", optics.cone.opening_rad, parse_cone);
    section.read("beams", optics.cone.beams, parse_beams);
    section.read("aggregate", optics.aggregate, parse_aggregate);
    sim::StaringSpec spec{.optics = optics};
    read_rest(section, spec, faults);
    return spec;
}

/// Keys of a scanner's wire are faults here.
void refuse_wire(const sim::YamlSection& sensor, sim::YamlFaults& faults) {
    for (const std::string_view key : wire_keys) {
        if (const sim::YamlField* field = sensor.find(key)) {
            faults.add(*field,
                       "is of scanners, which speak SCIP; a camera or ranger is read through the "
                       "control API: leave it out");
        }
    }
}

constexpr std::array<std::string_view, 21> sensor_keys{
    "model", "camera",   "ranger",  "mount",        "tcp",    "pty",    "backend",
    "depth", "accuracy", "echo",    "interference", "motion", "timing", "power_up",
    "clock", "link",     "profile", "sees_body",    "noise",  "bias",   "replay"};
constexpr std::array<std::string_view, 3> depth_keys{"between_pixels", "oversample",
                                                     "widest_pass_deg"};
constexpr std::array<std::string_view, 3> clock_keys{"ppm", "start_ms", "phase_ms"};
constexpr std::array<std::string_view, 7> link_keys{
    "latency_ms", "jitter_ms", "baud", "split_bytes", "coalesce_ms", "on_close", "dead_after_s"};

bool is_none(const sim::YamlField* listener) {
    return !listener || (listener->value.IsScalar() && listener->value.Scalar() == "none");
}

std::string listed(const std::vector<int>& numbers) {
    std::string text;
    for (const int number : numbers)
        text += (text.empty() ? "" : ", ") + std::to_string(number);
    return text;
}

/// Nothing where the model is unknown, which has been told then.
std::optional<Model> read_model(const sim::YamlSection& section, const SensorContext& context) {
    std::optional<Model> model;
    section.read("model", model,
                 [&](const std::string& text) { return context.models.find(text); });
    if (const sim::YamlField* profile = section.find("profile")) {
        override_model(profile_section(*profile, {}, context.faults), *profile, model,
                       context.faults);
    }
    if (const sim::YamlField* bias = section.find("bias"); bias && model)
        model->own_bias = read_bias_choice(*bias, model->optics, context.faults);
    return model;
}

sim::DepthOptions read_depth(const sim::YamlField& field, const std::string& backend,
                             sim::YamlFaults& faults) {
    const sim::YamlSection section{field, depth_keys, faults, "depth: {oversample: 2}"};
    sim::DepthOptions depth;
    section.read("between_pixels", depth.between_pixels, parse_between_pixels);
    section.read("oversample", depth.oversample, parse_oversample);
    section.read("widest_pass_deg", depth.widest_pass_rad, parse_pass);
    if (const sim::BackendRow* named = sim::find_backend(backend); named && !named->draws) {
        faults.add(field, "is of a depth buffer, which backend " + backend +
                              " has not; use backend " + std::string(sim::drawing_backend().name) +
                              " or auto, or leave it out");
    }
    return depth;
}

DeviceClockConfig read_clock(const sim::YamlSection& parent, sim::YamlFaults& faults) {
    DeviceClockConfig clock;
    if (const sim::YamlField* field = parent.find("clock")) {
        const sim::YamlSection section{*field, clock_keys, faults, "clock: {ppm: 20}"};
        section.read("ppm", clock.ppm, parse_ppm);
        section.read("start_ms", clock.start_ms, parse_device_time);
        section.read("phase_ms", clock.phase, parse_phase);
    }
    return clock;
}

sim::Expected<> check_baud(int baud, const protocol::DeviceProfile& profile) {
    const std::vector<int>& rates = profile.bit_rates;
    if (rates.empty()) return sim::refuse(profile.name + " has no serial line; leave it out");
    if (std::ranges::find(rates, baud) == rates.end())
        return sim::refuse(profile.name + " has no such rate; use one of " + listed(rates));
    return {};
}

LinkConfig read_link(const sim::YamlField& field, const sim::YamlSection& sensor,
                     const std::optional<Model>& model, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, link_keys, faults, "link: {latency_ms: 2}"};
    LinkConfig link;
    section.read("latency_ms", link.latency, parse_link_delay);
    section.read("jitter_ms", link.jitter, parse_link_delay);
    section.read("baud", link.baud, parse_baud);
    section.read("split_bytes", link.split_bytes, parse_split);
    section.read("coalesce_ms", link.coalesce, parse_link_delay);
    section.read("on_close", link.stop_on_close, parse_on_close);
    section.read("dead_after_s", link.dead_after, parse_dead_after);
    if (link.jitter > link.latency) {
        faults.add(*section.find("jitter_ms"),
                   "must not exceed latency_ms: nothing arrives before it is sent");
    }
    for (const std::string_view key : {"baud", "on_close"}) {
        if (is_none(sensor.find("pty")) && section.find(key)) {
            faults.add(*section.find(key), "is of a tty; give pty, or leave it out");
        }
    }
    if (is_none(sensor.find("tcp")) && section.find("dead_after_s")) {
        faults.add(*section.find("dead_after_s"), "is of TCP; give tcp, or leave it out");
    }
    if (link.baud && model)
        faults.require(*section.find("baud"), check_baud(*link.baud, model->profile));
    return link;
}

void check_reach(const sim::YamlField& field, const sim::YamlSection& section,
                 sim::YamlFaults& faults) {
    if (is_none(section.find("tcp")) && is_none(section.find("pty"))) {
        faults.add(field, "no driver could reach it: give tcp or pty, such as `pty: auto`");
    }
}

/// Reads the keys that only scanners have.
void read_scanner(const sim::YamlField& field, const sim::YamlSection& section,
                  SensorConfig& sensor, SensorContext& context) {
    sim::YamlFaults& faults = context.faults;
    if (const sim::YamlField* replay = section.find("replay")) {
        sensor.replay = read_replay(*replay, context.base, faults);
        sensor.replay->finds_model = !section.find("model");
        for (const std::string_view key : {"noise", "bias", "interference"}) {
            if (const sim::YamlField* errors = section.find(key))
                faults.warn(*errors,
                            "a recording has the errors of its own scanner; this adds none");
        }
    } else if (!section.find("model")) {
        faults.add(field, "needs a model, a camera or a ranger; `scipd --list-models` lists them");
    }
    const std::optional<Model> model = read_model(section, context);
    if (model) sensor.model = *model;
    section.read("tcp", sensor.tcp, parse_listener);
    section.read("pty", sensor.pty,
                 [&](const std::string& text) { return parse_pty(text, context.base); });
    section.read("echo", sensor.echo, parse_echo_choice);
    section.read("interference", sensor.interference, parse_switch);
    section.read("noise", sensor.noise, parse_noise_factor);
    section.read("timing", sensor.timing, parse_timing);
    section.read("power_up", sensor.power_up, parse_power_up);
    if (const sim::YamlField* power_up = section.find("power_up"); power_up && model)
        faults.require(*power_up, check_power_up(sensor.power_up, model->profile));
    sensor.clock = read_clock(section, faults);
    if (const sim::YamlField* link = section.find("link")) {
        sensor.link = read_link(*link, section, model, faults);
    }
    context.claims.claim(section.find("tcp"), Transport::tcp, sensor.tcp);
    if (sensor.pty) {
        const bool is_auto = sensor.pty->link.empty();
        context.claims.claim_file(
            section.find("pty"),
            is_auto ? run_directory() / tty_name(context.robot, sensor.name) : sensor.pty->link);
    }
    check_reach(field, section, faults);
}

/// True: it is a camera or a ranger.
bool read_staring(const sim::YamlSection& section, SensorConfig& sensor, sim::YamlFaults& faults) {
    const sim::YamlField* const camera = section.find("camera");
    const sim::YamlField* const ranger = section.find("ranger");
    if (!camera && !ranger) return false;
    if (camera && ranger) faults.add(*ranger, "there is a camera already; give one of the two");
    if (const sim::YamlField* model = section.find("model")) {
        faults.add(*model,
                   "is of a scanner; give model, camera or ranger, and leave the others out");
    }
    if (ranger) sensor.staring = read_ranger(*ranger, faults);
    if (camera) sensor.staring = read_camera(*camera, faults);
    refuse_wire(section, faults);
    return true;
}

constexpr std::array<std::string_view, 7> replay_keys{"file",   "stream", "loop",    "speed",
                                                      "from_s", "begins", "begins_s"};

using Stamp = std::variant<std::chrono::nanoseconds, AsRecorded>;

sim::Expected<ReplayStart> parse_begins(std::string_view text) {
    if (text == "client") return ReplayStart::client;
    if (text == "start") return ReplayStart::start;
    return sim::refuse(
        "must be client (with the first program that takes scans) or start (with scipd), not " +
        sim::quote(text));
}

sim::Expected<std::optional<Stamp>> parse_begins_s(std::string_view text) {
    if (text == "recorded") return Stamp(AsRecorded{});
    const auto stamp = sim::parse_stamp(text);
    if (stamp) return Stamp(*stamp);
    return sim::refuse("must be a stamp in seconds, within 9e9, or recorded, not " +
                       sim::quote(text));
}

/// A path, or a list of those that are one recording.
void read_files(const sim::YamlField& field, const std::filesystem::path& base,
                sim::YamlFaults& faults, std::vector<std::filesystem::path>& files) {
    const auto read = [&](const YAML::Node& node) {
        const auto file = sim::text_of(node).and_then(
            [&](const std::string& text) { return parse_recording(text, base); });
        if (file) files.push_back(*file);
        if (!file) faults.add(field, file.error().why);
    };
    if (!field.value.IsSequence()) return read(field.value);
    if (field.value.size() == 0) faults.add(field, "needs a file, which is a recording");
    for (const YAML::Node& node : field.value)
        read(node);
}

}  // namespace

sim::Expected<> check_power_up(PowerUp power_up, const protocol::DeviceProfile& profile) {
    if (power_up == PowerUp::scip1 && !profile.speaks_scip1())
        return sim::refuse(profile.name + " never spoke SCIP 1.1; use scip2.0 or boot");
    return {};
}

SensorConfig read_sensor(const sim::YamlField& field, SensorContext& context) {
    sim::YamlFaults& faults = context.faults;
    const sim::YamlSection section{field, sensor_keys, faults};
    SensorConfig sensor;
    faults.take(field, parse_name(field.key), sensor.name);
    read_mount(section, sensor, faults, context.places);
    section.read("backend", sensor.backend, parse_backend);
    if (const sim::YamlField* depth = section.find("depth")) {
        sensor.depth = read_depth(*depth, sensor.backend, faults);
    }
    section.read("accuracy", sensor.accuracy, parse_accuracy);
    if (read_staring(section, sensor, faults)) {
        sensor.motion = 1;  // a picture is of one instant
        if (const sim::YamlField* field = section.find("accuracy");
            field && sensor.accuracy == sim::Accuracy::material)
            faults.add(*field, "material is for scanners; use sensor or ideal");
    } else {
        read_scanner(field, section, sensor, context);
    }
    section.read("motion", sensor.motion, parse_motion);
    section.read("sees_body", sensor.sees_body, parse_switch);
    return sensor;
}

sim::Expected<std::filesystem::path> parse_recording(std::string_view text,
                                                     const std::filesystem::path& base) {
    if (sim::extension_of(text) == ".tum")
        return sim::refuse(sim::quote(text) +
                           " is a trajectory, not a recording; a robot follows it by its poses "
                           "(--poses)");
    return parse_scene(text, base);  // or a folder, as a bag of rosbag2 is
}

sim::Expected<ReplayLoop> parse_loop(std::string_view text) {
    if (text == "on") return ReplayLoop::on;
    if (text == "true" || text == "yes") return ReplayLoop::again;
    if (text == "false" || text == "no") return ReplayLoop::none;
    return sim::refuse(
        "must be true (each round has the recorded stamps), on (stamps go on) or "
        "false, not " +
        sim::quote(text));
}

ReplayConfig read_replay(const sim::YamlField& field, const std::filesystem::path& base,
                         sim::YamlFaults& faults) {
    ReplayConfig replay;
    if (!field.value.IsMap()) {
        read_files(field, base, faults, replay.files);
        return replay;
    }
    const sim::YamlSection section{field, replay_keys, faults};
    const sim::YamlField* const file = section.find("file");
    if (file == nullptr) faults.add(field, "needs a file, which is a recording");
    if (file != nullptr) read_files(*file, base, faults, replay.files);
    section.read("stream", replay.stream);
    section.read("loop", replay.loop, parse_loop);
    section.read("speed", replay.speed, parse_speed);
    section.read("from_s", replay.from, parse_span);
    section.read("begins", replay.begins, parse_begins);
    section.read("begins_s", replay.begins_s, parse_begins_s);
    for (const char* const key : {"from_s", "begins"}) {
        const sim::YamlField* const stamp = section.find("begins_s");
        if (stamp != nullptr && section.find(key))
            faults.add(*stamp, "give begins_s or " + std::string(key) + ", not both");
    }
    return replay;
}

}  // namespace scipd::daemon
