// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Keeps what a bus says. Any thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "daemon/bridges/bus.h"

namespace scipd::tests {

class Kept : public daemon::BusListener {
  public:
    void hear(daemon::Heard message) override {
        keep([&] { messages_.push_back(std::move(message)); });
    }
    void refuse(std::string why) override {
        keep([&] { refusals_.push_back(std::move(why)); });
    }
    void tell_trouble(std::string trouble) override {
        keep([&] { trouble_ = std::move(trouble); });
    }

    [[nodiscard]] std::vector<daemon::Heard> messages() const {
        const std::scoped_lock lock(mutex_);
        return messages_;
    }
    [[nodiscard]] std::vector<std::string> refusals() const {
        const std::scoped_lock lock(mutex_);
        return refusals_;
    }
    [[nodiscard]] std::string trouble() const {
        const std::scoped_lock lock(mutex_);
        return trouble_;
    }

    /// Waits until so many have come.
    [[nodiscard]] bool wait_for(std::size_t messages, std::size_t refusals = 0) {
        return wait([&] { return messages_.size() >= messages && refusals_.size() >= refusals; });
    }
    [[nodiscard]] bool wait_for_trouble() {
        return wait([&] { return !trouble_.empty(); });
    }

  private:
    void keep(const std::function<void()>& change) {
        const std::scoped_lock lock(mutex_);
        change();
        changed_.notify_all();
    }
    [[nodiscard]] bool wait(const std::function<bool()>& done) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(20), done);
    }

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<daemon::Heard> messages_;
    std::vector<std::string> refusals_;
    std::string trouble_;
};

}  // namespace scipd::tests
