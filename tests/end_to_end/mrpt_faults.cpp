// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/end_to_end/mrpt_faults.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/support/control_request.h"

namespace scipd::tests {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error("there is no " + file.string());
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
}

}  // namespace

void Seen::add(const MrptDriver::Look& look) {
    const auto now = Steady::now();
    if (now - last > 500ms) silent = true;
    if (look.failed) {
        ++failures;
        in_a_row = 0;
    }
    if (!look.scan) return;
    ++scans;
    ++in_a_row;
    last = now;
    const double told_s = mrpt::Clock::toDouble(look.scan->timestamp);
    if (std::abs(told_s - mrpt::Clock::nowDouble()) > 10.0) ++off_time;
}

void expect_scans(MrptDriver& driver) {
    EXPECT_NO_THROW(watch(driver, [](const Seen& seen) { return seen.in_a_row >= 10; }));
}

void expect_no_scan(MrptDriver& driver, std::chrono::seconds time) {
    const auto end = Steady::now() + time;
    const Seen seen = watch(driver, [&](const Seen&) { return Steady::now() > end; });
    EXPECT_EQ(seen.scans, 0);
}

void MrptFaultsTest::start(const std::vector<std::string>& arguments) {
    daemon_.emplace(directory_, arguments);
    ASSERT_NE(daemon_->ready_line(), "") << daemon_->standard_error();
}

void MrptFaultsTest::start_configuration(const std::filesystem::path& file) {
    std::string text = text_of(file);
    for (const char* const port : {":10940", ":10941", ":10942", ":14550"})
        replace_all(text, port, ":0");
    const std::string folder = file.parent_path().string() + "/";
    replace_all(text, "scene: ", "scene: " + folder);
    replace_all(text, "poses: rescue", "poses: " + folder + "rescue");
    start({"--config", directory_.write("on_free_ports.yaml", text)});
}

std::unique_ptr<MrptDriver> MrptFaultsTest::connect(Link link, std::size_t sensor) const {
    for (int attempt = 0; attempt < 5; ++attempt) {
        auto driver = std::make_unique<MrptDriver>(*daemon_, link, sensor);
        try {
            (void)driver->next_scan();
            return driver;
        } catch (const std::runtime_error&) {
            // The next one.
        }
    }
    throw std::runtime_error("no driver gets scans");
}

void MrptFaultsTest::run(const std::string& file) {
    const nlohmann::json scenario = {{"name", file}, {"yaml", text_of(scene("faults") / file)}};
    const auto answer = control_request(daemon_->control(), "PUT", "/scenario", scenario.dump());
    ASSERT_EQ(answer.status, 200) << answer.body;
}

bool MrptFaultsTest::over() const {
    return daemon_->get("/scenario")["state"] == "ended";
}

Seen MrptFaultsTest::watch_until_over(MrptDriver& driver) {
    return watch(driver, [this](const Seen&) { return over(); });
}

}  // namespace scipd::tests
