// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Who sees every measurement of a sensor, whatever its clients want. Lives where the sensor lives.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>

namespace scipd::daemon {

enum class WatchedBy {
    stream,  ///< those who get all of them
    view,    ///< pages, which get some
    recordings,
};

template <class Record>
class Watchers {
  public:
    using Watcher = std::function<void(const Record&)>;

    /// Null: nobody.
    void set(WatchedBy who, Watcher watcher) {
        watchers_[static_cast<std::size_t>(who)] = std::move(watcher);
    }
    [[nodiscard]] bool any() const {
        return std::ranges::any_of(watchers_, [](const Watcher& one) { return one != nullptr; });
    }
    void tell(const Record& record) const {
        for (const Watcher& watcher : watchers_) {
            if (watcher) watcher(record);
        }
    }

  private:
    std::array<Watcher, 3> watchers_;
};

}  // namespace scipd::daemon
