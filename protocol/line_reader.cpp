// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/line_reader.h"

#include <algorithm>
#include <utility>

namespace scipd::protocol {

std::optional<Line> LineReader::next(std::string_view& bytes) {
    while (!bytes.empty()) {
        if (line_.text.empty())
            bytes.remove_prefix(std::min(bytes.find_first_not_of('\0'), bytes.size()));
        const std::size_t end = std::min(bytes.find_first_of("\r\n"), bytes.size());
        const std::size_t room = longest_ - line_.text.size();
        line_.text.append(bytes.substr(0, std::min(end, room)));
        line_.overlong |= end > room;

        const bool terminated = end < bytes.size();
        bytes.remove_prefix(terminated ? end + 1 : end);
        if (terminated && !line_.text.empty()) return std::exchange(line_, {});
    }
    return std::nullopt;
}

}  // namespace scipd::protocol
