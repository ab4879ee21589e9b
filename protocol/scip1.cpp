// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/scip1.h"

#include <algorithm>

#include "protocol/char_code.h"
#include "protocol/data_block.h"
#include "protocol/scan_block.h"

namespace scipd::protocol {
namespace {

using Kind = Scip1Request::Kind;

constexpr std::size_t scan_length = 9;       // G, start 3, end 3, cluster 2
constexpr std::size_t bit_rate_length = 14;  // S, rate 6, 7 more

// The steps as SCIP 2.0 has them, but for a digit less.
Scip1Request scan_request(std::string_view digits, const DeviceProfile& profile) {
    std::string window("0");
    window.append(digits.substr(0, 3)).append("0").append(digits.substr(3));
    const auto parsed = parse_step_window(window, profile);
    const auto* steps = std::get_if<StepWindow>(&parsed);
    if (steps == nullptr || steps->contents != Contents::distances) return {};
    return {.kind = Kind::scan, .window = *steps};
}

Scip1Request rate_request(std::string_view digits, const DeviceProfile& profile) {
    const auto rate = parse_digits(digits.substr(0, 6));
    const auto& rates = profile.bit_rates;
    if (!parse_digits(digits.substr(6)) || !rate) return {};
    if (std::find(rates.begin(), rates.end(), *rate) == rates.end()) return {};
    return {.kind = Kind::bit_rate, .bit_rate = *rate};
}

std::string head(std::string_view echo, char status) {
    std::string text(echo);
    return text.append("\n").append(1, status).append("\n");
}

}  // namespace

Scip1Request parse_scip1(std::string_view line, const DeviceProfile& profile) {
    if (line == "V") return {.kind = Kind::version};
    if (line == "L0") return {.kind = Kind::laser_off};
    if (line == "L1") return {.kind = Kind::laser_on};
    if (line == "SCIP2.0") return {.kind = Kind::choose_scip2};
    if (line.starts_with('G') && line.size() == scan_length)
        return scan_request(line.substr(1), profile);
    if (line.starts_with('S') && line.size() == bit_rate_length)
        return rate_request(line.substr(1), profile);
    return {};
}

char operate_scip1(DeviceState& device, const Scip1Request& request, Uptime now) {
    switch (request.kind) {
        case Kind::version:
            break;
        case Kind::scan:
            if (!device.laser_on() || device.failed()) return scip1_status::unknown;
            break;
        case Kind::laser_off:
            device.stop();
            break;
        case Kind::laser_on:
            device.switch_laser_on(now);
            break;
        case Kind::bit_rate:
            device.settings().bit_rate = request.bit_rate;
            break;
        case Kind::choose_scip2:
            device.speak_scip2();
            break;
        case Kind::unknown:
            return scip1_status::unknown;
    }
    return scip1_status::ok;
}

std::string scip1_reply(std::string_view echo, char status) {
    return head(echo, status) + "\n";
}

std::string scip1_version(std::string_view echo, const DeviceProfile& profile,
                          const DeviceState& device) {
    const Scip1Texts& texts = profile.scip1;
    std::string text = head(echo, scip1_status::ok);
    text.append("VEND:").append(profile.vendor).append("\n");
    text.append("PROD:").append(profile.product).append("\n");
    text.append("FIRM:").append(texts.firmware).append("\n");
    text.append("PROT:").append(texts.protocol).append("\n");
    text.append("SERI:").append(profile.serial).append("\n");
    text.append("STAT:").append(device.failed() ? texts.health_failed : texts.health);
    return text + "\n\n";
}

std::string scip1_scan(std::string_view echo, const ScanView& scan, const StepWindow& window,
                       const DeviceProfile& profile) {
    constexpr DataFormat format{.width = 2};
    std::string characters;
    for (const std::uint32_t value : values_in(scan, window, format, profile))
        append_encoded(characters, value, format.width);
    std::string text = head(echo, scip1_status::ok);
    for (std::size_t begin = 0; begin < characters.size(); begin += data_line_length)
        text.append(characters, begin, data_line_length).push_back('\n');
    return text + "\n";
}

}  // namespace scipd::protocol
