// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How many bytes there are in messages that are on their way to clients. A message counts from when
// it is made until the last client has it, and once, however many get it. Lives on the I/O thread.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

namespace scipd::daemon {

class Unsent {
  public:
    using Message = std::shared_ptr<const std::string>;

    [[nodiscard]] Message hold(std::string text) {
        *bytes_ += text.size();
        return {new const std::string(std::move(text)),
                [bytes = bytes_](const std::string* message) {
                    *bytes -= message->size();
                    delete message;
                }};
    }
    [[nodiscard]] std::size_t bytes() const { return *bytes_; }

  private:
    /// Connections may end later.
    std::shared_ptr<std::size_t> bytes_ = std::make_shared<std::size_t>(0);
};

}  // namespace scipd::daemon
