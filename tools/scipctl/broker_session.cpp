// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/broker_session.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "daemon/config/secret_file.h"
#include "daemon/fleet/pose_frame.h"
#include "daemon/fleet/topics.h"
#include "tools/control_client.h"

namespace scipd::tools {

using daemon::Topic;

namespace {

constexpr auto patience = std::chrono::seconds(10);

template <class Value>
Value checked(const char* option, sim::Expected<Value> value) {
    if (!value) throw CLI::ValidationError(option, value.error().why);
    return *std::move(value);
}

daemon::FleetConfig config_of(const BrokerOptions& options) {
    const auto said = checked("--to", daemon::parse_broker_and_world(options.to));
    daemon::FleetConfig config{.broker = said.broker, .world = said.world};
    config.tls.ca = options.ca;
    if (!options.user_file.empty()) {
        const auto line = daemon::secret_in(options.user_file);
        config.user = checked("--user-file", line.and_then(daemon::parse_broker_user));
    }
    return config;
}

}  // namespace

void add_broker_options(CLI::App& command, BrokerOptions& options, const std::string& help) {
    command.add_option("--to", options.to, help)->type_name("mqtt://HOST:PORT/WORLD");
    command
        .add_option("--user-file", options.user_file, "a file with USER:PASSWORD for the broker")
        ->check(CLI::ExistingFile);
    command
        .add_option("--ca", options.ca, "file of CA certificates that verify an mqtts:// broker")
        ->check(CLI::ExistingFile);
}

BrokerSession::BrokerSession(const BrokerOptions& options)
    : name_("scipctl-" + daemon::usual_name()),
      config_(config_of(options)),
      topics_(config_.world) {
    const std::string instance = daemon::new_instance();
    const std::string marker = topics_.of(Topic::Kind::marker, instance);
    daemon::MqttLink::Hooks hooks{
        .connected = [this, marker] { link_->subscribe(marker); },
        .message = [this](const daemon::MqttMessage& message) { take(message); },
        .lost = [](const std::string&) {}};
    link_ = std::make_unique<daemon::MqttLink>(io_.get_executor(), config_, "scipctl-" + instance,
                                               daemon::MqttLink::Will{}, std::move(hooks));
    marker_ = marker;
    if (!link_->run_until([&] { return link_->connected(); }, patience))
        throw ControlError(0, text_of(config_.broker) + ": " + link_->trouble());
}

void BrokerSession::take(const daemon::MqttMessage& message) {
    const auto topic = topics_.read(message.topic);
    if (!topic) return;
    if (topic->kind == Topic::Kind::marker)
        marks_seen_ = std::atoi(std::string(message.payload).c_str());
    if (topic->kind == Topic::Kind::ack) {
        if (const auto step = daemon::acknowledged(message.payload, name_))
            acknowledged_[topic->name] = *step;
    }
    kept_.take(*topic, message.payload);
}

int BrokerSession::acknowledged(const std::string& name) const {
    const auto found = acknowledged_.find(name);
    return found == acknowledged_.end() ? 0 : found->second;
}

const daemon::KeptMessages& BrokerSession::kept() {
    for (const auto kind :
         {Topic::Kind::scene, Topic::Kind::daemon, Topic::Kind::model, Topic::Kind::places})
        link_->subscribe(topics_.all(kind));
    finish();
    return kept_;
}

void BrokerSession::publish(Topic::Kind kind, const std::string& name, std::string_view text) {
    const bool passes = kind == Topic::Kind::poses || kind == Topic::Kind::time;
    link_->publish(topics_.of(kind, name), text,
                   {.surely = kind != Topic::Kind::poses, .kept = !passes});
}

// What was sent before the mark has arrived when the mark comes back.
void BrokerSession::finish() {
    link_->publish(marker_, std::to_string(++marks_), {.surely = true});
    if (!link_->run_until([&] { return marks_seen_ == marks_; }, patience))
        throw ControlError(0, text_of(config_.broker) + ": " + link_->trouble());
}

}  // namespace scipd::tools
