// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/truth.h"

#include <algorithm>
#include <cmath>

namespace scipd::daemon {
namespace {

/// As many digits as a float has at a scanner's ranges.
double rounded(double value) {
    constexpr double per_unit = 1e6;
    return std::round(value * per_unit) / per_unit;
}

Json poses_of(const ScanRecord& record) {
    const sim::Scan& scan = *record.cast;
    Json poses = Json::array();
    for (std::size_t i = 0; i < scan.world_from_sensor.size(); ++i) {
        if (i > 0 && scan.posed_at[i] == scan.posed_at[i - 1]) continue;
        Json pose{{"time_s", seconds(record.told(scan.posed_at[i]))}};
        pose.update(pose_document(scan.world_from_sensor[i]));
        poses.push_back(std::move(pose));
    }
    return poses;
}

Json steps_of(const WireScan& sent) {
    Json steps = Json::array();
    for (std::size_t i = 0; i < sent.distance.size(); ++i)
        steps.push_back(sent.first_step + static_cast<int>(i));
    return steps;
}

Json reason_of(const BackendChoice& backend) {
    return backend.reason.empty() ? Json(nullptr) : Json(backend.reason);
}

/// One element a hit.
template <class Tell>
Json of_hits(const sim::Scan& scan, Tell tell) {
    Json list = Json::array();
    for (const sim::Hit& hit : scan.hits)
        list.push_back(hit.met() ? Json(tell(hit)) : Json(nullptr));
    return list;
}

}  // namespace

Json truth_document(const std::string& sensor, const ScanRecord& record) {
    const sim::Scan& cast = *record.cast;
    const sim::Scene& scene = *record.scene;
    return {
        {"sensor", sensor},
        {"scan", cast.revolution},
        {"time_s", seconds(record.told(cast.start))},
        {"stamp_ms", record.stamp_ms},
        {"backend", record.backend->backend},
        {"backend_reason", reason_of(*record.backend)},
        {"poses", poses_of(record)},
        {"steps", steps_of(record.sent)},
        {"true_m", of_hits(cast, [](const sim::Hit& hit) { return rounded(hit.range_m); })},
        {"object",
         of_hits(cast, [&](const sim::Hit& hit) { return scene.objects[hit.object].name; })},
        {"material",
         of_hits(cast, [&](const sim::Hit& hit) { return scene.materials[hit.material].name; })},
        {"incidence_rad", of_hits(cast,
                                  [](const sim::Hit& hit) {
                                      return rounded(std::acos(std::min(1.0F, hit.cos_incidence)));
                                  })},
        {"sent_mm", record.sent.distance},
        {"intensity", record.sent.intensity}};
}

}  // namespace scipd::daemon
