// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Recordings of lines of text, read and written. Of one owner each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sim/recording/file/recording_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

/// An error in a line ends the recording. A last line without an end is left out: its writer may
/// have been stopped within it, and its last number may lack digits.
class TextRecording : public Recording {
  public:
    /// Limit of a line, bytes. A scan of 100 000 steps with echoes takes 3 MB.
    static constexpr std::size_t longest_line = std::size_t{16} << 20;

    TextRecording(std::string format, InputFile file)
        : Recording(std::move(format)), file_(std::move(file)) {}

  protected:
    /// Returns the item that the line completes, if any, or the error in the line.
    [[nodiscard]] virtual Next take(std::string_view line) = 0;

    [[nodiscard]] const std::string& file_name() const { return file_.name(); }
    /// Index of the stream with this key. The first call with a key adds the stream.
    [[nodiscard]] std::size_t stream_of(const std::string& key, const RecordedStream& stream);

  private:
    Next do_next() final;
    /// Returns nullopt at the end of the file. Valid until the next call.
    [[nodiscard]] Expected<std::optional<std::string_view>> next_line();
    /// True if a line without an end is complete by itself.
    [[nodiscard]] virtual bool is_whole(std::string_view line) const { return line.empty(); }

    InputFile file_;
    std::uint64_t read_ = 0;       ///< bytes of the file
    std::string text_;             ///< read, but not yet taken
    std::size_t begin_ = 0;        ///< of the next line, in `text_`
    std::size_t line_number_ = 0;  ///< of the current line, from 1
    bool cut_off_ = false;         ///< the current line has no end
    std::map<std::string, std::size_t> streams_by_key_;
};

/// Each scan is on the disk at once. Throws std::runtime_error where the disk is full.
class TextRecordingWriter : public RecordingWriter {
  public:
    TextRecordingWriter(const std::filesystem::path& path, ScannerIdentity identity)
        : file_(path), identity_(std::move(identity)) {}

    void write(const RecordedScan& scan) final {
        const std::string head = std::exchange(begun_, true) ? std::string{} : head_of(scan);
        file_.write(head + text_of(scan));
        file_.flush();
    }

  protected:
    [[nodiscard]] const ScannerIdentity& identity() const { return identity_; }

  private:
    /// The text before the first scan.
    [[nodiscard]] virtual std::string head_of(const RecordedScan&) { return {}; }
    [[nodiscard]] virtual std::string text_of(const RecordedScan& scan) = 0;

    GrowingFile file_;
    ScannerIdentity identity_;
    bool begun_ = false;
};

/// Takes the text before `mark` off the front, and the mark; all of the text if it has no mark.
std::string_view take_until(std::string_view& text, std::string_view mark);

/// The text behind the byte order mark of UTF-8, with which some programs begin a file.
[[nodiscard]] std::string_view behind_byte_order_mark(std::string_view text);

/// Unix time in seconds, to a microsecond.
[[nodiscard]] std::string seconds_text(HostTime time);

/// The nearest whole number, without a point.
[[nodiscard]] std::string whole_text(double value);

}  // namespace scipd::sim
