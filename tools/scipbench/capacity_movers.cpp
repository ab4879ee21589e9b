// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/capacity_movers.h"

#include <chrono>
#include <cstddef>
#include <stop_token>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>
#include <nlohmann/json.hpp>

#include "tools/scipbench/capacity_site.h"

namespace scipd::tools {
namespace {

namespace asio = boost::asio;
using asio::ip::udp;
using Clock = std::chrono::steady_clock;

constexpr const char* box =
    "<model name='mover'><link name='l'><visual name='v'><pose>0 0 0.4 0 0 0</pose><geometry><box>"
    "<size>0.2 0.15 0.8</size></box></geometry></visual></link></model>";

std::string name_of(std::size_t mover) {
    return "mover_" + std::to_string(mover);
}

std::string pose_line(std::size_t mover, const sim::Pose& pose) {
    const auto& [at, q] = pose;
    return nlohmann::json{
               {"model", name_of(mover)}, {"xyz", {at.x, at.y, at.z}}, {"q", {q.x, q.y, q.z, q.w}}}
               .dump() +
           "\n";
}

void send_all(udp::socket& socket, const std::vector<sim::Pose>& places, sim::Time time) {
    constexpr std::size_t most_bytes = 8000;
    std::string lines;
    const auto leave = [&] {
        boost::system::error_code lost;  // as UDP may lose them: the next ones come soon
        socket.send(asio::buffer(lines), 0, lost);
        lines.clear();
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
        lines += pose_line(i, on_its_lap(places[i], time));
        if (lines.size() > most_bytes) leave();
    }
    if (!lines.empty()) leave();
}

void send_until(const std::stop_token& end, std::uint16_t port,
                const std::vector<sim::Pose>& places) {
    asio::io_context io;
    udp::socket socket(io, udp::v4());
    socket.connect({asio::ip::address_v4::loopback(), port});
    const Clock::time_point begin = Clock::now();
    for (sim::Time time{}; !end.stop_requested(); time += pose_period) {
        send_all(socket, places, time);
        std::this_thread::sleep_until(begin + time + pose_period);
    }
}

}  // namespace

CapacityMovers::CapacityMovers(ControlClient& scipd, std::uint16_t port,
                               const std::vector<sim::Pose>& places) {
    for (std::size_t i = 0; i < places.size(); ++i)
        scipd.post("/scene/models", {{"name", name_of(i)}, {"sdf", box}});
    sender_ =
        std::jthread([port, places](const std::stop_token& end) { send_until(end, port, places); });
}

}  // namespace scipd::tools
