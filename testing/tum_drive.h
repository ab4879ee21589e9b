// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A drive: poses at times, read from a TUM file. A value; no thread rule.
#pragma once

#include <filesystem>
#include <vector>

#include "testing/scipd_values.h"

namespace scipd::testing {

class TumDrive {
  public:
    /// Throws ScipdError with the line that is wrong.
    explicit TumDrive(const std::filesystem::path& path);

    [[nodiscard]] double seconds() const { return knots_.back().time_s; }
    /// Evenly between the poses of the file; `time_s` counts from its first.
    [[nodiscard]] Json pose_at(double time_s) const;

  private:
    struct Knot {
        double time_s;
        Json pose;
    };
    std::vector<Knot> knots_;
};

}  // namespace scipd::testing
