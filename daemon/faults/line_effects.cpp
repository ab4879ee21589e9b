// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A line that is late, stalls, joins or splits what is sent. cut_effects.cpp has those that end.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/config/numbers.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_values.h"

namespace scipd::daemon {
namespace {

using std::chrono::nanoseconds;

class Delay final : public FaultEffect {
  public:
    struct Members {
        std::optional<nanoseconds> delay;
        nanoseconds jitter{};
    };
    static constexpr Member<Members> members[] = {
        {"ms", read_as<&Members::delay, parse_link_delay>},
        {"jitter_ms", read_as<&Members::jitter, parse_link_delay>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        if (!members.delay) faults.add(fault, "needs ms, how late each message arrives");
    }

    explicit Delay(const Members& members) : members_(members) {}

    void line(LineState& line) const override {
        line.link.latency += *members_.delay;
        line.link.jitter += members_.jitter;
    }
    void bytes(protocol::Send& /*message*/, FaultScene& scene) override {
        scene.touched({.what = "a message is late"});
    }

  private:
    Members members_;
};

class Coalesce final : public FaultEffect {
  public:
    struct Members {
        std::optional<nanoseconds> time;
    };
    static constexpr Member<Members> members[] = {
        {"ms", read_as<&Members::time, parse_link_delay>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        if (!members.time) faults.add(fault, "needs ms, within which messages leave together");
    }

    explicit Coalesce(const Members& members) : members_(members) {}

    void line(LineState& line) const override {
        line.link.coalesce = std::max(line.link.coalesce, *members_.time);
    }
    void bytes(protocol::Send& /*message*/, FaultScene& scene) override {
        scene.touched({.what = "a message waits for more"});
    }

  private:
    Members members_;
};

constexpr int largest_message = 65'535;

sim::Expected<int> parse_place(std::string_view text) {
    return parse_whole(text, 1, largest_message);
}

/// Before which bytes of a message it is split: those that stand there, or each Nth.
struct SplitChoice {
    std::vector<int> at;
    int every = 0;
};

constexpr Member<SplitChoice> split_choice_members[] = {
    {"at", read_list<&SplitChoice::at, parse_place>},
    {"every", read_as<&SplitChoice::every, parse_place>},
};

class Split final : public FaultEffect {
  public:
    struct Members {
        SplitChoice bytes;
        nanoseconds pause = std::chrono::milliseconds(2);
    };
    static constexpr Member<Members> members[] = {
        {"bytes", read_map<&Members::bytes, split_choice_members>},
        {"pause_ms", read_as<&Members::pause, parse_link_delay>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        if (members.bytes.at.empty() == (members.bytes.every == 0))
            faults.add(fault, "needs either bytes: {at: [offsets]} or bytes: {every: N}");
    }

    explicit Split(const Members& members) : members_(members) {
        std::vector<int>& at = members_.bytes.at;
        std::ranges::sort(at);
        at.erase(std::unique(at.begin(), at.end()), at.end());
    }

    void line(LineState& line) const override {
        LinkConfig& link = line.link;
        const SplitChoice& choice = members_.bytes;
        link.split_at.insert(link.split_at.end(), choice.at.begin(), choice.at.end());
        const bool is_finer = link.split_bytes == 0 || choice.every < link.split_bytes;
        if (choice.every > 0 && is_finer) link.split_bytes = choice.every;
        link.split_pause = std::max(link.split_pause, members_.pause);
    }
    void bytes(protocol::Send& message, FaultScene& scene) override {
        std::vector<std::size_t> places = places_in(message.bytes.size());
        if (places.empty()) return;
        scene.touched({.what = "split into " + std::to_string(places.size() + 1) + " pieces",
                       .bytes = std::move(places)});
    }

  private:
    [[nodiscard]] std::vector<std::size_t> places_in(std::size_t size) const {
        std::vector<std::size_t> places;
        for (const int at : members_.bytes.at) {
            if (static_cast<std::size_t>(at) < size) places.push_back(static_cast<std::size_t>(at));
        }
        const auto every = static_cast<std::size_t>(members_.bytes.every);
        for (std::size_t at = every; every > 0 && at < size; at += every)
            places.push_back(at);
        return places;
    }

    Members members_;
};

class Stall final : public FaultEffect {
  public:
    using Members = NoMembers;
    static constexpr auto members = no_members;
    static void check(const Members& /*members*/, const sim::YamlField& /*fault*/,
                      sim::YamlFaults& /*faults*/) {}

    explicit Stall(const Members& /*members*/) {}

    void line(LineState& line) const override { line.stalled = true; }
    void bytes(protocol::Send& /*message*/, FaultScene& scene) override {
        scene.touched({.what = "a message waits"});
    }
};

constexpr FaultKind line_rows[] = {
    kind_of<Delay>("delay", "link", "messages arrive late, each way"),
    kind_of<Coalesce>("coalesce", "link", "messages leave together"),
    kind_of<Split>("split", "link", "messages leave in pieces"),
    kind_of<Stall>("stall", "link", "nothing leaves, and then all at once"),
};

}  // namespace

std::span<const FaultKind> line_kinds() {
    return line_rows;
}

}  // namespace scipd::daemon
