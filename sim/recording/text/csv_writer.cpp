// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sim/recording/file/growing_file.h"
#include "sim/recording/text/csv.h"
#include "sim/recording/text/text_values.h"

namespace scipd::sim {
namespace {

/// No scanner sends more.
constexpr std::size_t most_echoes = 3;

/// A group of columns, one for each value: the ranges or the intensities of one echo.
struct Block {
    std::string name;
    std::size_t echo;
    bool intensity;
};

std::vector<Block> blocks_of(const RecordedScan& scan) {
    std::vector<Block> blocks;
    for (std::size_t echo = 0; echo < (scan.has_echoes() ? most_echoes : 1); ++echo) {
        const std::string suffix = scan.has_echoes() ? std::to_string(echo + 1) : "";
        blocks.push_back({"distance" + suffix + "_mm_", echo, false});
        if (!scan.intensities.empty()) blocks.push_back({"intensity" + suffix + "_", echo, true});
    }
    return blocks;
}

/// What all rows of a table have in common.
struct Shape {
    Directions directions;
    std::size_t steps;
    bool intensities;
    bool echoes;

    bool operator==(const Shape&) const = default;
};

Shape shape_of(const RecordedScan& scan) {
    return {scan.directions, scan.steps(), !scan.intensities.empty(), scan.has_echoes()};
}

class CsvWriter final : public RecordingWriter {
  public:
    CsvWriter(const std::filesystem::path& path, ScannerIdentity identity, std::string recorder)
        : file_(path), identity_(std::move(identity)), recorder_(std::move(recorder)) {}

    void write(const RecordedScan& scan) override {
        if (!shape_) file_.write(head(scan));
        if (!shape_) shape_ = shape_of(scan);
        if (*shape_ != shape_of(scan))
            throw std::invalid_argument(
                "the scans differ in their steps, intensities or echoes, and the rows of a CSV "
                "have "
                "the same columns: ask for mcap, ubh or jsonl");
        file_.write(row(scan));
        file_.flush();
    }

  private:
    [[nodiscard]] std::string head(const RecordedScan& scan) const;
    [[nodiscard]] std::string row(const RecordedScan& scan) const;

    GrowingFile file_;
    ScannerIdentity identity_;
    std::string recorder_;
    std::optional<Shape> shape_;  ///< once there was a scan
};

std::string CsvWriter::head(const RecordedScan& scan) const {
    const int first_step = scan.directions.first_step.value_or(0);
    const int cluster = scan.directions.cluster;
    std::ostringstream text;
    text << "# " << identity_.model << ", serial " << identity_.serial << ", firmware "
         << identity_.firmware << ", recorded by " << recorder_ << "\n"
         << "# A row is a scan. host_time_s: its time on the host, Unix time in seconds. stamp_ms: "
            "the scanner's clock at step 0, in milliseconds, 24 bits.\n"
         << "# distance_mm_S: the nearest return of steps S to S+" << cluster - 1
         << ", in millimetres; what is not within "
         << whole_text(identity_.min_range_m.value_or(0) * 1000) << " to "
         << whole_text(identity_.max_range_m.value_or(0) * 1000)
         << " is a code for no distance. intensity_S: relative, no unit.\n";
    if (identity_.front_step && identity_.steps_per_turn) {
        text << "# Step S looks to (S - " << *identity_.front_step << ") * 360 / "
             << *identity_.steps_per_turn << " degrees, counter-clockwise from forward.\n";
    }
    text << "# host_time_s,stamp_ms";
    for (const Block& block : blocks_of(scan)) {
        for (std::size_t i = 0; i < scan.steps(); ++i)
            text << ',' << block.name << first_step + static_cast<int>(i) * cluster;
    }
    text << '\n';
    return text.str();
}

std::string CsvWriter::row(const RecordedScan& scan) const {
    std::string text = scan.host_time ? seconds_text(*scan.host_time) : "0.000000";
    text += "," + std::to_string(scan.stamp_ms.value_or(0));
    for (const Block& block : blocks_of(scan)) {
        for (std::size_t step = 0; step < scan.steps(); ++step) {
            const auto values = block.intensity ? scan.intensities_of(step) : scan.ranges_of(step);
            text += ',';
            if (block.echo < values.size()) text += whole_text(values[block.echo]);
        }
    }
    return text + "\n";
}

}  // namespace

std::unique_ptr<RecordingWriter> create_csv(const std::filesystem::path& path,
                                            ScannerIdentity identity, std::string recorder) {
    return std::make_unique<CsvWriter>(path, std::move(identity), std::move(recorder));
}

}  // namespace scipd::sim
