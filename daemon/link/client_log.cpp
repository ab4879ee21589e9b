// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/client_log.h"

#include <chrono>
#include <utility>

#include <spdlog/spdlog.h>

namespace scipd::daemon {
namespace {

const char* words(Leaving why) {
    switch (why) {
        case Leaving::closed:
            return "it has closed its side";
        case Leaving::cut:
            return "a fault has cut the line";
        case Leaving::silent:
            return "its machine does not answer any more";
        case Leaving::booted:
            return "the scanner boots";
        case Leaving::ended:
            break;
    }
    return "the scanner ends, or is another one now";
}

}  // namespace

ClientLog::ClientLog(std::string scanner, std::vector<std::shared_ptr<Port>> ports)
    : scanner_(std::move(scanner)), ports_(std::move(ports)) {
    for (const auto& port : ports_)
        port->set_watch(this);
}

// Another scanner may have the port by now.
ClientLog::~ClientLog() {
    for (const auto& port : ports_) {
        if (port->watch() == this) port->set_watch(nullptr);
    }
}

void ClientLog::came(const std::string& from) {
    tell(comings_, from.empty() ? "a client has opened the tty" : "a client came from " + from);
}

void ClientLog::left(Leaving why) {
    tell(leavings_, std::string("the client has left: ") + words(why));
}

void ClientLog::tell(Throttle& throttle, const std::string& what) {
    if (const auto others = throttle.admit(std::chrono::steady_clock::now()))
        spdlog::info("{}: {}{}", scanner_, what, *others);
}

}  // namespace scipd::daemon
