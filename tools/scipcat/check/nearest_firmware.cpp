// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/nearest_firmware.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "daemon/models/model_registry.h"
#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/ideal.h"
#include "protocol/session.h"
#include "tools/scipcat/check/answer.h"
#include "tools/scipcat/check/facts.h"

namespace scipd::tools::checks {
namespace {

/// The whole reply to a request, without scans that came before it. Returns nullopt if there is
/// none.
using Ask = std::function<std::optional<std::string>(const std::string& request)>;

/// The answers to a fixed list of questions in four states, by state and question, without all that
/// differs from unit to unit or with time. A scanner and a model of one are asked the same. None of
/// the questions sets anything.
using Fingerprint = std::map<std::string, std::string>;

// Step 100 is one that every scanner measures.
constexpr const char* single_scan_digits = "0100010001";
constexpr const char* stream_request = "MD0100010001000";

/// A state, and the requests that lead to it from any.
struct Situation {
    const char* name;
    std::vector<const char*> way;
    std::vector<std::string> questions;
    /// In these the state is reached anew before each question that follows, since it may be left.
    std::vector<std::string> departures;
};

std::vector<std::string> scan_requests(const char* digits) {
    std::vector<std::string> requests;
    for (const char* const command : {"GD", "GS", "GE", "HD", "HE"})
        requests.push_back(std::string(command) + digits);
    return requests;
}

std::vector<std::string> questions_at_rest() {
    return {"GD",
            "GS",
            "GE",
            "HD",
            "HE",
            "MD",
            "MS",
            "ME",
            "ND",
            "NE",
            "GF",
            "GG",
            "MF",
            "MG",
            "%MD",
            "%ME",
            "%TM1",
            "%ST",
            "TM1",
            "TM2",
            "TM3",
            "XX",
            "vv",
            "V",
            "T",
            "VV1",
            "SS",
            "CR",
            "HS",
            "DB",
            "%XX",
            "QT;a-b",
            "QT;0123456789abcdefg",
            "SCIP2.0",
            "GD0100010001",
            "GD9999999901",
            "MD0000999901001",
            "MD0101010001001",
            "MDx100010001001",
            "MD0100x10001001",
            "MD01000100x1001",
            "MD0100010001x01",
            "MD01000100010x1"};
}

std::vector<Situation> situations() {
    const std::vector<std::string> scans = scan_requests(single_scan_digits);
    std::vector<std::string> measuring = {"BM", "%ST", "TM1", "TM2", "TM3", "XX", "GD", "MD"};
    measuring.insert(measuring.end(), scans.begin(), scans.end());
    std::vector<std::string> adjusting = {"%ST", "TM0", "TM1", "TM3",    "XX",
                                          "SS",  "GD",  "MD",  "SCIP2.0"};
    adjusting.insert(adjusting.end(), scans.begin(), scans.end());
    std::vector<std::string> streaming = {"BM", "%ST", "TM1", "XX", "MD"};
    streaming.insert(streaming.end(), scans.begin(), scans.end());
    return {
        {"at rest", {}, questions_at_rest(), {}},
        {"laser on", {"BM"}, std::move(measuring), {"TM0"}},
        {"adjust mode",
         {"TM0"},
         std::move(adjusting),
         {"VV", "PP", "II", "BM", "MD0100010001001", "TM2", "QT"}},
        {"stream", {stream_request}, std::move(streaming), {"TM0", "TM2", stream_request}},
    };
}

/// Goes to the state in which a check begins: laser off, no stream, no adjust mode.
void go_to_rest(const Ask& ask) {
    const auto reply = ask("QT");
    const std::string status = reply ? read_answer(*reply).status() : "";
    if (status != "0E" && status != "10") return;
    (void)ask("TM2");
    (void)ask("QT");
}

void go_to(const Situation& situation, const Ask& ask) {
    go_to_rest(ask);
    for (const char* const request : situation.way)
        (void)ask(request);
}

/// Status, and how much follows.
std::string shape_of(const std::optional<std::string>& reply) {
    if (!reply) return "nothing";
    const Answer answer = read_answer(*reply);
    if (answer.message.damage) return "damaged";
    std::size_t characters = 0;
    for (const std::string& line : answer.message.lines)
        characters += line.size();
    return answer.status() + ", " + std::to_string(answer.message.lines.size()) + " lines, " +
           std::to_string(characters) + " characters";
}

/// Each text is an answer of its own. A serial number tells units, not firmwares.
void take_texts_of(const std::string& where, const char* request, const Ask& ask,
                   Fingerprint& fingerprint) {
    Facts facts;
    if (const auto reply = ask(request)) take_texts(facts, *reply);
    facts.texts.erase("SERI");
    if (const auto time = facts.texts.find("TIME"); time != facts.texts.end())
        time->second = std::to_string(time->second.size()) + " characters";
    // The rate of a line is a setting.
    if (const auto rate = facts.texts.find("SBPS"); rate != facts.texts.end())
        rate->second.erase(0, rate->second.find_first_not_of("0123456789"));
    for (const auto& [key, text] : facts.texts)
        fingerprint[where + ": " + key + " of " + request] = text;
}

Fingerprint take_fingerprint(const Ask& ask) {
    Fingerprint fingerprint;
    for (const Situation& situation : situations()) {
        const std::string where = situation.name;
        go_to(situation, ask);
        if (where == "at rest") {
            take_texts_of(where, "VV", ask, fingerprint);
            take_texts_of(where, "PP", ask, fingerprint);
        }
        if (where != "adjust mode") take_texts_of(where, "II", ask, fingerprint);
        for (const std::string& question : situation.questions)
            fingerprint[where + ": " + question] = shape_of(ask(question));
        for (const std::string& question : situation.departures) {
            go_to(situation, ask);
            std::string shape = shape_of(ask(question));
            // Some texts have another length each time: only their status is compared.
            if (question == "VV" || question == "II") shape = shape.substr(0, shape.find(','));
            fingerprint[where + ": " + question] = std::move(shape);
        }
    }
    go_to_rest(ask);
    return fingerprint;
}

/// The number of answers that both have in common.
std::size_t alike(const Fingerprint& a, const Fingerprint& b) {
    return static_cast<std::size_t>(std::ranges::count_if(a, [&](const auto& answer) {
        const auto found = b.find(answer.first);
        return found != b.end() && found->second == answer.second;
    }));
}

/// Long enough for any reply; a scan takes two turns.
constexpr protocol::Uptime patience = std::chrono::milliseconds(500);
constexpr protocol::Uptime step = std::chrono::milliseconds(1);

bool answers(const std::string& message, const std::string& request) {
    return message.starts_with(request + "\n") && message.compare(request.size() + 1, 2, "99") != 0;
}

/// A model of scipd that answers in this process, without a socket or a clock: what a scanner with
/// that firmware would say. Its scans hold one distance.
class PlayedModel {
  public:
    PlayedModel(protocol::DeviceProfile profile, protocol::LinkKind link)
        : profile_(protocol::ideal(std::move(profile))),
          session_(profile_, device_, link),
          distances_(static_cast<std::size_t>(profile_.last_step) + 1, 1000),
          intensities_(distances_.size(), 1000) {}

