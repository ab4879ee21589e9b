// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A request as a client sends it, taken apart: CODE PARAMETERS [;STRING]. Each line is parsed once,
// when it comes in; what waits is kept as a Request.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/command.h"
#include "protocol/device_profile.h"
#include "protocol/line_reader.h"
#include "protocol/status.h"

namespace scipd::protocol {

struct Request {
    std::string echo;                  ///< the whole line, as every reply to it begins
    const Command* command = nullptr;  ///< null: this model does not know it
    std::size_t parameters_length = 0;
    /// Wrong whatever the command and the state are: an overlong line, a bad string.
    std::optional<Status> fault;

    [[nodiscard]] std::string_view parameters() const {
        return std::string_view(echo).substr(command->code.size(), parameters_length);
    }
};

[[nodiscard]] Request parse_request(Line line, const DeviceProfile& profile);

}  // namespace scipd::protocol
