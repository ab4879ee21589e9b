// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A dialogue: a text file that says what a client sends, when, and every byte that the scanner
// answers. The format is described in dialogues/README.md.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/action.h"
#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/scan_view.h"
#include "protocol/uptime.h"

namespace scipd::protocol {

/// What the scanner sees from here on: base + slope * step, over a run of steps.
struct Sight {
    bool intensity = false;  ///< else distance
    int first = 0;
    int last = 0;
    std::int64_t base = 0;
    std::int64_t slope = 0;

    [[nodiscard]] std::uint32_t value(int step) const {
        return static_cast<std::uint32_t>(base + slope * step);
    }
};

/// All that comes back from a step, near to far, from here on.
struct Echoes {
    int first = 0;
    int last = 0;
    StepEchoes echoes;
};

struct Wait {
    Uptime until{};
};

struct Say {
    std::string bytes;
};

/// All that is sent at the present instant: no byte more, no byte less.
struct Hear {
    std::string bytes;
    std::vector<int> lines;  ///< of the file, one for each line of the bytes
};

struct Hang {};

/// What the shell is asked to do besides sending: a part of what happens at the present instant.
struct Expect {
    Action action;
};

/// Something happens to the device.
struct Suffer {
    Trouble trouble = Trouble::none;
};

struct Step {
    int line = 0;
    std::variant<Sight, Echoes, Wait, Say, Hear, Hang, Expect, Suffer, IoWords> what;
};

struct Dialogue {
    std::string name;    ///< of the file
    std::string source;  ///< where its bytes are known from
    std::string model;
    bool ideal = false;     ///< no reply grid
    bool io_lines = false;  ///< the model has GF GG MF MG, which none of the real ones has
    bool boot = false;      ///< power comes at 0; else the device is up
    bool scip1 = false;     ///< it is up and speaks SCIP 1.1
    std::chrono::milliseconds clock{};  ///< what its clock shows at 0
    std::vector<Step> steps;
};

/// Throws std::invalid_argument, naming file and line, on what it does not understand and on a
/// first line that does not cite a source.
[[nodiscard]] Dialogue parse_dialogue(const std::string& name, std::string_view text);
[[nodiscard]] Dialogue read_dialogue(const std::filesystem::path& file);

/// Empty where the device did as the dialogue says, else FILE:LINE and the first difference.
[[nodiscard]] std::string play(const Dialogue& dialogue, const DeviceProfile& profile);

}  // namespace scipd::protocol
