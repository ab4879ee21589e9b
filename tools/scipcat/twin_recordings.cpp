// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/twin_recordings.h"

#include <iostream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "protocol/client/error.h"
#include "tools/scipcat/record_scans.h"
#include "tools/terminal.h"

namespace scipd::tools {
namespace {

namespace fs = std::filesystem;

class Recorder {
  public:
    Recorder(const ConnectionOptions& connection, double seconds)
        : connection_(connection), limits_{.scans = 0, .seconds = seconds} {
        scan_.intensity = true;
    }

    void record(const fs::path& file, const std::string& before) {
        const Recorded recorded = try_to_record(file, before);
        std::cerr << recorded.scans << " scans recorded to " << file.string() << '\n';
        if (recorded.interrupted)
            throw std::runtime_error("interrupted; to fit what was recorded: scipfit " +
                                     file.string() + " -o twin.yaml --room room.sdf");
    }

  private:
    /// Only asking for intensities tells whether a scanner has them.
    Recorded try_to_record(const fs::path& file, const std::string& before) {
        try {
            return record_scans(connection_, scan_, limits_, file, sim::mcap::Compression::zstd,
                                before);
        } catch (const protocol::client::Error& error) {
            const bool refused = error.kind() == protocol::client::Error::Kind::refused;
            if (!refused || !scan_.intensity) throw;
        }
        scan_.intensity = false;
        return try_to_record(file, before);
    }

    const ConnectionOptions& connection_;
    RecordLimits limits_;
    ScanOptions scan_;
};

/// Whether the person has done so. Other places tell of other ranges and angles.
bool is_turned() {
    std::cerr << "Turn the scanner by about 90 degrees where it stands, let go of it, and press "
                 "Enter;\nor leave that out with n and Enter: "
              << std::flush;
    std::string answer;
    return std::getline(std::cin, answer) && !answer.starts_with('n');
}

}  // namespace

std::vector<fs::path> record_for_twin(const ConnectionOptions& connection, double seconds,
                                      const fs::path& folder) {
    const fs::path standing = folder / "standing.mcap";
    const fs::path turned = folder / "turned.mcap";
    std::error_code not_there;
    fs::remove(turned, not_there);  // of an earlier twin
    Recorder recorder(connection, seconds);
    recorder.record(standing, "standing: ");
    if (!somebody_answers() || !is_turned()) return {standing};
    recorder.record(turned, "turned: ");
    return {standing, turned};
}

}  // namespace scipd::tools
