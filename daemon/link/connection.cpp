// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/connection.h"

#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>

namespace scipd::daemon {

namespace asio = boost::asio;
using boost::system::error_code;

Connection::Connection(Descriptor descriptor, Device& device, Hooks hooks)
    : descriptor_(std::move(descriptor)),
      hooks_(std::move(hooks)),
      client_(std::make_unique<Client>(device, [this] { flush(); })),
      alarm_(device.clock().make_alarm()) {}

void Connection::start() {
    read();
}

void Connection::close() {
    client_.reset();
    alarm_->cancel();
    error_code ignored;
    descriptor_.close(ignored);
}

void Connection::drop_output() {
    if (writing_) {
        // The half of a message must not reach whoever comes next; write() goes on when the
        // cancelled one reports.
        error_code ignored;
        descriptor_.cancel(ignored);
    }
    outbox_.clear();
}

// Reading pauses while the client has asked more than it takes answers for, and goes on from
// flush().
void Connection::read() {
    if (reading_ || input_ended_ || !client_ || client_->full() || outbox_.full()) return;
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

void Connection::take_input(std::size_t count) {
    if (count > 0 && hooks_.somebody_there()) client_->receive({input_.data(), count});
    flush();
}

void Connection::flush() {
    const bool somebody_there = hooks_.somebody_there();
    while (auto action = client_->next_action()) {
        if (std::holds_alternative<protocol::DropLink>(*action)) return drop();
        auto* message = std::get_if<protocol::Send>(&*action);
        if (message != nullptr && somebody_there && !outbox_.push(std::move(*message))) ++lost_;
    }
    write();
    wait();
    read();
    end_if_done();
}

void Connection::write() {
    if (writing_ || outbox_.empty()) return;
    writing_ = true;
    sending_ = outbox_.pop();
    asio::async_write(descriptor_, asio::buffer(sending_),
                      [self = shared_from_this()](error_code error, std::size_t) {
                          self->writing_ = false;
                          if (!self->client_) return;
                          if (error && error != asio::error::operation_aborted) return self->end();
                          self->flush();
                      });
}

void Connection::wait() {
    const auto at = client_->wake_at();
    if (!at) return alarm_->cancel();
    alarm_->set(*at, [weak = weak_from_this()] {
        const auto self = weak.lock();
        if (!self) return;
        self->client_->wake();
        self->flush();
    });
}

// A client that has closed its side still gets the answers that it asked for, but no stream.
void Connection::end_of_input() {
    input_ended_ = true;
    if (client_->streaming()) return end();
    end_if_done();
}

// The device boots. A tty outlives that: only what was under way is lost.
void Connection::drop() {
    drop_output();
    if (!hooks_.survives_boot) input_ended_ = true;
    flush();
}

// Not at once: this may be called from within a call of the client's, which end() takes away.
void Connection::end_if_done() {
    if (!input_ended_ || client_->busy() || !outbox_.empty() || writing_) return;
    asio::post(descriptor_.get_executor(), [self = shared_from_this()] {
        if (self->client_) self->end();
    });
}

void Connection::end() {
    close();
    hooks_.ended();
}

}  // namespace scipd::daemon
