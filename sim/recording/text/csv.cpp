// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/recording/text/table_row.h"
#include "sim/recording/text/text_formats.h"
#include "sim/recording/text/text_recording.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

/// Stems of the titles, such as distance_mm_ of distance_mm_44: ranges at even indices, intensities
/// at odd ones, of the only echo of a step, then of each of several.
constexpr std::array<std::string_view, 8> stems = {
    "distance_mm_",  "intensity_",  "distance1_mm_", "intensity1_",
    "distance2_mm_", "intensity2_", "distance3_mm_", "intensity3_"};
constexpr std::size_t stems_without_echoes = 2;

/// Describes the rows below "host_time_s,stamp_ms,distance_mm_44,...". `cluster`: of a single step.
Expected<table::Description> description_in(const table::Cells& titles, int cluster) {
    constexpr std::size_t time_columns = 2;
    if (titles.size() <= time_columns || titles[0] != "host_time_s" || titles[1] != "stamp_ms")
        return refuse("the columns must be host_time_s, stamp_ms, distance_mm_S and so on");
    table::Description description{.columns = {.host_time = 0, .stamp_ms = 1}};
    std::vector<table::Block>& blocks = description.blocks;
    std::vector<int> steps;
    std::size_t last_stem = stems.size();
    for (std::size_t column = time_columns; column < titles.size(); ++column) {
        const std::string_view title = titles[column];
        const std::size_t digits = title.find_last_not_of("0123456789") + 1;
        const auto found = std::ranges::find(stems, title.substr(0, digits));
        const auto step = parse_number(title.substr(digits));
        if (found == stems.end() || !step || *step > 1e6)
            return refuse(quote(title) + " is neither distance_mm_S nor intensity_S");
        const auto stem = static_cast<std::size_t>(found - stems.begin());
        if (std::exchange(last_stem, stem) != stem)
            blocks.push_back({.first = column, .intensities = stem % 2 == 1});
        ++blocks.back().steps;
        if (blocks.size() == 1) steps.push_back(static_cast<int>(*step));
        description.echoes = description.echoes || stem >= stems_without_echoes;
    }
    if (blocks.front().intensities) return refuse("the distances must come first");
    const auto differs = [&](const table::Block& block) { return block.steps != steps.size(); };
    if (std::ranges::any_of(blocks, differs))
        return refuse("each range and intensity must have a column for each step");
    if (steps.size() > 1) cluster = std::max(steps[1] - steps[0], 1);
    description.blank.directions = {.first_step = steps.front(), .cluster = cluster};
    return description;
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
        if (columns_ == 0)
            return refuse(
                "there is no comment before it that names the columns: host_time_s, stamp_ms, "
                "distance_mm_S and so on, as scipcat record writes them; a table of ranges, a "
                "scan a row, is read with range_0,range_1,... above it or without names");
        const table::Cells cells = table::cells_of(line, ',', columns_);
        if (cells.size() != columns_)
            return refuse("there are " + std::to_string(cells.size()) + " cells in place of " +
                          std::to_string(columns_));
        auto scan = table::scan_of(cells, description_);
        if (!scan)
            return refuse("column " + std::to_string(scan.error() + 1) + " must be a number, not " +
                          quote(cells[scan.error()]));
        if (!scan->host_time) return refuse("host_time_s must be a number, not " + quote(cells[0]));
        if (!scan->stamp_ms)
            return refuse("stamp_ms must be a number of milliseconds, not " + quote(cells[1]));
        if (!scan->intensities.empty() && scan->intensities.size() != scan->ranges.size())
            return refuse("there must be an intensity for each distance");
        return RecordedItem{0, *std::move(scan)};
    }

    Next take_comment(const std::string& text) {
        read_identity(text);
        if (!text.starts_with("host_time_s")) return std::nullopt;
        const table::Cells titles = table::cells_of(text, ',');
        auto description = description_in(titles, said_cluster_);
        if (!description) return tl::unexpected(description.error());
        description_ = *std::move(description);
        columns_ = titles.size();
        Directions& directions = description_.blank.directions;
        directions = with_angles(directions, stream(0).identity);
        return std::nullopt;
    }

    /// Reads the comments of scipcat and of the live page.
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

    std::size_t columns_ = 0;  ///< 0: before their titles
    table::Description description_;
    int said_cluster_ = 1;
};

