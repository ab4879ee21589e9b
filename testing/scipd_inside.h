// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a Scipd consists of, for its parts. One thread.
#pragma once

#include <memory>
#include <vector>

#include "testing/recorded_scans.h"
#include "testing/running.h"
#include "testing/test_clock.h"
#include "testing/wire_heard.h"

namespace scipd::testing {

struct ScipdInside {
    explicit ScipdInside(const Options& options);

    Running running;
    WireLog wire;
    std::unique_ptr<LastScans> last;  ///< null: nobody wants them
    std::vector<std::shared_ptr<ScanRecorder>> recorders;
    TestClock clock;
};

}  // namespace scipd::testing
