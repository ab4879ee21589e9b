// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One client comes after the other, and two at a time.
#include <optional>
#include <string>

#include "protocol/client/error.h"
#include "tools/scipcat/check/check_table.h"

namespace scipd::tools::checks {
namespace {

using std::chrono::milliseconds;

constexpr std::string_view notes = "notes of Hokuyo and MATLAB: close other programs first";
constexpr std::string_view simulated = "urg_stamped's simulator";

/// How long a scanner may take to see that a client has left.
constexpr milliseconds parting{2000};

/// A second client, if it gets that far: a scanner may also refuse it, or hang up.
class Visitor {
  public:
    explicit Visitor(const Conversation::Place& place) {
        try {
            wire_.emplace(place);
        } catch (const protocol::client::Error&) {
        }
    }
    /// What VV brings; empty: nothing, in this time.
    [[nodiscard]] std::string version(milliseconds patience) {
        try {
            if (!wire_) return "";
            if (!asked_) wire_->send("VV\n");
            asked_ = true;
            return wire_->message(patience).value_or("");
        } catch (const protocol::client::Error&) {
            wire_.reset();
            return "";
        }
    }

  private:
    std::optional<Conversation> wire_;
    bool asked_ = false;
};

Finding on_network(Subject& subject, Finding (*look)(Subject&)) {
    if (subject.on_tty()) return not_applicable("a tty has no second client");
    subject.rest();
    return look(subject);
}

Finding first_goes_on(Subject& subject) {
    const std::string version = subject.ask("VV").raw;
    Visitor visitor(subject.wire().place());
    (void)visitor.version(milliseconds(150));
    subject.stream("MD" + subject.window() + "01000");
    (void)subject.scans(3);
    (void)subject.ask("QT");
    return require(subject.ask("VV").raw == version, "the first client gets another answer to VV");
}

Finding second_waits(Subject& subject) {
    Visitor visitor(subject.wire().place());
    const std::string version = visitor.version(milliseconds(400));
    return require(version.empty(), "a second client is answered while the first is there");
}

Finding second_follows(Subject& subject) {
    const std::string version = subject.ask("VV").raw;
    Visitor waiting(subject.wire().place());
    (void)waiting.version(milliseconds(50));
    subject.wire().hang_up();
    if (waiting.version(parting) == version) return pass();
    Visitor next(subject.wire().place());
    return require(next.version(parting) == version, "nobody is served after the first has left");
}

Finding ends_with_client(Subject& subject) {
    subject.stream("MD" + subject.window() + "01000");
    (void)subject.scans(2);
    subject.wire().reconnect();
    if (!subject.wire().quiet_for(subject.turns(4)))
        return fail("the stream of a client who left goes on");
    return subject.expect_laser_off();
}

Finding again_and_again(Subject& subject) {
    const std::string version = subject.ask("VV").raw;
    for (int i = 0; i < 5; ++i) {
        subject.wire().reconnect();
        if (subject.ask("VV").raw != version) return fail("VV gets another answer");
    }
    return pass();
}

Finding half_is_forgotten(Subject& subject) {
    const std::string version = subject.ask("VV").raw;
    subject.wire().send("V");
    (void)subject.wire().listen(milliseconds(50));
    subject.wire().reconnect();
    return require(subject.ask("VV").raw == version, "VV gets another answer");
}

constexpr Check table_of_two_clients[] = {
    {"12.1", "the first client is served while a second knocks", notes,
     [](Subject& subject) { return on_network(subject, first_goes_on); }},
    {"12.2", "a second client is not answered while the first is there", notes,
     [](Subject& subject) { return on_network(subject, second_waits); }},
    {"12.3", "when the first leaves, the next one is served", simulated,
     [](Subject& subject) { return on_network(subject, second_follows); }},
    {"12.4", "a stream ends with its client, and the laser goes off", simulated,
     [](Subject& subject) { return on_network(subject, ends_with_client); }},
    {"12.5", "five clients can come right after each other", simulated,
     [](Subject& subject) { return on_network(subject, again_and_again); }},
    {"12.6", "half a request of a client who left is forgotten", "none: robustness",
     [](Subject& subject) { return on_network(subject, half_is_forgotten); }},
};

}  // namespace

std::span<const Check> two_client_checks() {
    return table_of_two_clients;
}

}  // namespace scipd::tools::checks
