// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipfit/room_report.h"

#include "tools/formatted.h"

namespace scipd::tools {

nlohmann::ordered_json as_json(const Room& room) {
    const RoomCheck& check = room.check;
    return {{"walls", room.walls.size()},
            {"beams", check.beams},
            {"explained", check.explained},
            {"rms_mm", check.rms_mm},
            {"worst_of_95_mm", check.worst_of_95_mm},
            {"stations", room.stations}};
}

std::string as_text(const Room& room) {
    const RoomCheck& check = room.check;
    std::string text = formatted(
        "%zu walls explain %zu of %zu beams, %.1f mm around them (rms), 95 %% within %.1f mm\n",
        room.walls.size(), check.explained, check.beams, check.rms_mm, check.worst_of_95_mm);
    if (check.explained < check.beams)
        text +=
            formatted("%zu beams see no wall and are left out\n", check.beams - check.explained);
    if (room.stations > 1)
        text += formatted("the scanner is stationary at %zu places; the first is used\n",
                          room.stations);
    return text;
}

}  // namespace scipd::tools
