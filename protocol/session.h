// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One conversation with one client, as a machine without sockets, threads or a clock: bytes,
// finished scans and the time go in, actions come out. Its shell reads, waits and writes, and
// decides nothing. All sessions of a device live on one thread and share its DeviceState, which
// must outlive them.
//
//   bytes ─► receive() ─► requests wait for their tick ─► advance() ─► replies ─► next_action()
//                                 turn_complete() ─► take() ─► scans ─────────────┘
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/action.h"
#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/line_reader.h"
#include "protocol/refusal.h"
#include "protocol/request.h"
#include "protocol/scan_view.h"
#include "protocol/subscription.h"

namespace scipd::protocol {

class Session {
  public:
    Session(const DeviceProfile& profile, DeviceState& device, LinkKind link = LinkKind::network);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    /// As close().
    ~Session() { close(); }

    /// Bytes in any pieces. Answers what is due at `now`; the rest waits for advance().
    void receive(std::string_view bytes, Uptime now);
    /// Too many requests wait for their answers: the shell must not read on until this is over.
    [[nodiscard]] bool full() const { return requests_.size() >= max_waiting; }

    /// When the next request is due; nothing: only bytes or a scan can get this session on. What
    /// other sessions of the device do changes it.
    [[nodiscard]] std::optional<Uptime> wake_at() const;
    void advance(Uptime now);

    [[nodiscard]] bool streaming() const;
    /// Scans are wanted now or later: somebody must tell this session of every turn.
    [[nodiscard]] bool measuring() const { return streaming() || single_shot_.has_value(); }
    /// A turn has just fired its last step. To be told once for each while measuring(), in order.
    /// True: take() must follow.
    [[nodiscard]] bool turn_complete(const Turn& turn);
    /// Whether this turn, complete by now, answers the request for the latest one that waits. True:
    /// take() must follow.
    [[nodiscard]] bool waits_for(const Turn& turn) const;
    void take(const ScanView& scan, Uptime now);

    /// The next thing to be done, in order; nothing: there is none at present.
    [[nodiscard]] std::optional<Action> next_action();

    /// The client is gone: what it began (stream, laser, adjust mode) ends as by QT and TM2; what
    /// it asked and what was to be sent is forgotten. What other clients began stays.
    void close();
    /// What the client asked, a half request too, and what was to be sent is forgotten; what it
    /// began goes on.
    void forget();

  private:
    static constexpr std::size_t max_waiting = 64;

    struct Waiting {
        Line line;
        Uptime arrived;
    };
    struct SingleShot {
        Request request;  ///< without a command: in SCIP 1.1
        StepWindow window;
        Uptime begun{};
    };

    [[nodiscard]] State state(Uptime now) const;
    [[nodiscard]] bool link_lost() const { return boots_seen_ != device_.boots(); }
    void lose_link();
    /// By whatever session, or a boot.
    [[nodiscard]] bool rate_changed() const;
    void tell_rate();
    [[nodiscard]] Uptime due(const Waiting& waiting) const;
    [[nodiscard]] bool single_shot_in_vain() const;
    void answer_next(Uptime now);
    void answer_scip1(const std::string& line, Uptime now);
    void answer(const Request& request, Uptime arrived, Uptime now);
    [[nodiscard]] std::optional<Status> refusal(const Request& request, Uptime now) const;
    [[nodiscard]] Uptime shown(Uptime now) const;
    void carry_out(const Request& request, Uptime arrived, Uptime now);
    [[nodiscard]] Status change(const Request& request, Uptime now);

    void begin_single_shot(const Request& request, Uptime now);
    void refuse_single_shot(Uptime now);
    void answer_single_shot(const ScanView& scan, Uptime now);
    void begin_stream(const Request& request, Uptime arrived, Uptime now);
    void send_scan(const ScanView& scan, Uptime now);
    void quit();
    void reply(const Request& request, Status status);
    void send(std::string message, Send::Kind kind = Send::Kind::reply);

    const DeviceProfile& profile_;
    DeviceState& device_;
    LinkKind link_;
    LineReader reader_;
    std::deque<Waiting> requests_;
    Uptime last_answer_ = Uptime::min();
    Uptime last_scan_ = Uptime::min();  ///< when the stream last sent one
    std::optional<SingleShot>
        single_shot_;  ///< GD and its kin, waiting for the latest complete scan
    std::optional<Subscription> subscription_;
    DeviceState::StreamId stream_ = 0;
    std::vector<Uptime> taken_turns_;  ///< begins of turns whose scans the stream still waits for
    bool holds_device_ = false;        ///< this client has the laser on or adjusts
    int boots_seen_;
    int rate_told_;  ///< of the serial line, by the last SetBitRate
    std::deque<Action> actions_;
};

}  // namespace scipd::protocol
