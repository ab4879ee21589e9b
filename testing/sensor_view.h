// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a sensor of a test sends, and what was true. One thread.
#pragma once

#include <chrono>
#include <string>

#include "testing/running.h"
#include "testing/scanner_line.h"
#include "testing/test_clock.h"

namespace scipd::testing {

class SensorView {
  public:
    /// `name`: as Running::sensor() takes it.
    SensorView(Running& running, TestClock& clock, const std::string& name);
    SensorView(const SensorView&) = delete;
    SensorView& operator=(const SensorView&) = delete;

    /// The next whole turn, over the wire as a driver gets it. Throws NoScan.
    [[nodiscard]] Scan next_scan(std::chrono::milliseconds timeout);
    /// What is true of the next whole turn, or of a later one. No driver notices it. Throws NoScan.
    [[nodiscard]] Truth next_truth(std::chrono::milliseconds timeout);
    /// What was true of a scan that is less than a second old. Throws ScipdError.
    [[nodiscard]] Truth truth_of(const Scan& scan);

  private:
    void keep_scans();
    [[nodiscard]] ScannerLine open_line();
    [[nodiscard]] bool is_free(ScannerLine& line);
    [[nodiscard]] Truth truth_in(Json raw) const;
    [[nodiscard]] NoScan explained(const std::string& why);

    Running& running_;
    TestClock& clock_;
    const Json& told_;  ///< of the ready line
    std::string name_;
    std::string path_;
    ScannerLine::Meanwhile meanwhile_;
    // Steps of time in lockstep: first the sweep of a revolution, then half of the gap between two
    // sweeps. So time stands before the next revolution begins, and a change holds for all of that.
    TestClock::Seconds sweep_{};      ///< 0 once it has passed
    TestClock::Seconds step_{0.002};  ///< until the scanner's parameters are known
    // How steps become angles; 0 where nobody has told, as of a camera.
    int front_step_ = 0;
    int steps_per_turn_ = 0;
};

}  // namespace scipd::testing