bool same_columns(const RecordedScan& a, const RecordedScan& b) {
    return a.directions == b.directions && a.steps() == b.steps() &&
           a.intensities.empty() == b.intensities.empty() && a.has_echoes() == b.has_echoes();
}

class CsvWriter final : public TextRecordingWriter {
  public:
    CsvWriter(const std::filesystem::path& path, ScannerIdentity identity, std::string recorder)
        : TextRecordingWriter(path, std::move(identity)), recorder_(std::move(recorder)) {}

  private:
    std::string head_of(const RecordedScan& scan) override {
        first_ = scan;
        const std::size_t end = scan.has_echoes() ? stems.size() : stems_without_echoes;
        std::size_t stem = scan.has_echoes() ? stems_without_echoes : 0;
        for (; stem < end; stem += scan.intensities.empty() ? 2 : 1)
            stems_.push_back(stem);
        const int first_step = scan.directions.first_step.value_or(0);
        const int cluster = scan.directions.cluster;
        std::ostringstream text;
        text << "# " << identity().model << ", serial " << identity().serial << ", firmware "
             << identity().firmware << ", recorded by " << recorder_ << "\n"
             << "# A row is a scan. host_time_s: its time on the host, Unix time in seconds. "
                "stamp_ms: the scanner's clock at step 0, in milliseconds, 24 bits.\n"
             << "# distance_mm_S: the nearest return of steps S to S+" << cluster - 1
             << ", in millimetres; what is not within "
             << whole_text(identity().min_range_m.value_or(0) * 1000) << " to "
             << whole_text(identity().max_range_m.value_or(0) * 1000)
             << " is a code for no distance. intensity_S: relative, no unit.\n";
        if (identity().front_step && identity().steps_per_turn) {
            text << "# Step S looks to (S - " << *identity().front_step << ") * 360 / "
                 << *identity().steps_per_turn << " degrees, counter-clockwise from forward.\n";
        }
        text << "# host_time_s,stamp_ms";
        for (const std::size_t column : stems_) {
            for (std::size_t i = 0; i < scan.steps(); ++i)
                text << ',' << stems[column] << first_step + static_cast<int>(i) * cluster;
        }
        text << '\n';
        return text.str();
    }

    std::string text_of(const RecordedScan& scan) override {
        if (!same_columns(first_, scan))
            throw std::invalid_argument(
                "the scans differ in their steps, intensities or echoes, and the rows of a CSV "
                "have the same columns: ask for mcap, ubh or jsonl");
        std::string text = scan.host_time ? seconds_text(*scan.host_time) : "0.000000";
        text += "," + std::to_string(scan.stamp_ms.value_or(0));
        for (const std::size_t stem : stems_) {
            const std::size_t echo = scan.has_echoes() ? stem / 2 - 1 : 0;
            for (std::size_t step = 0; step < scan.steps(); ++step) {
                const auto values =
                    stem % 2 == 1 ? scan.intensities_of(step) : scan.ranges_of(step);
                text += ',';
                if (echo < values.size()) text += whole_text(values[echo]);
            }
        }
        return text + "\n";
    }

    std::string recorder_;
    RecordedScan first_;
    std::vector<std::size_t> stems_;  ///< of the columns
};

}  // namespace

Expected<std::unique_ptr<Recording>> open_csv(InputFile file) {
    return std::make_unique<Csv>(std::move(file));
}

std::unique_ptr<RecordingWriter> create_csv(const std::filesystem::path& path,
                                            ScannerIdentity identity, std::string recorder) {
    return std::make_unique<CsvWriter>(path, std::move(identity), std::move(recorder));
}

}  // namespace scipd::sim
