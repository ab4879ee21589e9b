// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity_site.h"

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iomanip>
#include <numbers>
#include <system_error>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>
#include <nlohmann/json.hpp>

#include "tools/output_file.h"

namespace scipd::tools {
namespace {

namespace asio = boost::asio;

/// One of 127.0.0.1 that nobody has now, for a scipd that is to be started.
std::uint16_t free_udp_port() {
    asio::io_context io;
    const asio::ip::udp::endpoint any{asio::ip::address_v4::loopback(), 0};
    return asio::ip::udp::socket(io, any).local_endpoint().port();
}

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Nothing is nearer to a place than 0.2 m (free_poses.h). A lap takes 1.88 s.
constexpr double lap_radius_m = 0.15;
constexpr int poses_per_lap = 94;

fs::path new_folder() {
    std::string pattern = fs::temp_directory_path() / "scipbench-XXXXXX";
    if (::mkdtemp(pattern.data()) == nullptr)
        throw std::system_error(errno, std::generic_category(), pattern);
    return pattern;
}

void write_lap(const sim::Pose& place, std::ostream& out) {
    out << std::fixed << std::setprecision(7);
    for (int i = 0; i < poses_per_lap; ++i) {
        const sim::Time time = i * pose_period;
        const sim::Pose pose = on_its_lap(place, time);
        const auto& [at, q] = pose;
        out << std::chrono::duration<double>(time).count() << " " << at.x << " " << at.y << " "
            << at.z << " " << q.x << " " << q.y << " " << q.z << " " << q.w << "\n";
    }
}

Json robot_at(const sim::Pose& place, const CapacitySetup& setup, const std::string& lap) {
    const sim::Pose start = on_its_lap(place, {});
    const double yaw_rad = 2.0 * std::atan2(start.rotation.z, start.rotation.w);
    const glm::dvec3& at = start.translation_m;
    Json robot{{"pose", {{"xyz", {at.x, at.y, at.z}}, {"rpy", {0, 0, yaw_rad}}}},
               {"sensors",
                {{"scanner",
                  {{"model", setup.model},
                   {"mount", {{"xyz", {0, 0, scanner_height_m}}}},
                   {"tcp", "127.0.0.1:0"},
                   {"accuracy", "sensor"}}}}}};
    if (setup.driving) robot["poses"] = {{"from", lap}, {"loop", true}};
    return robot;
}

/// Poses come by way of a robot. Nobody asks this one's sensor.
Json gate_of_movers(std::uint16_t port) {
    return {
        {"poses", "udp:127.0.0.1:" + std::to_string(port)},
        {"sensors",
         {{"none",
           {{"ranger", {{"cone_deg", 1}, {"beams", 1}, {"rate_hz", 1}, {"range_m", {0.1, 1}}}}}}}}};
}

}  // namespace

std::string describe(const CapacitySetup& setup) {
    const std::string threads =
        setup.threads ? std::to_string(*setup.threads) : std::string("scipd's own number of");
    return setup.scene.string() + ", " + setup.model + (setup.driving ? " driving" : " standing") +
           (setup.moving > 0 ? ", " + std::to_string(setup.moving) + " models move" : "") + ", " +
           threads + " threads, " + std::to_string(setup.duration.count()) + " s a run";
}

sim::Pose on_its_lap(const sim::Pose& place, sim::Time time) {
    const double laps = std::chrono::duration<double>(time) / (poses_per_lap * pose_period);
    const double angle_rad = std::remainder(2.0 * std::numbers::pi * laps, 2.0 * std::numbers::pi);
    return place * sim::pose_from_rpy({lap_radius_m * std::cos(angle_rad),
                                       lap_radius_m * std::sin(angle_rad), 0.0},
                                      {0.0, 0.0, angle_rad + std::numbers::pi / 2});
}

CapacitySite::CapacitySite() : folder_(new_folder()), poses_port_(free_udp_port()) {}

CapacitySite::~CapacitySite() {
    std::error_code error;
    fs::remove_all(folder_, error);
}

// JSON is YAML too.
void CapacitySite::write(const CapacitySetup& setup, const std::vector<sim::Pose>& places) const {
    Json configuration{{"scene", fs::absolute(setup.scene).string()},
                       {"control", control().string()}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::string name = "robot_" + std::to_string(i);
        const std::string lap = folder_ / (name + ".tum");
        configuration["robots"][name] = robot_at(places[i], setup, lap);
        if (setup.driving) write_to(lap, [&](std::ostream& out) { write_lap(places[i], out); });
    }
    if (setup.lockstep) configuration["clock"] = "poses";
    if (setup.moving > 0) configuration["robots"]["movers"] = gate_of_movers(poses_port_);
    write_to(this->configuration(), [&](std::ostream& out) { out << configuration.dump(1); });
}

}  // namespace scipd::tools
