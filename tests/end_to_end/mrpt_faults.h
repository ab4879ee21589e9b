// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What tests of scenes/faults/ share: a scipd that runs one of these files, and what MRPT's driver
// tells meanwhile.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/end_to_end/mrpt_driver.h"
#include "tests/support/daemon_process.h"
#include "tests/support/temp_dir.h"

namespace scipd::tests {

/// What the driver has told while it was watched.
struct Seen {
    int scans = 0;
    int failures = 0;
    int off_time = 0;     ///< scans whose stamps are wrong by more than 10 s
    int in_a_row = 0;     ///< the last scans, with no failure among them
    bool silent = false;  ///< at some time no scan came for half a second
    std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();

    void add(const MrptDriver::Look& look);
};

/// Lets the driver work until `done(seen)`.
template <class Done>
Seen watch(MrptDriver& driver, Done done) {
    using namespace std::chrono_literals;
    // Nothing here takes as long, even on a busy machine.
    const auto until = std::chrono::steady_clock::now() + 40s;
    Seen seen;
    while (!done(seen)) {
        if (std::chrono::steady_clock::now() > until)
            throw std::runtime_error("the driver was watched in vain");
        const MrptDriver::Look look = driver.look();
        seen.add(look);
        // As a program does that waits for its scanner: this call has not waited.
        if (look.failed) std::this_thread::sleep_for(20ms);
    }
    return seen;
}

void expect_scans(MrptDriver& driver);
/// Lets it work for so long.
void expect_no_scan(MrptDriver& driver, std::chrono::seconds time);

class MrptFaultsTest : public testing::Test {
  protected:
    /// The demo.
    void start() { start({"--tcp", "127.0.0.1:0", "--pty", "auto"}); }
    void start(const std::vector<std::string>& arguments);
    /// The configuration, with its ports free ones.
    void start_configuration(const std::filesystem::path& file);

    /// A driver that gets scans. MRPT has little patience with a busy machine, so it may try again.
    [[nodiscard]] std::unique_ptr<MrptDriver> connect(Link link, std::size_t sensor = 0) const;

    /// Has the scenario run from now on.
    void run(const std::string& file);
    [[nodiscard]] bool over() const;

    /// Lets the driver work until the scenario is over.
    Seen watch_until_over(MrptDriver& driver);

    TempDir directory_;
    std::optional<DaemonProcess> daemon_;
};

}  // namespace scipd::tests
