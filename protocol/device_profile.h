// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What one product says of itself and how it behaves on the wire: pure data, one object per model,
// filled in by daemon/models/. Its optics are sim::SensorSpec.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/family.h"
#include "protocol/gate.h"
#include "protocol/status.h"
#include "protocol/uptime.h"

namespace scipd::protocol {

/// A code that now and then stands where another mostly does.
struct RareCode {
    std::uint32_t code = 0;
    double inside = 0.0;  ///< its share of the steps without a distance whose neighbours have none
    double beside = 0.0;  ///< of those beside a distance
    double edge = 0.0;    ///< of those where two surfaces in one beam contradict each other
    bool alone = false;   ///< never at two steps side by side; others come in runs of four inside

    bool operator==(const RareCode&) const = default;
};

/// How II spells the clock.
enum class TimeSpelling {
    hexadecimal,  ///< 6A5404
    encoded,      ///< 0Y\\3, SCIP's own characters; may contain ';'
};

/// Whether a model has what came with some firmware only.
enum class Support {
    never,           ///< the model has not got it
    later_firmware,  ///< this firmware is older
    yes,
};

/// What stands in the place of a distance where there is none.
struct DistanceCodes {
    std::uint32_t nothing = 0;       ///< no return
    std::uint32_t too_near = 0;      ///< nearer than nearest_mm
    std::uint32_t too_far = 0;       ///< farther than DMAX
    std::uint32_t not_measured = 0;  ///< a step that may be asked for but is not measured
    // Where one of these is not given, `nothing` stands for it.
    std::optional<std::uint32_t> too_dark;      ///< too weak a return
    std::optional<std::uint32_t> too_bright;    ///< a return that blinds the receiver
    std::optional<std::uint32_t> edge;          ///< two surfaces in one beam contradict each other
    std::optional<std::uint32_t> interference;  ///< light of another scanner
    std::optional<std::uint32_t> lost;          ///< not measured for another reason

    bool operator==(const DistanceCodes&) const = default;
};

/// What V says in SCIP 1.1, besides what VV says too.
struct Scip1Texts {
    std::string firmware;  ///< FIRM; empty: the model never spoke SCIP 1.1
    std::string protocol;  ///< PROT
    std::string health;    ///< STAT
    std::string health_failed;

    bool operator==(const Scip1Texts&) const = default;
};

struct DeviceProfile {
    std::string name;     ///< as a user asks for it: NAME or NAME@RELEASE
    std::string release;  ///< the firmware whose texts and pace these are
    Family family = Family::ust;

    // VV
    std::string vendor;
    std::string product;
    std::string firmware;
    std::string protocol;
    std::string serial;

    Scip1Texts scip1;

    // PP; lengths in mm, angles in steps
    std::string model;
    int dmin_mm = 0;
    int dmax_mm = 0;
    int ares = 0;
    int amin = 0;
    int amax = 0;
    int afrt = 0;
    int scan_rpm = 0;

    // II
    std::string motor_speed;     ///< SCSP
    std::string mode_idle;       ///< MESM while the laser is off
    std::string mode_measuring;  ///< MESM while it is on
    std::string mode_streaming;  ///< MESM in a stream; empty: as mode_measuring
    std::string mode_sensitive;  ///< MESM while it is on in high-sensitivity mode
    std::string mode_booting;    ///< MESM while booting; empty: as mode_idle
    std::string bit_rate;        ///< SBPS
    std::string health;          ///< STAT
    std::string health_unstable;
    std::string health_failed;
    TimeSpelling time_spelling = TimeSpelling::encoded;

    // Distances
    // The first and the last step that may be asked for. They lie outside AMIN to AMAX on models
    // that have steps which they cannot measure.
    int first_step = 0;
    int last_step = 0;
    int nearest_mm = 0;  ///< the smallest distance that is reported as such
    DistanceCodes codes;
    std::vector<RareCode> rare_codes;  ///< in place of nothing, too_dark and edge

    // What it can that others of its family cannot
    bool multi_echo = false;
    bool microseconds = false;
    bool io_lines = false;
    bool intensity_codes = false;  ///< a cluster of FF, FE, FD, ... asks for intensity and gain

    // What can be set
    std::vector<int> bit_rates;  ///< of SS, the one of power-up first; empty: no serial line
    bool motor_levels = false;   ///< CR
    Support sensitivity = Support::never;  ///< HS
    Support rehearsals = Support::never;   ///< DB

    // Statuses
    Status unknown_command = status::undefined;
    std::vector<Deviation> deviations;

    // Pace. A tick of 0: at once.
    Uptime scan_period{};     ///< one turn of the mirror, as measured; nominally what scan_rpm says
    int turns_per_reply = 0;  ///< between replies, with a scan each turn; 0: both leave on ticks
    Uptime reply_tick{};      ///< replies leave on a grid of this spacing
    Uptime time_tick{};       ///< the reply to TM1 has a grid of its own; 0: as other replies
    Uptime scan_tick{};       ///< scans leave on a grid of this spacing
    Uptime scan_delay{};      ///< a scan leaves at least so long after its last step
    Uptime settle_time{};     ///< from when the laser is switched on until a turn has a scan
    Uptime reply_delay{};     ///< a reply leaves at least so long after its request
    Uptime state_report_delay{};                             ///< the same for the reply to II
    Uptime pause_after_scan = std::chrono::milliseconds(1);  ///< before a reply; deduced
    bool single_scan_is_next = false;  ///< GD brings the next scan that leaves, not the latest
    Uptime boot_time{};
    bool answers_while_booting = false;  ///< else what is asked then waits until it is up
    Uptime wake_time{};                  ///< until the motor is up to speed again

    bool operator==(const DeviceProfile&) const = default;

    [[nodiscard]] bool has(Feature feature) const;
    [[nodiscard]] Uptime nominal_scan_period() const;
    [[nodiscard]] bool speaks_scip1() const { return !scip1.firmware.empty(); }
    /// Whether the value of a step is a distance and not one of the codes.
    [[nodiscard]] bool is_distance(std::uint32_t value) const {
        return value >= static_cast<std::uint32_t>(nearest_mm) &&
               value <= static_cast<std::uint32_t>(dmax_mm);
    }
};

}  // namespace scipd::protocol
