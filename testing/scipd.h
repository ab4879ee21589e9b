// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scipd of one's own, for a test:
//
//   Scipd scipd({.world = "room.sdf", .accuracy = "ideal"});
//   scipd.robot().set_pose({1, 0.5, 1.57});
//   EXPECT_EQ(scipd.scan().at(0), 1.5);
//
// It starts the daemon on free ports in a folder of its own, and ends it; the daemon also ends if
// the test is killed. It is no driver: scan() looks at what a driver would get. scipd_test.h has a
// fixture for GoogleTest. Any number of them, on any threads; one Scipd is of one thread at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "testing/scan_recording.h"
#include "testing/scipd_options.h"
#include "testing/scipd_parts.h"
#include "testing/scipd_values.h"

namespace scipd::testing {

class Scipd {
  public:
    using Patience = std::chrono::milliseconds;

    /// Returns when scipd is ready. Throws ScipdNotFound, ScipdNotReady, and std::invalid_argument
    /// where the options contradict each other.
    explicit Scipd(const Options& options = {});
    Scipd(const Scipd&) = delete;
    Scipd& operator=(const Scipd&) = delete;
    /// As close(), but says on standard error what that would throw.
    ~Scipd();

    // Where it listens. A sensor is ROBOT/SENSOR, or SENSOR where that says enough; without a name
    // it is the first scanner.
    [[nodiscard]] std::string host(const std::string& sensor = {}) const;
    [[nodiscard]] std::uint16_t port(const std::string& sensor = {}) const;
    [[nodiscard]] std::filesystem::path tty(const std::string& sensor = {}) const;
    [[nodiscard]] std::filesystem::path control() const;
    [[nodiscard]] std::string http() const;  ///< the address of the live page; empty: none
    [[nodiscard]] int pid() const;
    [[nodiscard]] std::vector<std::string> sensors() const;

    // What it is steered by. Without a name the only robot, whatever it is called.
    [[nodiscard]] Robot robot(const std::string& name = {});
    [[nodiscard]] Scene scene() { return Scene(*inside_); }
    [[nodiscard]] Clock clock() { return Clock(*inside_); }
    [[nodiscard]] Wire wire() { return Wire(*inside_); }

    /// Has something go wrong. The members are those of docs/faults.md, and `sensor`, `after` (it
    /// begins so many seconds later) and `seconds` (it lasts so long):
    ///   fault("dirty", {{"steps", {400, 500}}, {"seconds", 2}})
    Fault fault(const std::string& kind, Json members = Json::object());

    /// The next whole turn, over the wire as a driver gets it. In lockstep time goes on until it is
    /// there. Where a driver has the TCP port, it comes by the tty. Throws NoScan.
    [[nodiscard]] Scan scan(const std::string& sensor = {},
                            Patience timeout = std::chrono::seconds(10));
    /// What is true of the next whole turn. No driver notices it. Throws NoScan.
    [[nodiscard]] Truth truth(const std::string& sensor = {},
                              Patience timeout = std::chrono::seconds(10));
    /// What was true of a scan that is less than a second old.
    [[nodiscard]] Truth truth(const Scan& of);

    /// Anything else of the control API: null if the answer is empty. Throws Refused.
    Json ask(const std::string& method, const std::string& target, const Json& body = nullptr);
    /// What scipd has told on standard error, also after close().
    [[nodiscard]] std::string log() const;

    /// Writes all scans from now on, of one scanner or of all, into FILE.mcap or FILE.jsonl. Scans
    /// are computed for it, and no driver notices it.
    [[nodiscard]] Recording record(const std::filesystem::path& file,
                                   const std::string& sensor = {});
    /// From now on save() has the scans of so many last seconds.
    void keep_last(std::chrono::duration<double> seconds);
    /// Writes scipd.log, wire.txt and last_scans.mcap there, also after close().
    void save(const std::filesystem::path& folder) const;

    /// Nothing: it runs. A negative code is that of the signal that ended it.
    [[nodiscard]] std::optional<int> exit_code();
    /// Ends it. Throws ScipdEnded if it had ended by itself, and nobody was told so far.
    void close();

  private:
    std::unique_ptr<ScipdInside> inside_;
};

}  // namespace scipd::testing
