// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/broker/mqtt_link.h"

#include <array>
#include <stdexcept>
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
// Of a broker that takes a connection and says nothing.
constexpr auto longest_silence = 10s;
constexpr auto longest_goodbye = 1s;
constexpr auto care_time = 500ms;
// So many messages are taken before the event loop turns to the scanners again.
constexpr int messages_in_one_go = 16;

const char* path_or_null(const std::filesystem::path& path) {
    return path.empty() ? nullptr : path.c_str();
}

// The library's own words for TLS are that it has failed.
std::string text_of_error(int code) {
    if (code != MOSQ_ERR_TLS) return mosquitto_strerror(code);
    return "TLS fails: `ca` must vouch for the broker's certificate, which must have its name";
}

void require(int code, const std::string& what) {
    if (code != MOSQ_ERR_SUCCESS) throw std::runtime_error(what + ": " + text_of_error(code));
}

}  // namespace

struct MqttLink::Library {
    Library(const std::string& client, MqttLink* link) {
        require(mosquitto_lib_init(), "cannot prepare the MQTT library");
        constexpr bool begin_anew = true;
        client_ = mosquitto_new(client.c_str(), begin_anew, link);
        if (client_ == nullptr) throw std::runtime_error("cannot make an MQTT client");
    }
    ~Library() { mosquitto_destroy(client_); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    [[nodiscard]] mosquitto* get() const { return client_; }

  private:
    mosquitto* client_ = nullptr;
};

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

MqttLink::MqttLink(const asio::any_io_executor& executor, const BrokerConfig& config,
                   const std::string& client, const Will& will, Hooks hooks)
    : config_(config),
      hooks_(std::move(hooks)),
      library_(std::make_unique<Library>(client, this)),
      loop_(std::make_unique<Loop>(executor)) {
    mosquitto* const mqtt = library_->get();
    constexpr bool kept = true;
    if (!will.topic.empty())
        require(mosquitto_will_set(mqtt, will.topic.c_str(), int(will.payload.size()),
                                   will.payload.data(), 1, kept),
                "cannot leave a will with the broker");
    // Else a message waits until the broker's TCP confirms the one before it, up to 40 ms later.
    mosquitto_int_option(mqtt, MOSQ_OPT_TCP_NODELAY, 1);
    if (!config.user.name.empty())
        mosquitto_username_pw_set(mqtt, config.user.name.c_str(), config.user.password.c_str());
    if (config.broker.tls) {
        const BrokerTls& tls = config.tls;
        require(mosquitto_tls_set(mqtt, path_or_null(tls.ca),
                                  tls.ca.empty() ? "/etc/ssl/certs" : nullptr,
                                  path_or_null(tls.cert), path_or_null(tls.key), nullptr),
                "cannot use the files of fleet.tls");
    }
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
        const int code = mosquitto_connect_async(library_->get(), config_.broker.host.c_str(),
                                                 config_.broker.port, keep_alive_s);
        if (code != MOSQ_ERR_SUCCESS) lose(code);
        tried = true;
    }
    return true;
}

bool MqttLink::step(std::chrono::milliseconds patience) {
    const int code = mosquitto_loop(library_->get(), int(patience.count()), 1);
    if (code == MOSQ_ERR_SUCCESS) return true;
    lose(code);
    return false;
}

void MqttLink::take_connected(int code) {
    answered_ = true;
    if (code != 0) return void(trouble_ = mosquitto_connack_string(code));
    connected_ = true;
    hooks_.connected();
}

void MqttLink::take_message(const MqttMessage& message) {
    came_ = true;
    hooks_.message(message);
}

bool MqttLink::congested() const {
    return mosquitto_want_write(library_->get());
}

void MqttLink::subscribe(const std::string& topic) {
    mosquitto_subscribe(library_->get(), nullptr, topic.c_str(), 1);
    look_after();
}

void MqttLink::unsubscribe(const std::string& topic) {
    mosquitto_unsubscribe(library_->get(), nullptr, topic.c_str());
    look_after();
}

void MqttLink::publish(const std::string& topic, std::string_view payload, MqttDelivery delivery) {
    if (!connected_) return;
    mosquitto_publish(library_->get(), nullptr, topic.c_str(), int(payload.size()), payload.data(),
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
    const int socket = ::dup(mosquitto_socket(library_->get()));
    mosquitto_disconnect(library_->get());
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
    if (code == MOSQ_ERR_TLS) answered_ = true;
    const bool still_lost = code == MOSQ_ERR_NO_CONN && !connected_;
    lose(code == MOSQ_ERR_CONN_REFUSED || still_lost ? trouble_ : text_of_error(code));
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
    const int socket = mosquitto_socket(library_->get());
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
        const int code = mosquitto_loop_read(library_->get(), 1);
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
                                 const int code = mosquitto_loop_write(library_->get(), 1);
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
        const int code = open ? mosquitto_loop_misc(library_->get()) : MOSQ_ERR_NO_CONN;
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
                               mqtt = library_->get()] {
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
