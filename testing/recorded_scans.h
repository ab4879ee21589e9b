// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans of scipd in a file, while it runs or when a test has failed: MCAP by its public
// specification (https://mcap.dev/spec), which Foxglove, Lichtblick and scipcat read, or JSON
// lines. They are told by scipd itself, not over the wire, and no driver notices it. Any thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "testing/listener.h"
#include "testing/scipd_values.h"

namespace scipd::testing {

/// What is written is on the disk at once. One thread.
class ScanFile {
  public:
    /// FILE.mcap or FILE.jsonl. Throws std::invalid_argument for others, and ScipdError.
    explicit ScanFile(const std::filesystem::path& path);

    /// A message of /stream. Others than scans are left out.
    void write(const std::string& told);
    void finish();
    [[nodiscard]] std::size_t scans() const { return scans_; }

  private:
    void write_mcap(const Json& told);
    void put(std::uint8_t kind, std::string_view content);

    std::ofstream file_;
    bool is_mcap_;
    std::size_t scans_ = 0;
    std::map<std::string, std::uint16_t> channels_;
};

/// All scans from now on. But for what it hears, it is of one thread.
class ScanRecorder {
  public:
    /// Records this scanner, or all if `sensor` is empty.
    ScanRecorder(const std::string& control, const std::filesystem::path& path,
                 const std::string& sensor);

    void catch_up() const;
    [[nodiscard]] std::size_t scans() const;
    /// The file is whole, and nothing follows.
    void stop();

  private:
    mutable std::mutex mutex_;
    ScanFile file_;
    std::unique_ptr<Listener> listener_;  ///< null: it has stopped
};

/// The scans of all scanners, of the latest seconds.
class LastScans {
  public:
    LastScans(const std::string& control, std::chrono::duration<double> seconds);

    void save(const std::filesystem::path& path) const;
    void catch_up() const { listener_.catch_up(); }

  private:
    struct Kept {
        double time_s;
        std::string told;
    };

    void hear(const std::string& told);

    double seconds_;
    mutable std::mutex mutex_;
    std::deque<Kept> kept_;
    Listener listener_;  ///< last, as its thread uses the others
};

}  // namespace scipd::testing
