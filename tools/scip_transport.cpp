// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scip_transport.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string>
#include <utility>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/write.hpp>
#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include "protocol/client/error.h"
#include "tools/set_line_rate.h"

namespace scipd::tools {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using protocol::client::Error;

Error unreachable(const std::string& sentence) {
    return {Error::Kind::closed, sentence};
}

/// A socket or a descriptor. Each read runs the context until it is done, but no longer than its
/// timeout.
template <typename Stream>
class StreamTransport final : public ScipTransport {
  public:
    StreamTransport() : stream_(io_), signals_(io_) {}

    [[nodiscard]] asio::io_context& io() { return io_; }
    [[nodiscard]] Stream& stream() { return stream_; }

    void write(std::string_view bytes) override {
        error_code error;
        asio::write(stream_, asio::buffer(bytes), error);
        if (error) throw gone(error);
    }

    std::size_t read(std::span<char> buffer, std::chrono::milliseconds timeout) override {
        if (std::exchange(interrupted_, false)) throw Interrupted();
        error_code error;
        std::size_t count = 0;
        bool done = false;
        stream_.async_read_some(asio::buffer(buffer.data(), buffer.size()),
                                [&](const error_code& result, std::size_t bytes) {
                                    error = result;
                                    count = bytes;
                                    done = true;
                                });
        io_.restart();
        // A socket that has become writable wakes the context too, without running any of our
        // handlers. Hence the loop.
        const auto end = std::chrono::steady_clock::now() + timeout;
        while (!done && !interrupted_ && std::chrono::steady_clock::now() < end)
            io_.run_one_until(end);
        // The timeout also passes while the process is stopped. Bytes that came meanwhile still
        // count.
        if (!done) io_.poll();
        if (!done) {
            stream_.cancel();
            while (!done && io_.run_one() > 0) {
            }
        }
        // Bytes that were read come first: the end of a scan must not get lost.
        if (count == 0 && std::exchange(interrupted_, false)) throw Interrupted();
        if (error && error != asio::error::operation_aborted) throw gone(error);
        return count;
    }

    void interrupt_on_signals() override {
        signals_.add(SIGINT);
        signals_.add(SIGTERM);
        signals_.async_wait([this](const error_code& error, int) {
            if (error) return;
            interrupted_ = true;
            signals_.clear();
        });
    }

    int release() override { return stream_.release(); }

  private:
    // If the other end of a pty is closed, reading it gives EIO.
    static Error gone(const error_code& error) {
        const bool ended = error == asio::error::eof || error.value() == EIO;
        return unreachable(ended ? "the scanner has closed the connection"
                                 : "the connection to the scanner broke: " + error.message());
    }

    asio::io_context io_;
    Stream stream_;
    asio::signal_set signals_;
    bool interrupted_ = false;
};

std::unique_ptr<ScipTransport> open(const TcpTarget& target, const OpenOptions& options) {
    auto transport = std::make_unique<StreamTransport<tcp::socket>>();
    error_code error;
    tcp::resolver resolver(transport->io());
    const auto endpoints = resolver.resolve(target.host, target.port, error);
    if (error) throw unreachable("there is no host \"" + target.host + "\": " + error.message());

    const std::string address = target.host + " port " + target.port;
    error = asio::error::would_block;
    asio::async_connect(transport->stream(), endpoints,
                        [&](const error_code& result, const tcp::endpoint&) { error = result; });
    transport->io().run_for(options.connect_timeout);
    if (error == asio::error::would_block) throw unreachable(address + " does not answer");
    if (error) throw unreachable("cannot connect to " + address + ": " + error.message());
    transport->stream().set_option(tcp::no_delay(true), error);
    return transport;
}

std::unique_ptr<ScipTransport> open(const TtyTarget& target, const OpenOptions& options) {
    const int descriptor = ::open(target.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) {
        throw unreachable("cannot open " + target.path + ": " + std::strerror(errno));
    }
    auto transport = std::make_unique<StreamTransport<asio::posix::stream_descriptor>>();
    transport->stream().assign(descriptor);

    termios settings{};
    if (tcgetattr(descriptor, &settings) != 0) throw unreachable(target.path + " is no tty");
    cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    tcsetattr(descriptor, TCSANOW, &settings);
    if (!set_line_rate(descriptor, options.baud)) {
        throw unreachable(target.path + " cannot be set to " + std::to_string(options.baud) +
                          " baud: " + std::strerror(errno) + "; --baud names another rate");
    }
    tcflush(descriptor, TCIOFLUSH);
    return transport;
}

}  // namespace

std::unique_ptr<ScipTransport> open_target(const Target& target, const OpenOptions& options) {
    return std::visit([&](const auto& place) { return open(place, options); }, target);
}

}  // namespace scipd::tools
