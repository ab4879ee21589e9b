// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Several files as one recording in order of time, such as the parts of a bag that was split.
// Streams of one name and one scanner are one stream. Of one owner; any thread.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/recording/recording_files.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

class MergedRecording final : public Recording {
  public:
    using Open = std::function<Expected<std::unique_ptr<Recording>>(const std::filesystem::path&)>;

    /// Opens each file once for its streams and its first time. One that is not `named` by the user
    /// and cannot be read is left out with a warning.
    [[nodiscard]] static Expected<std::unique_ptr<Recording>> open(
        const std::vector<RecordingFile>& files, Open open_file);

    void skip_ahead(std::chrono::nanoseconds since_first) override;

  private:
    struct Part {
        RecordingFile file;
        std::unique_ptr<Recording> recording;  ///< null before and after its time
        std::optional<RecordedItem> head;      ///< the next item
        std::optional<HostTime> begin;
        std::vector<std::size_t> streams;  ///< index here for each of the part's own
    };

    explicit MergedRecording(Open open_file) : Recording(""), open_(std::move(open_file)) {}

    Next do_next() override;
    /// Opens a part and reads its first item.
    Expected<> begin(Part& part);
    Expected<> read_head(Part& part);
    void enqueue(std::size_t index);
    void skip(Part& part) const;
    void meet_streams(Part& part);
    std::size_t stream_for(const RecordedStream& stream, const Part& part);

    Open open_;
    std::vector<Part> parts_;
    std::set<std::pair<HostTime, std::size_t>> queue_;  ///< time of the next item, index of part
    std::multimap<std::string, std::size_t> streams_by_name_;  ///< as the parts call them
    std::set<std::string> told_;  ///< warnings, without the file's name
    std::optional<std::chrono::nanoseconds> skip_;
};

}  // namespace scipd::sim
