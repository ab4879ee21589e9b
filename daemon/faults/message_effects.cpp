// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Messages of SCIP that are wrong, although each byte arrives as it was sent.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "daemon/config/numbers.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_values.h"
#include "daemon/faults/message_lines.h"

namespace scipd::daemon {
namespace {

using protocol::Send;
using protocol::Speaker;

/// The number of the chance that decides whether a message is chosen.
constexpr std::uint32_t whether = 0xffff'ffff;

sim::Expected<int> parse_keep(std::string_view text) {
    return parse_whole(text, 0, 1'000'000);
}

/// Which messages an effect takes.
struct Selection {
    MessageChoice messages = MessageChoice::all;
    std::string command;  ///< empty: any
    double rate = 1.0;

    [[nodiscard]] bool takes(const Send& message, const FaultScene& scene) const {
        return chooses(messages, message) && message.bytes.starts_with(command) &&
               scene.chance(whether) < rate;
    }
};

/// An effect that changes messages one by one.
template <class Change>
void change_each(std::vector<Send>& leaving, const Selection& selection, FaultScene& scene,
                 Change change) {
    for (Send& message : leaving) {
        if (selection.takes(message, scene)) change(message.bytes);
    }
}

std::string name_of(const std::string& bytes) {
    return sim::quote(bytes.substr(0, bytes.find('\n')));
}

class WrongSums : public FaultEffect {
  public:
    struct Members : Selection {
        SumsOf of = SumsOf::all;
    };
    static constexpr Member<Members> members[] = {
        {"of", read_as<&Members::of, parse_word<sums_choices>>},
        {"messages", read_as<&Members::messages, parse_word<message_choices>>},
        {"command", read_as<&Members::command, parse_code>},
        {"rate", read_as<&Members::rate, parse_share>},
    };
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit WrongSums(const Members& members) : members_(members) {}

    void messages(const Speaker&, std::vector<Send>& leaving, FaultScene& scene) override {
        change_each(leaving, members_, scene, [&](std::string& bytes) {
            const auto sums = places_of_sums(bytes, members_.of);
            for (std::size_t i = 0; i < sums.size(); ++i) {
                // Another one of the 64 that a sum can be.
                const int more = 1 + static_cast<int>(63 * scene.chance(static_cast<unsigned>(i)));
                bytes[sums[i]] = static_cast<char>('0' + ((bytes[sums[i]] - '0' + more) & 0x3f));
            }
            if (sums.empty()) return;
            const char* const noun = sums.size() == 1 ? " sum of " : " sums of ";
            scene.touched(
                {.what = std::to_string(sums.size()) + noun + name_of(bytes) + " made wrong",
                 .bytes = sums});
        });
    }

  private:
    Members members_;
};

class Truncated : public FaultEffect {
  public:
    struct Members : Selection {
        std::optional<int> keep;
    };
    static constexpr Member<Members> members[] = {
        {"keep", read_as<&Members::keep, parse_keep>},
        {"messages", read_as<&Members::messages, parse_word<message_choices>>},
        {"command", read_as<&Members::command, parse_code>},
        {"rate", read_as<&Members::rate, parse_share>},
    };
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit Truncated(const Members& members) : members_(members) {}

    void messages(const Speaker&, std::vector<Send>& leaving, FaultScene& scene) override {
        change_each(leaving, members_, scene, [&](std::string& bytes) {
            const std::size_t keep =
                members_.keep ? static_cast<std::size_t>(*members_.keep) : bytes.size() / 2;
            if (keep >= bytes.size()) return;
            scene.touched({.what = std::to_string(bytes.size() - keep) + " bytes of " +
                                   name_of(bytes) + " left out at its end",
                           .bytes = {keep}});
            bytes.resize(keep);
        });
    }

  private:
    Members members_;
};

class MissingLineFeeds : public FaultEffect {
  public:
    enum class Lines { last, all };
    static constexpr std::pair<std::string_view, Lines> lines[] = {{"last", Lines::last},
                                                                   {"all", Lines::all}};
    struct Members : Selection {
        Lines lines = Lines::last;
    };
    static constexpr Member<Members> members[] = {
        {"lines", read_as<&Members::lines, parse_word<lines>>},
        {"messages", read_as<&Members::messages, parse_word<message_choices>>},
        {"command", read_as<&Members::command, parse_code>},
        {"rate", read_as<&Members::rate, parse_share>},
    };
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit MissingLineFeeds(const Members& members) : members_(members) {}

    void messages(const Speaker&, std::vector<Send>& leaving, FaultScene& scene) override {
        change_each(leaving, members_, scene, [&](std::string& bytes) {
            FaultTouch touch{.what = "line feeds of " + name_of(bytes) + " left out"};
            for (std::size_t i = bytes.size(); i-- > 0;) {
                if (bytes[i] != '\n') continue;
                touch.bytes.insert(touch.bytes.begin(), i);
                bytes.erase(i, 1);
                if (members_.lines == Lines::last) break;
            }
            scene.touched(std::move(touch));
        });
    }

