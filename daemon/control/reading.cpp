// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/reading.h"

#include <cmath>
#include <variant>

namespace scipd::daemon {
namespace {

Json range_document(float range_m) {
    return std::isfinite(range_m) ? Json(rounded(range_m)) : Json(nullptr);
}

}  // namespace

Json said_by(const StaringRecord& record) {
    const auto* const grid = std::get_if<sim::PinholeGrid>(&record.spec.optics);
    if (grid == nullptr) return {{"range_m", range_document(record.range_m.front())}};
    Json ranges = Json::array();
    for (const float range_m : record.range_m)
        ranges.push_back(range_document(range_m));
    return {{"columns", grid->columns}, {"rows", grid->rows}, {"range_m", std::move(ranges)}};
}

Json reading_document(const std::string& sensor, const StaringRecord& record) {
    const auto& poses = record.cast->world_from_sensor;
    Json reading{{"sensor", sensor},
                 {"scan", record.cast->revolution},
                 {"time_s", seconds(record.told(record.cast->start))},
                 {"pose", pose_document(poses[poses.size() / 2])}};
    reading.update(said_by(record));
    return reading;
}

}  // namespace scipd::daemon
