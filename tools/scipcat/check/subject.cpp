// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/subject.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <variant>

#include "protocol/char_code.h"
#include "protocol/client/error.h"

namespace scipd::tools::checks {
namespace {

using protocol::client::Error;
using protocol::client::timed_out;
using std::chrono::milliseconds;

/// "GD", "TM" or "%ST": a request without its parameters.
std::string command_of(std::string_view request) {
    return std::string(request.substr(0, request.starts_with('%') ? 3 : 2));
}

}  // namespace

Subject::Subject(Conversation::Place place) : wire_(std::move(place)) {
    const std::string status = status_of_quit();
    if (status.empty()) {
        const std::string& heard = wire_.got();
        if (heard.empty())
            throw timed_out("answer to QT", wire_.place().patience, protocol::client::maybe_busy);
        throw Error(Error::Kind::foreign,
                    "what answers there does not speak SCIP (QT was answered with \"" +
                        printable(heard) + "\")");
    }
    speaks_scip1_ = status.size() == 1;
    facts_.commands.insert("QT");
}

void Subject::begin() {
    wire_.begin();
    lacking_.clear();
}

bool Subject::responds() {
    if (status_of_quit().empty()) return false;
    try {
        (void)wire_.listen(milliseconds(50));
    } catch (const Error&) {
        wire_.hang_up();
    }
    return true;
}

bool Subject::on_tty() const {
    return std::holds_alternative<TtyTarget>(wire_.place().target);
}

bool Subject::on_serial_line() const {
    return on_tty() && facts_.text("SBPS").find("[bps]") != std::string::npos;
}

void Subject::introduce() {
    if (speaks_scip1_) {
        (void)try_ask("SCIP2.0");
        speaks_scip1_ = status_of_quit().size() == 1;
        if (speaks_scip1_) return;
    }
    rest();
    learn_texts();
    learn_commands();
}

// The slowest of the replies tells how slow the line is: what comes by network or USB comes whole.
void Subject::learn_texts() {
    ms_per_byte_ = 0.0;
    for (const char* const request : {"VV", "PP", "II"}) {
        const auto answer = try_ask(request);
        if (!answer || is_unknown(answer->status())) continue;
        facts_.commands.insert(request);
        take_texts(facts_, answer->raw);
        const std::chrono::duration<double, std::milli> lasted = answer->came_at - answer->begun_at;
        ms_per_byte_ =
            std::max(ms_per_byte_, lasted.count() / static_cast<double>(answer->raw.size()));
    }
    conclude(facts_);
}

// As UrgBenri does: a bare command is refused for its length or for the state where it is known.
void Subject::learn_commands() {
    for (const char* const request :
         {"GD", "GS", "GE", "HD", "HE",  "GF",  "GG",   "MD",  "MS",  "ME",
          "ND", "NE", "MF", "MG", "%MD", "%ME", "%TM1", "%ST", "TM2", "BM"}) {
        if (!refuses(request)) facts_.commands.insert(command_of(request));
    }
    rest();
}

/// A scanner that hangs up at a bare command knows it: the check of short requests is for that.
bool Subject::refuses(const std::string& command) {
    try {
        const auto answer = try_ask(command);
        return !answer || is_unknown(answer->status());
    } catch (const Error& error) {
        if (error.kind() != Error::Kind::closed) throw;
        wire_.reconnect();
        return false;
    }
}

void Subject::note_unknown(const std::string& request, std::string_view status) {
    const std::string command = command_of(request);
    if (is_unknown(status) && !facts_.knows(command)) lacking_.push_back(command);
}

/// The empty line ends a request that an earlier client left unfinished. Empty: nothing that is
/// SCIP answers.
std::string Subject::status_of_quit() {
    constexpr int tries = 3;
    for (int i = 0; i < tries; ++i) {
        const auto answer = try_ask("\nQT\n", "QT");
        if (!answer) continue;
        const std::string line = answer->lines().at(1);
        return line.size() > 1 ? line.substr(0, line.size() - 1) : line;
    }
    return "";
}

// 0E and 10 are what QT gets in adjust mode, where scanners do not leave it by QT.
void Subject::rest() {
    const std::string status = status_of_quit();
    if (status == "0E" || status == "10") {
        (void)try_ask("TM2");
        (void)status_of_quit();
    }
    (void)wire_.listen(milliseconds(0));
}

void Subject::measure() {
    rest();
    if (const auto on = has_status(ask("BM"), "00"); !on.passed())
        throw Error(Error::Kind::refused, on.why);
}

void Subject::adjust() {
    rest();
    if (const auto in = has_status(ask("TM0"), "00"); !in.passed())
        throw Error(Error::Kind::refused, in.why);
}

void Subject::stream(const std::string& request) {
    if (const auto begun = has_status(ask(request), "00"); !begun.passed())
        throw Error(Error::Kind::refused, begun.why);
}

Answer Subject::ask(const std::string& request) {
    return ask(request + "\n", request);
}

Answer Subject::ask(std::string_view bytes, const std::string& echo) {
    auto answer = try_ask(bytes, echo);
    if (!answer) throw timed_out("answer to " + echo, wire_.place().patience);
    return *std::move(answer);
}

std::optional<Answer> Subject::try_ask(const std::string& request) {
    return try_ask(request + "\n", request);
}

/// A scan of an endless stream has the echo of the request for it, but never its status.
std::optional<Answer> Subject::try_ask(std::string_view bytes, const std::string& echo) {
    constexpr std::size_t most_before = 200;
    const auto asked_at = Clock::now();
    wire_.send(bytes);
    std::vector<std::string> before;
    while (before.size() < most_before) {
        auto raw = wire_.message();
        if (!raw) break;
        Answer answer = read_answer(*std::move(raw));
        if (answer.message.echo == echo && answer.status() != "99" && answer.lines().size() > 1) {
            note_unknown(echo, answer.status());
            answer.asked_at = asked_at;
            answer.begun_at = wire_.heard_from();
            answer.came_at = wire_.heard_at();
            answer.before = std::move(before);
            return answer;
        }
        before.push_back(std::move(answer.raw));
    }
    note_unknown(echo, "");
    return std::nullopt;
}

Answer Subject::next(std::optional<milliseconds> patience) {
    const auto asked_at = Clock::now();
    auto raw = wire_.message(patience.value_or(wire_.place().patience));
    if (!raw) throw Error(Error::Kind::silent, "nothing comes any more");
    Answer answer = read_answer(*std::move(raw));
    note_unknown(answer.message.echo, answer.status());
    answer.asked_at = asked_at;
    answer.came_at = wire_.heard_at();
    return answer;
}

Answer Subject::scan(const std::string& steps, const std::string& cluster) {
    if (facts_.knows("MD") && !facts_.knows("GD")) {
        rest();
        stream("MD" + steps + cluster + "001");
        return next_scan();
    }
    measure();
    return ask("GD" + steps + cluster);
}

Answer Subject::next_scan() {
    constexpr double most_turns = 16.0;
    return next(wire_.place().patience + turns(most_turns));
}

std::vector<protocol::client::ScanMessage> Subject::scans(int count) {
    std::vector<protocol::client::ScanMessage> scans;
    while (static_cast<int>(scans.size()) < count) {
        const Answer answer = next_scan();
        scans.push_back(scan_of(answer));
        if (scans.back().status != "99")
            throw Error(Error::Kind::damaged,
                        "a scan of a stream has the status " + scans.back().status + ", not 99");
    }
    return scans;
}

std::uint32_t Subject::clock_ms() {
    adjust();
    const Answer answer = ask("TM1");
    const auto& lines = answer.message.lines;
    const auto time = lines.size() == 1 ? protocol::decode(lines.front()) : std::nullopt;
    rest();
    if (!time) throw Error(Error::Kind::damaged, "the reply to TM1 has no time");
    return static_cast<std::uint32_t>(*time);
}

Finding Subject::expect(const std::string& request, std::string_view status) {
    return has_status(ask(request), status);
}

Finding Subject::expect_scans(const std::string& request, int count) {
    rest();
    stream(request + "0" + std::to_string(count));
    while (--count >= 0) {
        const Answer answer = next_scan();
        if (auto fine = has_status(answer, "99"); !fine.passed()) return fine;
        if (auto fine = is_scan(answer, request + "0" + std::to_string(count)); !fine.passed())
            return fine;
    }
    return pass();
}

Finding Subject::expect_laser_off() {
    if (facts_.knows("BM") && !facts_.knows("GD")) return expect("BM", "00");
    return expect("GD" + window() + "01", "10");
}

std::string Subject::window(int steps) const {
    const int count = std::min(steps, facts_.steps());
    const int first = std::clamp(facts_.afrt - count / 2, facts_.amin, facts_.amax - count + 1);
    char digits[16];
    std::snprintf(digits, sizeof digits, "%04d%04d", first, first + count - 1);
    return digits;
}

std::string Subject::all() const {
    constexpr double bytes_per_step = 3.1;
    constexpr double share = 0.85;
    const double carried = share * facts_.period_ms() / bytes_per_step / ms_per_byte_;
    if (carried < facts_.steps()) return window(std::max(static_cast<int>(carried), 1));
    char digits[16];
    std::snprintf(digits, sizeof digits, "%04d%04d", facts_.amin, facts_.amax);
    return digits;
}

milliseconds Subject::turns(double count) const {
    return milliseconds(static_cast<int>(count * facts_.period_ms()) + 1);
}

}  // namespace scipd::tools::checks
