// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What the log warns of while this lives, a line each.
#pragma once

#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

namespace scipd::tests {

class Warnings {
  public:
    Warnings() {
        const auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(lines_);
        auto logger = std::make_shared<spdlog::logger>("warnings", sink);
        logger->set_level(spdlog::level::warn);
        logger->set_pattern("%v");
        spdlog::set_default_logger(std::move(logger));
    }
    ~Warnings() { spdlog::set_default_logger(before_); }
    Warnings(const Warnings&) = delete;
    Warnings& operator=(const Warnings&) = delete;

    [[nodiscard]] std::string text() const { return lines_.str(); }
    void clear() { lines_.str({}); }

  private:
    std::ostringstream lines_;
    std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
};

}  // namespace scipd::tests
