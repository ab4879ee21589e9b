// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a fault does while it acts. Each kind is a class that overrides what it needs; the files
// *_effects.cpp have them. An effect lives from its begin to its end, on its shard.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "daemon/faults/device_condition.h"
#include "daemon/link/line_hook.h"
#include "protocol/action.h"
#include "protocol/request.h"
#include "protocol/status.h"
#include "protocol/uptime.h"
#include "sim/sensor/scan.h"
#include "sim/sensor/sensor_spec.h"

namespace scipd::protocol {
class Speaker;
}

namespace scipd::daemon {

class Device;
class Port;
struct PoseShift;

/// What one injection touched.
struct FaultTouch {
    std::string what;                     ///< for people: "3 bytes of MD changed"
    std::vector<std::size_t> bytes = {};  ///< which bytes of the message
    std::vector<int> steps = {};          ///< which steps of the scan
};

/// Where an effect is, at one moment.
class FaultScene {
  public:
    virtual ~FaultScene() = default;

    /// There is none behind a proxy, and the kinds of wire_kinds() do without.
    [[nodiscard]] virtual Device& device() = 0;
    /// The scanner boots, as after its cable was out.
    virtual void boot() = 0;
    /// The ports that reach it.
    [[nodiscard]] virtual std::span<Port* const> ports() = 0;
    /// The revolution that is being served, or the latest one.
    [[nodiscard]] virtual std::int64_t scan() const = 0;
    /// Even between 0 and 1, by the fault's seed, the scan or message under way, and `n`. So a run
    /// with the same seed repeats to the byte.
    [[nodiscard]] virtual double chance(std::uint32_t n) const = 0;
    /// The instant, on the device's own clock, that the stamp told next is of.
    [[nodiscard]] virtual protocol::Uptime stamped() const = 0;
    /// Writes into the log that the fault has acted. To be called whenever something was touched.
    virtual void touched(FaultTouch touch) = 0;
};

class FaultEffect {
  public:
    FaultEffect() = default;
    FaultEffect(const FaultEffect&) = delete;
    FaultEffect& operator=(const FaultEffect&) = delete;
    virtual ~FaultEffect() = default;

    virtual void begin(FaultScene& /*scene*/) {}
    /// All that it has changed is to be as if it had never acted.
    virtual void end(FaultScene& /*scene*/) {}

    // The link. Asked anew whenever a fault begins or ends; all effects see the same state, the
    // oldest first.

    virtual void line(LineState& /*line*/) const {}
    /// Bytes that go out, after everything of the protocol.
    virtual void bytes(protocol::Send& /*message*/, FaultScene& /*scene*/) {}
    /// A client has connected.
    virtual void connected(Port& /*port*/, FaultScene& /*scene*/) {}

    // The protocol.

    /// A request is about to be looked at. A status: the device refuses it with that.
    virtual std::optional<protocol::Status> refuse(const protocol::Request& /*request*/,
                                                   FaultScene& /*scene*/) {
        return std::nullopt;
    }
    /// What is about to leave for a client; it begins as one message.
    virtual void messages(const protocol::Speaker& /*from*/,
                          std::vector<protocol::Send>& /*leaving*/, FaultScene& /*scene*/) {}
    /// The client of this one is another one from here on, or there is none.
    virtual void forget(const protocol::Speaker& /*from*/) {}

    /// Whether it keeps messages back. Until it lets them go messages() is called, also after its
    /// end.
    [[nodiscard]] virtual bool holds() const { return false; }

    // The device.

    /// As line().
    virtual void condition(DeviceCondition& /*condition*/) const {}
    /// How much later the zero of the device's clock is than it would be. Asked before anything of
    /// a revolution, or of a request, is looked at. Nothing: the clock is right.
    virtual std::optional<protocol::Uptime> clock_shift(FaultScene& /*scene*/) {
        return std::nullopt;
    }
    virtual void booted(FaultScene& /*scene*/) {}

    // Scans.

    /// False: the revolution passes as if there had been none.
    virtual bool serves(FaultScene& /*scene*/) { return true; }
    [[nodiscard]] virtual sim::Time late() const { return {}; }
    /// Changes what the sensor read. What was hit stays true.
    virtual void read(sim::Scan& /*scan*/, const sim::SensorSpec& /*optics*/,
                      FaultScene& /*scene*/) {}

    // The world.

    /// As line().
    virtual void poses(PoseShift& /*shift*/) const {}
};

}  // namespace scipd::daemon
