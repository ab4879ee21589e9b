// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A crowd on one core. scipd runs in the rescue maze, pinned to one core. Models and robots drive
// in circles by pose lines over UDP, and for each robot a client takes every scan of its UST-10LX.
// Clients and sender have the other cores. The program reports what share of its core the daemon
// used, how many scans were lost, and, by the daemon's own count, how late scans left. No scan may
// be missing.
//
//   build/release/bin/crowd_soak [SECONDS] [--models N] [--scanners N] [--rate HZ] [--speed M/S]
//                                [--wait-ms MS] [--backend B]
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <sched.h>

#include "tests/end_to_end/in_square_room.h"
#include "tests/support/udp_sender.h"

namespace {

using namespace scipd::tests;
using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

struct Crowd {
    double seconds = 60.0;
    int models = 100;
    int scanners = 10;
    int rate_hz = 50;
    double speed_mps = 1.0;
    int wait_ms = 0;
    std::string backend = "auto";
};

/// The place of number `i` of `count` in a square grid over the maze, shifted by `aside` cells.
struct Place {
    double x_m;
    double y_m;
};
Place place_of(int i, int count, double aside) {
    constexpr double maze_m = 14.4;
    const int side = std::max(1, static_cast<int>(std::ceil(std::sqrt(count))));
    const double cell_m = maze_m / side;
    return {(i % side + 0.5 + aside) * cell_m, (i / side % side + 0.5 + aside) * cell_m};
}

/// Writes the rescue maze with this many boxes added.
void write_world(const TempDir& directory, int models) {
    const char* terrain = "rescue_maze_terrain.obj";
    std::filesystem::copy_file(scene(terrain), directory.path() / terrain);
    std::ifstream file(scene("rescue_maze.sdf"));
    std::string world{std::istreambuf_iterator<char>(file), {}};
    std::string boxes;
    for (int i = 0; i < models; ++i) {
        const Place at = place_of(i, models, 0.0);
        boxes += "<model name='box_" + std::to_string(i) + "'><pose>" + std::to_string(at.x_m) +
                 " " + std::to_string(at.y_m) +
                 " 0.25 0 0 0</pose><link name='body'><visual name='box'><geometry><box>"
                 "<size>0.4 0.4 0.5</size></box></geometry></visual></link></model>\n";
    }
    world.insert(world.rfind("</world>"), boxes);
    directory.write("crowd.sdf", world);
}

std::string write_configuration(const TempDir& directory, const Crowd& crowd, std::uint16_t port) {
    std::string text = "scene: crowd.sdf\nrobots:\n";
    for (int i = 0; i < crowd.scanners; ++i) {
        const Place at = place_of(i * crowd.models / crowd.scanners, crowd.models, 0.5);
        text += "  robot_" + std::to_string(i) + ":\n    pose: {xyz: [" + std::to_string(at.x_m) +
                ", " + std::to_string(at.y_m) + ", 0]}\n";
        const std::string from =
            i == 0 ? "udp:127.0.0.1:" + std::to_string(port) : "udp:127.0.0.1:0";
        text += "    poses: {from: '" + from + "', wait_ms: " + std::to_string(crowd.wait_ms) +
                "}\n    sensors:\n      scanner: {model: UST-10LX, mount: {xyz: [0, 0, 0.25]}, "
                "tcp: '127.0.0.1:0', backend: " +
                crowd.backend + "}\n";
    }
    return directory.write("crowd.yaml", text);
}

/// The pose line of something that drives in a circle around `middle` at this speed and looks
/// ahead.
std::string line_of(const std::string& who, double time_s, const Place& middle, double radius_m,
                    double speed_mps) {
    const double angle_rad = std::remainder(time_s * speed_mps / radius_m, 2.0 * M_PI);
    char line[256];
    std::snprintf(line, sizeof(line), R"({%s,"t":%.6f,"xyz":[%.6f,%.6f,%.3f],"rpy":[0,0,%.6f]})",
                  who.c_str(), time_s, middle.x_m + radius_m * std::cos(angle_rad),
                  middle.y_m + radius_m * std::sin(angle_rad),
                  who.starts_with("\"model") ? 0.25 : 0.0, angle_rad + M_PI / 2);
    return line;
}

/// Sends one datagram for each line until `over`. Returns how many it has sent.
long send_poses(const Crowd& crowd, const UdpSender& sender, const std::atomic<bool>& over) {
    long lines = 0;
    const Steady::time_point begin = Steady::now();
    for (long tick = 0; !over; ++tick) {
        const double time_s = static_cast<double>(tick) / crowd.rate_hz;
        std::this_thread::sleep_until(
            begin + std::chrono::duration_cast<Steady::duration>(Seconds(time_s)));
        for (int i = 0; i < crowd.scanners; ++i, ++lines) {
            sender.send(line_of("\"robot\":\"robot_" + std::to_string(i) + "\"", time_s,
                                place_of(i * crowd.models / crowd.scanners, crowd.models, 0.5),
                                0.15, std::min(crowd.speed_mps, 0.5)));
        }
        for (int i = 0; i < crowd.models; ++i, ++lines) {
            sender.send(line_of("\"model\":\"box_" + std::to_string(i) + "\"", time_s,
                                place_of(i, crowd.models, 0.0), 0.5, crowd.speed_mps));
        }
    }
    return lines;
}

/// Takes scans for `seconds`. Returns how many are missing between them.
long take_scans(ScannerWire& wire, double seconds, std::atomic<long>& taken) {
    constexpr std::uint32_t clock_mask = 0xffffff;  // 24 bits
    long missing = 0;
    std::uint32_t stamp_ms = wire.next_scan().stamp_ms;
    for (const auto end = Steady::now() + Seconds(seconds); Steady::now() < end; ++taken) {
        const std::uint32_t next_ms = wire.next_scan().stamp_ms;
        missing += turns_between(0, (next_ms - stamp_ms) & clock_mask) - 1;
        stamp_ms = next_ms;
    }
    return missing;
}

/// Pins this process, and those that it starts from now on, to these cores.
void pin_to(int first_core, int last_core) {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    for (int core = first_core; core <= last_core; ++core)
        CPU_SET(core, &cores);
    if (::sched_setaffinity(0, sizeof(cores), &cores) != 0)
        throw std::runtime_error("cannot choose cores");
}

double processor_seconds(pid_t process) {
    clockid_t clock{};
    timespec time{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0)
        throw std::runtime_error("scipd has ended");
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void print_status(const DaemonProcess& daemon, long lines) {
    const auto status = daemon.get("/status");
    double p50_ms = 0.0, p99_ms = 0.0, max_ms = 0.0;
    long lost = 0;
    for (const auto& sensor : status.at("sensors")) {
        const auto& late = sensor.at("lateness_ms");
        p50_ms = std::max(p50_ms, late.at("p50").get<double>());
        p99_ms = std::max(p99_ms, late.at("p99").get<double>());
        max_ms = std::max(max_ms, late.at("max").get<double>());
        lost += sensor.at("lost").get<long>();
    }
    std::printf("of the scanner that was worst: late by p50 %.2f ms, p99 %.2f ms, max %.2f ms\n",
                p50_ms, p99_ms, max_ms);
    std::printf(
        "by the daemon's own count: %ld scans lost; %ld of %ld poses accepted, %ld refused\n", lost,
        status.at("poses").at("accepted").get<long>(), lines,
        status.at("poses").at("refused").get<long>());
}

int soak(const Crowd& crowd) {
    const auto last_core = static_cast<int>(std::thread::hardware_concurrency()) - 1;
    const TempDir directory;
    const UdpSender sender;
    write_world(directory, crowd.models);
    const std::string configuration = write_configuration(directory, crowd, sender.port());
    pin_to(0, 0);
    const DaemonProcess daemon(directory, {"--config", configuration});
    if (daemon.ready_line().empty()) throw std::runtime_error(daemon.standard_error());
    pin_to(last_core > 0 ? 1 : 0, last_core);

    std::atomic<bool> over{false};
    std::atomic<long> taken{0}, missing{0}, lines{0};
    std::jthread poses([&] { lines = send_poses(crowd, sender, over); });
    std::vector<ScannerWire> wires;
    for (int i = 0; i < crowd.scanners; ++i) {
        wires.push_back(ScannerWire::tcp(daemon.port(static_cast<std::size_t>(i))));
        if (wires.back().ask(stream_of_all_beams) != "00") return 1;
    }
    const double used_s = processor_seconds(daemon.pid());
    const Steady::time_point begin = Steady::now();
    std::vector<std::jthread> clients;
    for (ScannerWire& wire : wires) {
        clients.emplace_back([&] {
            try {
                missing += take_scans(wire, crowd.seconds, taken);
            } catch (const std::exception& error) {
                std::printf("%s\n", error.what());
                ++missing;
            }
        });
    }
    clients.clear();
    const double share =
        (processor_seconds(daemon.pid()) - used_s) / Seconds(Steady::now() - begin).count();
    over = true;
    poses.join();
    std::printf("%d models at %.1f m/s and %d scanners, poses %d times a second, for %.0f s\n",
                crowd.models, crowd.speed_mps, crowd.scanners, crowd.rate_hz, crowd.seconds);
    std::printf("%.3f of the core; %ld scans, %ld missing\n", share, taken.load(), missing.load());
    print_status(daemon, lines);
    return missing == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    Crowd crowd;
    CLI::App app("Drives many models past many scanners of a scipd on one core.", "crowd_soak");
    app.add_option("SECONDS", crowd.seconds, "how long")
        ->check(CLI::Range(1.0, 24.0 * 3600.0))
        ->capture_default_str();
    app.add_option("--models", crowd.models)->check(CLI::Range(1, 10'000))->capture_default_str();
    app.add_option("--scanners", crowd.scanners)->check(CLI::Range(1, 500))->capture_default_str();
    app.add_option("--rate", crowd.rate_hz)->check(CLI::Range(1, 1000))->capture_default_str();
    app.add_option("--speed", crowd.speed_mps)->check(CLI::Range(0.0, 20.0))->capture_default_str();
    app.add_option("--wait-ms", crowd.wait_ms)->check(CLI::Range(0, 900))->capture_default_str();
    app.add_option("--backend", crowd.backend)->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        return soak(crowd);
    } catch (const std::exception& error) {
        std::printf("%s\n", error.what());
        return 1;
    }
}
