// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/wire/wire_log.h"

#include <chrono>
#include <memory>
#include <utility>

#include <spdlog/spdlog.h>

#include "daemon/limits/throttle.h"

namespace scipd::daemon {
namespace {

class WireLog {
  public:
    explicit WireLog(std::string scanner) : scanner_(std::move(scanner)) {}

    void take(const WireEntry& entry) {
        const auto level = entry.scan ? spdlog::level::trace : spdlog::level::debug;
        if (!spdlog::should_log(level)) return;
        if (const auto suppressed = throttle_.admit(std::chrono::steady_clock::now()))
            spdlog::log(level, "{}: {}{}", scanner_, line_of(entry), *suppressed);
    }

  private:
    std::string scanner_;
    Throttle throttle_{500};
};

}  // namespace

TakeEntry wire_log(const std::string& scanner) {
    if (!spdlog::should_log(spdlog::level::debug)) return nullptr;
    const auto log = std::make_shared<WireLog>(scanner);
    return [log](const WireEntry& entry) { log->take(entry); };
}

std::string line_of(const WireEntry& entry) {
    std::string text = entry.client;
    if (entry.from_client) return text + " hears " + entry.line + ": " + entry.means;
    if (!entry.line.empty()) text += " answers " + entry.line;
    if (!entry.status.empty()) text += " with " + entry.status;
    return text + ": " + (entry.explains.empty() ? entry.means : entry.explains);
}

}  // namespace scipd::daemon
