// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/wire/wire_tap.h"

#include <cstddef>
#include <utility>

#include "daemon/link/port.h"
#include "daemon/wire/wire_listener.h"

namespace scipd::daemon {

namespace {

TakeEntry both(const TakeEntry& first, const TakeEntry& second) {
    if (!first) return second;
    if (!second) return first;
    return [first, second](WireEntry entry) {
        first(entry);
        second(std::move(entry));
    };
}

}  // namespace

WireTap::WireTap(Device& device, std::vector<std::shared_ptr<Port>> ports, TakeEntry log)
    : device_(device), ports_(std::move(ports)), log_(std::move(log)) {
    listen(nullptr);
}

WireTap::~WireTap() {
    remove_ears();
}

// Another scanner may have the port by now, and listen at it.
void WireTap::remove_ears() {
    for (std::size_t i = 0; i < ears_.size(); ++i) {
        if (ports_[i]->ear() == ears_[i].get()) ports_[i]->set_ear(nullptr);
    }
    ears_.clear();
}

void WireTap::listen(const TakeEntry& wanted) {
    remove_ears();
    const TakeEntry take = both(log_, wanted);
    if (!take) return;
    for (const auto& port : ports_) {
        const bool is_tty = port->kind() == protocol::LinkKind::tty;
        ears_.push_back(std::make_unique<WireListener>(device_, is_tty ? "tty" : "tcp", take));
        port->set_ear(ears_.back().get());
    }
}

}  // namespace scipd::daemon
