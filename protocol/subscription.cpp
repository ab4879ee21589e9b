// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/subscription.h"

#include <utility>

#include "protocol/scan_block.h"

namespace scipd::protocol {
namespace {

// In the echo, behind the code and as many digits of window and interval.
constexpr std::size_t window_and_interval_digits = 11;
constexpr std::size_t remaining_digits = 2;

}  // namespace

std::variant<Subscription, Status> Subscription::from(const Request& request, Uptime arrived,
                                                      Uptime scan_period,
                                                      const DeviceProfile& profile) {
    const std::string_view digits = request.parameters();
    const auto window = parse_step_window(digits, profile);
    // Faults are looked for in the order of the parameters. Only 04 and 05 come later, as they need
    // all numbers of the window.
    if (const Status* fault = std::get_if<Status>(&window)) return *fault;
    const auto interval = parse_digits(digits.substr(10, 1));
    if (!interval) return status::scan::interval_not_numeric;
    const auto scans = parse_digits(digits.substr(11, 2));
    if (!scans) return status::scan::count_not_numeric;

    Subscription subscription;
    subscription.echo_ = request.echo;
    subscription.remaining_position_ = request.command->code.size() + window_and_interval_digits;
    subscription.window_ = std::get<StepWindow>(window);
    subscription.format_ = request.command->format;
    subscription.interval_ = *interval;
    // The turn under way began at most one period before the request.
    subscription.after_ = arrived + (*interval - 1) * scan_period;
    subscription.remaining_ = *scans;
    subscription.endless_ = *scans == 0;
    return subscription;
}

bool Subscription::takes(const Turn& turn, Uptime settled_at) {
    if (!has_begun(turn, settled_at)) return false;
    if (turns_to_skip_ > 0) {
        --turns_to_skip_;
        return false;
    }
    turns_to_skip_ = interval_;
    return true;
}

std::string Subscription::message(const ScanView& scan, const DeviceState& device,
                                  const DeviceProfile& profile) {
    if (!endless_) --remaining_;
    ++sent_;
    Reply reply = head(status::scan_follows);
    add_scan(reply, scan, window_, format_, device, profile);
    return reply.finish();
}

std::optional<Status> Subscription::trouble(const DeviceState& device,
                                            const DeviceProfile& profile) {
    const bool old = !is_ethernet(profile.family);
    const bool interrupted = std::exchange(interrupted_, device.trouble() != Trouble::none);
    if (device.failed()) return old ? status::broken : status::abnormal;
    if (interrupted_) return old ? status::verifying : status::unstable;
    if (interrupted && old) return status::resumed;
    return std::nullopt;
}

std::string Subscription::interruption(Status status) {
    ++interruptions_;
    return head(status).finish();
}

// The echo says how many scans are still to come.
Reply Subscription::head(Status status) const {
    std::string echo = echo_;
    const std::string left = {static_cast<char>('0' + remaining_ / 10),
                              static_cast<char>('0' + remaining_ % 10)};
    echo.replace(remaining_position_, remaining_digits, left);
    return {echo, status};
}

}  // namespace scipd::protocol
