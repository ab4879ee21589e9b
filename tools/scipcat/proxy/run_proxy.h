// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The proxy from its first listening to its end: a port for drivers on one side, the scanner on the
// other, and between them faults, a twin, and whoever listens. One thread moves bytes, and a second
// one compares and listens.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/recording/values/recorded_scan.h"
#include "tools/scip_transport.h"
#include "tools/target.h"

namespace scipd::tools {

/// What a user has asked for. Of `listen` and `pty` one is set.
struct ProxyWanted {
    std::string scanner;  ///< as the user wrote it
    Target target;
    OpenOptions open;
    std::string listen;  ///< ADDR:PORT; port 0: a free one
    std::string pty;     ///< the name of a tty
    std::string twin;    ///< a scanner or a configuration of scipd; empty: none
    double tolerance_mm = 100.0;
    std::vector<std::string> faults;  ///< KIND[,MEMBER=VALUE...]
    bool json = false;
};

/// Gets what has gone to the scanner, or come from it, once it has been handed on, and when that
/// was. On a thread of its own. Null: nobody listens.
using ProxyEar = std::function<void(bool to_scanner, sim::HostTime time, std::string_view bytes)>;

/// Returns when SIGINT or SIGTERM comes. Throws WrongInput, before it listens, for what it cannot
/// use.
void run_proxy(const ProxyWanted& wanted, const ProxyEar& ear);

}  // namespace scipd::tools
