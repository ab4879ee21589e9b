// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A time-synchronising driver against every timing family: from TM1 and from the stamps of scans
// alone, with the times at which it sends and receives, it tells how fast the device's clock runs
// and when each scan began. It knows nothing of what was injected; world time is stepped, so ten
// minutes take moments.
#include <algorithm>
#include <cmath>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/device/client.h"
#include "daemon/device/device.h"
#include "daemon/device/scan_loop.h"
#include "daemon/device/stepped_clock.h"
#include "daemon/models/registry.h"
#include "protocol/char_code.h"
#include "protocol/client/decoder.h"
#include "protocol/client/scan_message.h"
#include "tests/daemon/wall_world.h"

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
    struct Received {
        sim::Time at;
        std::string bytes;
        sim::SharedScan scan;  ///< the latest one then
    };

    /// Of the device's clock, at a time.
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

    void collect() {
        while (const auto action = client_.next_action()) {
            if (const auto* message = std::get_if<protocol::Send>(&*action))
                received_.push_back({clock_.now(), message->bytes, device_.latest_scan()});
        }
        if (const auto at = client_.wake_at()) {
            alarm_->set(*at, [this] {
                client_.wake();
                collect();
            });
        }
    }

    void send(const std::string& line) {
        client_.receive(line + "\n");
        collect();
    }

    Received await() {
        while (received_.empty()) {
            clock_.advance_to(clock_.now() + 100us);
            collect();
        }
        Received first = received_.front();
        received_.pop_front();
        return first;
    }

    std::string ask(const std::string& line) {
        send(line);
        return await().bytes;
    }

    /// The device's clock is ahead of world time by at least so much: no reply shows a time that
    /// the device has not reached when it arrives. With many replies, each at another phase of its
    /// millisecond, the bound becomes tight.
    Ahead ahead() {
        EXPECT_EQ(ask("TM0"), "TM0\n00P\n\n");
        Ahead bound{0.0, -1e18};
        for (int i = 0; i < 400; ++i) {
            clock_.advance_to(clock_.now() + 130us * (1 + i % 11));
            send("TM1");
            const Received reply = await();
            const std::string_view stamp = std::string_view(reply.bytes).substr(8, 4);
            const double now_ms = milliseconds(reply.at);
            const double shown_ms = unwrapped_ms(
                static_cast<double>(protocol::decode(stamp).value_or(0)), now_ms + start_ms_);
            if (shown_ms - now_ms > bound.ms) bound = {now_ms, shown_ms - now_ms};
        }
        EXPECT_EQ(ask("TM2"), "TM2\n00P\n\n");
        return bound;
    }

    static constexpr double start_ms_ = 16'777'216 - 250'000;

    SteppedClock clock_;
    World world_ = wall_world();
    Device device_{"robot", sensor(GetParam()), 1, world_, clock_};
    ScanLoop loop_{device_, clock_};
    std::unique_ptr<Clock::Alarm> alarm_ = clock_.make_alarm();
    Client client_{device_, [this] { collect(); }};
    std::deque<Received> received_;
};

/// Of a straight line through (i, values[i]).
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
    clock_.advance_to(1s);
    const Ahead first = ahead();
    clock_.advance_to(600s);
    const Ahead second = ahead();
    const double ppm = (second.ms - first.ms) / (second.at_ms - first.at_ms) * 1e6;
    EXPECT_NEAR(ppm, GetParam().ppm, 2.0);

    // Scans: their number against their stamps gives a line without the grain of a millisecond.
    const int step = device_.profile().afrt;
    const std::string digits = std::to_string(10000 + step).substr(1);
    const std::string stream = "MD" + digits + digits + "00099";
    EXPECT_EQ(ask(stream), stream + "\n00P\n\n");
    std::vector<double> number;
    std::vector<double> stamp_ms;
    std::vector<double> true_ms;
    protocol::client::Decoder decoder;
    while (number.size() < 99) {
        const Received received = await();
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
    for (std::size_t i = 0; i < number.size(); ++i) {
        // Stamps are whole milliseconds, rounded down.
        const double device_ms = line.at_0 + line.slope * number[i] + 0.5;
        const double estimate_ms = second.at_ms + (device_ms - second.at_ms - second.ms) / rate;
        EXPECT_NEAR(estimate_ms, true_ms[i], 0.3) << number[i];
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