    /// The whole reply to a request. Returns nullopt if it stays silent.
    [[nodiscard]] std::optional<std::string> ask(const std::string& request) {
        session_.receive(request + "\n", now_);
        for (const protocol::Uptime end = now_ + patience; now_ < end; go_on()) {
            while (auto action = session_.next_action()) {
                auto* const sent = std::get_if<protocol::Send>(&*action);
                if (sent != nullptr && answers(sent->bytes, request)) return std::move(sent->bytes);
            }
        }
        return std::nullopt;
    }

  private:
    void go_on() {
        now_ += step;
        session_.advance(now_);
        for (; turn_.start + profile_.scan_period <= now_; turn_.start += profile_.scan_period) {
            if (session_.turn_complete(turn_))
                session_.take({turn_, 0, distances_, intensities_}, now_);
        }
    }

    protocol::DeviceProfile profile_;
    protocol::DeviceState device_;
    protocol::Session session_;
    std::vector<std::uint32_t> distances_;
    std::vector<std::uint32_t> intensities_;
    protocol::Uptime now_{};
    protocol::Turn turn_{};
};

Fingerprint fingerprint_of(const protocol::DeviceProfile& profile, protocol::LinkKind link) {
    PlayedModel model(profile, link);
    return take_fingerprint([&](const std::string& request) { return model.ask(request); });
}

}  // namespace

NearestFirmware nearest_firmware(Subject& subject) {
    const auto link = subject.on_tty() ? protocol::LinkKind::tty : protocol::LinkKind::network;
    const Fingerprint asked =
        take_fingerprint([&](const std::string& request) -> std::optional<std::string> {
            const auto answer = subject.try_ask(request);
            return answer ? std::optional(answer->raw) : std::nullopt;
        });
    NearestFirmware nearest{.of = asked.size()};
    for (const daemon::Model& model : daemon::models()) {
        const std::size_t same = alike(asked, fingerprint_of(model.profile, link));
        if (nearest.model.empty() || same > nearest.alike) {
            nearest.model = model.profile.name + "@" + model.profile.release;
            nearest.alike = same;
        }
    }
    return nearest;
}

}  // namespace scipd::tools::checks
