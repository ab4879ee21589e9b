// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <stdexcept>
#include <string>

namespace scipd::protocol::client {

/// Why a conversation cannot go on; what() is a sentence for the user.
class Error : public std::runtime_error {
  public:
    enum class Kind {
        silent,   ///< nothing came in time
        foreign,  ///< what came is not SCIP
        damaged,  ///< a reply has a wrong sum or lacks something
        refused,  ///< the scanner said no
        closed,   ///< the other end is gone, or cannot be reached
    };

    Error(Kind kind, const std::string& sentence) : std::runtime_error(sentence), kind_(kind) {}

    [[nodiscard]] Kind kind() const { return kind_; }

  private:
    Kind kind_;
};

}  // namespace scipd::protocol::client
