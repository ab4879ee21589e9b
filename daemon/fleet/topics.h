// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The topics of a shared world, and the identity of this daemon on them. Values; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace scipd::daemon {

std::string host_name();

/// HOST-PID, for a daemon that nobody has given a name.
std::string usual_name();

/// Another one each time: no two clients of a broker may have the same, since it would throw the
/// older one out.
std::string new_instance();

/// What a message is about.
struct Topic {
    enum class Kind { poses, places, model, scene, daemon, marker, time, ack };
    Kind kind = Kind::poses;
    std::string name;  ///< of the sender, the model, the daemon; else empty

    bool operator==(const Topic&) const = default;
};

class Topics {
  public:
    /// The world's name is one that parse_world_name() takes.
    explicit Topics(std::string_view world) : root_("scipd/" + std::string(world) + "/") {}

    /// Any characters of a name that topics cannot hold are written as %XX.
    [[nodiscard]] std::string of(Topic::Kind kind, std::string_view name = {}) const;
    /// All topics of this kind.
    [[nodiscard]] std::string all(Topic::Kind kind) const;
    /// Nothing where it is none of this world's.
    [[nodiscard]] std::optional<Topic> read(std::string_view topic) const;

  private:
    std::string root_;
};

}  // namespace scipd::daemon
