// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Faults as people write and read them. Values; no thread rule.
#pragma once

#include <string>
#include <vector>

#include "tools/control_client.h"

namespace scipd::tools {

/// A fault in the words of the command line.
struct FaultWords {
    std::string kind;
    std::vector<std::string> members;  ///< KEY=VALUE: a value is YAML, and dots nest
    std::string at;                    ///< KEY=VALUE; request=MD:2
    std::string how_long;
    std::string until;
    std::string every;
    std::string jitter;
    std::string seed;
};

/// The fault as the control API takes it. Throws WrongInput.
[[nodiscard]] ControlClient::Json fault_of(const FaultWords& words);

/// One line for people.
[[nodiscard]] std::string line_of(const ControlClient::Json& log_entry);

}  // namespace scipd::tools
