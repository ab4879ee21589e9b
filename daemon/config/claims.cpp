// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/claims.h"

#include <algorithm>

#include <arpa/inet.h>

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

/// The host in the form of IPv6, in which A.B.C.D of IPv4 is ::ffff:A.B.C.D.
in6_addr host_of(const Address& address) {
    const bool v6 = address.host.find(':') != std::string::npos;
    in6_addr host{};
    inet_pton(AF_INET6, (v6 ? address.host : "::ffff:" + address.host).c_str(), &host);
    return host;
}

/// Whether `host` is `other`, or all interfaces and `other` is one of them.
bool has(const in6_addr& host, const in6_addr& other) {
    const in6_addr all_v4 = host_of({"0.0.0.0"});
    if (IN6_IS_ADDR_UNSPECIFIED(&host)) return true;
    if (IN6_ARE_ADDR_EQUAL(&host, &all_v4)) return IN6_IS_ADDR_V4MAPPED(&other);
    return IN6_ARE_ADDR_EQUAL(&host, &other);
}

/// The path with the links among its folders followed. Its last part stays as it is, since a tty is
/// a link itself.
std::string real_path(const fs::path& file) {
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(file.parent_path(), error);
    return error ? file : folder / file.filename();
}

bool lies_below(const std::string& file, const std::string& folder) {
    return file.starts_with(folder + "/");
}

}  // namespace

bool exclude_each_other(const Address& one, const Address& other) {
    const in6_addr first = host_of(one);
    const in6_addr second = host_of(other);
    return one.port == other.port && (has(first, second) || has(second, first));
}

void Claims::claim(const sim::YamlField* field, const std::string& what) {
    if (!field) return;
    const auto [owner, is_new] = owner_of_.emplace(what, field->path);
    if (!is_new) faults_.add(*field, what + " is taken by " + owner->second + "; use another");
}

void Claims::claim_file(const sim::YamlField* field, const fs::path& file) {
    if (!field) return;
    const std::string path = real_path(file);
    const auto in_its_way = std::ranges::find_if(files_, [&](const auto& other) {
        return lies_below(path, other.first) || lies_below(other.first, path);
    });
    if (in_its_way != files_.end()) {
        faults_.add(*field, path + " and " + in_its_way->first + " of " + in_its_way->second +
                                " cannot both be: one is a folder of the other; use another");
    }
    files_.emplace(path, field->path);
    claim(field, path);
}

void Claims::claim_file(const std::string& owner, const fs::path& file) {
    const std::string path = real_path(file);
    files_.emplace(path, owner);
    owner_of_.emplace(path, owner);
}

void Claims::claim(const sim::YamlField* field, Transport transport,
                   const std::optional<Address>& address) {
    if (!field || !address || address->port == 0) return;
    auto& taken = taken_[{transport, address->port}];
    const auto other = std::ranges::find_if(
        taken, [&](const Taken& by) { return exclude_each_other(by.address, *address); });
    if (other == taken.end()) return taken.push_back({*address, field->path});
    const bool equal = other->address == *address;
    faults_.add(*field, text_of(*address) + " is taken by " + other->owner +
                            (equal ? "" : ", which has " + text_of(other->address)) +
                            "; use another");
}

}  // namespace scipd::daemon
