// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a session asks its shell to do, in order.
#pragma once

#include <string>
#include <variant>

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

/// The device boots. The connection ends; a tty, which cannot end, loses all that is under way.
struct DropLink {
    bool operator==(const DropLink&) const = default;
};

/// The serial line changes its rate as soon as everything earlier has been sent. Every session is
/// told once, whichever of them was asked for the change. The first rate is the model's.
struct SetBitRate {
    int bits_per_second = 0;

    bool operator==(const SetBitRate&) const = default;
};

using Action = std::variant<Send, DropLink, SetBitRate>;

}  // namespace scipd::protocol
