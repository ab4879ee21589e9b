// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scanner that boots, sleeps, is in trouble, or whose motor is not at its speed.
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
    static void check(const Members&, const Field&, Faults&) {}

    explicit Reboot(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override {
        const Uptime boot_time = members_.boot_time.value_or(scene.device().profile().boot_time);
        scene.touched({.what = "the device boots"});
        scene.device().change([&](DeviceState& state, Uptime now) { state.boot(now, boot_time); });
    }

  private:
    Members members_;
};

/// What the device says of itself. A boot does not heal it while the fault lasts.
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
    static void check(const Members& members, const Field& fault, Faults& faults) {
        if (members.state == Trouble::none)
            faults.add(fault, "needs state: unstable, recovering, laser or abnormal");
    }

    explicit InTrouble(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override {
        scene.touched({.what = "the device is in trouble"});
        set(scene, members_.state);
    }
    void end(FaultScene& scene) override {
        if (scene.device().state().trouble() == members_.state) set(scene, Trouble::none);
    }
    void booted(FaultScene& scene) override {
        scene.device().amend(
            [&](DeviceState& state, Uptime) { state.set_trouble(members_.state); });
    }

  private:
    static void set(FaultScene& scene, Trouble trouble) {
        scene.device().change([&](DeviceState& state, Uptime) { state.set_trouble(trouble); });
    }

    Members members_;
};

/// As by %SL, and by a BM when it ends.
class Asleep : public FaultEffect {
  public:
    using Members = NoMembers;
    static constexpr auto& members = no_members;
    static void check(const Members&, const Field&, Faults&) {}

    explicit Asleep(const Members&) {}

    void begin(FaultScene& scene) override {
        scene.touched({.what = "the motor stops, and the laser goes off"});
        scene.device().change([](DeviceState& state, Uptime) { state.sleep(); });
    }
    void end(FaultScene& scene) override {
        const Uptime wake_time = scene.device().profile().wake_time;
        scene.device().change([&](DeviceState& state, Uptime now) { state.wake(now, wake_time); });
    }
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
    static void check(const Members& members, const Field& fault, Faults& faults) {
        if (!members.percent && !members.spin_up)
            faults.add(fault, "needs percent, of its speed, or spin_up_s");
    }

    explicit Motor(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override {
        scene.touched({.what = "the motor is not at its speed"});
        scene.device().change([&](DeviceState& state, Uptime now) {
            if (members_.percent) state.set_motor_error(*members_.percent);
            if (members_.spin_up) state.spin_up(now + *members_.spin_up);
        });
    }
    void booted(FaultScene& scene) override {
        scene.device().amend([&](DeviceState& state, Uptime) {
            if (members_.percent) state.set_motor_error(*members_.percent);
        });
    }
    void end(FaultScene& scene) override {
        scene.device().change([&](DeviceState& state, Uptime now) {
            if (members_.percent) state.set_motor_error(0.0);
            if (members_.spin_up && state.waking(now)) state.spin_up(now);
        });
    }

  private:
    Members members_;
};

}  // namespace

std::span<const FaultKind> device_kinds() {
    static constexpr FaultKind kinds[] = {
        kind_of<Reboot>("reboot", "device", "the device boots", true),
        kind_of<InTrouble>("state", "device", "the device is in trouble, and says so"),
        kind_of<Asleep>("sleep", "device", "the device sleeps, and streams end"),
        kind_of<Motor>("motor", "device", "the motor is not at its speed"),
    };
    return kinds;
}

}  // namespace scipd::daemon
