// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The connection to an MQTT broker. It is found again when it is lost; what was subscribed to is
// then for on_connected() to ask for anew. Nothing here waits for the broker but run_until(). Lives
// on the I/O thread; names are looked up on a thread of its own.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/any_io_executor.hpp>

#include "daemon/config/fleet_config.h"
#include "daemon/fleet/mqtt_client.h"

namespace scipd::daemon {

struct MqttMessage {
    std::string_view topic;
    std::string_view payload;
};

/// What a broker does with a message.
struct MqttDelivery {
    bool surely = false;  ///< QoS 1: at least once; else at most once
    bool kept = false;    ///< for those who come later (retained)
};

class MqttLink {
  public:
    struct Hooks {
        std::function<void()> connected;
        std::function<void(const MqttMessage&)> message;
        std::function<void(const std::string& why)> lost;  ///< a connection that there was
    };
    /// What the broker says, and keeps, when this goes without a word; an empty topic: nothing.
    struct Will {
        std::string topic;
        std::string payload;
    };

    /// `client` is a name that no other client of the broker has. Throws std::runtime_error where
    /// the files of TLS are no good.
    MqttLink(const boost::asio::any_io_executor& executor, const FleetConfig& config,
             const std::string& client, const Will& will, Hooks hooks);
    MqttLink(const MqttLink&) = delete;
    MqttLink& operator=(const MqttLink&) = delete;
    /// As stop().
    ~MqttLink();

    /// Connects, unless it is connected, and goes on until `done` or that time has passed. Returns
    /// whether it is done. Nothing of the event loop may run meanwhile.
    bool run_until(const std::function<bool()>& done, std::chrono::milliseconds patience);
    /// From now on the event loop drives it.
    void begin();
    /// Says goodbye: there is no will then.
    void stop();

    [[nodiscard]] bool connected() const { return connected_; }
    /// Whether the broker takes less than it is sent.
    [[nodiscard]] bool congested() const;
    /// Whether the broker has refused this client, or cannot be trusted: asking again is in vain.
    [[nodiscard]] bool refused() const { return refused_; }
    /// Why there is no connection.
    [[nodiscard]] const std::string& trouble() const { return trouble_; }

    void subscribe(const std::string& topic);
    void unsubscribe(const std::string& topic);
    /// Without a connection it goes nowhere.
    void publish(const std::string& topic, std::string_view payload, MqttDelivery delivery);

  private:
    struct Loop;

    void take_connected(int code);
    void take_message(const MqttMessage& message);
    [[nodiscard]] bool step(std::chrono::milliseconds patience);
    [[nodiscard]] std::string text_of_error(int code) const;
    void lose(int code);
    void lose(const std::string& why);
    void say_goodbye();
    void watch();
    void wait_to_read();
    void wait_to_write();
    void read();
    void look_after();
    void tick();
    void try_again();
    void take_tried(int code);

    const FleetConfig config_;
    Hooks hooks_;
    MqttClient client_;
    std::unique_ptr<Loop> loop_;
    bool connected_ = false;
    bool refused_ = false;
    bool trying_ = false;                           ///< the other thread has the library
    bool came_ = false;                             ///< a message, since this was set
    std::string tls_says_ = "the broker hangs up";  ///< of what failed last
    std::string trouble_ = "it has not answered yet";
    std::chrono::steady_clock::time_point since_{};  ///< when it was tried last
};

}  // namespace scipd::daemon
