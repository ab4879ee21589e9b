// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A client attaches, ends by Ctrl-C, and attaches again, three times. Each ends like a killed
// process, in mid-stream and without QT. Tests every model, over TCP and over the tty.
#include <array>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "protocol/client/driver.h"
#include "tests/end_to_end/mrpt_driver.h"
#include "tests/support/scanner_wire.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;

constexpr int scans_until_it_ends = 3;

struct Attached {
    std::string model;
    Link link;
};

std::vector<Attached> every_model_on_both() {
    std::vector<Attached> all;
    for (const std::string& model : all_models()) {
        all.push_back({model, Link::tcp});
        all.push_back({model, Link::tty});
    }
    return all;
}

std::string configuration(const std::vector<Attached>& scanners, const std::string& tcp_keys) {
    std::string text =
        "scene: " + scene("square_room.sdf").string() + "\nrobots:\n  robot:\n    sensors:\n";
    for (std::size_t i = 0; i < scanners.size(); ++i) {
        const auto& [model, link] = scanners[i];
        text += "      s" + std::to_string(i) + ": {model: " + model +
                ", mount: {xyz: [0, 0, 0.3]}, " +
                (link == Link::tcp ? "tcp: 127.0.0.1:0" + tcp_keys : "pty: auto") + "}\n";
    }
    return text;
}

/// Attaches, reads some scans of a stream and ends the process. Throws if it gives up.
using ClientProgram = std::function<void(const DaemonProcess&, std::size_t sensor, Link)>;

/// Never returns. Restarts a client that gives up, as its user would, for a while.
[[noreturn]] void run_and_die(const ClientProgram& client, const DaemonProcess& daemon,
                              std::size_t sensor, const Attached& scanner) {
    const auto until = Steady::now() + 10s;
    do {
        try {
            client(daemon, sensor, scanner.link);
        } catch (const std::exception& error) {
            std::cerr << scanner.model
                      << (scanner.link == Link::tcp ? " over TCP: " : " on a tty: ") << error.what()
                      << std::endl;
        }
    } while (Steady::now() < until);
    ::_exit(1);
}

/// Runs all clients at once, because they mostly wait.
void expect_all_attach(const ClientProgram& client, const DaemonProcess& daemon,
                       const std::vector<Attached>& scanners, std::size_t first, std::size_t end) {
    std::map<pid_t, std::string> running;
    for (std::size_t i = first; i < end; ++i) {
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) run_and_die(client, daemon, i, scanners[i]);
        running[child] = scanners[i].model + (scanners[i].link == Link::tcp ? ", TCP" : ", tty");
    }
    for (const auto& [child, name] : running) {
        int status = -1;
        EXPECT_EQ(::waitpid(child, &status, 0), child);
        EXPECT_EQ(status, 0) << name;
    }
}

void expect_attached_three_times(const ClientProgram& client, const std::string& tcp_keys = "") {
    const std::vector<Attached> scanners = every_model_on_both();
    ASSERT_GE(scanners.size(), 42U);
    const TempDir directory;
    const auto file = directory.write("rig.yaml", configuration(scanners, tcp_keys));
    const DaemonProcess daemon(directory, {"--config", file});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    constexpr std::size_t at_once = 14;
    for (std::size_t first = 0; first < scanners.size(); first += at_once) {
        const std::size_t end = std::min(first + at_once, scanners.size());
        for (int time = 0; time < 3; ++time)
            expect_all_attach(client, daemon, scanners, first, end);
    }
}

ScannerWire wire_to(const DaemonProcess& daemon, std::size_t sensor, Link link) {
    return link == Link::tcp ? ScannerWire::tcp(daemon.port(sensor))
                             : ScannerWire::tty(daemon.tty(sensor));
}

void wait_for_silence(ScannerWire& wire, std::chrono::milliseconds silence) {
    const auto until = Steady::now() + 2s;
    std::array<char, 4096> buffer;
    while (wire.read(buffer, silence) > 0) {
        if (Steady::now() > until) throw std::runtime_error("the scanner does not fall silent");
    }
}

/// Does what the maker's urg_library 1.2.7 does.
void waits_for_silence(const DaemonProcess& daemon, std::size_t sensor, Link link) {
    constexpr auto patience = 140ms;
    ScannerWire wire = wire_to(daemon, sensor, link);
    wire.write("\n");
    wait_for_silence(wire, patience);
    wire.write("QT\n");
    const auto reply = wire.next_message(patience);
    if (!reply || reply->echo != "QT" || reply->status != "00")
        throw std::runtime_error("QT is not answered");
    protocol::client::Driver driver(wire, {.reply = patience});
    const protocol::client::Parameters parameters = driver.parameters();
    driver.start({.first_step = parameters.amin, .last_step = parameters.amax});
    for (int i = 0; i < scans_until_it_ends; ++i)
        (void)driver.next_scan();
    ::_exit(0);
}

void uses_mrpt(const DaemonProcess& daemon, std::size_t sensor, Link link) {
    MrptDriver driver(daemon, link, sensor);
    for (int i = 0; i < scans_until_it_ends; ++i)
        (void)driver.next_scan();
    ::_exit(0);
}

TEST(AttachAgain, WorksForAClientThatWaitsForSilence) {
    expect_attached_three_times(waits_for_silence);
}

// Ideal timing: over TCP MRPT waits for 100 ms, which is as long as a URG-04LX takes.
TEST(AttachAgain, WorksForMrpt) {
    expect_attached_three_times(uses_mrpt, ", timing: ideal");
}

}  // namespace
}  // namespace scipd::tests
