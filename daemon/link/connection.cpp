// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/connection.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>

#include "daemon/link/uart.h"

namespace scipd::daemon {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

// Requests are short: more under way than a tty's buffer holds is not read yet.
constexpr std::size_t input_under_way_bytes = 4096;

LinkConfig to_device(LinkConfig link) {
    // The client cuts and joins its requests itself.
    link.split_bytes = 0;
    link.split_at.clear();
    link.coalesce = sim::Time::zero();
    return link;
}

Outbox outbox_of(const Endpoint& scanner, const LinkConfig& link) {
    LinkModel line(link, scanner.chance(sim::Purpose::latency_to_client));
    if (!link.baud) return Outbox(std::move(line));
    line.set_rate(*link.baud);
    return Outbox(std::move(line), Outbox::serial_capacity_bytes);
}

}  // namespace

Connection::Connection(Descriptor descriptor, Endpoint& scanner, const LinkConfig& link,
                       Hooks hooks)
    : descriptor_(std::move(descriptor)),
      hooks_(std::move(hooks)),
      client_(scanner.connect([this] { flush(); }, hooks_.kind)),
      clock_(scanner.clock()),
      alarm_(clock_.make_alarm()),
      inbox_(to_device(link), scanner.chance(sim::Purpose::latency_to_device)),
      outbox_(outbox_of(scanner, link)),
      device_rate_(link.baud.value_or(0)) {}

void Connection::hold_to(const SharedLimits& limits, const std::string& here) {
    constexpr Limit of_lines = Limit::scip_line_bytes;
    client_->session().limit_lines((*limits)[of_lines],
                                   [limits, here] { limits->refuse(of_lines, here); });
}

void Connection::start() {
    read();
}

void Connection::close() {
    client_.reset();
    alarm_->cancel();
    clock_.hold(this, false);
    error_code ignored;
    descriptor_.close(ignored);
}

void Connection::set_line(const LineState& line) {
    if (abandoned_) return;
    inbox_.set_config(to_device(line.link), clock_.now());
    outbox_.line().set_config(line.link, clock_.now());
    dead_ = line.dead;
    stalled_ = line.stalled;
    flush_soon();
}

void Connection::send_raw(std::string bytes) {
    asio::post(descriptor_.get_executor(),
               [self = shared_from_this(), bytes = std::move(bytes)]() mutable {
                   if (!self->client_ || self->dead_) return;
                   // There may be too many bytes that nobody waits for.
                   (void)self->outbox_.push({std::move(bytes), protocol::Send::Kind::scan},
                                            self->clock_.now());
                   self->flush();
               });
}

void Connection::forget() {
    drop_under_way();
    client_->session().forget();
}

void Connection::hang_up() {
    drop_under_way();
    client_->session().close();
}

void Connection::drop_under_way() {
    if (writing_) {
        // The rest of a message must not reach whoever comes next, also where a part of it has
        // just been written, so that nothing is left to cancel.
        error_code ignored;
        descriptor_.cancel(ignored);
        sending_.clear();
    }
    outbox_.line().clear();
    device_rate_ = outbox_.line().rate();
    inbox_.clear();
}

// Reading pauses while the client has asked more than it takes answers for, and goes on from
// flush().
void Connection::read() {
    const bool enough =
        client_->session().full() || outbox_.full() || inbox_.bytes() >= input_under_way_bytes;
    if (reading_ || input_ended_ || enough) return;
    reading_ = true;
    descriptor_.async_read_some(asio::buffer(input_),
                                [self = shared_from_this()](error_code error, std::size_t count) {
                                    self->reading_ = false;
                                    if (!self->client_) return;
                                    if (error == asio::error::eof) return self->end_of_input();
                                    if (error && error != asio::error::operation_aborted)
                                        return self->end();
                                    self->take_input(count);
                                });
}

void Connection::drop_input() {
    received_ = 0;
    if (!reading_) return;
    error_code ignored;
    descriptor_.cancel(ignored);
    drops_reading_ = true;
}

void Connection::take_input(std::size_t count) {
    received_ = std::exchange(drops_reading_, false) ? 0 : count;
    if (hooks_.somebody_there() && !dead_ && received_ > 0) {
        if (device_rate_ != 0) inbox_.set_rate(hooks_.client_rate());
        inbox_.send(std::string(input_.data(), received_), clock_.now());
    }
    received_ = 0;
    flush();
}

