// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/reading.h"

#include <cmath>
#include <utility>
#include <variant>

namespace scipd::daemon {

void add_said(ObjectText& text, const StaringRecord& record) {
    const auto* const grid = std::get_if<sim::PinholeGrid>(&record.spec.optics);
    if (grid == nullptr) {
        const float range_m = record.range_m.front();
        return text.add("range_m", std::isfinite(range_m) ? Json(rounded(range_m)) : Json());
    }
    text.add("columns", grid->columns);
    text.add("rows", grid->rows);
    text.add_list("range_m", record.range_m, append_rounded);
}

std::string reading_text(const std::string& sensor, const StaringRecord& record) {
    const auto& poses = record.cast->world_from_sensor;
    ObjectText text({{"sensor", sensor},
                     {"scan", record.cast->revolution},
                     {"time_s", seconds(record.told(record.cast->start))},
                     {"pose", pose_document(poses[poses.size() / 2])}});
    add_said(text, record);
    return std::move(text).finish();
}

}  // namespace scipd::daemon
