// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_sensors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string_view>
#include <utility>

#include "sim/loaders/file/xml_tree.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

constexpr std::array<std::string_view, 4> lidar_types{"ray", "gpu_ray", "lidar", "gpu_lidar"};
constexpr std::size_t longest_type = 40;

const XMLElement& child_of(const XMLElement& element, const char* name) {
    const auto* child = element.FirstChildElement(name);
    if (child == nullptr) {
        throw UnreadableValue("has no <" + std::string{name} + "> in its <" + element.Name() + ">");
    }
    return *child;
}

/// Reads the numbers of a lidar. They may be infinite, as a range may be.
class LidarValues {
  public:
    LidarValues(const XMLElement& element, const Dialect& dialect)
        : element_(element), values_(element, dialect) {}

    [[nodiscard]] double number(const char* name, std::optional<double> otherwise = {}) const {
        const auto text = values_.text(name);
        if (!text && otherwise) return *otherwise;
        if (!text) (void)child_of(element_, name);
        const std::string trim{trimmed(*text)};
        char* end = nullptr;
        const double number = std::strtod(trim.c_str(), &end);
        if (*end != '\0' && end == trim.c_str()) {
            throw UnreadableValue("<" + std::string{name} + "> has " + quote(trim) +
                                  " where a number is wanted");
        }
        if (trim.empty() || *end != '\0' || std::isnan(number)) {
            throw UnreadableValue("<" + std::string{name} + "> must be one number");
        }
        return number;
    }

    /// The number of samples or rows. SDF multiplies <samples> by <resolution>.
    [[nodiscard]] int count(double otherwise) const {
        constexpr double most = 1e6;
        const double samples = number("samples", otherwise);
        const double count = std::round(samples * number("resolution", 1.0));
        if (!(samples >= 1.0 && count >= 0.0 && count <= most)) {
            throw UnreadableValue("<samples> must be 1 to 1000000");
        }
        return std::max(1, static_cast<int>(count));
    }

  private:
    const XMLElement& element_;
    SdfValues values_;
};

void check(const Lidar& lidar) {
    // Files often round a full turn up.
    constexpr double turn_rad = 2.0 * std::numbers::pi + 0.01;
    const double view_rad = lidar.max_angle_rad - lidar.min_angle_rad;
    if (!(view_rad >= 0.0 && view_rad <= turn_rad)) {
        throw UnreadableValue(
            "<max_angle> must be <min_angle> or more, by a turn at most; they are in radians");
    }
    if (!(lidar.min_range_m >= 0.0 && lidar.min_range_m < lidar.max_range_m)) {
        throw UnreadableValue("<min> in its <range> must be 0 or more, and <max> above it");
    }
    if (!(lidar.rate_hz >= 0.0 && std::isfinite(lidar.rate_hz))) {
        throw UnreadableValue("<update_rate> must not be negative");
    }
}

Lidar lidar_of(const XMLElement& sensor, const Dialect& dialect) {
    const auto* ray = sensor.FirstChildElement("lidar");
    if (ray == nullptr) ray = sensor.FirstChildElement("ray");
    if (ray == nullptr) throw UnreadableValue("has neither <lidar> nor <ray>");
    const XMLElement& scan = child_of(*ray, "scan");
    const LidarValues row(child_of(scan, "horizontal"), dialect);
    const auto* vertical = scan.FirstChildElement("vertical");
    const LidarValues range(child_of(*ray, "range"), dialect);
    constexpr double samples_of_sdf = 640.0;
    const Lidar lidar{.samples = row.count(samples_of_sdf),
                      .rows = vertical == nullptr ? 1 : LidarValues(*vertical, dialect).count(1.0),
                      .min_angle_rad = row.number("min_angle"),
                      .max_angle_rad = row.number("max_angle"),
                      .min_range_m = range.number("min"),
                      .max_range_m = range.number("max"),
                      .rate_hz = LidarValues(sensor, dialect).number("update_rate", 0.0)};
    check(lidar);
    return lidar;
}

}  // namespace

bool is_lidar(const XMLElement& sensor) {
    const std::string type = attribute(sensor, "type");
    return std::ranges::find(lidar_types, type) != lidar_types.end();
}

Expected<SdfPart> frame_of_sensor(const XMLElement& sensor, const std::string& link,
                                  const SdfSheet& sheet) {
    const std::string name = attribute(sensor, "name");
    if (name.empty()) return refuse("has no name");
    SdfPart frame{SdfPart::Kind::frame, link + "::" + name, sheet.place(sensor)};
    frame.attached_to = link;
    try {
        frame.pose = SdfValues(sensor, sheet.dialect).pose();
        FoundSensor found{printable(attribute(sensor, "type"), longest_type), std::nullopt};
        if (is_lidar(sensor)) found.lidar = lidar_of(sensor, sheet.dialect);
        frame.sensor = std::make_shared<const FoundSensor>(std::move(found));
    } catch (const UnreadableValue& value) {
        return refuse(value.what());
    }
    return frame;
}

}  // namespace scipd::sim
