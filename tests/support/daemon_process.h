// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipd as a user runs it: a process of its own, with a run directory of its own, talked to through
// what it says and where it listens. Ends with the object, and with the test should that be killed.
// One thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <sys/types.h>

#include "tests/support/temp_dir.h"

namespace scipd::tests {

/// Where the scenes of the sources are.
std::filesystem::path scene(std::string_view file);

/// Whether scipd has a depth backend here: `scipd --probe` says that the self-test has passed.
bool can_draw();

/// As `scipd --list-models` names them, with their firmwares.
std::vector<std::string> all_models();

class DaemonProcess {
  public:
    /// Starts scipd with these arguments and `directory` as the parent of its run directory; waits
    /// until it is ready or has ended. Throws std::runtime_error if neither comes about.
    DaemonProcess(const TempDir& directory, std::vector<std::string> arguments);
    DaemonProcess(const DaemonProcess&) = delete;
    DaemonProcess& operator=(const DaemonProcess&) = delete;
    /// Kills it if it still runs.
    ~DaemonProcess();

    /// The first line on standard output; empty where it ended without one.
    [[nodiscard]] const std::string& ready_line() const { return ready_line_; }
    [[nodiscard]] pid_t pid() const { return pid_; }

    // What the ready line says; sensors in the order of the configuration.
    [[nodiscard]] std::uint16_t port(std::size_t sensor = 0) const;
    [[nodiscard]] std::filesystem::path tty(std::size_t sensor = 0) const;
    [[nodiscard]] std::filesystem::path control() const;

    /// GET of the control API. Throws std::runtime_error where the answer is not 200.
    [[nodiscard]] nlohmann::json get(const std::string& path) const;
    /// That sensor's part of /status.
    [[nodiscard]] nlohmann::json sensor_status(std::size_t sensor = 0) const;

    /// To its standard input.
    void say(std::string_view text) const;
    void signal(int number) const;
    /// Waits for its end: the exit code, or 128 + the signal that killed it. Throws
    /// std::runtime_error if it does not end.
    int wait();

    /// All that it wrote to standard output, once it has ended.
    [[nodiscard]] const std::string& standard_output() const { return output_; }
    /// What it has written to standard error so far.
    [[nodiscard]] std::string standard_error() const;

  private:
    void start(const std::vector<std::string>& arguments);
    void read_ready_line();
    [[nodiscard]] bool read_output(std::chrono::milliseconds patience);
    [[nodiscard]] nlohmann::json sensor(std::size_t index) const;

    std::filesystem::path directory_;
    std::filesystem::path error_file_;
    pid_t pid_ = -1;
    int input_ = -1;
    int output_descriptor_ = -1;
    std::string output_;
    std::string ready_line_;
    std::optional<int> exit_code_;
};

}  // namespace scipd::tests
