// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The world of a measurement, as this process sees it, and how many scanners this process and those
// that it starts can have. One thread.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "sim/backends/range_backend.h"
#include "sim/world/pose.h"

namespace scipd::tools {

class CapacityWorld {
  public:
    /// Throws sim::LoadError. From now on this process, and those that it starts, may open as many
    /// files as the system lets them.
    explicit CapacityWorld(const std::filesystem::path& scene);

    [[nodiscard]] sim::RangeBackend& backend() { return *backend_; }
    /// Free places on the ground for so many robots. Each run gets the same ones.
    [[nodiscard]] std::vector<sim::Pose> places(int robots);
    /// As many scanners as there are descriptors for.
    [[nodiscard]] int most() const { return most_; }

  private:
    std::unique_ptr<sim::RangeBackend> backend_;
    int most_;
};

}  // namespace scipd::tools
