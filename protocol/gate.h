// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whether a command is carried out, by family and state: the right half of the command table. The
// text of a row is read when it is compiled.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/family.h"
#include "protocol/state.h"
#include "protocol/status.h"

namespace scipd::protocol {

/// What one family answers in each state instead of carrying a command out.
class Gate {
  public:
    static constexpr std::size_t text_length = 3 * state_count - 1;

    /// One status per state in the order of State, "--" where the command is carried out, as in
    /// "10 -- -- 0E -- 50 --". Blanks: the family does not know the command.
    consteval explicit Gate(std::string_view text) : known_(text[0] != ' ') {
        if (text.size() != text_length) throw "a gate has one status for each state";
        for (std::size_t i = 0; i < state_count; ++i) {
            const char code[3] = {text[3 * i], text[3 * i + 1], '\0'};
            if ((code[0] == ' ') == known_) throw "a family knows a command in all states or none";
            if (code[0] != '-' && known_) refusals_[i] = Status(code);
        }
    }

    [[nodiscard]] constexpr bool known() const { return known_; }
    [[nodiscard]] constexpr std::optional<Status> refusal(State state) const {
        return refusals_[static_cast<std::size_t>(state)];
    }

  private:
    bool known_;
    std::array<std::optional<Status>, state_count> refusals_{};
};

/// The gates of one command, a family each.
class Gates {
  public:
    static constexpr std::size_t text_length = family_count * (Gate::text_length + 3) - 3;

    /// The texts of the gates in the order of Family, " | " between them. Implicit: the rows of the
    /// table are literals.
    // NOLINTNEXTLINE(google-explicit-constructor)
    consteval Gates(const char (&row)[text_length + 1])
        : gates_{Gate(cell(row, 0)), Gate(cell(row, 1)), Gate(cell(row, 2)), Gate(cell(row, 3))} {}

    [[nodiscard]] constexpr const Gate& operator[](Family family) const {
        return gates_[static_cast<std::size_t>(family)];
    }
    [[nodiscard]] constexpr auto begin() const { return gates_.begin(); }
    [[nodiscard]] constexpr auto end() const { return gates_.end(); }

  private:
    static constexpr std::string_view cell(std::string_view row, std::size_t number) {
        return row.substr(number * (Gate::text_length + 3), Gate::text_length);
    }

    std::array<Gate, family_count> gates_;
};

/// A single cell of the command table in which a model differs from its family.
struct Deviation {
    std::string command;  ///< its code
    State state = State::standby;
    std::optional<Status> status;  ///< nothing: the command is carried out

    bool operator==(const Deviation&) const = default;
};

}  // namespace scipd::protocol
