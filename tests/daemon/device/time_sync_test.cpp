// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A time-synchronising driver against every timing family: from TM1 and from the stamps of scans
// alone, with the times at which it sends and receives, it tells how fast the device's clock runs
// and when each scan began. It knows nothing of what was injected; world time is stepped, so ten
// minutes take moments.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "protocol/char_code.h"
#include "protocol/client/decoder.h"
#include "protocol/client/scan_message.h"
#include "tests/daemon/stepped_driver.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;
using protocol::client::ScanMessage;

double milliseconds(sim::Time time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

/// 24 bits unwrapped: the value nearest to what is expected.
double unwrapped_ms(double stamp_ms, double expected_ms) {
    constexpr double wrap_ms = 16'777'216.0;
    return stamp_ms + wrap_ms * std::round((expected_ms - stamp_ms) / wrap_ms);
}

struct Case {
    std::string model;
    double ppm;
};

void PrintTo(const Case& c, std::ostream* out) {  // NOLINT(readability-identifier-naming)
    *out << c.model << " at " << c.ppm << " ppm";
}

class TimeSync : public testing::TestWithParam<Case> {
  protected:
    /// By how much the device's clock is ahead, at a time.
    struct Ahead {
        double at_ms;
        double ms;
    };

    static SensorConfig sensor(const Case& c) {
        SensorConfig config = ideal_sensor(c.model);
        config.timing = Timing::real;
        config.clock = {.ppm = c.ppm, .start_ms = 16'777'216 - 250'000};  // wraps on the way
        return config;
    }

    /// The device's clock is ahead of world time by at least so much: no reply shows a time that
    /// the device has not reached when it arrives. With many replies, each at another phase of its
    /// millisecond, the bound becomes tight.
    Ahead ahead() {
        EXPECT_EQ(driver_.ask("TM0"), "TM0\n00P\n\n");
        Ahead bound{0.0, -1e18};
        for (int i = 0; i < 400; ++i) {
            driver_.wait(130us * (1 + i % 11));
            driver_.send("TM1");
            const SteppedDriver::Received reply = driver_.await();
            const std::string_view stamp = std::string_view(reply.bytes).substr(8, 4);
            const double now_ms = milliseconds(reply.at);
            const double shown_ms = unwrapped_ms(
                static_cast<double>(protocol::decode(stamp).value_or(0)), now_ms + start_ms_);
            if (shown_ms - now_ms > bound.ms) bound = {now_ms, shown_ms - now_ms};
        }
        EXPECT_EQ(driver_.ask("TM2"), "TM2\n00P\n\n");
        return bound;
    }

    static constexpr double start_ms_ = 16'777'216 - 250'000;

    SteppedDriver driver_{sensor(GetParam())};
};

/// A straight line through (i, values[i]).
struct Line {
    double at_0;
    double slope;
};
Line line_through(const std::vector<double>& x, const std::vector<double>& y) {
    const auto n = static_cast<double>(x.size());
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        sxy += x[i] * y[i];
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    return {(sy - slope * sx) / n, slope};
}

TEST_P(TimeSync, RecoversTheRateAndTheInstantsOfScans) {
    driver_.wait_until(1s);
    const Ahead first = ahead();
    driver_.wait_until(600s);
    const Ahead second = ahead();
    const double ppm = (second.ms - first.ms) / (second.at_ms - first.at_ms) * 1e6;
    EXPECT_NEAR(ppm, GetParam().ppm, 2.0);

    // Scans: their number against their stamps gives a line without the grain of a millisecond.
    const int step = driver_.profile().afrt;
    const std::string digits = std::to_string(10000 + step).substr(1);
    const std::string stream = "MD" + digits + digits + "00099";
    EXPECT_EQ(driver_.ask(stream), stream + "\n00P\n\n");
    std::vector<double> number;
    std::vector<double> stamp_ms;
    std::vector<double> true_ms;
    protocol::client::Decoder decoder;
    while (number.size() < 99) {
        const SteppedDriver::Received received = driver_.await();
        std::string_view bytes = received.bytes;
        const auto message = decoder.next(bytes);
        ASSERT_TRUE(message);
        const auto scan = protocol::client::parse_scan(*message);
        ASSERT_TRUE(std::holds_alternative<ScanMessage>(scan));
        number.push_back(static_cast<double>(received.scan->revolution));
        true_ms.push_back(milliseconds(received.scan->start));
        stamp_ms.push_back(unwrapped_ms(std::get<ScanMessage>(scan).stamp_ms,
                                        milliseconds(received.at) + start_ms_));
    }
    const double rate = 1.0 + ppm * 1e-6;
    const Line line = line_through(number, stamp_ms);
    // Where a mirror turns in whole milliseconds every stamp is rounded by the same.
    const bool same_rounding = driver_.profile().scan_period % 1ms == 0ms;
    // Where the clock is read well before the reply leaves the bound stays loose by so much.
    const double looseness_ms = milliseconds(driver_.profile().reply_delay / 2);
    const double tolerance_ms = (same_rounding ? 0.51 : 0.3) + looseness_ms;
    for (std::size_t i = 0; i < number.size(); ++i) {
        // Stamps are whole milliseconds, rounded down.
        const double device_ms = line.at_0 + line.slope * number[i] + 0.5;
        const double estimate_ms = second.at_ms + (device_ms - second.at_ms - second.ms) / rate;
        EXPECT_NEAR(estimate_ms, true_ms[i], tolerance_ms) << number[i];
    }
}

std::vector<Case> cases() {
    std::vector<Case> all;
    double ppm = -180.0;
    for (const Model& model : models()) {
        all.push_back({model.profile.name + "@" + model.profile.release, ppm});
        ppm += 23.7;
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(EveryModel, TimeSync, testing::ValuesIn(cases()));

}  // namespace
}  // namespace scipd::daemon
