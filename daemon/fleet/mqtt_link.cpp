// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/mqtt_link.h"

#include <array>
#include <thread>
#include <utility>

#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <mosquitto.h>
#include <poll.h>
#include <unistd.h>

namespace scipd::daemon {

namespace asio = boost::asio;
using namespace std::chrono_literals;
using boost::system::error_code;

namespace {

constexpr int keep_alive_s = 10;
// How long a broker may take a connection and say nothing.
constexpr auto longest_silence = 10s;
constexpr auto longest_goodbye = 1s;
constexpr auto care_time = 500ms;
// So many messages are taken before the event loop turns to the scanners again.
constexpr int messages_in_one_go = 16;

/// "certificate verify failed" in "OpenSSL Error[0]: error:0A000086:SSL routines::certificate
/// verify failed".
std::string last_words(const std::string& log) {
    return log.substr(log.rfind(':') + 1);
}

}  // namespace

struct MqttLink::Loop {
    explicit Loop(const asio::any_io_executor& io) : executor(io), socket(io), timer(io) {}

    asio::any_io_executor executor;
    asio::posix::stream_descriptor socket;  ///< a duplicate: the library closes its own as it likes
    asio::steady_timer timer;
    bool begun = false;
    bool writing = false;
    std::shared_ptr<bool> alive = std::make_shared<bool>(true);
    asio::thread_pool finder{1};  ///< looking up a name may take long
};

MqttLink::MqttLink(const asio::any_io_executor& executor, const FleetConfig& config,
                   const std::string& client, const Will& will, Hooks hooks)
    : config_(config),
      hooks_(std::move(hooks)),
      client_(make_mqtt_client(config, client, this)),
      loop_(std::make_unique<Loop>(executor)) {
    mosquitto* const mqtt = client_.get();
    constexpr bool kept = true;
    if (!will.topic.empty())
        require_mqtt(mosquitto_will_set(mqtt, will.topic.c_str(), int(will.payload.size()),
                                        will.payload.data(), 1, kept),
                     "cannot leave a will with the broker");
    mosquitto_log_callback_set(mqtt, [](mosquitto*, void* link, int level, const char* text) {
        if (level == MOSQ_LOG_ERR && std::string_view(text).starts_with("OpenSSL"))
            static_cast<MqttLink*>(link)->tls_says_ = last_words(text);
    });
    mosquitto_connect_callback_set(mqtt, [](mosquitto*, void* link, int code) {
        static_cast<MqttLink*>(link)->take_connected(code);
    });
    mosquitto_message_callback_set(mqtt, [](mosquitto*, void* link, const mosquitto_message* said) {
        static_cast<MqttLink*>(link)->take_message(
            {said->topic, {static_cast<const char*>(said->payload), size_t(said->payloadlen)}});
    });
}

MqttLink::~MqttLink() {
    stop();
}

bool MqttLink::run_until(const std::function<bool()>& done, std::chrono::milliseconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    bool tried = connected_;
    while (!done()) {
        if (std::chrono::steady_clock::now() > end) return false;
        if (tried && step(100ms)) continue;
        if (tried) std::this_thread::sleep_for(100ms);
        const int code = mosquitto_connect_async(client_.get(), config_.broker.host.c_str(),
                                                 config_.broker.port, keep_alive_s);
        if (code != MOSQ_ERR_SUCCESS) lose(code);
        tried = true;
    }
    return true;
}

bool MqttLink::step(std::chrono::milliseconds patience) {
    const int code = mosquitto_loop(client_.get(), int(patience.count()), 1);
    if (code == MOSQ_ERR_SUCCESS) return true;
    lose(code);
    return false;
}

void MqttLink::take_connected(int code) {
    constexpr int unavailable = 3;  // for now (MQTT 3.1.1, 3.2.2.3)
    refused_ = code != 0 && code != unavailable;
    if (code != 0) return void(trouble_ = mosquitto_connack_string(code));
    connected_ = true;
    hooks_.connected();
}

void MqttLink::take_message(const MqttMessage& message) {
    came_ = true;
    hooks_.message(message);
}

bool MqttLink::congested() const {
    return mosquitto_want_write(client_.get());
}

void MqttLink::subscribe(const std::string& topic) {
    mosquitto_subscribe(client_.get(), nullptr, topic.c_str(), 1);
    look_after();
}

void MqttLink::unsubscribe(const std::string& topic) {
    mosquitto_unsubscribe(client_.get(), nullptr, topic.c_str());
    look_after();
}

void MqttLink::publish(const std::string& topic, std::string_view payload, MqttDelivery delivery) {
    if (!connected_) return;
    mosquitto_publish(client_.get(), nullptr, topic.c_str(), int(payload.size()), payload.data(),
                      delivery.surely ? 1 : 0, delivery.kept);
    look_after();
}

void MqttLink::begin() {
    loop_->begun = true;
    since_ = std::chrono::steady_clock::now();
    watch();
    tick();
}

void MqttLink::stop() {
    if (loop_ == nullptr) return;
    loop_->alive.reset();
    loop_->finder.join();
    if (connected_) say_goodbye();
    connected_ = false;
    loop_.reset();
}

// The library closes its socket at once. Closed with something unread, the connection would be
// reset, and the broker might not read the goodbye: then it would say the will. So what comes is
// read from a duplicate until the broker has closed its side.
void MqttLink::say_goodbye() {
    const int socket = ::dup(mosquitto_socket(client_.get()));
    mosquitto_disconnect(client_.get());
    std::array<char, 4096> unread{};
    const auto end = std::chrono::steady_clock::now() + longest_goodbye;
    while (std::chrono::steady_clock::now() < end) {
        pollfd readable{socket, POLLIN, 0};
        if (::poll(&readable, 1, 100) <= 0) continue;
        if (::read(socket, unread.data(), unread.size()) <= 0) break;
    }
    ::close(socket);
}

// Where the broker has refused the client, take_connected() knows better why. And that there is no
// connection says less than why the last one ended.
void MqttLink::lose(int code) {
    if (code == MOSQ_ERR_TLS) refused_ = tls_says_.find("certificate") != tls_says_.npos;
    const bool still_lost = code == MOSQ_ERR_NO_CONN && !connected_;
    lose(code == MOSQ_ERR_CONN_REFUSED || still_lost ? trouble_ : text_of_error(code));
}

// The library's own words for TLS are that it has failed.
std::string MqttLink::text_of_error(int code) const {
    if (code == MOSQ_ERR_KEEPALIVE) return "it does not answer";
    if (code != MOSQ_ERR_TLS) return mosquitto_strerror(code);
    return "TLS fails: " + tls_says_ +
           (refused_ ? "; `ca` must vouch for the broker's certificate, which must have its name"
                     : "");
}

void MqttLink::lose(const std::string& why) {
    error_code ignored;
    loop_->socket.close(ignored);
    loop_->writing = false;
    trouble_ = why;
    if (std::exchange(connected_, false)) hooks_.lost(why);
}

// Behind the library's back: it may close its socket in any call, and the number may be another
// file's by then.
void MqttLink::watch() {
    const int socket = mosquitto_socket(client_.get());
    if (socket < 0 || loop_->socket.is_open()) return;
    loop_->socket.assign(::dup(socket));
    wait_to_read();
    look_after();
}

void MqttLink::wait_to_read() {
    loop_->socket.async_wait(asio::posix::stream_descriptor::wait_read,
                             [this, alive = std::weak_ptr(loop_->alive)](error_code error) {
                                 if (!alive.expired() && !error) read();
                             });
}

// With TLS, what has come may wait in the library while the socket is silent.
void MqttLink::read() {
    for (int i = 0; i < messages_in_one_go; ++i) {
        came_ = false;
        const int code = mosquitto_loop_read(client_.get(), 1);
        if (code != MOSQ_ERR_SUCCESS) return lose(code);
        if (!came_) break;
    }
    look_after();
    if (!came_) return wait_to_read();
    asio::post(loop_->executor, [this, alive = std::weak_ptr(loop_->alive)] {
        if (!alive.expired() && loop_->socket.is_open()) read();
    });
}

void MqttLink::look_after() {
    if (loop_->begun && loop_->socket.is_open() && congested()) wait_to_write();
}

void MqttLink::wait_to_write() {
    if (std::exchange(loop_->writing, true)) return;
    loop_->socket.async_wait(asio::posix::stream_descriptor::wait_write,
                             [this, alive = std::weak_ptr(loop_->alive)](error_code error) {
                                 if (alive.expired() || error) return;
                                 loop_->writing = false;
                                 const int code = mosquitto_loop_write(client_.get(), 1);
                                 if (code != MOSQ_ERR_SUCCESS) return lose(code);
                                 look_after();
                             });
}

void MqttLink::tick() {
    loop_->timer.expires_after(care_time);
    loop_->timer.async_wait([this, alive = std::weak_ptr(loop_->alive)](error_code error) {
        if (alive.expired() || error) return;
        tick();
        if (trying_) return;
        const bool open = loop_->socket.is_open();
        const int code = open ? mosquitto_loop_misc(client_.get()) : MOSQ_ERR_NO_CONN;
        const bool silent =
            !connected_ && std::chrono::steady_clock::now() - since_ > longest_silence;
        if (code == MOSQ_ERR_SUCCESS && !silent) return look_after();
        silent ? lose("it does not answer") : lose(code);
        try_again();
    });
}

void MqttLink::try_again() {
    trying_ = true;
    since_ = std::chrono::steady_clock::now();
    asio::post(loop_->finder, [this, alive = std::weak_ptr(loop_->alive), io = loop_->executor,
                               mqtt = client_.get()] {
        const int code = mosquitto_reconnect_async(mqtt);
        asio::post(io, [this, alive, code] {
            if (!alive.expired()) take_tried(code);
        });
    });
}

void MqttLink::take_tried(int code) {
    trying_ = false;
    if (code == MOSQ_ERR_SUCCESS) return watch();
    trouble_ = text_of_error(code);
}

}  // namespace scipd::daemon
