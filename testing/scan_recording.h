// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The handle of a recording that a test has asked for. One thread.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

namespace scipd::testing {

class ScanRecorder;

/// Scans that are being written. It ends with stop(), or with the Scipd, not with this object.
class Recording {
  public:
    explicit Recording(std::shared_ptr<ScanRecorder> recorder) : recorder_(std::move(recorder)) {}

    /// How many it has written.
    [[nodiscard]] std::size_t scans() const;
    /// The file is whole when this returns.
    void stop() const;

  private:
    std::shared_ptr<ScanRecorder> recorder_;
};

}  // namespace scipd::testing
