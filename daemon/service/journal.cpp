// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdlib>
#include <vector>

#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include "daemon/service/logging.h"
#define SD_JOURNAL_SUPPRESS_LOCATION  // which would be this file
#include <systemd/sd-journal.h>

namespace scipd::daemon {

// systemd names the stream that it has made, since standard error may lead elsewhere by now. Where
// nobody takes entries, as in a sandbox without /run/systemd, its library drops them silently.
bool leads_to_journal(int descriptor) {
    const char* const stream = std::getenv("JOURNAL_STREAM");
    struct stat status = {};
    if (stream == nullptr || ::fstat(descriptor, &status) != 0) return false;
    if (::access("/run/systemd/journal/socket", W_OK) != 0) return false;
    return stream == std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
}

bool write_to_journal(const JournalEntry& entry) {
    std::vector<std::string> fields{"MESSAGE=" + entry.message,
                                    "PRIORITY=" + std::to_string(entry.priority),
                                    "SYSLOG_IDENTIFIER=scipd"};
    if (!entry.sensor.empty()) fields.push_back("SCIPD_SENSOR=" + entry.sensor);
    std::vector<iovec> parts;
    for (std::string& field : fields)
        parts.push_back({field.data(), field.size()});
    return ::sd_journal_sendv(parts.data(), static_cast<int>(parts.size())) == 0;
}

}  // namespace scipd::daemon
