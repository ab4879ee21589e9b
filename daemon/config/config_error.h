// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace scipd::daemon {

/// Everything that is wrong with a configuration, at once: one fault a line, each with FILE:LINE:
/// KEY: what to do.
class ConfigError : public std::runtime_error {
  public:
    explicit ConfigError(std::vector<std::string> faults);
    [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }

  private:
    std::vector<std::string> faults_;
};

}  // namespace scipd::daemon
