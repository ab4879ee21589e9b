// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Topics of ROS 1 and 2 by rosbridge, a WebSocket that carries JSON. Where it is not there, or goes
// away, scipd tries again every second, and asks again for topics that are not there yet.
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include "daemon/bridges/bus.h"
#include "daemon/bridges/ros_json.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using boost::system::error_code;
using namespace std::chrono_literals;

constexpr auto retry_after = 1s;
constexpr auto patience = 10s;
constexpr std::size_t longest_message = 16U << 20U;

class RosbridgeBus : public Bus {
  public:
    RosbridgeBus(std::string host, std::uint16_t port, RosTopics topics, BusListener& listener)
        : host_(std::move(host)),
          port_(std::to_string(port)),
          topics_(std::move(topics)),
          listener_(listener) {
        connect();
        thread_ = std::thread([this] { io_.run(); });
    }

    ~RosbridgeBus() override {
        io_.stop();
        thread_.join();
    }

  private:
    using Socket = beast::websocket::stream<beast::tcp_stream>;

    void connect() {
        buffer_.clear();
        unsent_.clear();
        socket_ = std::make_unique<Socket>(io_);
        socket_->read_message_max(longest_message);
        resolver_.async_resolve(host_, port_, [this](error_code error, const auto& found) {
            if (error) return try_again(error);
            beast::get_lowest_layer(*socket_).expires_after(patience);
            beast::get_lowest_layer(*socket_).async_connect(found,
                                                            [this](error_code failed, const auto&) {
                                                                if (failed)
                                                                    return try_again(failed);
                                                                shake_hands();
                                                            });
        });
    }

    void shake_hands() {
        beast::get_lowest_layer(*socket_).expires_never();
        // Pings find out that the other machine is gone.
        auto timeout = beast::websocket::stream_base::timeout::suggested(beast::role_type::client);
        timeout.idle_timeout = patience;
        timeout.keep_alive_pings = true;
        socket_->set_option(timeout);
        socket_->async_handshake(host_ + ':' + port_, "/", [this](error_code error) {
            if (error) return try_again(error);
            told_.clear();
            listener_.tell_trouble({});
            for (const std::string& topic : {topics_.topic, topics_.fixed, topics_.clock}) {
                if (!topic.empty()) send(subscription_to(topic));
            }
            read();
        });
    }

    void read() {
        socket_->async_read(buffer_, [this](error_code error, std::size_t) {
            if (error) return try_again(error);
            take(beast::buffers_to_string(buffer_.data()));
            buffer_.clear();
            read();
        });
    }

    void take(const std::string& text) {
        auto said = read_rosbridge(text);
        if (!said) return listener_.refuse(said.error().why);
        if (auto* const published = std::get_if<RosbridgePublish>(&*said)) {
            if (published->topic == topics_.topic && !told_.empty()) tell("");
            published->heard.for_good = published->topic == topics_.fixed;
            listener_.hear(std::move(published->heard));
        } else if (const auto* const refusal = std::get_if<RosbridgeRefusal>(&*said)) {
            ask_again(*refusal);
        }
    }

    /// Nobody publishes it yet, for instance.
    void ask_again(const RosbridgeRefusal& refusal) {
        if (refusal.id == topics_.topic || refusal.id.empty())
            tell("rosbridge refuses " + sim::printable(topics_.topic) + ": " +
                 sim::printable(refusal.why));
        if (refusal.id.empty()) return;
        auto& timer = timers_.try_emplace(refusal.id, io_).first->second;
        timer.expires_after(retry_after);
        timer.async_wait([this, topic = refusal.id](error_code error) {
            if (!error) send(subscription_to(topic));
        });
    }

    void send(std::string text) {
        unsent_.push_back(std::move(text));
        if (unsent_.size() == 1) write();
    }

    void write() {
        socket_->async_write(asio::buffer(unsent_.front()), [this](error_code error, std::size_t) {
            // The read fails as well, and begins anew.
            if (error || unsent_.empty()) return;
            unsent_.pop_front();
            if (!unsent_.empty()) write();
        });
    }

    void try_again(error_code error) {
        tell("no rosbridge at " + host_ + ':' + port_ + ": " + error.message() +
             "; start rosbridge_server there, scipd tries again");
        timers_.clear();
        pause_.expires_after(retry_after);
        pause_.async_wait([this](error_code cancelled) {
            if (!cancelled) connect();
        });
    }

    void tell(const std::string& trouble) {
        if (told_ == trouble) return;
        told_ = trouble;
        listener_.tell_trouble(trouble);
    }

    const std::string host_;
    const std::string port_;
    const RosTopics topics_;
    BusListener& listener_;
    asio::io_context io_{1};
    asio::ip::tcp::resolver resolver_{io_};
    asio::steady_timer pause_{io_};
    std::unique_ptr<Socket> socket_;
    beast::flat_buffer buffer_;
    std::deque<std::string> unsent_;                    ///< the first is being written
    std::map<std::string, asio::steady_timer> timers_;  ///< by topics to ask for again
    std::string told_;
    std::thread thread_;
};

}  // namespace

std::unique_ptr<Bus> listen_to_rosbridge(const std::string& host, std::uint16_t port,
                                         const RosTopics& topics, BusListener& listener) {
    return std::make_unique<RosbridgeBus>(host, port, topics, listener);
}

}  // namespace scipd::daemon