  private:
    Members members_;
};

class WrongEcho : public FaultEffect {
  public:
    struct Members : Selection {};
    static constexpr Member<Members> members[] = {
        {"messages", read_as<&Members::messages, parse_word<message_choices>>},
        {"command", read_as<&Members::command, parse_code>},
        {"rate", read_as<&Members::rate, parse_share>},
    };
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit WrongEcho(const Members& members) : members_(members) {}

    void messages(const Speaker&, std::vector<Send>& leaving, FaultScene& scene) override {
        change_each(leaving, members_, scene, [&](std::string& bytes) {
            const std::size_t length = bytes.find('\n');
            if (length == std::string::npos || length == 0) return;
            const auto at = static_cast<std::size_t>(scene.chance(0) * static_cast<double>(length));
            const std::string name = name_of(bytes);
            bytes[at] = bytes[at] == 'X' ? 'Y' : 'X';
            scene.touched({.what = "the echo of " + name + " made wrong", .bytes = {at}});
        });
    }

  private:
    Members members_;
};

/// Some URG-04LX answer twice, or with the reply to the request before.
class Resent : public FaultEffect {
  public:
    enum class What { twice, previous };
    static constexpr std::pair<std::string_view, What> whats[] = {{"twice", What::twice},
                                                                  {"previous", What::previous}};
    struct Members : Selection {
        Members() { messages = MessageChoice::replies; }
        What what = What::twice;
    };
    static constexpr Member<Members> members[] = {
        {"what", read_as<&Members::what, parse_word<whats>>},
        {"command", read_as<&Members::command, parse_code>},
        {"rate", read_as<&Members::rate, parse_share>},
    };
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit Resent(const Members& members) : members_(members) {}

    void messages(const Speaker& from, std::vector<Send>& leaving, FaultScene& scene) override {
        if (leaving.size() != 1 || leaving[0].kind != Send::Kind::reply) return;
        const std::string reply = leaving[0].bytes;
        const auto previous = std::exchange(previous_[&from], reply);
        if (!members_.takes(leaving[0], scene)) return;
        if (members_.what == What::twice) {
            leaving.push_back(leaving[0]);
            scene.touched({.what = name_of(reply) + " answered twice"});
        } else if (!previous.empty()) {
            leaving[0].bytes = previous;
            scene.touched(
                {.what = name_of(reply) + " answered with the reply to " + name_of(previous)});
        }
    }

    void forget(const Speaker& session) override { previous_.erase(&session); }

  private:
    Members members_;
    std::map<const Speaker*, std::string> previous_;
};

class WrongStatus : public FaultEffect {
  public:
    struct Members {
        std::optional<protocol::Status> status;
        std::string command;  ///< empty: all but those that a driver recovers by
    };
    static sim::Expected<protocol::Status> parse_status(std::string_view text) {
        if (const auto status = protocol::Status::parse(text)) return *status;
        return sim::refuse("must be two of 0-9 and A-Z, such as 0L, not " + sim::quote(text));
    }
    static constexpr Member<Members> members[] = {
        {"status", read_as<&Members::status, parse_status>},
        {"command", read_as<&Members::command, parse_code>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        if (!members.status) faults.add(fault, "needs status: what is answered, such as 0L");
    }
    /// Without a command it is that of the request that the fault begins with.
    static MakeEffect maker(const sim::YamlField& fault, const sim::YamlSection& section,
                            sim::YamlFaults& faults) {
        Members read;
        read_members(section, members, read, faults);
        check(read, fault, faults);
        const sim::YamlField* const at = section.find("at");
        const auto request = at ? sim::entry_of(*at, "request") : std::nullopt;
        if (read.command.empty() && request)
            read.command = sim::text_of(request->value).value_or("");
        return [read] { return std::make_unique<WrongStatus>(read); };
    }

    explicit WrongStatus(const Members& members) : members_(members) {}

    std::optional<protocol::Status> refuse(const protocol::Request& request,
                                           FaultScene& scene) override {
        static constexpr std::string_view ways_out[] = {"QT", "RS", "RB"};
        const std::string code = request.echo.substr(0, 2);
        const bool chosen = members_.command.empty() ? !std::ranges::count(ways_out, code)
                                                     : request.echo.starts_with(members_.command);
        if (!chosen) return std::nullopt;
        scene.touched({.what = sim::quote(request.echo) + " answered " +
                               std::string(members_.status->text())});
        return members_.status;
    }

  private:
    Members members_;
};

}  // namespace

std::span<const FaultKind> message_kinds() {
    static constexpr FaultKind kinds[] = {
        kind_of<WrongSums>("sums", "protocol", "sums are wrong"),
        kind_of<Truncated>("truncate", "protocol", "the ends of messages are missing"),
        kind_of<MissingLineFeeds>("linefeed", "protocol", "line feeds are missing"),
        kind_of<WrongEcho>("echo", "protocol", "a character of the echo is another one"),
        kind_of<Resent>("resend", "protocol",
                        "a request is answered twice, or with the reply to the one before"),
        {"status", "protocol", "requests are refused with a status", false,
         [] { return keys_of(WrongStatus::members); }, WrongStatus::maker},
    };
    return kinds;
}

}  // namespace scipd::daemon
