// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world that daemons share, straight at its broker. Each call waits for its answer. One thread.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>
#include <boost/asio/io_context.hpp>

#include "daemon/fleet/kept_messages.h"
#include "daemon/fleet/mqtt_link.h"
#include "daemon/fleet/topics.h"

namespace scipd::tools {

/// What commands that go to a broker take.
struct BrokerOptions {
    std::string to;  ///< mqtt://HOST:PORT/WORLD
    std::string user_file;
    std::string ca;
};

/// Adds --to, --user-file and --ca.
void add_broker_options(CLI::App& command, BrokerOptions& options, const std::string& help);

class BrokerSession {
  public:
    /// Throws ControlError if the broker cannot be reached, CLI::ValidationError if `to` is no
    /// world of a broker.
    explicit BrokerSession(const BrokerOptions& options);

    [[nodiscard]] boost::asio::io_context& io() { return io_; }
    [[nodiscard]] daemon::MqttLink& link() { return *link_; }
    [[nodiscard]] const daemon::Topics& topics() const { return topics_; }
    [[nodiscard]] const std::string& name() const { return name_; }

    /// What the broker keeps of the world, as of now. From then on it is followed.
    [[nodiscard]] const daemon::KeptMessages& kept();
    [[nodiscard]] const daemon::KeptMessages& kept_now() const { return kept_; }

    /// Which step of this session each daemon has done.
    void listen_to_acks() { link_->subscribe(topics_.all(daemon::Topic::Kind::ack)); }
    [[nodiscard]] int acknowledged(const std::string& name) const;

    void publish(daemon::Topic::Kind kind, const std::string& name, std::string_view text);
    /// Returns when the broker has taken all. Throws ControlError.
    void finish();

  private:
    void take(const daemon::MqttMessage& message);

    boost::asio::io_context io_;
    std::string name_;
    daemon::FleetConfig config_;
    daemon::Topics topics_;
    daemon::KeptMessages kept_;
    std::string marker_;  ///< the topic of this session's own marks
    int marks_ = 0;
    int marks_seen_ = 0;
    std::map<std::string, int> acknowledged_;  ///< by daemon
    std::unique_ptr<daemon::MqttLink> link_;
};

}  // namespace scipd::tools
