// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One whole message of a scanner, taken apart but not yet understood. A value; no thread rule.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace scipd::protocol::client {

/// The first thing that is wrong with a message.
struct Damage {
    enum class Kind {
        no_status,      ///< the message ends after its echo
        bad_status,     ///< neither two characters with their sum nor the one of SCIP 1.1
        bad_sum,        ///< a line does not add up
        line_too_long,  ///< longer than Decoder::max_line; its end was thrown away
        too_long,       ///< longer than Decoder::max_message; its end was thrown away
    };
    Kind kind;
    std::size_t line;  ///< counted from 1, the echo

    bool operator==(const Damage&) const = default;
};

struct Message {
    std::string echo;                ///< the request as it was understood, without its line end
    std::string status;              ///< two characters, or one from a scanner in SCIP 1.1
    std::vector<std::string> lines;  ///< what follows; sums (and the semicolons of VV, PP and II)
                                     ///< are taken off
    std::optional<Damage> damage;    ///< nothing: every sum was right
};

}  // namespace scipd::protocol::client
