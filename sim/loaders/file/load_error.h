// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace scipd::sim {

/// Reports everything that is wrong with a file at once. what() has one fault per line, each with
/// the file, the line if known, and what to do.
class LoadError : public std::runtime_error {
  public:
    explicit LoadError(std::vector<std::string> faults);
    [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }

  private:
    std::vector<std::string> faults_;
};

}  // namespace scipd::sim
