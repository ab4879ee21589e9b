// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How well a room fits, as people and programs read it. Any thread; nothing shared.
#pragma once

#include <iosfwd>
#include <string>

#include <nlohmann/json.hpp>

#include "tools/scipfit/kind.h"
#include "tools/scipfit/room_fit.h"

namespace scipd::tools {

[[nodiscard]] nlohmann::ordered_json as_json(const Room& room);
/// Sentences, each on a line of its own.
[[nodiscard]] std::string as_text(const Room& room);

/// The scanner is at the origin, in the middle of the walls' height. `readings`: where they are
/// from; `model`: how its receiver tells what is brighter than white.
void write_room(const Room& room, const ScanTable& readings, const daemon::Model& model,
                std::ostream& out);

}  // namespace scipd::tools
