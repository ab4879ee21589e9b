// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/pace.h"

#include <cstdio>
#include <utility>

#include "sim/backends/registry.h"

namespace scipd::daemon {
namespace {

constexpr sim::Time long_enough = std::chrono::seconds(5);
/// Where nobody asks for more than one now and then.
constexpr int enough_sweeps = 8;

// A thread that cannot keep up is ever later until sweeps are given up, a second late (ScanLoop).
// Who casts little is late because of others.
constexpr sim::Time late = std::chrono::milliseconds(200);
constexpr int good_part = 5;  // of its period

double milliseconds(sim::Time time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

std::string remedy(const CastSweep& sweep) {
    const std::string preferred(sim::preferred_backend().name);
    std::string text;
    if (sweep.many_poses) text = "fewer poses a sweep (motion: N)";
    if (sweep.backend != preferred)
        text += (text.empty() ? "" : " or ") + ("rays (backend: auto or " + preferred + ")");
    return text.empty() ? "fewer beams or a lower rate" : text;
}

constexpr std::chrono::seconds apart(10);

std::string counted(std::uint64_t count, const std::string& things) {
    return std::to_string(count) + " " + things + (count == 1 ? "" : "s");
}

}  // namespace

std::optional<std::string> Pace::add(const CastSweep& sweep) {
    if (told_) return std::nullopt;
    if (sweeps_ == 0 || backend_ != sweep.backend) {
        backend_ = sweep.backend;
        begin_ = sweep.begin;
        sweeps_ = 0;
        spent_ = {};
        late_ = {};
    }
    ++sweeps_;
    spent_ += sweep.end - sweep.begin;
    late_ += sweep.begin - sweep.due;
    if (sweeps_ < enough_sweeps || sweep.end - begin_ < long_enough) return std::nullopt;
    const sim::Time mean = spent_ / sweeps_;
    const bool is_late = late_ / sweeps_ > late && good_part * mean > sweep.period;
    sweeps_ = 0;
    if (mean <= sweep.period && !is_late) return std::nullopt;
    told_ = true;
    char text[160];
    std::snprintf(text, sizeof text,
                  " takes %.1f ms to cast a sweep, of which one is due every %.1f ms,%s so that "
                  "some are lost; what helps: ",
                  milliseconds(mean), milliseconds(sweep.period),
                  mean <= sweep.period ? " beside all else that this machine does," : "");
    return backend_ + text + remedy(sweep);
}

std::optional<std::string> ScanLosses::add(const std::string& sensor, std::uint64_t lost,
                                           Time now) {
    sensors_.insert(sensor);
    lost_ += lost;
    if (told_ && now - *told_ < apart) return std::nullopt;
    told_ = now;
    const auto sensors = std::exchange(sensors_, {});
    const std::string who = sensors.size() == 1
                                ? sensor
                                : sensor + " and " + counted(sensors.size() - 1, "other sensor");
    return who + " lost " + counted(std::exchange(lost_, 0), "scan") +
           ": this machine is too slow for all that is to be cast, or was asleep. If it happens "
           "again: fewer sensors or beams, a lower rate, or more cores";
}

}  // namespace scipd::daemon
