// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner that boots, sleeps, is in trouble, or whose motor is not at its speed.
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "daemon/config/numbers.h"
#include "daemon/device/device.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_values.h"

namespace scipd::daemon {
namespace {

using protocol::DeviceState;
using protocol::Trouble;
using protocol::Uptime;

sim::Expected<Uptime> parse_up_to_hour(std::string_view text) {
    return parse_stale(text);
}

class Reboot : public FaultEffect {
  public:
    struct Members {
        std::optional<Uptime> boot_time;
    };
    static constexpr Member<Members> members[] = {
        {"boot_s", read_as<&Members::boot_time, parse_up_to_hour>},
    };
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit Reboot(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override {
        const Uptime boot_time = members_.boot_time.value_or(scene.device().profile().boot_time);
        scene.touched({.what = "the device boots"});
        scene.device().change([&](DeviceState& state, Uptime now) { state.boot(now, boot_time); });
    }

  private:
    Members members_;
};

class InTrouble : public FaultEffect {
  public:
    static constexpr std::pair<std::string_view, Trouble> states[] = {
        {"unstable", Trouble::unstable},
        {"recovering", Trouble::unstable},
        {"laser", Trouble::laser},
        {"abnormal", Trouble::abnormal}};
    struct Members {
        Trouble state = Trouble::none;
    };
    static constexpr Member<Members> members[] = {
        {"state", read_as<&Members::state, parse_word<states>>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        if (members.state == Trouble::none)
            faults.add(fault, "needs state: unstable, recovering, laser or abnormal");
    }

    explicit InTrouble(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override {
        scene.touched({.what = "the device is in an error state"});
    }
    /// The worst one counts.
    void condition(DeviceCondition& condition) const override {
        condition.trouble = std::max(condition.trouble, members_.state);
    }

  private:
    Members members_;
};

/// As by %SL.
class Asleep : public FaultEffect {
  public:
    using Members = NoMembers;
    static constexpr auto& members = no_members;
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit Asleep(const Members&) {}

    void begin(FaultScene& scene) override {
        scene.touched({.what = "the motor stops, and the laser goes off"});
    }
    void condition(DeviceCondition& condition) const override { condition.asleep = true; }
};

class Motor : public FaultEffect {
  public:
    struct Members {
        std::optional<double> percent;  ///< faster than it is set to
        std::optional<Uptime> spin_up;  ///< until it is at its speed
    };
    static sim::Expected<double> parse_percent(std::string_view text) {
        return parse_whole(text, -50, 50).map([](int percent) { return percent * 0.01; });
    }
    static constexpr Member<Members> members[] = {
        {"percent", read_as<&Members::percent, parse_percent>},
        {"spin_up_s", read_as<&Members::spin_up, parse_up_to_hour>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        if (members.percent.value_or(0.0) == 0.0 && !members.spin_up)
            faults.add(fault, "needs percent, of its speed and not 0, or spin_up_s");
    }

    explicit Motor(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override {
        scene.touched({.what = "the motor is not at its speed"});
        if (members_.spin_up) up_at_ = scene.device().uptime() + *members_.spin_up;
    }
    void condition(DeviceCondition& condition) const override {
        if (members_.percent)
            condition.motor_error = (1.0 + condition.motor_error) * (1.0 + *members_.percent) - 1.0;
        if (up_at_)
            condition.spins_up_until =
                std::max(condition.spins_up_until.value_or(*up_at_), *up_at_);
    }

  private:
    Members members_;
    std::optional<Uptime> up_at_;
};

}  // namespace

std::span<const FaultKind> device_kinds() {
    static constexpr FaultKind kinds[] = {
        kind_of<Reboot>("reboot", "device", "the device boots", true),
        kind_of<InTrouble>("state", "device", "the device is in an error state, and reports it"),
        kind_of<Asleep>("sleep", "device", "the device sleeps, and streams end"),
        kind_of<Motor>("motor", "device", "the motor is not at its speed"),
    };
    return kinds;
}

}  // namespace scipd::daemon
