// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/pose_feed.h"

#include <array>
#include <cassert>
#include <chrono>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "daemon/limits/rate.h"
#include "daemon/limits/throttle.h"
#include "daemon/poses/sender_rates.h"
#include "daemon/poses/some_lines.h"
#include "sim/loaders/poses/pose_line.h"

namespace scipd::daemon {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

/// Hands lines from anywhere to the intake, and tells a person of refusals, but not of every one.
class LineSink {
  public:
    /// `robot` and `needs` are members of the feed and may change.
    LineSink(FeedContext context, const std::string& robot, const PoseNeeds& needs)
        : context_(std::move(context)), robot_(robot), needs_(needs) {}

    /// From now on the time in lockstep waits for these poses.
    void begin() {
        if (context_.lockstep != nullptr) context_.lockstep->add(&sender_);
    }

    /// No more lines will come.
    void end() {
        ended_ = true;
        if (context_.lockstep != nullptr) context_.lockstep->remove(&sender_);
    }

    /// Takes some lines in each turn of the event loop, and calls back when all are taken and there
    /// is room for more. `feed` owns both this and the text.
    void take_lines(std::string_view text, const std::shared_ptr<PoseFeed>& feed,
                    const std::function<void()>& call) {
        text.remove_prefix(take_some_lines(text, [&](std::string_view line) { take(line); }));
        if (text.empty()) return when_ready(call);
        asio::post(context_.executor, [this, text, feed, call] {
            if (!ended_) take_lines(text, feed, call);
        });
    }

    /// Whose lines come next.
    void count_for(Rate& rate) { rate_ = &rate; }

    void take(std::string_view line) {
        if (sim::says_nothing(line) || !context_.intake.admit(*rate_)) return;
        const auto taken = context_.intake.take_line(line, robot_, sender_, context_.clock.now());
        const auto now = std::chrono::steady_clock::now();
        arrivals_.note(now, sender_.last_lateness());
        if (context_.lockstep == nullptr) arrivals_.log(now, robot_, needs_);
        if (taken) return;
        arrivals_.note_refused();
        tell(taken.error().why);
    }

    [[nodiscard]] SourceReport report(const PoseSource& source) const {
        SourceReport report{.robot = robot_, .source = text_of(source)};
        arrivals_.tell(std::chrono::steady_clock::now(), report);
        return report;
    }

    [[nodiscard]] const FeedContext& context() const { return context_; }

  private:
    void tell(const std::string& refusal) {
        const auto others = throttle_.admit(std::chrono::steady_clock::now());
        if (others) context_.report("pose of " + robot_ + " refused: " + refusal + *others);
    }

    void when_ready(const std::function<void()>& call) {
        if (context_.lockstep == nullptr) return call();
        context_.lockstep->when_caught_up(call);
    }

