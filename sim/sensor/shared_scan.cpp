// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/sensor/shared_scan.h"

#include <utility>

#include "sim/recycled.h"

namespace scipd::sim {
namespace {

struct RecycledScan {
    explicit RecycledScan(Scan made) : scan(std::move(made)) {}
    RecycledScan(const RecycledScan&) = delete;
    RecycledScan& operator=(const RecycledScan&) = delete;
    ~RecycledScan() {
        Recycled<Pose>::give(std::move(scan.world_from_sensor));
        Recycled<Time>::give(std::move(scan.posed_at));
        Recycled<Hit>::give(std::move(scan.hits));
        Recycled<Reading>::give(std::move(scan.readings));
    }

    Scan scan;
};

}  // namespace

SharedScan share(Scan scan) {
    const auto kept = std::make_shared<RecycledScan>(std::move(scan));
    return {kept, &kept->scan};
}

}  // namespace scipd::sim
