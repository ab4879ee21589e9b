// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "sim/recording/text/csv.h"
#include "sim/recording/text/csv_columns.h"
#include "sim/recording/text/text_recording.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

/// Takes the text up to these words off the front, with the words; all of it where they are not
/// there.
std::string take_until(std::string_view& text, std::string_view words) {
    const std::size_t end = std::min(text.find(words), text.size());
    std::string taken(text.substr(0, end));
    text.remove_prefix(std::min(end + words.size(), text.size()));
    return taken;
}

class Csv final : public TextRecording {
  public:
    explicit Csv(InputFile file) : TextRecording("csv", std::move(file)) {
        add_stream({.name = "scanner", .type = "CSV"});
    }

  private:
    Next take(std::string_view line) override {
        line = trimmed(line);
        if (line.empty()) return std::nullopt;
        if (line.front() == '#') return take_comment(std::string(trimmed(line.substr(1))));
        if (!columns_)
            return refuse(
                "there is no comment before it that names the columns: host_time_s, stamp_ms, "
                "distance_mm_S and so on, as scipcat record writes them; a table of ranges, a "
                "scan a row, is read with range_0,range_1,... above it or without names");
        auto scan = columns_->scan_of(line);
        if (!scan) return tl::unexpected(scan.error());
        scan->directions = directions_;
        return RecordedItem{0, std::move(*scan)};
    }

    Next take_comment(const std::string& text) {
        read_identity(text);
        if (!text.starts_with("host_time_s")) return std::nullopt;
        auto columns = CsvColumns::in(text);
        if (!columns) return tl::unexpected(columns.error());
        columns_ = std::move(*columns);
        directions_ = with_angles({.first_step = columns_->first_step(),
                                   .cluster = columns_->cluster().value_or(said_cluster_)},
                                  stream(0).identity);
        return std::nullopt;
    }

    /// Understands the comments of scipcat and of the page.
    void read_identity(const std::string& text) {
        ScannerIdentity& identity = stream(0).identity;
        int last = 0;
        int low_mm = 0;
        int high_mm = 0;
        const auto reads = [&](const char* pattern, int numbers, auto*... values) {
            return std::sscanf(text.c_str(), pattern, values...) == numbers;
        };
        if (reads("distance_mm_S: the nearest return of steps S to S+%6d, in millimetres; "
                  "what is not within %7d to %7d",
                  3, &last, &low_mm, &high_mm) ||
            reads("distance_mm_S: the nearest return of step S, in millimetres; "
                  "what is not within %7d to %7d",
                  2, &low_mm, &high_mm)) {
            said_cluster_ = std::max(last, 0) + 1;
            identity.min_range_m = low_mm / 1000.0;
            identity.max_range_m = high_mm / 1000.0;
        }
        int front = 0;
        int turn = 0;
        if (reads("Step S looks to (S - %6d) * 360 / %6d degrees", 2, &front, &turn) && turn > 0) {
            identity.front_step = front;
            identity.steps_per_turn = turn;
        }
        std::string_view rest = text;
        if (!identity.model.empty() || rest.find(", serial ") == rest.npos) return;
        identity.model = take_until(rest, ", serial ");
        identity.serial = take_until(rest, ", firmware ");
        identity.firmware = take_until(rest, ", recorded by ");
    }

    std::optional<CsvColumns> columns_;
    Directions directions_;
    int said_cluster_ = 1;
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_csv(InputFile file) {
    return std::make_unique<Csv>(std::move(file));
}

}  // namespace scipd::sim
