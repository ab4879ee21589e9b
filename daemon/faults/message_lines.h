// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Where the sums of a finished message are. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace scipd::daemon {

/// Which sums of a message.
enum class SumsOf {
    status,  ///< that of the second line
    data,    ///< those of the lines of a scan or a time
    text,    ///< those of VV, PP and II
    all,
};
inline constexpr std::pair<std::string_view, SumsOf> sums_choices[] = {{"status", SumsOf::status},
                                                                       {"data", SumsOf::data},
                                                                       {"text", SumsOf::text},
                                                                       {"all", SumsOf::all}};

/// The offsets of the sum characters, in order.
[[nodiscard]] std::vector<std::size_t> places_of_sums(std::string_view message, SumsOf of);

}  // namespace scipd::daemon
