// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/answer.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

#include "protocol/checksum.h"
#include "protocol/client/decoder.h"
#include "protocol/client/error.h"
#include "protocol/client/status_text.h"

namespace scipd::tools::checks {
namespace {

using protocol::client::Error;
using protocol::client::ScanMessage;

std::string reply_of(const Answer& answer) {
    return "the reply to " + answer.message.echo;
}

}  // namespace

std::vector<std::string> Answer::lines() const {
    std::vector<std::string> lines;
    std::string_view rest = raw;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        lines.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (!lines.empty()) lines.pop_back();  // the empty one
    return lines;
}

double Answer::took_ms() const {
    return std::chrono::duration<double, std::milli>(came_at - asked_at).count();
}

bool is_unknown(std::string_view status) {
    return status.empty() || status == "0D" || status == "0E" || status == "0F";
}

Answer read_answer(std::string raw) {
    Answer answer{.raw = std::move(raw)};
    std::string_view bytes = answer.raw;
    protocol::client::Decoder decoder;
    if (auto message = decoder.next(bytes)) answer.message = *std::move(message);
    return answer;
}

Finding has_status(const Answer& answer, std::string_view status) {
    const auto& message = answer.message;
    if (message.damage) return fail(reply_of(answer) + ": " + describe(*message.damage));
    std::string bare = message.echo + "\n" + message.status;
    bare.append(1, protocol::checksum(message.status)).append("\n\n");
    if (message.lines.empty() && answer.raw != bare)
        return fail(reply_of(answer) + " is not echo, status, sum and an empty line");
    if (message.status == status) return pass();
    return {Verdict::fail,
            message.echo + " is answered with " + message.status + ", not " + std::string(status),
            message.status};
}

Finding is_scan(const Answer& answer, std::string_view echo) {
    if (answer.message.echo != echo)
        return fail("the echo is " + answer.message.echo + ", not " + std::string(echo));
    const auto scan = parse_scan(answer.message);
    const auto* const why = std::get_if<std::string>(&scan);
    return require(why == nullptr, why == nullptr ? "" : reply_of(answer) + ": " + *why);
}

Finding is_scan(const Answer& answer) {
    const std::string& echo = answer.message.echo;
    const auto fine = has_status(answer, echo.starts_with('M') ? "99" : "00");
    return fine.passed() ? is_scan(answer, echo) : fine;
}

ScanMessage scan_of(const Answer& answer) {
    auto scan = parse_scan(answer.message);
    if (const auto* const why = std::get_if<std::string>(&scan))
        throw Error(Error::Kind::damaged, reply_of(answer) + ": " + *why);
    return std::get<ScanMessage>(std::move(scan));
}

}  // namespace scipd::tools::checks
