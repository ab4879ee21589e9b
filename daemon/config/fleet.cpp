// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/fleet.h"

#include <array>
#include <string>

#include "daemon/config/numbers.h"
#include "daemon/config/secret_file.h"
#include "daemon/config/values.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> fleet_keys{"broker",    "world", "name",
                                                     "user_file", "tls",   "near_m"};
constexpr std::array<std::string_view, 3> tls_keys{"ca", "cert", "key"};

sim::Expected<BrokerUser> parse_user_file(std::string_view text, const fs::path& base) {
    return parse_file(text, base).and_then(secret_in).and_then([](const std::string& line) {
        return parse_broker_user(line);
    });
}

void read_tls(const sim::YamlField& field, const fs::path& base, FleetConfig& fleet,
              sim::YamlFaults& faults) {
    const sim::YamlSection section{field, tls_keys, faults};
    const auto parse = [&](const std::string& text) { return parse_file(text, base); };
    section.read("ca", fleet.tls.ca, parse);
    section.read("cert", fleet.tls.cert, parse);
    section.read("key", fleet.tls.key, parse);
    if (!fleet.broker.tls) faults.add(field, "needs a broker: mqtts://HOST:PORT");
    if (fleet.tls.cert.empty() != fleet.tls.key.empty())
        faults.add(field, "cert and key go together");
}

}  // namespace

void read_fleet(const sim::YamlField& field, const fs::path& base, Config& config,
                sim::YamlFaults& faults) {
    const sim::YamlSection section{field, fleet_keys, faults};
    FleetConfig& fleet = config.fleet.emplace();
    for (const std::string_view key : {"broker", "world"}) {
        if (field.value.IsMap() && !section.find(key))
            faults.add(field, "needs " + std::string(key) +
                                  ", such as {broker: mqtt://127.0.0.1:1883, world: warehouse}");
    }
    section.read("broker", fleet.broker, parse_broker);
    section.read("world", fleet.world, parse_world_name);
    section.read("name", fleet.name, parse_name);
    section.read("user_file", fleet.user,
                 [&](const std::string& text) { return parse_user_file(text, base); });
    if (const sim::YamlField* const tls = section.find("tls")) read_tls(*tls, base, fleet, faults);
    section.read("near_m", fleet.near_m, parse_length);
}

}  // namespace scipd::daemon