    FeedContext context_;
    const std::string& robot_;
    const PoseNeeds& needs_;
    SenderClock sender_;
    Rate only_rate_;
    Rate* rate_ = &only_rate_;
    bool ended_ = false;
    Throttle throttle_;
    Arrivals arrivals_;
};

bool is_regular_file(int descriptor) {
    struct stat status = {};
    return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

/// Every datagram holds one line or several.
class UdpFeed : public PoseFeed, public std::enable_shared_from_this<UdpFeed> {
  public:
    UdpFeed(const FeedContext& context, const Address& address)
        : sink_(context, robot(), needs()), socket_(context.executor) {
        try {
            const asio::ip::udp::endpoint endpoint(asio::ip::make_address(address.host),
                                                   address.port);
            socket_.open(endpoint.protocol());
            socket_.bind(endpoint);
        } catch (const boost::system::system_error& error) {
            const std::string what = "cannot receive poses on " + text_of(address);
            require_own_address(what, error.code());
            const bool taken = error.code() == asio::error::address_in_use;
            throw std::runtime_error(what + ": " + error.code().message() +
                                     (taken ? "; each robot needs an address of its own" : ""));
        }
    }

    void stop() override {
        sink_.end();
        socket_.close();
    }

    [[nodiscard]] std::optional<Address> address() const override {
        const asio::ip::udp::endpoint taken = socket_.local_endpoint();
        return Address{taken.address().to_string(), taken.port()};
    }

    [[nodiscard]] SourceReport report() const override {
        return sink_.report({.kind = PoseSource::Kind::udp, .address = *address()});
    }

  private:
    void begin() override {
        sink_.begin();
        receive();
    }

    void receive() {
        socket_.async_receive_from(asio::buffer(datagram_), from_,
                                   [self = shared_from_this()](error_code error, std::size_t size) {
                                       // After stop(), a datagram that had come is still handed in.
                                       if (!self->socket_.is_open()) return;
                                       self->take({self->datagram_.data(), error ? 0 : size});
                                   });
    }

    void take(std::string_view datagram) {
        sink_.count_for(rates_.of(from_.address(), std::chrono::steady_clock::now()));
        sink_.take_lines(datagram, shared_from_this(), [weak = weak_from_this()] {
            if (const auto feed = weak.lock()) feed->receive();
        });
    }

    LineSink sink_;
    asio::ip::udp::socket socket_;
    asio::ip::udp::endpoint from_;
    SenderRates rates_;
    std::array<char, 65536> datagram_;
};

class StandardInputFeed : public PoseFeed, public std::enable_shared_from_this<StandardInputFeed> {
  public:
    explicit StandardInputFeed(const FeedContext& context)
        : sink_(context, robot(), needs()), input_(context.executor) {
        // All poses of a file would come at once, more than are kept. In lockstep they are read as
        // time goes on.
        if (context.lockstep == nullptr && is_regular_file(STDIN_FILENO))
            throw std::runtime_error(
                "poses from standard input need a pipe or a terminal, not a file: play a TUM file "
                "with --poses FILE, or let its stamps be the time with --clock poses");
        const int descriptor = ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0);
        if (descriptor < 0)
            throw std::system_error(errno, std::generic_category(), "cannot read standard input");
        input_.assign(descriptor);
    }

    void stop() override {
        sink_.end();
        input_.close();
    }

    [[nodiscard]] SourceReport report() const override {
        return sink_.report({.kind = PoseSource::Kind::standard_input});
    }

  private:
    // A line that is longer than any pose is cut here, and the parser refuses it.
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
                               });
    }

    void end_of_input() {
        sink_.take(line_);
        sink_.end();
        sink_.context().report("standard input has ended: " + robot() +
                               " stays where its last pose puts it");
    }

    void take(std::string_view bytes) {
        line_.append(bytes);
        const std::size_t end = line_.rfind('\n');
        const bool too_long = end == line_.npos && line_.size() > max_line;
        const std::size_t whole = too_long ? line_.size() : end + 1;  // of no line end it is 0
        sink_.take_lines(std::string_view(line_).substr(0, whole), shared_from_this(),
                         [weak = weak_from_this(), whole] {
                             if (const auto feed = weak.lock()) feed->read_on(whole);
                         });
    }

    void read_on(std::size_t taken) {
        line_.erase(0, taken);
        read();
    }

    LineSink sink_;
    asio::posix::stream_descriptor input_;
    std::array<char, 4096> input_buffer_;
    std::string line_;
};

}  // namespace

std::shared_ptr<PoseFeed> make_feed(const FeedContext& context, const PoseSource& source,
                                    PlayedPoses poses) {
    switch (source.kind) {
        case PoseSource::Kind::udp:
            return std::make_shared<UdpFeed>(context, source.address);
        case PoseSource::Kind::standard_input:
            return std::make_shared<StandardInputFeed>(context);
        case PoseSource::Kind::gz:
        case PoseSource::Kind::ros2:
        case PoseSource::Kind::rosbridge:
            return make_bus_feed(context, source);
        case PoseSource::Kind::vda5050:
            assert(false);  // daemon/fleet takes these
            break;
        case PoseSource::Kind::file:
            break;
    }
    return make_trajectory_feed(context, source, std::move(poses));
}

}  // namespace scipd::daemon
