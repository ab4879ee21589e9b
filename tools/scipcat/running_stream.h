// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <exception>

#include "protocol/client/driver.h"

namespace scipd::tools {

/// A stream of scans. Switches the scanner off even after an error: over a tty it would otherwise
/// go on streaming.
class RunningStream {
  public:
    RunningStream(protocol::client::Driver& driver, const protocol::client::ScanRequest& request)
        : driver_(driver) {
        driver_.start(request);
    }
    ~RunningStream() {
        try {
            driver_.stop();
        } catch (const std::exception&) {  // it is gone; another exception tells why
        }
    }
    RunningStream(const RunningStream&) = delete;
    RunningStream& operator=(const RunningStream&) = delete;

  private:
    protocol::client::Driver& driver_;
};

}  // namespace scipd::tools
