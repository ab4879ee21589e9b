// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <nlohmann/json.hpp>

#include "tools/scipcat/scan_format.h"

namespace scipd::tools {
namespace {

using Json = nlohmann::ordered_json;
using protocol::client::Echo;
using protocol::client::ScanMessage;

/// [[mm, mm, ...], ...], or [mm, intensity] in the place of each mm. The list of a step begins with
/// its first echo.
Json echoes_of(const ScanMessage& scan) {
    const auto as_json = [&](const Echo& echo) {
        return scan.request.intensity ? Json{echo.distance_mm, echo.intensity}
                                      : Json(echo.distance_mm);
    };
    Json steps = Json::array();
    for (std::size_t i = 0; i < scan.distances_mm.size(); ++i) {
        const std::uint32_t intensity = scan.request.intensity ? scan.intensities[i] : 0;
        Json echoes = Json::array({as_json({scan.distances_mm[i], intensity})});
        for (const Echo& echo : scan.further_echoes[i])
            echoes.push_back(as_json(echo));
        steps.push_back(std::move(echoes));
    }
    return steps;
}

class JsonLinesFormat final : public ScanFormat {
  public:
    [[nodiscard]] std::string head(const RecordedScanner& scanner) const override;
    [[nodiscard]] std::string line(const RecordedScanner& scanner, const ScanMessage& scan,
                                   HostTime received) const override;
};

std::string JsonLinesFormat::head(const RecordedScanner&) const {
    return {};
}

std::string JsonLinesFormat::line(const RecordedScanner& scanner, const ScanMessage& scan,
                                  HostTime received) const {
    const auto& parameters = scanner.parameters;
    const double step_rad = parameters.angle_rad(1) - parameters.angle_rad(0);
    Json object{
        {"host_time_s", std::stod(unix_seconds(received))},
        {"stamp_ms", scan.stamp_ms},
        {"model", scanner.model},
        {"serial", scanner.serial},
        {"first_step", scan.request.first_step},
        {"cluster", scan.request.cluster},
        {"first_angle_rad", parameters.angle_rad(scan.request.first_step)},
        {"angle_increment_rad", step_rad * scan.request.cluster},
        {"dmin_mm", parameters.dmin_mm},
        {"dmax_mm", parameters.dmax_mm},
        {"distances_mm", scan.distances_mm},
    };
    if (scan.request.intensity) object["intensities"] = scan.intensities;
    if (scan.request.echoes) object["echoes"] = echoes_of(scan);
    return object.dump() + "\n";
}

}  // namespace

std::unique_ptr<ScanFormat> json_lines_format() {
    return std::make_unique<JsonLinesFormat>();
}

}  // namespace scipd::tools
