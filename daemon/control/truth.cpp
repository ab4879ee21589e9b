// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/truth.h"

#include <algorithm>
#include <cmath>

#include "daemon/control/reading.h"

namespace scipd::daemon {
namespace {

Json poses_of(const Measurement& record) {
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

/// What every hit has.
Json of_all_hits(const sim::Scan& cast, const sim::Scene& scene) {
    return {
        {"true_m", of_hits(cast, [](const sim::Hit& hit) { return rounded(hit.range_m); })},
        {"object",
         of_hits(cast, [&](const sim::Hit& hit) { return scene.objects[hit.object].name; })},
        {"material",
         of_hits(cast, [&](const sim::Hit& hit) { return scene.materials[hit.material].name; })},
        {"incidence_rad", of_hits(cast, [](const sim::Hit& hit) {
             return rounded(std::acos(std::min(1.0F, hit.cos_incidence)));
         })}};
}

}  // namespace

Json truth_document(const std::string& sensor, const ScanRecord& record) {
    const sim::Scan& cast = *record.cast;
    Json truth{{"sensor", sensor},
               {"scan", cast.revolution},
               {"time_s", seconds(record.told(cast.start))},
               {"stamp_ms", record.stamp_ms},
               {"backend", record.backend->backend},
               {"backend_reason", reason_of(*record.backend)},
               {"poses", poses_of(record)},
               {"steps", steps_of(record.sent)}};
    truth.update(of_all_hits(cast, *record.scene));
    truth["sent_mm"] = record.sent.distance;
    truth["intensity"] = record.sent.intensity;
    return truth;
}

Json truth_document(const std::string& sensor, const StaringRecord& record) {
    Json truth{{"sensor", sensor},
               {"scan", record.cast->revolution},
               {"time_s", seconds(record.told(record.cast->start))},
               {"backend", record.backend->backend},
               {"backend_reason", reason_of(*record.backend)},
               {"poses", poses_of(record)}};
    truth.update(of_all_hits(*record.cast, *record.scene));
    truth.update(said_by(record));
    return truth;
}

}  // namespace scipd::daemon
