// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A recording that a scanner plays in place of a world. A value; any thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace scipd::daemon {

enum class ReplayLoop {
    none,   ///< after the last scan there are no more
    again,  ///< each round has the recorded stamps
    on,     ///< stamps go on from round to round
};

enum class ReplayStart {
    client,  ///< with the first program that takes scans of it
    start,   ///< with scipd
};

/// When its first scan was recorded, as the file says.
struct AsRecorded {
    bool operator==(const AsRecorded&) const = default;
};

struct ReplayConfig {
    std::vector<std::filesystem::path> files;  ///< one recording; also folders of it
    std::string stream;  ///< which of several scanners or topics of the file; empty: the only one
    ReplayLoop loop = ReplayLoop::none;
    double speed = 1.0;  ///< how many times as fast as it was recorded
    /// Position at which it begins, since the first scan of all scanners that play these files.
    std::chrono::nanoseconds from{};
    ReplayStart begins = ReplayStart::client;
    /// Stamp of the poses at which that first scan is due; nullopt: `begins` says when it is.
    std::optional<std::variant<std::chrono::nanoseconds, AsRecorded>> begins_s;
    bool finds_model = false;  ///< the recording says of which model the scanner is
    bool serves_all = false;   ///< a recording of several scanners becomes as many sensors

    /// "a.mcap+b.mcap"
    [[nodiscard]] std::string name() const {
        std::string text;
        for (const std::filesystem::path& file : files)
            text += (text.empty() ? "" : "+") + file.string();
        return text;
    }

    bool operator==(const ReplayConfig&) const = default;
};

}  // namespace scipd::daemon
