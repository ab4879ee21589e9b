// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Scans that come twice or in the wrong order.
#include <map>
#include <utility>
#include <vector>

#include "daemon/config/numbers.h"
#include "daemon/faults/fault_kind.h"

namespace scipd::daemon {
namespace {

using protocol::Send;
using protocol::Speaker;

struct RateMembers {
    double rate = 1.0;
};
constexpr Member<RateMembers> rate_members[] = {
    {"rate", read_as<&RateMembers::rate, parse_share>},
};

class RepeatedScans : public FaultEffect {
  public:
    using Members = RateMembers;
    static constexpr auto& members = rate_members;
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit RepeatedScans(const Members& members) : members_(members) {}

    void messages(const Speaker&, std::vector<Send>& leaving, FaultScene& scene) override {
        if (leaving.size() != 1 || leaving[0].kind != Send::Kind::scan) return;
        if (scene.chance(0) >= members_.rate) return;
        leaving.push_back(leaving[0]);
        scene.touched({.what = "the scan sent twice"});
    }

  private:
    Members members_;
};

/// A scan waits for the next one, which leaves first.
class ReorderedScans : public FaultEffect {
  public:
    using Members = RateMembers;
    static constexpr auto& members = rate_members;
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit ReorderedScans(const Members& members) : members_(members) {}

    void messages(const Speaker& from, std::vector<Send>& leaving, FaultScene& scene) override {
        if (leaving.size() != 1) return;
        const auto held = held_.find(&from);
        if (held != held_.end()) {
            // A reply must not overtake: the stream may end with it.
            const bool scan = leaving[0].kind == Send::Kind::scan;
            leaving.insert(scan ? leaving.end() : leaving.begin(), std::move(held->second));
            held_.erase(held);
        } else if (!ended_ && leaving[0].kind == Send::Kind::scan &&
                   scene.chance(0) < members_.rate) {
            held_.emplace(&from, std::move(leaving[0]));
            leaving.clear();
            scene.touched({.what = "the scan sent after the next one"});
        }
    }

    void forget(const Speaker& session) override { held_.erase(&session); }
    void end(FaultScene&) override { ended_ = true; }
    [[nodiscard]] bool holds() const override { return !held_.empty(); }

  private:
    Members members_;
    std::map<const Speaker*, Send> held_;
    bool ended_ = false;
};

}  // namespace

std::span<const FaultKind> repeat_kinds() {
    static constexpr FaultKind kinds[] = {
        kind_of<RepeatedScans>("repeat", "scans", "scans come twice"),
        kind_of<ReorderedScans>("reorder", "scans", "scans change places with the next one"),
    };
    return kinds;
}

}  // namespace scipd::daemon