void Connection::flush() {
    const bool somebody_there = hooks_.somebody_there();
    deliver();
    while (auto action = next_action()) {
        if (std::holds_alternative<protocol::DropLink>(*action)) return drop();
        perform(std::move(*action), somebody_there && !dead_);
    }
    write();
    wait();
    read();
    // Where time can wait it does so before scans are lost to a client that reads too slowly.
    clock_.hold(this, writing_ && outbox_.half_full());
    end_if_done();
}

std::optional<protocol::Action> Connection::next_action() {
    protocol::Speaker& session = client_->session();
    return session.patient() && outbox_.half_full() ? std::nullopt : session.next_action();
}

// Who asks may be called by the client itself, or by flush().
void Connection::flush_soon() {
    asio::post(descriptor_.get_executor(), [self = shared_from_this()] {
        if (self->client_) self->flush();
    });
}

void Connection::deliver() {
    while (!client_->session().full()) {
        const auto piece = inbox_.take(clock_.now());
        if (!piece) return;
        if (device_rate_ == 0) {
            receive(piece->bytes);
        } else {
            receive(heard_by_scanner(piece->bytes, piece->bits_per_second, device_rate_));
        }
    }
}

void Connection::receive(std::string_view bytes) {
    if (ear_) ear_->heard(bytes);
    client_->receive(bytes);
}

void Connection::perform(protocol::Action action, bool carried) {
    if (auto* message = std::get_if<protocol::Send>(&action)) {
        if (carried) send(std::move(*message));
    } else if (const auto* rate = std::get_if<protocol::SetBitRate>(&action)) {
        if (device_rate_ != 0) outbox_.line().set_rate(rate->bits_per_second);
    }
}

void Connection::send(protocol::Send message) {
    if (hook_) {
        hook_->leaving(message);
        if (message.bytes.empty()) return;
    }
    if (ear_) ear_->said(message);
    if (outbox_.push(std::move(message), clock_.now())) return;
    ++counts_.lost_scans;
    if (ear_) ear_->dropped();
}

void Connection::write() {
    while (!writing_ && !stalled_) {
        if (sending_.empty()) {
            auto piece = outbox_.line().take(clock_.now());
            if (!piece) return;
            device_rate_ = piece->bits_per_second;
            sending_ = device_rate_ == 0 ? std::move(piece->bytes)
                                         : heard(piece->bytes, device_rate_, hooks_.client_rate());
            continue;
        }
        writing_ = true;
        descriptor_.async_write_some(
            asio::buffer(sending_),
            [self = shared_from_this()](error_code error, std::size_t count) {
                self->writing_ = false;
                if (!self->client_) return;
                if (error && error != asio::error::operation_aborted) return self->end();
                self->counts_.sent_bytes += count;
                // What has been dropped meanwhile has left nothing here.
                self->sending_.erase(0, count);
                self->flush();
            });
    }
}

void Connection::wait() {
    std::optional<sim::Time> next = client_->wake_at();
    const auto or_at = [&](std::optional<sim::Time> at) {
        if (at) next = std::min(next.value_or(*at), *at);
    };
    if (!client_->session().full()) or_at(inbox_.next_at());
    if (!writing_ && !stalled_) or_at(outbox_.line().next_at());
    if (!next) return alarm_->cancel();
    alarm_->set(*next, [weak = weak_from_this()] {
        const auto self = weak.lock();
        if (!self) return;
        self->client_->wake();
        self->flush();
    });
}

void Connection::end_of_input() {
    input_ended_ = true;
    client_->session().end_of_input();
    flush();
}

// The device boots. A tty outlives that: only what was under way is lost.
void Connection::drop() {
    drop_under_way();
    if (hooks_.kind == protocol::LinkKind::network) {
        input_ended_ = true;
        why_ended_ = Leaving::booted;
    }
    flush();
}

// A client that has closed its side still gets the answers that it asked for, but no stream.
void Connection::end_if_done() {
    const protocol::Speaker& session = client_->session();
    const bool sends = !outbox_.line().empty() || !sending_.empty() || writing_;
    if (session.ended() && !sends) {
        if (!input_ended_) why_ended_ = Leaving::ended;
        return end_soon();
    }
    if (!input_ended_ || !inbox_.empty()) return;
    if ((session.owes() || sends) && !session.streaming()) return;
    end_soon();
}

// Not at once: the client itself may be calling, and end() destroys it.
void Connection::end_soon() {
    asio::post(descriptor_.get_executor(), [self = shared_from_this()] {
        if (self->client_) self->end();
    });
}

void Connection::end() {
    close();
    hooks_.ended(why_ended_);
}

}  // namespace scipd::daemon
