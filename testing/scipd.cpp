// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/scipd.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "testing/scipd_inside.h"
#include "testing/sensor_view.h"

namespace scipd::testing {
namespace {

std::vector<std::string> scanners_of(const Running& running) {
    std::vector<std::string> scanners;
    for (const Json& sensor : running.ready().at("sensors")) {
        if (!sensor.at("tcp").is_null() || !sensor.at("pty").is_null())
            scanners.push_back(sensor.at("name"));
    }
    return scanners;
}

/// Where the only scanner listens, or this one. Throws std::invalid_argument.
std::string place_of(const Running& running, const std::string& sensor, const char* kind) {
    const Json& told = running.sensor(sensor);
    const Json& place = told.at(kind);
    if (place.is_null())
        throw std::invalid_argument(told.at("name").get<std::string>() + " has no " + kind);
    return place;
}

/// `after` and `seconds` in the words of the control API.
void spell_out(Json& members, const char* shorthand, const char* key) {
    const auto found = members.find(shorthand);
    if (found == members.end()) return;
    if (members.contains(key))
        throw std::invalid_argument(std::string("a fault has either ") + shorthand + " or " + key);
    const Json seconds = *found;
    members.erase(found);
    members[key] = {{"s", seconds}};
}

}  // namespace

ScipdInside::ScipdInside(const Options& options)
    : running(options),
      wire(running.control(), scanners_of(running)),
      clock(running, options, [this] {
          wire.catch_up();
          if (last) last->catch_up();
          for (const auto& recorder : recorders)
              recorder->catch_up();
      }) {}

Scipd::Scipd(const Options& options) : inside_(std::make_unique<ScipdInside>(options)) {}

Scipd::~Scipd() {
    try {
        close();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
}

std::string Scipd::host(const std::string& sensor) const {
    const std::string address = place_of(inside_->running, sensor, "tcp");
    return address.substr(0, address.rfind(':'));
}

std::uint16_t Scipd::port(const std::string& sensor) const {
    const std::string address = place_of(inside_->running, sensor, "tcp");
    return static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
}

std::filesystem::path Scipd::tty(const std::string& sensor) const {
    return place_of(inside_->running, sensor, "pty");
}

std::filesystem::path Scipd::control() const {
    return inside_->running.control();
}

std::string Scipd::http() const {
    const Json& address = inside_->running.ready().at("http");
    return address.is_null() ? "" : "http://" + address.get<std::string>() + "/";
}

int Scipd::pid() const {
    return inside_->running.pid();
}

std::vector<std::string> Scipd::sensors() const {
    std::vector<std::string> names;
    for (const Json& sensor : inside_->running.ready().at("sensors"))
        names.push_back(sensor.at("name"));
    return names;
}

Robot Scipd::robot(const std::string& name) {
    const auto robots = inside_->running.robots();
    if (name.empty() && robots.size() == 1) return {*inside_, robots.front()};
    if (std::ranges::find(robots, name) != robots.end()) return {*inside_, name};
    std::string there;
    for (const std::string& robot : robots)
        there += " " + robot;
    throw std::invalid_argument("there is no robot '" + name + "'; there are:" + there);
}

Fault Scipd::fault(const std::string& kind, Json members) {
    const std::string sensor = members.value("sensor", "");
    members.erase("sensor");
    spell_out(members, "after", "at");
    spell_out(members, "seconds", "for");
    members["kind"] = kind;
    const std::string name = inside_->running.sensor(sensor).at("name");
    const std::string path = sensor_path(name) + "/faults";
    const int id = inside_->running.ask("POST", path, members).at("id");
    return {*inside_, path, id};
}

Scan Scipd::scan(const std::string& sensor, Patience timeout) {
    return SensorView(inside_->running, inside_->clock, sensor).next_scan(timeout);
}

Truth Scipd::truth(const std::string& sensor, Patience timeout) {
    return SensorView(inside_->running, inside_->clock, sensor).next_truth(timeout);
}

Truth Scipd::truth(const Scan& of) {
    return SensorView(inside_->running, inside_->clock, of.sensor).truth_of(of);
}

Json Scipd::ask(const std::string& method, const std::string& target, const Json& body) {
    return inside_->running.ask(method, target, body);
}

std::string Scipd::log() const {
    return inside_->running.log();
}

Recording Scipd::record(const std::filesystem::path& file, const std::string& sensor) {
    const std::string name =
        sensor.empty() ? "" : inside_->running.sensor(sensor).at("name").get<std::string>();
    auto recorder = std::make_shared<ScanRecorder>(inside_->running.control(), file, name);
    inside_->recorders.push_back(recorder);
    return Recording(std::move(recorder));
}

void Scipd::keep_last(std::chrono::duration<double> seconds) {
    inside_->last = std::make_unique<LastScans>(inside_->running.control(), seconds);
}

void Scipd::save(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "scipd.log") << log();
    std::ofstream(folder / "wire.txt") << Wire(*inside_).text();
    if (inside_->last) inside_->last->save(folder / "last_scans.mcap");
}

std::optional<int> Scipd::exit_code() {
    return inside_->running.exit_code();
}

void Scipd::close() {
    for (const auto& recorder : inside_->recorders)
        recorder->stop();
    inside_->running.close();
}

}  // namespace scipd::testing
