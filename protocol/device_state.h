// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What all sessions of one device share: laser, motor, clock, mode, trouble, and which streams are
// under way. Sessions change it on the one thread that all of them live on; whoever owns the device
// changes its power and trouble as well.
//
//              BM                  M*, N*
//   standby ────────► measuring ────────────► streaming
//    ▲ ▲ ▲ ▲            │   ▲                     │
//    │ │ │ └──── QT ────┘   └─ others stream on ──┤ QT, last counted scan
//    │ │ └──────────── no other stream ───────────┘
//    │ │
//    │ ├── TM2 ────── time adjust ◄── TM0: all streams end, the laser goes off
//    │ └── boot_time ── booting ◄──── RB twice, power
//    └── QT, RS, RT ── asleep ◄────── %SL: all streams end, the laser goes off, the motor stops
//                         └── BM ──► measuring
//
//   RS and RT lead from everywhere to standby.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/settings.h"
#include "protocol/state.h"
#include "protocol/uptime.h"

namespace scipd::protocol {

/// The wires beside the link, as GF, GG, MF and MG show them: 18 bits each.
struct IoWords {
    std::uint32_t inputs = 0;
    std::uint32_t outputs = 0;
};

class DeviceState {
  public:
    /// Names a stream; never used twice.
    using StreamId = std::uint64_t;

    /// Does what is due: a reboot that was asked for. To be called before anything else that
    /// happens at `now`.
    void advance(Uptime now);

    // Power. A new device is up and has booted.

    /// Everything is as at power-up, and the links to all clients are lost. The mirror starts anew.
    void boot(Uptime now, Uptime boot_time);
    [[nodiscard]] bool booting(Uptime now) const { return now < booted_at_; }
    [[nodiscard]] Uptime booted_at() const { return booted_at_; }
    /// How many times the device has booted. A session that sees another number has lost its link.
    [[nodiscard]] int boots() const { return boots_; }
    /// The device speaks SCIP 1.1 from here on and after each boot. Its laser is on, as clients of
    /// that language ask for scans at once.
    void power_up_in_scip1(Uptime now);
    /// RB. True: this is the second one within a second, and the device will boot a second later.
    bool ask_reboot(Uptime now, Uptime boot_time);
    [[nodiscard]] std::optional<Uptime> reboots_at() const { return reboots_at_; }

    // Laser and streams.

    [[nodiscard]] bool laser_on() const { return laser_on_; }
    /// There are no scans that began earlier. Meaningless while the laser is off.
    [[nodiscard]] Uptime laser_on_since() const { return laser_on_since_; }
    [[nodiscard]] bool streams(StreamId stream) const;
    [[nodiscard]] bool streaming() const { return !open_streams_.empty(); }
    void switch_laser_on(Uptime now);
    StreamId open_stream(Uptime now);
    /// The laser goes off with the last stream, even if BM had switched it on before. Does nothing
    /// to a stream that has ended already.
    void close_stream(StreamId stream);
    /// QT of a session that does not stream: the laser goes off unless others stream.
    void stop();

    // Modes.

    [[nodiscard]] bool speaks_scip1() const { return speaks_scip1_; }
    void speak_scip1();
    /// The laser goes off (a recorded URG-04LX).
    void speak_scip2();
    [[nodiscard]] bool adjusting() const { return adjusting_; }
    void enter_adjust();
    void leave_adjust();
    /// The motor stands still.
    [[nodiscard]] bool asleep() const { return asleep_; }
    /// The motor is getting up to speed.
    [[nodiscard]] bool waking(Uptime now) const { return now < motor_up_at_; }
    void sleep();
    /// Does nothing unless asleep.
    void wake(Uptime now, Uptime wake_time);

    /// RS: laser off, no streams, no adjust mode, clock 0, settings as at power-up.
    void reset(Uptime now);
    /// RT: as RS, but the speed of the motor and the rate of the line stay.
    void partial_reset(Uptime now);
    /// The instant at which the clock that the wire shows is 0, which may lie before power-up. RS
    /// and a boot set the clock to 0, set_clock() sets it to anything, near its wrap for example.
    [[nodiscard]] Uptime clock_zero() const { return clock_zero_; }
    void set_clock(Uptime now, Uptime shown) { clock_zero_ = now - shown; }
    /// The pass of step 0 from which on the mirror turns at its present speed. It may be still to
    /// come.
    [[nodiscard]] Uptime mirror_origin() const { return mirror_origin_; }
    void set_mirror_origin(Uptime pass) { mirror_origin_ = pass; }
    /// The share by which the motor turns faster than it is set to.
    [[nodiscard]] double motor_error() const { return motor_error_; }
    void set_motor_error(double share) { motor_error_ = share; }
    /// The motor has stood still, and gets up to speed again until then.
    void spin_up(Uptime until);
    /// It is at its speed already.
    void spun_up(Uptime now);
    [[nodiscard]] Settings& settings() { return settings_; }
    [[nodiscard]] const Settings& settings() const { return settings_; }

    [[nodiscard]] IoWords& io() { return io_; }
    [[nodiscard]] const IoWords& io() const { return io_; }

    // Trouble.

    [[nodiscard]] Trouble trouble() const { return trouble_; }
    /// Only questions and a reboot work.
    [[nodiscard]] bool failed() const { return trouble_ >= Trouble::laser; }
    void set_trouble(Trouble trouble) { trouble_ = trouble; }
    /// The number of the rehearsal (DB) that is under way; 0: none.
    [[nodiscard]] int rehearsal() const { return rehearsal_; }
    void set_rehearsal(int number) { rehearsal_ = number; }

  private:
    Uptime booted_at_{};
    int boots_ = 0;
    std::optional<Uptime> reboot_asked_at_;  ///< a first RB
    std::optional<Uptime> reboots_at_;
    Uptime boot_time_{};  ///< of that reboot

    bool laser_on_ = false;
    Uptime laser_on_since_{};
    StreamId last_stream_ = 0;
    std::vector<StreamId> open_streams_;

    bool powers_up_in_scip1_ = false;
    bool speaks_scip1_ = false;
    bool adjusting_ = false;
    bool asleep_ = false;
    Uptime motor_up_at_{};
    Uptime clock_zero_{};
    Uptime mirror_origin_{};
    double motor_error_ = 0.0;
    Settings settings_;
    IoWords io_;
    Trouble trouble_ = Trouble::none;
    int rehearsal_ = 0;
};

}  // namespace scipd::protocol
