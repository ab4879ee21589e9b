// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/pose_feed.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/loaders/trajectory.h"

namespace scipd::daemon {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

/// Lines from anywhere into the intake; a person is told of the first refusal and then of every
/// thousandth.
class LineSink {
  public:
    /// `robot` is the feed's own, whichever it is at the time.
    LineSink(FeedContext context, const std::string& robot)
        : context_(std::move(context)), robot_(robot) {}

    /// Time in lockstep waits for what comes from now on.
    void begin() {
        if (context_.lockstep != nullptr) context_.lockstep->add(&sender_);
    }

    /// Nothing comes any more.
    void end() {
        if (context_.lockstep != nullptr) context_.lockstep->remove(&sender_);
    }

    /// Calls when there is room for more.
    void when_ready(const std::function<void()>& call) {
        if (context_.lockstep == nullptr) return call();
        context_.lockstep->when_caught_up(call);
    }

    void take_lines(std::string_view text) {
        while (!text.empty()) {
            const std::size_t end = std::min(text.find('\n'), text.size());
            take(text.substr(0, end));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
    }

    void take(std::string_view line) {
        if (sim::says_nothing(line)) return;
        const auto refusal = context_.intake.take_line(line, robot_, sender_, context_.clock.now());
        if (refusal && refused_++ % 1000 == 0)
            context_.report("pose of " + robot_ + " refused: " + *refusal);
    }

    [[nodiscard]] const FeedContext& context() const { return context_; }

  private:
    FeedContext context_;
    const std::string& robot_;
    SenderClock sender_;
    std::uint64_t refused_ = 0;
};

bool is_regular_file(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

/// Every datagram holds one line or several.
class UdpFeed : public PoseFeed, public std::enable_shared_from_this<UdpFeed> {
  public:
    UdpFeed(const FeedContext& context, const Address& address)
        : sink_(context, robot()), socket_(context.executor) {
        try {
            const asio::ip::udp::endpoint endpoint(asio::ip::make_address(address.host),
                                                   address.port);
            socket_.open(endpoint.protocol());
            socket_.bind(endpoint);
        } catch (const boost::system::system_error& error) {
            throw std::runtime_error("cannot receive poses on " + text_of(address) + ": " +
                                     error.code().message() +
                                     "; each robot needs an address of its own");
        }
    }

    void stop() override {
        sink_.end();
        socket_.close();
    }

  private:
    void begin() override {
        sink_.begin();
        receive();
    }

    void receive() {
        socket_.async_receive(asio::buffer(datagram_),
                              [self = shared_from_this()](error_code error, std::size_t size) {
                                  // Stopped: what had come already does not say so itself.
                                  if (!self->socket_.is_open()) return;
                                  if (!error)
                                      self->sink_.take_lines({self->datagram_.data(), size});
                                  self->sink_.when_ready([weak = self->weak_from_this()] {
                                      if (const auto feed = weak.lock()) feed->receive();
                                  });
                              });
    }

    LineSink sink_;
    asio::ip::udp::socket socket_;
    std::array<char, 65536> datagram_;
};

class StandardInputFeed : public PoseFeed, public std::enable_shared_from_this<StandardInputFeed> {
  public:
    explicit StandardInputFeed(const FeedContext& context)
        : sink_(context, robot()), input_(context.executor) {
        // All of its poses would come at once, more than are kept; in lockstep they are read as
        // time goes on.
        if (context.lockstep == nullptr && is_regular_file(STDIN_FILENO))
            throw std::runtime_error(
                "poses from standard input need a pipe or a terminal, not a file: play a TUM file "
                "with --poses FILE.tum, or let its stamps be the time with --clock poses");
        input_.assign(::dup(STDIN_FILENO));
    }

    void stop() override {
        sink_.end();
        input_.close();
    }

  private:
    // Longer lines than any pose has are cut here and refused by the parser.
    static constexpr std::size_t max_line = 8192;

    void begin() override {
        sink_.begin();
        read();
    }

    void read() {
        input_.async_read_some(asio::buffer(input_buffer_),
                               [self = shared_from_this()](error_code error, std::size_t size) {
                                   if (!self->input_.is_open()) return;  // stopped, as above
                                   if (error) return self->end_of_input();
                                   self->take({self->input_buffer_.data(), size});
                                   self->sink_.when_ready([weak = self->weak_from_this()] {
                                       if (const auto feed = weak.lock()) feed->read();
                                   });
                               });
    }

    void end_of_input() {
        sink_.take_lines(std::exchange(line_, {}));
        sink_.end();
        sink_.context().report("standard input has ended: " + robot() +
                               " stays where its last pose puts it");
    }

    void take(std::string_view bytes) {
        line_.append(bytes);
        const std::size_t end = line_.rfind('\n');
        if (end != std::string::npos) {
            sink_.take_lines(std::string_view(line_).substr(0, end));
            line_.erase(0, end + 1);
        } else if (line_.size() > max_line) {
            sink_.take(line_);
            line_.clear();
        }
    }

    LineSink sink_;
    asio::posix::stream_descriptor input_;
    std::array<char, 4096> input_buffer_;
    std::string line_;
};

}  // namespace

std::shared_ptr<PoseFeed> make_feed(const FeedContext& context, const PoseSource& source) {
    switch (source.kind) {
        case PoseSource::Kind::udp:
            return std::make_shared<UdpFeed>(context, source.address);
        case PoseSource::Kind::standard_input:
            return std::make_shared<StandardInputFeed>(context);
        case PoseSource::Kind::file:
            break;
    }
    return make_trajectory_feed(context, source);
}

}  // namespace scipd::daemon
