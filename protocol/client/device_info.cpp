// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/client/device_info.h"

#include <charconv>
#include <numbers>
#include <string_view>

#include "protocol/char_code.h"
#include "protocol/timestamp.h"

namespace scipd::protocol::client {
namespace {

/// The KEY:VALUE lines of one message. Remembers the first fault.
class Entries {
  public:
    explicit Entries(const Message& message) : message_(message) {}

    void optional(std::string_view key, std::string& value) const {
        if (const auto found = find(key)) value = *found;
    }
    void required(std::string_view key, std::string& value) {
        if (const auto found = find(key)) {
            value = *found;
        } else {
            fault(key, " is missing");
        }
    }
    void required(std::string_view key, int& value) {
        std::string text;
        required(key, text);
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc{} || stop != end || value < 0) {
            fault(key, " is no number: \"" + text + "\"");
        }
    }

    template <typename Parsed>
    std::variant<Parsed, std::string> finish(Parsed value) const {
        if (!fault_.empty()) return fault_;
        return value;
    }
    void fault(std::string_view key, const std::string& what) {
        if (fault_.empty()) fault_ = std::string(key) + what;
    }

  private:
    [[nodiscard]] std::optional<std::string_view> find(std::string_view key) const {
        for (const std::string_view line : message_.lines) {
            if (line.starts_with(key) && line.substr(key.size()).starts_with(':')) {
                return line.substr(key.size() + 1);
            }
        }
        return std::nullopt;
    }

    const Message& message_;
    std::string fault_;
};

/// Reads four of SCIP's characters (UST) or six hexadecimal digits (all older models).
std::optional<std::uint32_t> read_time(std::string_view text) {
    if (text.size() == timestamp_width) {
        const auto value = decode(text);
        return value ? std::optional(static_cast<std::uint32_t>(*value)) : std::nullopt;
    }
    constexpr std::size_t hexadecimal_width = 6;
    std::uint32_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value, 16);
    if (text.size() != hexadecimal_width || error != std::errc{} || stop != end) return {};
    return value;
}

}  // namespace

double Parameters::angle_rad(double step) const {
    return (step - afrt) * 2.0 * std::numbers::pi / ares;
}

std::variant<Version, std::string> parse_version(const Message& message) {
    Version version;
    Entries entries(message);
    entries.required("VEND", version.vendor);
    entries.required("PROD", version.product);
    entries.required("FIRM", version.firmware);
    entries.required("PROT", version.protocol);
    entries.required("SERI", version.serial);
    return entries.finish(version);
}

std::variant<Parameters, std::string> parse_parameters(const Message& message) {
    Parameters parameters;
    Entries entries(message);
    entries.required("MODL", parameters.model);
    entries.required("DMIN", parameters.dmin_mm);
    entries.required("DMAX", parameters.dmax_mm);
    entries.required("ARES", parameters.ares);
    entries.required("AMIN", parameters.amin);
    entries.required("AMAX", parameters.amax);
    entries.required("AFRT", parameters.afrt);
    entries.required("SCAN", parameters.scan_rpm);
    if (parameters.ares == 0) entries.fault("ARES", " is 0");
    if (parameters.amax < parameters.amin) entries.fault("AMAX", " lies before AMIN");
    return entries.finish(parameters);
}

std::variant<SensorState, std::string> parse_state(const Message& message) {
    SensorState state;
    Entries entries(message);
    entries.required("MODL", state.model);
    entries.optional("LASR", state.laser);
    entries.optional("SCSP", state.motor_speed);
    entries.optional("MESM", state.mode);
    entries.optional("SBPS", state.bit_rate);
    entries.optional("TIME", state.time);
    entries.required("STAT", state.health);
    state.time_ms = read_time(state.time);
    return entries.finish(state);
}

}  // namespace scipd::protocol::client
