// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What clients may at most, as a table. Each limit has a key in the configuration, by which it is
// also counted. Values; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace scipd::daemon {

/// In the order of the table.
enum class Limit {
    scip_line_bytes,
    scanner_connections,
    http_connections,
    control_connections,
    http_header_bytes,
    http_body_bytes,
    websocket_messages_per_s,
    websocket_queue_bytes,
    added_models,
    added_triangles,
    poses_per_s,
};

struct LimitRow {
    std::string_view key;
    int usual;
    int least;
    int most;
    std::string_view beyond;  ///< what is told of more; @ is the limit
};

// None hinders who means well. The longest request of SCIP has 32 bytes. A scanner serves one
// client, and a few wait. A driver, a viewer or a simulator has a connection or two. A hundred
// robots send 100'000 poses a second, if each has 1000. A body may have a mesh of 6 MB, as people
// drop them on the page. A world has 20 million triangles at most by itself.
inline constexpr std::array<LimitRow, 11> limit_table{{
    {"scip_line_bytes", 128, 32, 4096, "a request has more than @ bytes"},
    {"scanner_connections", 6, 1, 10'000, "more than @ clients are connected or wait"},
    {"http_connections", 256, 1, 10'000, "more than @ clients are connected"},
    {"control_connections", 256, 1, 10'000, "more than @ clients are connected"},
    {"http_header_bytes", 16'384, 256, 1'000'000,
     "the header, or what frames a chunk of the body, is larger than @ bytes"},
    {"http_body_bytes", 8'388'608, 1, 1'000'000'000, "the body or message is larger than @ bytes"},
    {"websocket_messages_per_s", 100'000, 1, 1'000'000, "more than @ messages a second"},
    {"websocket_queue_bytes", 67'108'864, 1, 1'000'000'000, "more than @ bytes wait to be read"},
    {"added_models", 10'000, 1, 1'000'000, "more than @ models would have been added"},
    {"added_triangles", 20'000'000, 1, 1'000'000'000,
     "the models that have been added would have more than @ triangles"},
    {"poses_per_s", 100'000, 1, 10'000'000, "more than @ poses a second of one sender"},
}};

constexpr std::size_t place_of(Limit limit) {
    return static_cast<std::size_t>(limit);
}

struct LimitValues {
    constexpr LimitValues() {
        for (std::size_t i = 0; i < limit_table.size(); ++i)
            values[i] = limit_table[i].usual;
    }

    constexpr int& operator[](Limit limit) { return values[place_of(limit)]; }
    constexpr int operator[](Limit limit) const { return values[place_of(limit)]; }
    bool operator==(const LimitValues&) const = default;

    std::array<int, limit_table.size()> values{};  ///< in the order of the table
};

/// What is told of more than this: what is too much, and which key allows more.
std::string beyond(Limit limit, int value);

}  // namespace scipd::daemon
