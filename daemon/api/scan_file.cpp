// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/scan_file.h"

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <exception>
#include <span>
#include <stdexcept>

#include <sys/mman.h>
#include <unistd.h>

#include "sim/recording/create_recording.h"

namespace scipd::daemon {
namespace {

/// A file that has no place on a disk.
class FileInMemory {
  public:
    FileInMemory() : descriptor_(memfd_create("recording", MFD_CLOEXEC)) {
        if (descriptor_ < 0) fail();
    }
    FileInMemory(const FileInMemory&) = delete;
    FileInMemory& operator=(const FileInMemory&) = delete;
    ~FileInMemory() { close(descriptor_); }

    /// Whoever opens this writes into it.
    [[nodiscard]] std::string path() const {
        return "/proc/self/fd/" + std::to_string(descriptor_);
    }

    [[nodiscard]] std::string bytes() const {
        const off_t size = lseek(descriptor_, 0, SEEK_END);
        if (size < 0) fail();
        std::string bytes(static_cast<std::size_t>(size), '\0');
        for (std::size_t at = 0; at < bytes.size();) {
            const ssize_t count =
                pread(descriptor_, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
            if (count <= 0) fail();
            at += static_cast<std::size_t>(count);
        }
        return bytes;
    }

  private:
    [[noreturn]] static void fail() {
        throw std::runtime_error(std::string("no memory for the recording: ") +
                                 std::strerror(errno));
    }

    int descriptor_;
};

void append(const protocol::Echo& echo, bool has_intensities, sim::RecordedScan& scan) {
    scan.ranges.push_back(echo.distance);
    if (has_intensities) scan.intensities.push_back(echo.intensity);
}

void append_echoes(const WireScan& sent, sim::RecordedScan& scan) {
    for (const protocol::StepEchoes& step : sent.echoes) {
        for (const protocol::Echo& echo :
             std::span(step.echo).first(static_cast<std::size_t>(step.count)))
            append(echo, !sent.intensity.empty(), scan);
        scan.echo_ends.push_back(static_cast<std::uint32_t>(scan.ranges.size()));
    }
}

}  // namespace

sim::ScannerIdentity identity_of(const protocol::DeviceProfile& profile) {
    constexpr double m_per_mm = 1e-3;
    return {// Some models append the maker's name.
            .model = profile.model.substr(0, profile.model.find('(')),
            .serial = profile.serial,
            .firmware = profile.firmware,
            .min_range_m = profile.dmin_mm * m_per_mm,
            .max_range_m = profile.dmax_mm * m_per_mm,
            .steps_per_turn = profile.ares,
            .front_step = profile.afrt,
            .rpm = profile.scan_rpm,
            .version = {},
            .parameters = {},
            .state = {}};
}

sim::RecordedScan recorded_scan(const ScanRecord& record, const sim::ScannerIdentity& identity) {
    const WireScan& sent = record.sent;
    sim::RecordedScan scan;
    scan.host_time = sim::HostTime(record.told(record.cast->start));
    scan.stamp_ms = record.stamp_ms;
    scan.directions = sim::with_angles({.first_step = sent.first_step}, identity);
    if (sent.echoes.empty()) {
        scan.ranges.assign(sent.distance.begin(), sent.distance.end());
        scan.intensities.assign(sent.intensity.begin(), sent.intensity.end());
    } else {
        append_echoes(sent, scan);
    }
    return scan;
}

sim::Expected<std::string> scan_file(const std::string& ending,
                                     const sim::ScannerIdentity& identity,
                                     const std::vector<sim::RecordedScan>& scans) {
    try {
        const FileInMemory file;
        const auto writer = sim::create_recording(file.path(), ending, identity,
                                                  {.name = "scipd", .version = SCIPD_VERSION});
        for (const sim::RecordedScan& scan : scans)
            writer->write(scan);
        writer->finish();
        return file.bytes();
    } catch (const std::exception& error) {
        return sim::refuse(error.what());
    }
}

}  // namespace scipd::daemon
