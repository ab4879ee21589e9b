// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <vector>

#include "tools/scipcat/scan_format.h"

namespace scipd::tools {
namespace {

using protocol::client::Echo;
using protocol::client::ScanMessage;
using protocol::client::ScanRequest;

/// No scanner sends more.
constexpr std::size_t max_echoes = 3;

/// A group of columns, one for each group of steps: the distances or the intensities of one echo.
struct Block {
    std::string name;
    std::size_t echo;
    std::uint32_t Echo::*value;
};

std::vector<Block> blocks_of(const ScanRequest& request) {
    std::vector<Block> blocks;
    for (std::size_t echo = 0; echo < (request.echoes ? max_echoes : 1); ++echo) {
        const std::string suffix = request.echoes ? std::to_string(echo + 1) : "";
        blocks.push_back({"distance" + suffix + "_mm_", echo, &Echo::distance_mm});
        if (!request.intensity) continue;
        blocks.push_back({"intensity" + suffix + "_", echo, &Echo::intensity});
    }
    return blocks;
}

void append_columns(std::string& text, const Block& block, const ScanRequest& request) {
    for (int step = request.first_step; step <= request.last_step; step += request.cluster)
        text.append(",").append(block.name).append(std::to_string(step));
}

void append_cells(std::string& text, const Block& block, const ScanMessage& scan) {
    for (std::size_t i = 0; i < scan.distances_mm.size(); ++i) {
        text.push_back(',');
        if (block.echo > 0) {
            const auto& further = scan.further_echoes[i];
            if (block.echo > further.size()) continue;
            text.append(std::to_string(further[block.echo - 1].*block.value));
        } else if (block.value == &Echo::distance_mm) {
            text.append(std::to_string(scan.distances_mm[i]));
        } else {
            text.append(std::to_string(scan.intensities[i]));
        }
    }
}

class CsvFormat final : public ScanFormat {
  public:
    [[nodiscard]] std::string head(const RecordedScanner& scanner) const override;
    [[nodiscard]] std::string line(const RecordedScanner& scanner, const ScanMessage& scan,
                                   HostTime received) const override;
};

std::string CsvFormat::head(const RecordedScanner& scanner) const {
    const auto& parameters = scanner.parameters;
    const auto& request = scanner.request;
    std::ostringstream text;
    text << "# " << scanner.model << ", serial " << scanner.serial << ", firmware "
         << scanner.firmware << ", recorded by scipcat\n"
         << "# A row is a scan. host_time_s: when it had arrived, Unix time in seconds. stamp_ms: "
            "the scanner's clock at step 0, in milliseconds, 24 bits.\n"
         << "# distance_mm_S: the nearest return of steps S to S+" << request.cluster - 1
         << ", in millimetres; what is not within " << parameters.dmin_mm << " to "
         << parameters.dmax_mm << " is a code for no distance. intensity_S: relative, no unit.\n"
         << "# Step S looks to (S - " << parameters.afrt << ") * 360 / " << parameters.ares
         << " degrees, counter-clockwise from forward.\n";
    std::string columns = "# host_time_s,stamp_ms";
    for (const Block& block : blocks_of(request))
        append_columns(columns, block, request);
    return text.str() + columns + "\n";
}

std::string CsvFormat::line(const RecordedScanner& scanner, const ScanMessage& scan,
                            HostTime received) const {
    std::string text = unix_seconds(received) + "," + std::to_string(scan.stamp_ms);
    for (const Block& block : blocks_of(scanner.request))
        append_cells(text, block, scan);
    return text + "\n";
}

}  // namespace

std::unique_ptr<ScanFormat> csv_format() {
    return std::make_unique<CsvFormat>();
}

}  // namespace scipd::tools
