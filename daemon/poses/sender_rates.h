// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How many poses each address sends. Addresses can be forged: where there are too many, the new
// ones count as one sender. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <map>

#include <boost/asio/ip/address.hpp>

#include "daemon/limits/rate.h"

namespace scipd::daemon {

class SenderRates {
  public:
    static constexpr std::size_t most_senders = 1000;

    [[nodiscard]] Rate& of(const boost::asio::ip::address& sender, Rate::Time now) {
        if (const auto known = rates_.find(sender); known != rates_.end()) return known->second;
        if (rates_.size() >= most_senders)
            std::erase_if(rates_, [&](const auto& entry) { return entry.second.rested(now); });
        return rates_.size() >= most_senders ? others_ : rates_[sender];
    }

  private:
    std::map<boost::asio::ip::address, Rate> rates_;
    Rate others_;
};

}  // namespace scipd::daemon
