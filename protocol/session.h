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
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/acquisition.h"
#include "protocol/action.h"
#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/line_reader.h"
#include "protocol/refusal.h"
#include "protocol/request.h"
#include "protocol/scan_view.h"
#include "protocol/session_hook.h"
#include "protocol/speaker.h"
#include "protocol/status_counts.h"

namespace scipd::protocol {

class Session final : public Speaker {
  public:
    Session(const DeviceProfile& profile, DeviceState& device, LinkKind link = LinkKind::network);
    /// As close().
    ~Session() override { close(); }

    void limit_lines(std::size_t longest, std::function<void()> on_overlong) override;

    /// Takes bytes in any pieces. Answers what is due at `now`; the rest waits for advance().
    void receive(std::string_view bytes, Uptime now);
    [[nodiscard]] bool full() const override { return requests_.size() >= max_waiting; }

    /// When advance() is due. Nothing: only bytes or a scan can get this session on. What other
    /// sessions of the device do changes it.
    [[nodiscard]] std::optional<Uptime> wake_at() const;
    void advance(Uptime now);

    [[nodiscard]] bool streaming() const override { return acquisition_.streaming(); }
    [[nodiscard]] bool owes() const override { return measuring() || wake_at().has_value(); }
    /// Scans are wanted now or later: somebody must tell this session of every turn.
    [[nodiscard]] bool measuring() const { return acquisition_.measuring(); }
    /// A turn has just fired its last step. To be told once for each turn while measuring(), in
    /// order. True: take() must follow.
    [[nodiscard]] bool turn_complete(const Turn& turn) { return acquisition_.turn_complete(turn); }
    /// Returns false if turns up to this one are too early for all that it measures.
    [[nodiscard]] bool has_begun(const Turn& turn) const { return acquisition_.has_begun(turn); }
    /// Whether this turn, complete by now, answers the request for a single scan. True: take() must
    /// follow.
    [[nodiscard]] bool waits_for(const Turn& turn) const { return acquisition_.awaits(turn); }
    void take(const ScanView& scan, Uptime now);

    [[nodiscard]] std::optional<Action> next_action() override;

    /// Null: nobody stands between the session and its client. The hook must outlive the session.
    void set_hook(SessionHook* hook) { hook_ = hook; }

    /// The requests that were not answered with 00 (0 in SCIP 1.1), in all its life.
    [[nodiscard]] const StatusCounts& refused() const { return refused_; }

    void close() override;
    void forget() override;

  private:
    static constexpr std::size_t max_waiting = 64;

    struct Waiting {
        Request request;
        Uptime arrived;
    };

    [[nodiscard]] State state(Uptime now) const;
    [[nodiscard]] bool link_lost() const { return boots_seen_ != device_.boots(); }
    void lose_link();
    /// Some session has changed the rate of the serial line, or a boot has.
    [[nodiscard]] bool rate_changed() const;
    void tell_rate();

    [[nodiscard]] Uptime due(const Waiting& waiting) const;
    void answer_next(Uptime now);
    void answer_scip1(const std::string& line, std::optional<Status> refused, Uptime now);
    void answer(const Waiting& waiting, Uptime now);
    void refuse_single_scan(Uptime now);
    [[nodiscard]] std::optional<Status> refusal(const Request& request, Uptime now) const;
    void reply(const Request& request, Status status);
    void reply_scip1(const std::string& line, char status);
    void send(std::string message, Send::Kind kind = Send::Kind::reply);

    const DeviceProfile& profile_;
    DeviceState& device_;
    LinkKind link_;
    LineReader reader_;
    std::function<void()> on_overlong_;
    std::deque<Waiting> requests_;
    Acquisition acquisition_;
    Uptime last_answer_ = Uptime::min();
    Uptime last_scan_ = Uptime::min();  ///< when the stream last sent one
    int boots_seen_;
    int rate_told_;  ///< the rate of the serial line in the last SetBitRate
    std::deque<Action> actions_;
    SessionHook* hook_ = nullptr;
    StatusCounts refused_;
};

}  // namespace scipd::protocol
