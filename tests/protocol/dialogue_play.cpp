// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <optional>

#include "protocol/ideal.h"
#include "tests/protocol/dialogue.h"
#include "tests/protocol/shell.h"
#include "tests/protocol/shown.h"

namespace scipd::protocol {
namespace {

/// Takes a line off the front, without its end; the rest where it has none.
std::string_view take_line(std::string_view& bytes) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    return line;
}

DeviceState powered_up(const Dialogue& dialogue, const DeviceProfile& profile) {
    DeviceState device;
    if (dialogue.boot) device.boot(Uptime::zero(), profile.boot_time);
    if (dialogue.scip1) device.power_up_in_scip1(Uptime::zero());
    device.set_clock(Uptime::zero(), dialogue.clock);
    return device;
}

class Player {
  public:
    Player(const Dialogue& dialogue, const DeviceProfile& profile)
        : dialogue_(dialogue), shell_(profile, 1, powered_up(dialogue, profile)) {
        shell_.distance = [this](int step) { return seen(false, step); };
        shell_.intensity = [this](int step) { return seen(true, step); };
    }

    std::string play() {
        for (const Step& step : dialogue_.steps) {
            const std::string fault =
                std::visit([&](const auto& what) { return act(what, step.line); }, step.what);
            if (!fault.empty()) return fault;
        }
        return unasked(dialogue_.steps.empty() ? 1 : dialogue_.steps.back().line);
    }

  private:
    std::uint32_t seen(bool intensity, int step) const {
        for (auto sight = sights_.rbegin(); sight != sights_.rend(); ++sight) {
            if (sight->intensity == intensity && sight->first <= step && step <= sight->last)
                return sight->value(step);
        }
        return 0;
    }

    StepEchoes echoes_at(int step) const {
        for (auto echoes = several_.rbegin(); echoes != several_.rend(); ++echoes) {
            if (echoes->first <= step && step <= echoes->last) return echoes->echoes;
        }
        return {.echo = {Echo{seen(false, step), seen(true, step)}}};
    }

    [[nodiscard]] std::string fault(int line, const std::string& what) const {
        return dialogue_.name + ":" + std::to_string(line) + ": " + what;
    }

    std::string unasked(int line) {
        for (const Sent& sent : shell_.take_sent())
            return fault(line, "at " + milliseconds(sent.at) +
                                   " nothing is expected, but there came " + shown(sent.bytes));
        if (!shell_.take_other_actions().empty())
            return fault(line, "at " + milliseconds(shell_.now()) +
                                   " the link drops or changes its rate, which nothing said");
        return {};
    }

    std::string act(const Sight& sight, int) {
        sights_.push_back(sight);
        return {};
    }

    std::string act(const Echoes& echoes, int) {
        several_.push_back(echoes);
        shell_.echoes = [this](int step) { return echoes_at(step); };
        return {};
    }

    std::string act(const Wait& wait, int line) {
        if (wait.until <= shell_.now())
            return fault(line, "it is " + milliseconds(shell_.now()) + " already");
        if (std::string early = unasked(line); !early.empty()) return early;
        shell_.advance_to(wait.until - Uptime(1));
        if (std::string early = unasked(line); !early.empty()) return early;
        shell_.advance_to(wait.until);
        return {};
    }

    std::string act(const Say& say, int line) {
        std::string early = unasked(line);
        shell_.receive(say.bytes);
        return early;
    }

    std::string act(const Hear& hear, int) {
        const std::string all = shell_.take_text();
        std::string_view expected = hear.bytes;
        std::string_view heard = all;
        for (const int line : hear.lines) {
            const std::string_view wanted = take_line(expected);
            if (heard.empty())
                return fault(line, "expected " + shown(wanted) + ", but nothing more came");
            const std::string_view got = take_line(heard);
            if (got != wanted)
                return fault(line, "expected " + shown(wanted) + ", but there came " + shown(got));
        }
        if (all != hear.bytes)
            return fault(hear.lines.back(), "more came than expected: " + shown(heard));
        return {};
    }

    std::string act(const Hang&, int line) {
        std::string early = unasked(line);
        shell_.session().close();
        return early;
    }

    std::string act(const Expect& expect, int line) {
        const std::vector<Action> actions = shell_.take_other_actions();
        if (actions == std::vector<Action>{expect.action}) return {};
        return fault(line, "the link does " + std::to_string(actions.size()) +
                               " things, which are not just this");
    }

    std::string act(const Suffer& suffer, int line) {
        std::string early = unasked(line);
        shell_.device().set_trouble(suffer.trouble);
        return early;
    }

    std::string act(const IoWords& io, int) {
        shell_.device().io() = io;
        return {};
    }

    const Dialogue& dialogue_;
    Shell shell_;
    std::vector<Sight> sights_;
    std::vector<Echoes> several_;
};

}  // namespace

std::string play(const Dialogue& dialogue, const DeviceProfile& profile) {
    DeviceProfile played = profile;
    played.io_lines |= dialogue.io_lines;
    if (dialogue.ideal) {  // but for what some of them are about
        played = ideal(played);
        played.boot_time = profile.boot_time;
        played.wake_time = profile.wake_time;
    }
    return Player(dialogue, played).play();
}

}  // namespace scipd::protocol
