// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where a scanner is: the TARGET that a user writes. A value; no thread rule.
#pragma once

#include <string>
#include <string_view>
#include <variant>

namespace scipd::tools {

struct TcpTarget {
    std::string host;
    std::string port;

    bool operator==(const TcpTarget&) const = default;
};

struct TtyTarget {
    std::string path;

    bool operator==(const TtyTarget&) const = default;
};

using Target = std::variant<TcpTarget, TtyTarget>;

/// Takes tcp://HOST, tcp://HOST:PORT, HOST:PORT, [IPV6]:PORT or the path of a tty. The default port
/// is 10940. Throws std::invalid_argument with a sentence.
[[nodiscard]] Target parse_target(std::string_view text);

}  // namespace scipd::tools
