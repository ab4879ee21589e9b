// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a session asks its shell to do.
#pragma once

#include <string>

namespace scipd::protocol {

/// One whole message for the client, to be sent after all earlier ones.
struct Send {
    enum class Kind {
        reply,  ///< somebody waits for it: never lost
        scan,   ///< of a stream: may be dropped whole where the client reads too slowly
    };
    std::string bytes;
    Kind kind = Kind::reply;

    bool operator==(const Send&) const = default;
};

}  // namespace scipd::protocol
