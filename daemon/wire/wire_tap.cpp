// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/wire/wire_tap.h"

#include <cstddef>
#include <utility>

#include "daemon/link/port.h"
#include "daemon/wire/wire_listener.h"

namespace scipd::daemon {

WireTap::WireTap(Device& device, std::vector<std::shared_ptr<Port>> ports)
    : device_(device), ports_(std::move(ports)) {}

WireTap::~WireTap() {
    listen(nullptr);
}

void WireTap::listen(const TakeEntry& take) {
    // Another scanner may have the port by now, and listen at it.
    for (std::size_t i = 0; i < ears_.size(); ++i) {
        if (ports_[i]->ear() == ears_[i].get()) ports_[i]->set_ear(nullptr);
    }
    ears_.clear();
    if (!take) return;
    for (const auto& port : ports_) {
        const bool is_tty = port->kind() == protocol::LinkKind::tty;
        ears_.push_back(std::make_unique<WireListener>(device_, is_tty ? "tty" : "tcp", take));
        port->set_ear(ears_.back().get());
    }
}

}  // namespace scipd::daemon
