// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/port.h"

#include <utility>

namespace scipd::daemon {

LinkCounts Port::counts() const {
    LinkCounts counts = counts_before_;
    if (connection_) counts += connection_->counts();
    return counts;
}

void Port::set_line(const LineState& line) {
    line_ = line;
    if (connection_) connection_->set_line(line_);
    follow_line();
}

void Port::set_hook(LineHook* hook) {
    hook_ = hook;
    if (connection_) connection_->set_hook(hook_);
}

void Port::set_ear(WireEar* ear) {
    ear_ = ear;
    if (connection_) connection_->set_ear(ear_);
}

void Port::send_raw(std::string bytes) {
    if (connected()) connection_->send_raw(std::move(bytes));
}

void Port::begin(std::shared_ptr<Connection> connection) {
    connection_ = std::move(connection);
    connection_->hold_to(limits_, address());
    connection_->set_line(line_);
    connection_->set_hook(hook_);
    connection_->set_ear(ear_);
    if (ear_) ear_->connected();
    connection_->start();
}

void Port::end_connection(Leaving why) {
    if (!connection_) return;
    if (connected()) tell_left(why);
    counts_before_ += connection_->counts();
    connection_->close();
    connection_.reset();
}

}  // namespace scipd::daemon
