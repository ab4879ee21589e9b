// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipd as a user runs it: a process of its own with its own run directory. Tests see it only
// through its output and where it listens. The process ends with this object, and also if the test
// is killed. One thread.
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

/// The path of a file in the project's scenes.
std::filesystem::path scene(std::string_view file);

/// Whether scipd has a depth backend here, that is, whether the self-test of `scipd --probe`
/// passes.
bool can_draw();

/// The names that `scipd --list-models` prints, with firmwares.
std::vector<std::string> all_models();

class DaemonProcess {
  public:
    /// How its standard descriptors differ from the usual ones.
    struct StandardDescriptors {
        std::vector<int> closed;   ///< numbers of those to close
        std::optional<int> error;  ///< takes the place of a file
    };

    /// Starts scipd with these arguments and with `directory` as the parent of its run directory.
    /// Waits until it is ready or has ended, but not if its output is closed. Throws
    /// std::runtime_error if neither happens.
    DaemonProcess(const TempDir& directory, std::vector<std::string> arguments,
                  const StandardDescriptors& descriptors = {});
    DaemonProcess(const DaemonProcess&) = delete;
    DaemonProcess& operator=(const DaemonProcess&) = delete;
    /// Kills it if it still runs.
    ~DaemonProcess();

    /// The first line on standard output; empty if it ended without one.
    [[nodiscard]] const std::string& ready_line() const { return ready_line_; }
    [[nodiscard]] pid_t pid() const { return pid_; }

    // From the ready line. Sensors are in the order of the configuration.
    [[nodiscard]] std::uint16_t port(std::size_t sensor = 0) const;
    [[nodiscard]] std::filesystem::path tty(std::size_t sensor = 0) const;
    [[nodiscard]] std::filesystem::path control() const;

    /// GET from the control API. Throws std::runtime_error if the answer is not 200.
    [[nodiscard]] nlohmann::json get(const std::string& path) const;
    /// That sensor's part of /status.
    [[nodiscard]] nlohmann::json sensor_status(std::size_t sensor = 0) const;

    /// Writes to its standard input.
    void say(std::string_view text) const;
    void signal(int number) const;
    /// Waits until it ends. Returns the exit code, or 128 + the signal that killed it. Throws
    /// std::runtime_error if it does not end.
    int wait();

    /// All that it wrote to standard output, available once it has ended.
    [[nodiscard]] const std::string& standard_output() const { return output_; }
    /// What it has written to standard error so far.
    [[nodiscard]] std::string standard_error() const;

  private:
    void start(const std::vector<std::string>& arguments, const StandardDescriptors& descriptors);
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
