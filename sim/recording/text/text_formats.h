// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The formats of text: a function that opens a recording of each, and one that creates a recording
// of those that scipd's programs write.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "sim/recording/file/recording_file.h"
#include "sim/recording/values/recording.h"

namespace scipd::sim {

/// CSV as create_csv() and the live page write it. Refuses other tables.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_csv(InputFile file);

/// Comments that name the scanner and explain the columns, then a row of numbers for each scan,
/// which numpy.loadtxt and gnuplot read without options. An echo that a step lacks is an empty
/// cell. `recorder` is the program, for the first comment. Throws std::runtime_error, and
/// std::invalid_argument for a scan whose steps, intensities or echoes are not those of the first.
[[nodiscard]] std::unique_ptr<RecordingWriter> create_csv(const std::filesystem::path& path,
                                                          ScannerIdentity identity,
                                                          std::string recorder);

/// JSON lines: a JSON object for each scan, complete in itself. Scanners of different serial
/// numbers are streams of their own.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_json_lines(InputFile file);

/// Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<RecordingWriter> create_json_lines(const std::filesystem::path& path,
                                                                 ScannerIdentity identity);

/// UBH, the log of Hokuyo's UrgBenri: each key in brackets and each value has a line of its own.
/// The values of a scan stand between semicolons, as mm, mm|intensity or, echo after echo, mm&mm.
/// Times are local times.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_ubh(InputFile file);

/// `recorder` is the program with its version. Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<RecordingWriter> create_ubh(const std::filesystem::path& path,
                                                          ScannerIdentity identity,
                                                          std::string recorder);

/// Logs of CARMEN: FLASER and RLASER of old logs, RAWLASERn and ROBOTLASERn of newer ones; each
/// laser is a stream. Other messages are passed over.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_carmen(InputFile file);

/// True for a comment or a message of such a log.
[[nodiscard]] bool is_carmen_line(std::string_view line);

/// Logs of Player (its driver writelog, file version 0.2 or 0.3): the messages of the interface
/// laser; each device is a stream.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_player(InputFile file);

/// Tables with a scan in each row, between blanks, tabs, commas or semicolons, as numpy.savetxt,
/// spreadsheets, pandas and `rostopic echo -p` write them. Titles above them may name ranges by
/// steps or angles (range_0, ranges[1], -1.5), times and intensities. The ranges decide their unit
/// unless a title names it. Logs of CoreSLAM and BreezySLAM are such tables as well.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_table(InputFile file);

/// True for the first row of such a table, or the beginning of one.
[[nodiscard]] bool is_row_of_numbers(std::string_view line);

/// True for the titles of such a table, or the beginning of them.
[[nodiscard]] bool is_row_of_titles(std::string_view line);

}  // namespace scipd::sim
