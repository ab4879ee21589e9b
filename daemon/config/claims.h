// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What two parts of one configuration cannot share: addresses, paths, standard input. The first
// that claims it has it; the second is a fault. Two addresses can exclude each other without being
// equal (exclude_each_other()). One thread at a time.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "daemon/config/address.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

enum class Transport { tcp, udp };

/// Whether a second socket cannot have its address when a first one has the other: both are the
/// same, or one is all interfaces and so contains the other. [::] contains the interfaces of IPv4,
/// too, which is Linux's default.
bool exclude_each_other(const Address& one, const Address& other);

class Claims {
  public:
    explicit Claims(sim::YamlFaults& faults) : faults_(faults) {}

    /// `field` claims this; null claims nothing.
    void claim(const sim::YamlField* field, const std::string& what);
    /// `field` claims this file, however the path is spelt.
    void claim_file(const sim::YamlField* field, const std::filesystem::path& file);
    /// `owner` claims this file, although its key may be left out.
    void claim_file(const std::string& owner, const std::filesystem::path& file);
    /// `field` claims this address. Port 0, where the system chooses one, claims nothing.
    void claim(const sim::YamlField* field, Transport transport,
               const std::optional<Address>& address);

  private:
    struct Taken {
        Address address;
        std::string owner;
    };

    sim::YamlFaults& faults_;
    std::map<std::string, std::string> owner_of_;
    std::map<std::string, std::string> files_;  ///< the files among them, and who owns each
    std::map<std::pair<Transport, std::uint16_t>, std::vector<Taken>> taken_;
};

}  // namespace scipd::daemon
