// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The recordings that clients of the API ask for: a scanner's next scans, as the file that scipcat
// would write of them, in Unix time on the wall clock. Scans are cast for them, whether a driver
// wants any or not. The files are made aside. Lives on the I/O thread; what scanners tell on
// another thread is carried there.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "daemon/api/scan_stream.h"
#include "daemon/clock/clock.h"
#include "daemon/world/worker.h"
#include "sim/expected.h"
#include "sim/recording/values/recorded_scan.h"
#include "sim/recording/values/scanner_identity.h"

namespace scipd::daemon {

class Recordings {
  public:
    using Ways = ScanStream::Ways;
    /// Has a worker do it.
    using Aside = std::function<void(Worker::Begin)>;

    /// At 40 Hz 100 seconds.
    static constexpr std::size_t most_scans = 4000;
    static constexpr std::size_t most_at_once = 4;

    /// A scanner's end of them. They and the scanner must outlive it. It is made, and goes, while
    /// no sensor does anything.
    class Tap {
      public:
        Tap(Recordings& recordings, std::string name, Device& device);
        Tap(const Tap&) = delete;
        Tap& operator=(const Tap&) = delete;
        ~Tap();

      private:
        friend class Recordings;

        Recordings& recordings_;
        std::string name_;
        Device& device_;
        bool watches_ = false;
    };

    /// What somebody wants.
    struct Order {
        std::string sensor;  ///< a scanner that is there
        std::string ending;  ///< ".mcap", one of sim::recording_endings
        std::size_t scans = 0;
        std::stop_token withdrawn = {};
        /// Takes the bytes of the file. Not called where the order is withdrawn.
        std::function<void(sim::Expected<std::string>)> done = {};
        /// The scanner goes before all scans are there. Nothing else is called then.
        std::function<void()> gone = {};
    };

    /// `clock` must outlive it.
    Recordings(Ways ways, const Clock& clock, Aside aside)
        : ways_(std::move(ways)), clock_(clock), aside_(std::move(aside)) {}
    Recordings(const Recordings&) = delete;
    Recordings& operator=(const Recordings&) = delete;

    /// Whether one more may begin.
    [[nodiscard]] bool has_room() const { return recordings_.size() < most_at_once; }
    /// Begins with the scanner's next scan.
    void begin(Order order);

  private:
    struct Recording;
    using SharedIdentity = std::shared_ptr<const sim::ScannerIdentity>;

    /// A scanner makes scans as long as somebody records them.
    void follow(Tap& tap);
    void follow_all();
    void take(const std::string& sensor, const SharedIdentity& identity,
              const sim::RecordedScan& scan);
    void finish(const std::shared_ptr<Recording>& recording, const SharedIdentity& identity);
    void end_those_of(const std::string& sensor);
    void forget(const Recording* recording);

    Ways ways_;
    const Clock& clock_;
    Aside aside_;
    std::vector<Tap*> taps_;
    std::vector<std::shared_ptr<Recording>> recordings_;
};

}  // namespace scipd::daemon
