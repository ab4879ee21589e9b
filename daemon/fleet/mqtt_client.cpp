// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/mqtt_client.h"

#include <filesystem>
#include <stdexcept>

#include <mosquitto.h>

namespace scipd::daemon {
namespace {

const char* path_or_null(const std::filesystem::path& path) {
    return path.empty() ? nullptr : path.c_str();
}

}  // namespace

void require_mqtt(int code, const std::string& what) {
    if (code != MOSQ_ERR_SUCCESS) throw std::runtime_error(what + ": " + mosquitto_strerror(code));
}

void EndMqttClient::operator()(mosquitto* client) const {
    mosquitto_destroy(client);
}

MqttClient make_mqtt_client(const FleetConfig& config, const std::string& name, void* link) {
    require_mqtt(mosquitto_lib_init(), "cannot prepare the MQTT library");
    constexpr bool begin_anew = true;
    MqttClient client(mosquitto_new(name.c_str(), begin_anew, link));
    if (client == nullptr) throw std::runtime_error("cannot make an MQTT client");
    // Else a message waits until the broker's TCP confirms the one before it, up to 40 ms later.
    mosquitto_int_option(client.get(), MOSQ_OPT_TCP_NODELAY, 1);
    if (!config.user.name.empty())
        mosquitto_username_pw_set(client.get(), config.user.name.c_str(),
                                  config.user.password.c_str());
    if (!config.broker.tls) return client;
    const BrokerTls& tls = config.tls;
    require_mqtt(mosquitto_tls_set(client.get(), path_or_null(tls.ca),
                                   tls.ca.empty() ? "/etc/ssl/certs" : nullptr,
                                   path_or_null(tls.cert), path_or_null(tls.key), nullptr),
                 "cannot use the files of fleet.tls");
    return client;
}

}  // namespace scipd::daemon
