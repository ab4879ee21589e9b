// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Makes scripts up: mostly what clients really say, in every state a device can be in, with
// malformed requests and bytes of no meaning between. The same choices make the same script.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/device_profile.h"
#include "tests/protocol/script.h"

namespace scipd::protocol {

/// Where decisions come from: a seed, or the bytes of a fuzzer.
class Choices {
  public:
    explicit Choices(std::uint64_t seed) : state_(seed) {}
    /// Behind the last of them everything is 0. They must outlive it.
    explicit Choices(std::string_view bytes) : bytes_(bytes), from_bytes_(true) {}

    /// 0 to `count` - 1.
    [[nodiscard]] std::uint32_t below(std::uint32_t count);
    /// Once in so many times.
    [[nodiscard]] bool one_in(std::uint32_t times) { return below(times) == times - 1; }
    [[nodiscard]] int between(int low, int high) {
        return low + static_cast<int>(below(static_cast<std::uint32_t>(high - low + 1)));
    }
    template <typename Range>
    [[nodiscard]] const auto& of(const Range& range) {
        return range[below(static_cast<std::uint32_t>(std::size(range)))];
    }
    /// The bytes are used up; never with a seed.
    [[nodiscard]] bool exhausted() const { return from_bytes_ && bytes_.empty(); }

  private:
    std::uint64_t state_ = 0;
    std::string_view bytes_;
    bool from_bytes_ = false;
};

[[nodiscard]] Script make_script(Choices& choices, const DeviceProfile& profile, int clients);

/// What a client of this model may say: a request, most often whole and right, or anything.
[[nodiscard]] std::string make_saying(Choices& choices, const DeviceProfile& profile);

/// The script with every saying cut into pieces that come one after the other, some of them
/// earlier, and with every wait cut into several.
[[nodiscard]] Script in_fragments(const Script& script, Choices& choices);

}  // namespace scipd::protocol
