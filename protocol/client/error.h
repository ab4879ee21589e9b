// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <chrono>
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

/// A hint for the first request of a conversation.
inline constexpr const char* maybe_busy =
    "; a scanner serves one client at a time: is another program connected?";

/// Timeout error: "no answer to QT within 1 s".
[[nodiscard]] inline Error timed_out(const std::string& awaited, std::chrono::milliseconds within,
                                     const std::string& hint = {}) {
    const auto ms = within.count();
    const std::string time = ms % 1000 == 0 ? std::to_string(ms / 1000) + " s"  //
                                            : std::to_string(ms) + " ms";
    return {Error::Kind::silent, "no " + awaited + " within " + time + hint};
}

}  // namespace scipd::protocol::client
