// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The scanner under check: brings it into a state, asks it, and knows what it says of itself. It
// judges nothing. What goes wrong on the wire it throws as a protocol::client::Error, which makes
// the check fail. One thread.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/client/scan_message.h"
#include "tools/scipcat/check/answer.h"
#include "tools/scipcat/check/conversation.h"
#include "tools/scipcat/check/facts.h"
#include "tools/scipcat/check/finding.h"

namespace scipd::tools::checks {

class Subject {
  public:
    /// Connects, and finds out whether it speaks SCIP 1.1. Throws Error where nothing does that
    /// speaks SCIP.
    explicit Subject(Conversation::Place place);

    [[nodiscard]] Conversation& wire() { return wire_; }
    [[nodiscard]] const Facts& facts() const { return facts_; }
    [[nodiscard]] bool on_tty() const;
    /// RS would set the rate of its line back, and nothing could be understood any more.
    [[nodiscard]] bool on_serial_line() const;
    /// It woke up in SCIP 1.1, and still speaks it.
    [[nodiscard]] bool speaks_scip1() const { return speaks_scip1_; }

    /// Leaves SCIP 1.1 if need be, and asks what the scanner says of itself.
    void introduce();

    /// Begins a check: empties the transcript and lacking().
    void begin();
    /// Commands that this check has sent and the scanner does not know, in their order.
    [[nodiscard]] const std::vector<std::string>& lacking() const { return lacking_; }
    /// True if QT is answered. Drops the replies that a check left unread which broke off.
    [[nodiscard]] bool responds();

    /// Laser off, no stream, no adjust mode, and nothing that was sent before is still to come.
    void rest();
    /// Laser on.
    void measure();
    void adjust();
    /// Begins a stream, which must be accepted.
    void stream(const std::string& request);

    /// The reply to a request; scans and other messages that come first are passed over.
    [[nodiscard]] Answer ask(const std::string& request);
    /// As ask(); nothing if the reply does not come in time.
    [[nodiscard]] std::optional<Answer> try_ask(const std::string& request);
    /// As ask(), for bytes with line ends of their own and the echo that is waited for.
    [[nodiscard]] Answer ask(std::string_view bytes, const std::string& echo);
    /// The next message, which must come within `patience`, or as long as an answer may take.
    [[nodiscard]] Answer next(std::optional<std::chrono::milliseconds> patience = {});
    /// One scan of these steps: by GD with the laser on, or by MD where the scanner has no GD.
    [[nodiscard]] Answer scan(const std::string& steps, const std::string& cluster = "01");
    /// The next scan of a stream, and `count` of them.
    [[nodiscard]] Answer next_scan();
    [[nodiscard]] std::vector<protocol::client::ScanMessage> scans(int count);

    /// The clock, asked for in adjust mode. Afterwards the scanner is at rest.
    [[nodiscard]] std::uint32_t clock_ms();

    /// Whether a request is answered with this status.
    Finding expect(const std::string& request, std::string_view status);
    /// Passes if MD or its kin, here without its number of scans, brings `count` scans (at most 9)
    /// that count down.
    Finding expect_scans(const std::string& request, int count);
    /// Passes if GD is refused because the laser is off; without GD, if BM switches it on.
    Finding expect_laser_off();

    /// The digits of so many steps around the front.
    [[nodiscard]] std::string window(int steps = 1) const;
    /// The digits of all that it measures, or of as many as its line carries in a turn.
    [[nodiscard]] std::string all() const;
    /// So many turns.
    [[nodiscard]] std::chrono::milliseconds turns(double count) const;

  private:
    [[nodiscard]] std::optional<Answer> try_ask(std::string_view bytes, const std::string& echo);
    [[nodiscard]] std::string status_of_quit();
    void learn_texts();
    void learn_commands();
    [[nodiscard]] bool refuses(const std::string& command);
    void note_unknown(const std::string& request, std::string_view status);

    Conversation wire_;
    Facts facts_;
    std::vector<std::string> lacking_;
    bool speaks_scip1_ = false;
    double ms_per_byte_ = 0.0;
};

/// How much later `later` is, on a clock of 24 bits that wraps.
[[nodiscard]] constexpr int since(std::uint32_t earlier, std::uint32_t later) {
    constexpr std::uint32_t wrap = 1U << 24U;
    const std::uint32_t forward = (later - earlier) & (wrap - 1);
    return forward < wrap / 2 ? static_cast<int>(forward) : -static_cast<int>(wrap - forward);
}

}  // namespace scipd::tools::checks
