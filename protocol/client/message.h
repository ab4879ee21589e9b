// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One whole message of a scanner, split into its parts but not interpreted. A value; no thread
// rule.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace scipd::protocol::client {

/// The first fault of a message.
struct Damage {
    enum class Kind {
        no_status,      ///< the message ends after its echo
        bad_status,     ///< neither two characters and a sum, nor one of SCIP 1.1
        bad_sum,        ///< the sum of a line is wrong
        line_too_long,  ///< longer than Decoder::max_line; its end was dropped
        too_long,       ///< longer than Decoder::max_message; its end was dropped
    };
    Kind kind;
    std::size_t line;  ///< counts from 1, which is the echo

    bool operator==(const Damage&) const = default;
};

struct Message {
    std::string echo;                ///< the request, as the scanner read it, without its line end
    std::string status;              ///< two characters, or one from a scanner in SCIP 1.1
    std::vector<std::string> lines;  ///< what follows; sums (and the semicolons of VV, PP and II)
                                     ///< are taken off
    std::optional<Damage> damage;    ///< nothing: every sum was right
};

}  // namespace scipd::protocol::client
