// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/command.h"
#include "protocol/device_profile.h"
#include "protocol/line_reader.h"
#include "protocol/status.h"

namespace scipd::protocol {

/// One line of a client, taken apart: CODE PARAMETERS [;STRING].
struct Request {
    std::string echo;                  ///< the whole line, as every reply to it begins
    const Command* command = nullptr;  ///< null: this model does not know it
    std::size_t parameters_length = 0;
    std::optional<Status>
        fault;  ///< wrong whatever the command and the state: an overlong line, a bad string

    [[nodiscard]] std::string_view parameters() const {
        return std::string_view(echo).substr(command->code.size(), parameters_length);
    }
};

[[nodiscard]] Request parse_request(Line line, const DeviceProfile& profile);

}  // namespace scipd::protocol
