// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/logging.h"

#include <stdexcept>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace scipd::daemon {

void start_logging(const std::string& level) {
    const auto parsed = spdlog::level::from_str(level);
    if (parsed == spdlog::level::off && level != "off") {
        throw std::invalid_argument("there is no log level \"" + level +
                                    "\"; use trace, debug, info, warning, error, critical or off");
    }
    spdlog::set_default_logger(spdlog::stderr_color_mt("scipd"));
    spdlog::set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
    spdlog::set_level(parsed);
}

}  // namespace scipd::daemon
