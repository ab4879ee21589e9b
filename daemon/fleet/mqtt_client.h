// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A client of the MQTT library as the configuration wants it: its user, its TLS. Not its
// connection. One thread.
#pragma once

#include <memory>
#include <string>

#include "daemon/config/fleet_config.h"

struct mosquitto;

namespace scipd::daemon {

struct EndMqttClient {
    void operator()(mosquitto* client) const;
};
using MqttClient = std::unique_ptr<mosquitto, EndMqttClient>;

/// The library hands `link` to all that it calls. Throws std::runtime_error where the files of TLS
/// are no good.
MqttClient make_mqtt_client(const FleetConfig& config, const std::string& name, void* link);

/// Throws std::runtime_error unless the library's code is that of success.
void require_mqtt(int code, const std::string& what);

}  // namespace scipd::daemon
