// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scipd of our own with so many scanners, from its start to its end. One thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

#include "sim/world/pose.h"
#include "tools/child_program.h"
#include "tools/control_client.h"
#include "tools/scipbench/capacity_site.h"

namespace scipd::tools {

class CapacityDaemon {
  public:
    /// Returns when it is ready. Throws std::runtime_error with what it said, if it is not.
    CapacityDaemon(const CapacitySetup& setup, const std::vector<sim::Pose>& places);

    [[nodiscard]] pid_t pid() const { return program_.pid(); }
    /// From exec to the line that says it is ready.
    [[nodiscard]] std::chrono::duration<double> start() const { return start_; }
    /// Where its scanners listen, as `scipbench load` takes them.
    [[nodiscard]] const std::vector<std::string>& targets() const { return targets_; }
    [[nodiscard]] ControlClient& control() { return control_; }
    [[nodiscard]] std::uint16_t poses_port() const { return site_.poses_port(); }
    /// For files of others that take part.
    [[nodiscard]] const std::filesystem::path& folder() const { return site_.folder(); }

  private:
    void wait_until_ready();

    CapacitySite site_;
    std::chrono::steady_clock::time_point begin_;
    ChildProgram program_;
    std::chrono::duration<double> start_{};
    std::vector<std::string> targets_;
    ControlClient control_;
};

/// `scipbench load` for these scanners.
[[nodiscard]] std::vector<std::string> load_command(const std::vector<std::string>& targets,
                                                    std::chrono::seconds duration);

}  // namespace scipd::tools
