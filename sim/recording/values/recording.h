// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A recording while it is read, whatever its format: item after item, so that no file is held in
// memory. open_recording.h opens one. Of one owner; any thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sim/expected.h"
#include "sim/recording/values/recorded_scan.h"
#include "sim/recording/values/scanner_identity.h"

namespace scipd::sim {

/// One scanner, topic or connection of a recording.
struct RecordedStream {
    std::string name;  ///< as the file calls it: a topic, a laser, addresses; unique in the file
    std::string type;  ///< what its messages are, such as sensor_msgs/LaserScan
    ScannerIdentity identity;
    bool has_scans = true;   ///< false: it has bytes alone, and who knows SCIP finds scans in them
    bool has_bytes = false;  ///< the conversation with the scanner
};

struct RecordedItem {
    std::size_t stream = 0;  ///< its index in Recording::streams()
    std::variant<RecordedScan, RecordedBytes> what;
    /// Time at which it was logged, if the format has that beside the scan's own stamp.
    std::optional<HostTime> logged = std::nullopt;
    /// True: the scan's time is its own stamp; else it is `logged`, or the only one of the format.
    bool stamped = false;
};

/// Time by which items are put in order; nullopt if they have none.
[[nodiscard]] inline std::optional<HostTime> order_time(const RecordedItem& item) {
    if (item.logged) return item.logged;
    if (const auto* const scan = std::get_if<RecordedScan>(&item.what)) return scan->host_time;
    return std::get<RecordedBytes>(item.what).host_time;
}

class Recording {
  public:
    explicit Recording(std::string format) : format_(std::move(format)) {}
    virtual ~Recording() = default;
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    /// "mcap", "bag", "db3", "ubh", "csv", "jsonl", "rows", "carmen", "player", "npy" or "pcap"; of
    /// several files each of theirs, with commas between them.
    [[nodiscard]] const std::string& format() const { return format_; }

    /// Those that have been met so far; all of them once next() has returned nothing. The identity
    /// of one may become better known on the way.
    [[nodiscard]] const std::vector<RecordedStream>& streams() const { return streams_; }

    /// What was lost or left out so far, in sentences for the user.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    /// The next scan or bytes: in order of time, or in that of the file where the format is a text.
    /// Returns nullopt at the end. A fault names the file and the byte or the line, and ends the
    /// recording. Damaged parts of bags and MCAP files are passed over with a warning, unless
    /// nothing else is there. A file that was cut off ends where its whole items end, with a
    /// warning.
    [[nodiscard]] Expected<std::optional<RecordedItem>> next();

    /// What comes earlier than so long after the file's first message is not wanted. A format that
    /// can pass over it unread does so, more or less; others bring it.
    virtual void skip_ahead(std::chrono::nanoseconds) {}

  protected:
    using Next = Expected<std::optional<RecordedItem>>;

    void add_format(const std::string& format) {
        if (format_.find(format) == format_.npos) format_ += (format_.empty() ? "" : ", ") + format;
    }
    /// Returns its index.
    std::size_t add_stream(RecordedStream stream) {
        streams_.push_back(std::move(stream));
        return streams_.size() - 1;
    }
    [[nodiscard]] RecordedStream& stream(std::size_t index) { return streams_[index]; }
    void warn(std::string sentence) { warnings_.push_back(std::move(sentence)); }
    /// Counts a damaged part that is passed over, with a warning.
    void lose(const tl::unexpected<Fault>& why);
    /// True once so many parts are damaged that no more is read.
    [[nodiscard]] bool is_beyond_reading() const { return losses_ > most_losses; }
    /// A topic, or the like, from which no scans are read: named in one warning at the end. `file`
    /// begins that warning.
    void leave_out(const std::string& file, const std::string& name, const std::string& type);

  private:
    [[nodiscard]] virtual Next do_next() = 0;

    static constexpr std::size_t most_losses = 10'000;

    std::string format_;
    std::vector<RecordedStream> streams_;
    std::vector<std::string> warnings_;
    std::string file_;                ///< for the warning of what was left out
    std::set<std::string> left_out_;  ///< "/tf (tf/tfMessage)"
    std::optional<Fault> lost_;       ///< the first damage
    std::size_t losses_ = 0;
    bool given_ = false;  ///< at least one item
    bool ended_ = false;
};

/// A recording while it is written. What it holds is on the disk after each scan, or with .mcap
/// after each second of them, so that a process that is killed leaves a file that opens.
/// create_recording.h makes one.
class RecordingWriter {
  public:
    RecordingWriter() = default;
    virtual ~RecordingWriter() = default;
    RecordingWriter(const RecordingWriter&) = delete;
    RecordingWriter& operator=(const RecordingWriter&) = delete;

    // All of them throw std::runtime_error where the disk is full. Scans are in millimetres.
    virtual void write(const RecordedScan& scan) = 0;
    /// Most formats have no place for the conversation, and leave it out.
    virtual void write(const RecordedBytes&) {}
    /// Ends the file; nothing may follow.
    virtual void finish() {}
};

}  // namespace scipd::sim
