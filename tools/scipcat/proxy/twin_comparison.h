// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the scans of a scanner differ from those of its twin, and since when. It looks at some
// scans at a time, at what most of them read at each step, so that noise is no difference, and
// tells what is new since it last looked. A value; no thread rule.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/analysis/scan_table.h"

namespace scipd::tools {

/// Steps in a row that differ alike.
struct TwinDifference {
    int from = 0;  ///< steps as SCIP counts them; the last is inclusive
    int to = 0;
    bool codes = false;  ///< at least one of the two reads no distance
    /// The mean of the steps, in mm; with codes, what the step in the middle has.
    double scanner = 0.0;
    double twin = 0.0;
    std::uint64_t scan = 0;  ///< since when: the scan, counted from 1
    sim::HostTime time{};

    [[nodiscard]] double by_mm() const { return scanner - twin; }
};

struct TwinChange {
    TwinDifference difference;
    bool begins = true;  ///< false: there the two agree again, since `scan`
};

class TwinComparison {
  public:
    /// As many are looked at together: at 40 Hz a quarter of a second.
    static constexpr std::size_t scans_together = 9;

    /// `tolerance_mm`: what the two may differ by.
    explicit TwinComparison(double tolerance_mm) : tolerance_mm_(tolerance_mm) {}

    /// What has changed with this scan of the scanner, beside one of the twin. Scans of which one
    /// begins at another step, or has other clusters, are not compared.
    [[nodiscard]] std::vector<TwinChange> add(const sim::RecordedScan& scanner,
                                              const sim::RecordedScan& twin,
                                              const sim::ScannerIdentity& identity);
    [[nodiscard]] const std::vector<TwinDifference>& differences() const { return told_; }
    [[nodiscard]] std::uint64_t scans() const { return scans_; }

  private:
    /// A row of both tables.
    struct Row {
        std::uint64_t scan = 0;
        sim::HostTime time{};
    };

    [[nodiscard]] bool differs(const Reading& scanner, const Reading& twin) const;
    [[nodiscard]] std::vector<TwinDifference> look() const;
    [[nodiscard]] TwinDifference difference_of(std::size_t begin, std::size_t end,
                                               bool codes) const;
    [[nodiscard]] std::size_t since_they_differ(std::size_t begin, std::size_t end) const;
    void clear();
    [[nodiscard]] std::vector<TwinChange> tell(const std::vector<TwinDifference>& now);
    [[nodiscard]] std::vector<TwinDifference> rest_of(const TwinDifference& old,
                                                      const std::vector<TwinDifference>& now) const;
    [[nodiscard]] bool alike(const TwinDifference& a, const TwinDifference& b) const;

    double tolerance_mm_;
    ScanTable scanner_;
    ScanTable twin_;
    std::vector<Row> rows_;
    std::vector<TwinDifference> told_;
    std::uint64_t scans_ = 0;
};

/// For people: "steps 210-221 nearer by 0.31 m".
[[nodiscard]] std::string sentence_of(const TwinChange& change);
/// A JSON object on one line.
[[nodiscard]] std::string json_of(const TwinChange& change);

}  // namespace scipd::tools
