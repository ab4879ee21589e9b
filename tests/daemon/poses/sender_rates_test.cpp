// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/poses/sender_rates.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using boost::asio::ip::address_v4;

const Rate::Time start = Rate::Time{} + 1000s;

TEST(SenderRates, CountsEachAddressByItself) {
    SenderRates rates;
    EXPECT_TRUE(rates.of(address_v4(1), start).admit(1, start));
    EXPECT_FALSE(rates.of(address_v4(1), start).admit(1, start));
    EXPECT_TRUE(rates.of(address_v4(2), start).admit(1, start));
}

TEST(SenderRates, TakesForgedAddressesForOneSenderOnceThereAreMany) {
    SenderRates rates;
    std::size_t admitted = 0;
    for (std::uint32_t i = 0; i < 5000; ++i)
        admitted += rates.of(address_v4(i), start).admit(1, start) ? 1 : 0;
    EXPECT_EQ(admitted, SenderRates::most_senders + 1);
    EXPECT_TRUE(rates.of(address_v4(9999), start + 2s).admit(1, start + 2s));
    EXPECT_TRUE(rates.of(address_v4(9998), start + 2s).admit(1, start + 2s))
        << "those that are silent are forgotten";
}

}  // namespace
}  // namespace scipd::daemon
