// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/running.h"

#include <algorithm>
#include <stdexcept>

#include "testing/find_program.h"
#include "testing/scipd_command.h"

namespace scipd::testing {
namespace {

using namespace std::chrono_literals;

// A large world takes long, and a sanitized scipd longer.
constexpr auto ready_patience = 120s;
// Its sockets close a little before it has ended, as a core may be written in between.
constexpr auto ending_patience = 3s;
constexpr int log_lines = 12;

std::string how_it_ended(int code) {
    return code < 0 ? "was ended by signal " + std::to_string(-code)
                    : "ended with exit code " + std::to_string(code);
}

bool is_called(const Json& sensor, const std::string& name) {
    const std::string whole = sensor.at("name");
    return name == whole || name == whole.substr(whole.find('/') + 1);
}

bool is_scanner(const Json& sensor) {
    return !sensor.at("tcp").is_null() || !sensor.at("pty").is_null();
}

std::string names_of(const Json& sensors) {
    std::string names;
    for (const Json& sensor : sensors)
        names += (names.empty() ? "" : ", ") + sensor.at("name").get<std::string>();
    return names;
}

}  // namespace

Running::Running(const Options& options)
    : process_([&](const auto& folder) { return command_for(options, find_program(), folder); }) {
    const std::string line = process_.first_line(ready_patience);
    if (line.empty()) {
        const auto code = process_.exit_code(ending_patience);
        process_.end();
        throw ScipdNotReady("scipd " +
                            (code ? "did not start: it " + how_it_ended(*code)
                                  : "was not ready within two minutes") +
                            ". The end of its log:\n" + log_end());
    }
    ready_ = Json::parse(line);
    client_.emplace(control());
}

std::vector<std::string> Running::robots() const {
    std::vector<std::string> robots;
    for (const Json& sensor : ready_.at("sensors")) {
        const std::string name = sensor.at("name");
        const std::string robot = name.substr(0, name.find('/'));
        if (std::ranges::find(robots, robot) == robots.end()) robots.push_back(robot);
    }
    return robots;
}

const Json& Running::sensor(const std::string& name) const {
    const Json& sensors = ready_.at("sensors");
    if (name.empty()) {
        const auto scanner = std::ranges::find_if(sensors, is_scanner);
        return scanner == sensors.end() ? sensors.at(0) : *scanner;
    }
    const auto fits = [&](const Json& sensor) { return is_called(sensor, name); };
    if (std::ranges::count_if(sensors, fits) == 1) return *std::ranges::find_if(sensors, fits);
    throw std::invalid_argument("'" + name +
                                "' names no sensor, or several; there are: " + names_of(sensors));
}

template <class Question>
auto Running::answer_to(Question question) {
    if (closed_) throw ScipdEnded("this scipd was closed");
    try {
        return question(*client_);
    } catch (const tools::ControlError& error) {
        if (error.status() == 0) tell_why_gone();
        throw Refused(error.status(),
                      "scipd refused it (" + std::to_string(error.status()) + "): " + error.what());
    }
}

Json Running::ask(const std::string& method, const std::string& path, const Json& body) {
    return answer_to([&](tools::ControlClient& client) {
        const std::string answer =
            client.ask(method, path, body.is_null() ? std::string() : body.dump());
        Json document = Json::parse(answer, nullptr, false);
        if (!document.is_discarded()) return document;
        return answer.empty() ? Json() : Json(answer);
    });
}

Json Running::get(const std::string& path) {
    return answer_to([&](tools::ControlClient& client) { return client.get(path); });
}

void Running::put(const std::string& path, const Json& body) {
    answer_to([&](tools::ControlClient& client) { client.put(path, body); });
}

std::string Running::log_end() const {
    std::string text = log();
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    std::size_t begin = text.size();
    for (int i = 0; i < log_lines && begin != text.npos && begin > 0; ++i)
        begin = text.rfind('\n', begin - 1);
    if (text.empty()) return "(it has said nothing)";
    return begin == text.npos || begin == 0 ? text : text.substr(begin + 1);
}

std::optional<int> Running::exit_code() {
    const auto code = process_.exit_code();
    if (code) told_ = true;
    return code;
}

void Running::close() {
    if (closed_) return;
    closed_ = true;
    const bool had_ended = process_.exit_code().has_value();
    process_.end();
    const int code = process_.exit_code().value_or(0);
    if ((had_ended || code != 0) && !told_) throw gone(code);
}

void Running::tell_why_gone() {
    const auto code = process_.exit_code(ending_patience);
    if (code) throw gone(*code);
    throw ScipdError("scipd does not answer on " + control() + ". The end of its log:\n" +
                     log_end());
}

ScipdEnded Running::gone(int code) {
    told_ = true;
    return ScipdEnded("scipd " + how_it_ended(code) +
                      " while it was needed. The end of its log:\n" + log_end());
}

std::string sensor_path(const std::string& name) {
    const std::size_t slash = name.find('/');
    return "/sensors/" + tools::path_segment(name.substr(0, slash)) + "/" +
           tools::path_segment(name.substr(slash + 1));
}

}  // namespace scipd::testing
