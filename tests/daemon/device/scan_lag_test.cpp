// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How old scans are when they leave, over a minute of every firmware: drivers that take the time of
// arrival for that of measurement rely on its being always the same.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "tests/daemon/stepped_driver.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

struct Ages {
    sim::Time youngest = sim::Time::max();
    sim::Time oldest = sim::Time::min();

    void add(sim::Time age) {
        youngest = std::min(youngest, age);
        oldest = std::max(oldest, age);
    }
};

class ScanLag : public testing::TestWithParam<Model> {
  protected:
    static SensorConfig sensor() {
        SensorConfig config =
            ideal_sensor(GetParam().profile.name + "@" + GetParam().profile.release);
        config.timing = Timing::real;
        return config;
    }

    /// A request for the front step alone: the code, then what follows the step.
    [[nodiscard]] std::string request(const std::string& code, const std::string& rest) const {
        const std::string step = std::to_string(10000 + driver_.profile().afrt).substr(1);
        return code + step + step + rest;
    }

    [[nodiscard]] sim::Time period() const { return driver_.profile().scan_period; }

    Ages ages_in_a_stream() {
        const std::string stream = request("MD", "00000");
        EXPECT_EQ(driver_.ask(stream), stream + "\n00P\n\n");
        Ages ages;
        std::int64_t revolution = driver_.await().scan->revolution;
        const sim::Time end = driver_.now() + 60s;
        while (driver_.now() < end) {
            const SteppedDriver::Received received = driver_.await();
            EXPECT_EQ(received.scan->revolution, ++revolution) << "one was left out";
            ages.add(received.at - received.scan->start);
        }
        driver_.send("QT");
        while (!driver_.await().bytes.starts_with("QT"))
            ;
        return ages;
    }

    Ages ages_of_single_scans() {
        EXPECT_EQ(driver_.ask("BM"), "BM\n00P\n\n");
        driver_.wait(1s);
        Ages ages;
        for (int i = 0; i < 200; ++i) {
            driver_.wait(1700us * (i % 13));
            driver_.send(request("GD", "00"));
            const SteppedDriver::Received received = driver_.await();
            ages.add(received.at - received.scan->start);
        }
        return ages;
    }

    SteppedDriver driver_{sensor()};
};

TEST_P(ScanLag, IsTheSameThroughoutAStream) {
    const protocol::DeviceProfile& profile = driver_.profile();
    const Ages ages = ages_in_a_stream();
    const sim::Time measuring = period() * profile.amax / profile.ares + profile.scan_delay;
    EXPECT_GE(ages.youngest, measuring);
    EXPECT_LE(ages.oldest, std::max(measuring + profile.scan_tick, period()));
    // The ticks of the clock are all that it varies by.
    EXPECT_LE(ages.oldest - ages.youngest, profile.scan_tick);
}

TEST_P(ScanLag, OfSingleScansIsThatOfAStream) {
    const Ages stream = ages_in_a_stream();
    const Ages single = ages_of_single_scans();
    EXPECT_GE(single.youngest, stream.youngest);
    EXPECT_LE(single.oldest, stream.oldest);
}

INSTANTIATE_TEST_SUITE_P(EveryModel, ScanLag, testing::ValuesIn(models()), [](const auto& model) {
    std::string name = model.param.profile.name + "_" + model.param.profile.release;
    const auto separates = [](char c) { return c == '-' || c == '.'; };
    std::ranges::replace_if(name, separates, '_');
    return name;
});

}  // namespace
}  // namespace scipd::daemon
