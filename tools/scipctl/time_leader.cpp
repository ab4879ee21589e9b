// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/time_leader.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <optional>
#include <set>
#include <vector>

#include "daemon/fleet/pose_frame.h"
#include "daemon/fleet/step.h"
#include "tools/control_client.h"
#include "tools/scipctl/pose_broadcast.h"

namespace scipd::tools {
namespace {

using daemon::Topic;

class TimeLeader {
  public:
    TimeLeader(const BrokerOptions& options, double patience_s)
        : session_(options), patience_(std::int64_t(patience_s * 1000.0)) {
        (void)session_.kept();
        session_.listen_to_acks();
    }

    /// Lines of a later stamp send the step before.
    void take(const sim::PoseLine& line) {
        if (time_ && *line.time != *time_) send();
        time_ = line.time;
        daemon::append_line(lines_, line);
    }

    /// Returns when all who take part have done it.
    void send() {
        if (!time_) return;
        ++number_;
        session_.publish(Topic::Kind::time, {},
                         daemon::step_head(number_, *time_, session_.name()) + lines_);
        lines_.clear();
        if (session_.link().run_until([&] { return missing().empty(); }, patience_)) return;
        if (!session_.link().connected())
            throw ControlError(0, "the broker is lost: " + session_.link().trouble());
        for (const std::string& name : missing()) {
            std::cerr << "daemon " << name << " does not acknowledge step " << number_
                      << "; it is left out\n";
            left_out_.insert(name);
        }
    }

  private:
    /// Those who have not done the step. Who is lost, or on the wall clock, takes no part.
    std::vector<std::string> missing() {
        std::vector<std::string> names;
        for (const auto& [name, note] : session_.kept_now().daemons) {
            tell_if_lost(name, note);
            if (note.lost || !note.in_steps || left_out_.contains(name)) continue;
            if (session_.acknowledged(name) < number_) names.push_back(name);
        }
        return names;
    }

    void tell_if_lost(const std::string& name, const daemon::DaemonNote& note) {
        if (!note.lost) {
            lost_.erase(name);
        } else if (lost_.insert(name).second && number_ > 1) {
            std::cerr << "daemon " << name << " is lost; it is left out\n";
        }
    }

    BrokerSession session_;
    const std::chrono::milliseconds patience_;
    int number_ = 0;
    std::optional<sim::Time> time_;
    std::string lines_;
    std::set<std::string> left_out_;
    std::set<std::string> lost_;
};

}  // namespace

void lead_time(const BrokerOptions& options, const std::string& robot, double patience_s,
               std::istream& lines) {
    TimeLeader leader(options, patience_s);
    for_each_line_for_many(lines, robot, [&](const sim::PoseLine& line) -> sim::Expected<> {
        if (!line.time) return sim::refuse("t is missing: time is that of the poses");
        leader.take(line);
        return {};
    });
    leader.send();
}

}  // namespace scipd::tools
