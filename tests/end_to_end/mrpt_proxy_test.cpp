// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A driver that others wrote, MRPT's CHokuyoURG, through `scipcat proxy`: it sees the same room,
// and fails where a fault of the proxy has it fail.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/recording/open_recording.h"
#include "sim/recording/values/recording.h"
#include "tests/end_to_end/mrpt_driver.h"
#include "tests/end_to_end/square_room.h"
#include "tests/support/daemon_process.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;

/// scipcat proxy, from its first line until end().
class ProxyProcess {
  public:
    explicit ProxyProcess(std::vector<std::string> words) {
        std::array<int, 2> out{};
        if (::pipe(out.data()) != 0) throw std::runtime_error("no pipe");
        words.insert(words.begin(), {SCIPCAT, "proxy"});
        words.emplace_back("--json");
        std::vector<char*> arguments;
        for (std::string& word : words)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        pid_ = ::fork();
        if (pid_ == 0) {
            ::dup2(out[1], STDOUT_FILENO);
            ::execv(arguments[0], arguments.data());
            ::_exit(127);
        }
        ::close(out[1]);
        std::array<char, 512> line{};
        const auto stream = std::unique_ptr<FILE, int (*)(FILE*)>(::fdopen(out[0], "r"), fclose);
        if (std::fgets(line.data(), line.size(), stream.get()) == nullptr)
            throw std::runtime_error("the proxy does not listen");
        place_ = nlohmann::json::parse(line.data()).at("listen");
    }
    ProxyProcess(const ProxyProcess&) = delete;
    ProxyProcess& operator=(const ProxyProcess&) = delete;
    ~ProxyProcess() { end(); }

    [[nodiscard]] MrptDriver driver() const {
        if (place_.starts_with('/')) return MrptDriver(std::filesystem::path(place_));
        const std::string port = place_.substr(place_.rfind(':') + 1);
        return MrptDriver(static_cast<std::uint16_t>(std::stoi(port)));
    }

    void end() {
        if (pid_ <= 0) return;
        ::kill(pid_, SIGINT);
        ::waitpid(pid_, nullptr, 0);
        pid_ = -1;
    }

  private:
    pid_t pid_ = -1;
    std::string place_;
};

std::vector<double> in_mm(const MrptDriver::Scan& scan) {
    std::vector<double> ranges;
    for (std::size_t i = 0; i < scan.getScanSize(); ++i)
        ranges.push_back(std::round(1000.0 * static_cast<double>(scan.getScanRange(i))));
    return ranges;
}

std::vector<std::vector<double>> scans_in(const std::string& file) {
    const auto recording = sim::open_recording(file);
    if (!recording) throw std::runtime_error(recording.error().why);
    std::vector<std::vector<double>> scans;
    for (auto item = (*recording)->next(); item && *item; item = (*recording)->next()) {
        if (const auto* const scan = std::get_if<sim::RecordedScan>(&(*item)->what))
            scans.push_back(scan->ranges);
    }
    return scans;
}

class MrptProxyTest : public testing::TestWithParam<Link> {
  protected:
    MrptProxyTest()
        : daemon_(directory_, {"--scene", scene("square_room.sdf"), "--model", ust_10lx.name,
                               "--mount", "0,0,0.3,0,0,0", "--accuracy", "ideal", "--tcp",
                               "127.0.0.1:0", "--pty", "auto"}) {}

    /// The scanner by the parameter's kind of link, and drivers by the other kind.
    [[nodiscard]] std::vector<std::string> words() const {
        if (GetParam() == Link::tty) return {daemon_.tty(), "--listen", "127.0.0.1:0"};
        return {"tcp://127.0.0.1:" + std::to_string(daemon_.port()), "--pty",
                directory_.path() / "door"};
    }

    TempDir directory_;
    DaemonProcess daemon_;
};

TEST_P(MrptProxyTest, SeesTheRoomAndIsRecorded) {
    const std::string file = directory_.path() / "day.mcap";
    auto with_file = words();
    with_file.insert(with_file.end(), {"-o", file});
    ProxyProcess proxy(with_file);
    std::vector<std::vector<double>> seen;
    {
        MrptDriver driver = proxy.driver();
        while (seen.size() < 20) {
            const MrptDriver::Scan scan = driver.next_scan();
            expect_shape(scan, ust_10lx);
            EXPECT_GT(expect_room(scan, ust_10lx, {}), 900);
            seen.push_back(in_mm(scan));
        }
    }
    proxy.end();
    const auto recorded = scans_in(file);
    EXPECT_GE(recorded.size(), seen.size());
    for (const auto& scan : seen)
        EXPECT_NE(std::ranges::find(recorded, scan), recorded.end());
}

// As with a cut of scipd (MrptFaultsTest): it fails, and connects anew.
TEST_P(MrptProxyTest, LosesItsScannerByAFaultAndFindsItAgain) {
    auto with_fault = words();
    with_fault.insert(with_fault.end(), {"--fault", "cut,how=silent,at.scan=20,for.s=2"});
    const ProxyProcess proxy(with_fault);
    MrptDriver driver = proxy.driver();
    int failures = 0;
    int scans = 0;
    int after = 0;
    const auto until = std::chrono::steady_clock::now() + 40s;
    while (after < 10 && std::chrono::steady_clock::now() < until) {
        const MrptDriver::Look look = driver.look();
        if (look.scan) failures > 0 ? ++after : ++scans;
        if (!look.failed) continue;
        ++failures;
        after = 0;
        std::this_thread::sleep_for(20ms);
    }
    EXPECT_LE(scans, 20);
    EXPECT_GT(failures, 0);
    EXPECT_EQ(after, 10);
}

INSTANTIATE_TEST_SUITE_P(Links, MrptProxyTest, testing::Values(Link::tcp, Link::tty));

}  // namespace
}  // namespace scipd::tests
