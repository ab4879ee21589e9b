// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/truth.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <variant>

#include "daemon/config/run_directory.h"
#include "tools/control_client.h"
#include "tools/target.h"
#include "tools/which_scipd.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

/// Whether a scanner that listens there is the one that the user calls so. A scanner that listens
/// on all addresses has one that nobody connects to, so that the port must do.
bool is_at(const Json& sensor, const Target& target) {
    if (const auto* const tty = std::get_if<TtyTarget>(&target)) {
        // std::filesystem::equivalent() is false for any two devices in libstdc++.
        std::error_code none;
        const auto device = std::filesystem::canonical(tty->path, none);
        return sensor.at("pty").is_string() && !device.empty() &&
               device == std::filesystem::canonical(sensor["pty"].get<std::string>(), none);
    }
    return sensor.at("tcp").is_string() &&
           sensor["tcp"].get<std::string>().ends_with(":" + std::get<TcpTarget>(target).port);
}

std::string name_of(ControlClient& client, const TruthOptions& options, const std::string& target) {
    if (!options.sensor.empty()) return options.sensor;
    const Target wanted = parse_target(target);
    for (const Json& sensor : client.get("/sensors")) {
        // Cameras and rangers have no links.
        if (sensor.contains("tcp") && is_at(sensor, wanted)) return sensor.at("name");
    }
    throw std::runtime_error("the scipd at " + options.control + " has no scanner at " + target +
                             ": name the scanner with --truth ROBOT/SENSOR, or its scipd's socket "
                             "with --control");
}

/// That of the sensor itself.
std::string path_of(const std::string& sensor) {
    const auto slash = sensor.find('/');
    if (slash == std::string::npos) {
        throw std::runtime_error("\"" + sensor +
                                 "\" is no sensor: write ROBOT/SENSOR, as `scipctl sensors` lists "
                                 "them");
    }
    return "/sensors/" + path_segment(sensor.substr(0, slash)) + "/" +
           path_segment(sensor.substr(slash + 1));
}

/// Nothing if the scipd does not keep that scan.
std::optional<Json> find_truth(ControlClient& client, const std::string& path) {
    try {
        return client.get(path);
    } catch (const ControlError& error) {
        if (error.status() != 404) throw;
        return std::nullopt;
    }
}

std::string earlier(const std::string& path, const Json& truth) {
    return path + "?scan=" + std::to_string(truth.at("scan").get<std::int64_t>() - 1);
}

/// The scan may no longer be the latest one: others may have asked for more.
Json find_stamp(ControlClient& client, const std::string& sensor, std::uint32_t stamp_ms) {
    const std::string path = path_of(sensor) + "/truth";
    std::optional<Json> truth = client.get(path);
    while (truth && truth->at("stamp_ms") != stamp_ms)
        truth = find_truth(client, earlier(path, *truth));
    if (truth) return *truth;
    throw std::runtime_error(sensor + " sent no scan of the stamp " + std::to_string(stamp_ms) +
                             " ms of late: is it another scanner?");
}

std::string text(const Json& value) {
    return value.is_string() ? value.get<std::string>() : std::string();
}

Truth read(const Json& document) {
    Truth truth;
    for (std::size_t i = 0; i < document.at("steps").size(); ++i) {
        Truth::Step step{.material = text(document.at("material").at(i))};
        const Json& true_m = document.at("true_m").at(i);
        if (true_m.is_number()) step.true_m = true_m.get<double>();
        if (document.contains("echoes")) {
            for (const Json& echo : document["echoes"].at(i))
                step.echoes.push_back({echo.at("range_m"), text(echo.at("material"))});
        }
        truth.steps.push_back(std::move(step));
    }
    if (!truth.steps.empty()) truth.first_step = document["steps"].front();
    return truth;
}

const Truth::Echo* nearest(const std::vector<Truth::Echo>& echoes, double range_m) {
    const auto found = std::ranges::min_element(
        echoes, {}, [&](const Truth::Echo& echo) { return std::abs(echo.range_m - range_m); });
    return found == echoes.end() ? nullptr : &*found;
}

}  // namespace

void TruthOptions::add_to(CLI::App& command) {
    control = daemon::usual_control_socket();
    command.add_option("--truth", sensor,
                       "the scanner's name in its scipd, as ROBOT/SENSOR; default: by its address");
    named_ = command.add_option("--control", control, "control socket of that scipd")
                 ->capture_default_str();
}

void TruthOptions::find_scipd() {
    if (named_->empty()) control = socket_of_the_scipd_meant(control);
}

void announce_question(const TruthOptions& options, const std::string& target) {
    ControlClient client(options.control);
    (void)find_truth(client, path_of(name_of(client, options, target)) + "/truth");
}

Truth ask_truth(const TruthOptions& options, const std::string& target, std::uint32_t stamp_ms) {
    ControlClient client(options.control);
    const std::string sensor = name_of(client, options, target);
    Truth truth = read(find_stamp(client, sensor, stamp_ms));
    const Json known = client.get(path_of(sensor));
    // An older scipd does not tell it.
    if (known.contains("seed")) truth.seed = text(known["seed"]);
    const Json scene = client.get("/scene");
    for (const Json& name : scene.at("materials"))
        truth.materials.push_back(text(name));
    return truth;
}

void add_truth(TopView& view, const Truth& truth) {
    const auto tell = [&](ViewPoint& point) {
        const auto index = static_cast<std::size_t>(point.step - truth.first_step);
        if (point.step < truth.first_step || index >= truth.steps.size()) return;
        const Truth::Step& step = truth.steps[index];
        const Truth::Echo* const echo = nearest(step.echoes, point.range_m);
        point.material = echo != nullptr ? echo->material : step.material;
        // A wall seen rightly through glass is right, although the beam met the glass first.
        const std::optional<double> true_m = echo != nullptr ? echo->range_m : step.true_m;
        if (true_m) point.error_m = point.range_m - *true_m;
    };
    std::ranges::for_each(view.points, tell);
    std::ranges::for_each(view.further, tell);
    view.materials = truth.materials;
}

}  // namespace scipd::tools
