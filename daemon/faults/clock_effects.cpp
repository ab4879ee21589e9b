// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The clock of a scanner jumps, drifts, wraps or stands still.
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "daemon/config/numbers.h"
#include "daemon/config/values.h"
#include "daemon/device/device.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_values.h"
#include "protocol/char_code.h"
#include "protocol/timestamp.h"

namespace scipd::daemon {
namespace {

using protocol::Uptime;
using std::chrono::milliseconds;

/// After so much the counter is 0 again.
constexpr Uptime counter_range =
    milliseconds(std::int64_t{protocol::max_encoded(protocol::timestamp_width)} + 1);

struct ClockMembers {
    std::optional<int> jump_ms;
    std::optional<double> ppm;
    std::optional<Uptime> wrap_in;
    bool frozen = false;
    std::optional<int> repeat;
};

sim::Expected<int> parse_jump(std::string_view text) {
    return parse_whole(text, -16'777'215, 16'777'215);
}
sim::Expected<double> parse_drift(std::string_view text) {
    return parse_ppm(text);
}
sim::Expected<int> parse_repeat(std::string_view text) {
    return parse_whole(text, 2, 1000);
}

class WrongClock : public FaultEffect {
  public:
    using Members = ClockMembers;
    static constexpr Member<Members> members[] = {
        {"jump_ms", read_as<&Members::jump_ms, parse_jump>},
        {"ppm", read_as<&Members::ppm, parse_drift>},
        {"wrap_in_s", read_as<&Members::wrap_in, parse_stale>},
        {"frozen", read_as<&Members::frozen, parse_switch>},
        {"repeat", read_as<&Members::repeat, parse_repeat>},
    };
    static void check(const Members& read, const sim::YamlField& fault, sim::YamlFaults& faults) {
        const int given = (read.jump_ms ? 1 : 0) + (read.ppm ? 1 : 0) + (read.wrap_in ? 1 : 0) +
                          (read.frozen ? 1 : 0) + (read.repeat ? 1 : 0);
        if (given != 1)
            faults.add(fault, "needs one of jump_ms, ppm, wrap_in_s, frozen: true and repeat");
        if (read.jump_ms == 0 || read.ppm == 0.0)
            faults.add(fault, "must not leave the clock right");
    }

    explicit WrongClock(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override {
        scene.touched({.what = "the clock goes wrong"});
        first_scan_ = scene.scan();
        begun_ = scene.stamped();
        const Uptime shown = *begun_ - scene.device().state().clock_zero();
        if (members_.wrap_in) to_wrap_ = shown % counter_range - counter_range + *members_.wrap_in;
    }

    std::optional<Uptime> clock_shift(FaultScene& scene) override {
        if (!begun_) return std::nullopt;
        const Uptime since = scene.stamped() - *begun_;
        if (members_.jump_ms) return -milliseconds(*members_.jump_ms);
        if (members_.ppm) {
            return -std::chrono::round<Uptime>(
                std::chrono::duration<double, Uptime::period>(since) * *members_.ppm * 1e-6);
        }
        if (members_.wrap_in) return to_wrap_;
        if (members_.frozen) return since;
        const std::int64_t passed = (scene.scan() - first_scan_) % *members_.repeat;
        Device& device = scene.device();
        return device.start_of(scene.scan()) - device.start_of(scene.scan() - passed);
    }

  private:
    Members members_;
    std::optional<Uptime> begun_;
    std::int64_t first_scan_ = 0;
    Uptime to_wrap_{};
};

}  // namespace

std::span<const FaultKind> clock_kinds() {
    static constexpr FaultKind kinds[] = {
        kind_of<WrongClock>("clock", "device", "the clock jumps, drifts, wraps or stands still"),
    };
    return kinds;
}

}  // namespace scipd::daemon
