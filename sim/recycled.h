// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Arrays of a scan, used again by the next one. To take them from the allocator and to clear them
// costs a tenth of a revolution, and those that were given back last are still in the processor's
// cache. Each thread has its own few, wherever an array comes from.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace scipd::sim {

template <class Thing>
class Recycled {
  public:
    /// As many things. What they are is not said.
    [[nodiscard]] static std::vector<Thing> take(std::size_t count) {
        for (std::vector<Thing>& array : arrays()) {
            // Small arrays must not come to hold the memory of large ones.
            if (array.capacity() < count || array.capacity() > 2 * count) continue;
            std::vector<Thing> taken = std::exchange(array, {});
            taken.resize(count);
            return taken;
        }
        return std::vector<Thing>(count);
    }

    static void give(std::vector<Thing> array) {
        const std::size_t bytes = array.capacity() * sizeof(Thing);
        if (bytes < worth_bytes || bytes > most_bytes) return;
        for (std::vector<Thing>& place : arrays()) {
            if (place.capacity() > 0) continue;
            place = std::move(array);
            return;
        }
    }

  private:
    static constexpr std::size_t worth_bytes = 1U << 12U;
    static constexpr std::size_t most_bytes = 1U << 18U;
    using Arrays = std::array<std::vector<Thing>, 4>;

    static Arrays& arrays() {
        thread_local Arrays of_this_thread;
        return of_this_thread;
    }
};

}  // namespace scipd::sim
