// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What two parts of one configuration cannot share: addresses, paths, standard input. The first to
// ask keeps it; the second is a fault. Two addresses may take the same port on the same interface
// without being equal. One thread at a time.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "daemon/config/address.h"
#include "daemon/config/section.h"

namespace scipd::daemon {

enum class Transport { tcp, udp };

/// Whether only one of two sockets can have its address: the same one, or all interfaces of it.
/// [::] is those of IPv4 as well, as Linux has it unless told otherwise.
bool exclude_each_other(const Address& one, const Address& other);

class Claims {
  public:
    explicit Claims(Faults& faults) : faults_(faults) {}

    /// `field` wants it; null claims nothing.
    void claim(const Field* field, const std::string& what);
    /// A file, however the path is spelt.
    void claim_file(const Field* field, const std::filesystem::path& file);
    /// The same by default, for somebody whose key may be left out.
    void claim_file(const std::string& owner, const std::filesystem::path& file);
    /// A port that the system chooses is nobody else's.
    void claim(const Field* field, Transport transport, const std::optional<Address>& address);

  private:
    struct Taken {
        Address address;
        std::string owner;
    };

    Faults& faults_;
    std::map<std::string, std::string> owner_of_;
    std::map<std::string, std::string> files_;  ///< whose they are, of those among them
    std::map<std::pair<Transport, std::uint16_t>, std::vector<Taken>> taken_;
};

}  // namespace scipd::daemon
