// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A recording of a conversation that somebody else has. It begins a second after the first word, so
// that it knows by then who the scanner is. Where the disk is full, or the format has no room for
// what comes, it ends, and the conversation goes on. One thread.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "tools/scipcat/live_recording.h"

namespace scipd::tools {

class ProxyRecording {
  public:
    /// `file`: its ending is one of sim::recording_endings.
    explicit ProxyRecording(std::string file) : file_(std::move(file)) {}

    void hear(bool to_scanner, sim::HostTime time, std::string_view bytes);
    /// Ends the file. Tells on standard error what is in it. Throws std::runtime_error where it
    /// could not be written.
    void finish();

  private:
    void begin();
    /// Where it fails, that is told, and nothing more is recorded.
    void attempt(const std::function<void()>& write);

    std::string file_;
    LiveRecording live_{0};
    std::optional<sim::HostTime> first_;
    std::size_t waiting_bytes_ = 0;
    bool begun_ = false;
    std::string trouble_;  ///< why it could not be written
};

}  // namespace scipd::tools
