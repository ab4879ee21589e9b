// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/reports.h"

#include "protocol/reply.h"
#include "protocol/settings.h"
#include "protocol/timestamp.h"

namespace scipd::protocol {
namespace {

const std::string& health_of(const DeviceProfile& profile, const DeviceState& device) {
    if (device.failed()) return profile.health_failed;
    return device.trouble() == Trouble::unstable ? profile.health_unstable : profile.health;
}

const std::string& mode_of(const DeviceProfile& profile, const DeviceState& device, Uptime now) {
    if (device.booting(now) && !profile.mode_booting.empty()) return profile.mode_booting;
    if (!device.laser_on()) return profile.mode_idle;
    if (device.settings().sensitive) return profile.mode_sensitive;
    if (device.streaming() && !profile.mode_streaming.empty()) return profile.mode_streaming;
    return profile.mode_measuring;
}

// "1%down(594[rpm])": hokuyoaist reads a level, '%', four characters that it ignores, and the speed
// in brackets. Which four characters real scanners send is not known.
std::string motor_speed_of(const DeviceProfile& profile, const DeviceState& device) {
    const int level = device.settings().motor_level;
    if (level == 0) return profile.motor_speed;
    const int speed_rpm = profile.scan_rpm * (100 - level) / 100;
    return std::to_string(level) + "%down(" + std::to_string(speed_rpm) + "[rpm])";
}

std::string bit_rate_text(const DeviceProfile& profile, const DeviceState& device) {
    const int rate = device.settings().bit_rate;
    return rate == 0 ? profile.bit_rate : std::to_string(rate) + "[bps]";
}

std::string time_of(const DeviceProfile& profile, const DeviceState& device, Uptime now) {
    return profile.time_spelling == TimeSpelling::hexadecimal
               ? hexadecimal_timestamp(now, device.clock_zero())
               : encoded_timestamp(now, device.clock_zero());
}

std::string_view state_number(const DeviceState& device, Uptime now) {
    const bool unstable = device.trouble() == Trouble::unstable;
    if (device.booting(now)) return "001";
    if (device.failed()) return "900";
    if (device.asleep()) return "005";
    if (device.waking(now)) return "006";
    if (device.adjusting()) return unstable ? "102" : "002";
    if (device.streaming()) return unstable ? "104" : "004";
    if (device.laser_on()) return unstable ? "103" : "003";
    return unstable ? "100" : "000";
}

}  // namespace

std::string version_report(std::string_view echo, const DeviceProfile& profile) {
    return Reply(echo, status::ok)
        .entry("VEND", profile.vendor)
        .entry("PROD", profile.product)
        .entry("FIRM", profile.firmware)
        .entry("PROT", profile.protocol)
        .entry("SERI", profile.serial)
        .finish();
}

std::string parameter_report(std::string_view echo, const DeviceProfile& profile) {
    return Reply(echo, status::ok)
        .entry("MODL", profile.model)
        .entry("DMIN", profile.dmin_mm)
        .entry("DMAX", profile.dmax_mm)
        .entry("ARES", profile.ares)
        .entry("AMIN", profile.amin)
        .entry("AMAX", profile.amax)
        .entry("AFRT", profile.afrt)
        .entry("SCAN", profile.scan_rpm)
        .finish();
}

std::string state_report(std::string_view echo, const DeviceProfile& profile,
                         const DeviceState& device, Uptime shown) {
    Reply reply(echo, status::ok);
    reply.entry("MODL", profile.model);
    if (!device.failed()) {
        reply.entry("LASR", device.laser_on() ? "ON" : "OFF")
            .entry("SCSP", motor_speed_of(profile, device))
            .entry("MESM", mode_of(profile, device, shown))
            .entry("SBPS", bit_rate_text(profile, device))
            .entry("TIME", time_of(profile, device, shown));
    }
    return reply.entry("STAT", health_of(profile, device)).finish();
}

std::string state_number_report(std::string_view echo, const DeviceState& device, Uptime now) {
    return Reply(echo, status::ok).line(state_number(device, now)).finish();
}

std::string time_report(const Request& request, const DeviceState& device, Uptime shown) {
    const Uptime zero = device.clock_zero();
    const bool microseconds = request.command->format.stamp == Stamp::microseconds;
    return Reply(request.echo, status::ok)
        .line(microseconds ? encoded_microseconds(shown, zero) : encoded_timestamp(shown, zero))
        .finish();
}

}  // namespace scipd::protocol
