// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/config_error.h"

#include <utility>

namespace scipd::daemon {

ConfigError::ConfigError(std::vector<std::string> faults)
    : std::runtime_error([&] {
          std::string text;
          for (const auto& fault : faults)
              text += (text.empty() ? "" : "\n") + fault;
          return text;
      }()),
      faults_(std::move(faults)) {}

}  // namespace scipd::daemon
