// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/acquisition.h"

#include <utility>

#include "protocol/rehearsal.h"
#include "protocol/reply.h"
#include "protocol/reply_grid.h"
#include "protocol/scan_block.h"
#include "protocol/scip1.h"

namespace scipd::protocol {

void Acquisition::stop() {
    device_.close_stream(std::exchange(stream_, 0));
    subscription_.reset();
    device_.stop();
    release_device();
}

void Acquisition::close() {
    if (!holds_device_) return;
    stop();
    device_.leave_adjust();
}

void Acquisition::lose() {
    release_device();
    subscription_.reset();
    forget_scan();
}

bool Acquisition::turn_complete(const Turn& turn) {
    const bool taken = streaming() && subscription_->takes(turn, settled_at());
    if (taken) taken_turns_.push_back(turn.start);
    return taken || awaits(turn);
}

bool Acquisition::has_begun(const Turn& turn) const {
    return (streaming() && subscription_->has_begun(turn, settled_at())) || awaits(turn);
}

void Acquisition::stream(Subscription subscription, Uptime now) {
    const DeviceState::StreamId replaced = std::exchange(stream_, device_.open_stream(now));
    device_.close_stream(replaced);
    subscription_ = std::move(subscription);
    taken_turns_.clear();  // those of the replaced stream
    hold_device();
}

bool Acquisition::streaming() const {
    return subscription_ && device_.streams(stream_);
}

std::optional<std::string> Acquisition::stream_message(const ScanView& scan) {
    if (std::erase(taken_turns_, scan.turn.start) == 0 || !streaming()) return std::nullopt;
    rehearse_in_stream(device_, *subscription_);
    if (const auto status = subscription_->trouble(device_, profile_)) {
        std::string message = subscription_->interruption(*status);
        if (device_.failed()) stop();
        return message;
    }
    std::string message = subscription_->message(scan, device_, profile_);
    if (subscription_->finished()) stop();
    return message;
}

bool Acquisition::awaits_scan_in_vain() const {
    return awaits_scan() && (!device_.laser_on() || device_.failed());
}

bool Acquisition::awaits(const Turn& turn) const {
    if (!awaits_scan() || !device_.laser_on() || turn.start < settled_at()) return false;
    if (!profile_.single_scan_is_next) return true;
    const Uptime period = mirror_of(device_, profile_).tick;
    const Uptime complete = turn.start + period * profile_.amax / profile_.ares;
    return scan_leaves(complete, device_, profile_) > single_scan_->begun;
}

Uptime Acquisition::settled_at() const {
    return device_.laser_on_since() + profile_.settle_time;
}

std::string Acquisition::single_scan_reply(const ScanView& scan) {
    const SingleScan awaited = std::move(*std::exchange(single_scan_, std::nullopt));
    const Request& request = awaited.request;
    if (request.command == nullptr) return scip1_scan(request.echo, scan, awaited.window, profile_);
    Reply reply(request.echo, status::ok);
    add_scan(reply, scan, awaited.window, request.command->format, device_, profile_);
    return reply.finish();
}

Request Acquisition::give_up_scan() {
    return std::move(std::exchange(single_scan_, std::nullopt)->request);
}

}  // namespace scipd::protocol
