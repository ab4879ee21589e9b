// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/proxy_faults.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <utility>

#include "daemon/faults/fault_effect.h"
#include "protocol/command_table.h"

namespace scipd::tools {
namespace {

using protocol::Send;

// The keys of replies are none of scans.
constexpr std::uint64_t reply_keys = std::uint64_t{1} << 62U;

/// The longest code that the request begins with: MD, %ST.
std::string_view code_of(std::string_view request) {
    std::string_view code;
    for (const protocol::Command& command : protocol::command_table()) {
        if (request.starts_with(command.code) && command.code.size() > code.size())
            code = command.code;
    }
    return code;
}

}  // namespace

class ProxyFaults::Site final : public daemon::FaultSite {
  public:
    Site(const std::string& scanner, daemon::Port& port) : FaultSite(scanner, {&port}) {}

    // No kind of wire_kinds() asks for a device, and fault_in_words() takes no boot.
    [[nodiscard]] daemon::Device& device() override {
        assert(false);
        std::abort();
    }
    void boot() override { assert(false); }
    [[nodiscard]] bool driven() const override { return ports.front()->connected(); }
};

ProxyFaults::ProxyFaults(const std::vector<daemon::FaultPlan>& plans, const std::string& scanner,
                         daemon::Port& port, daemon::Clock& clock)
    : port_(port),
      clock_(clock),
      site_(std::make_unique<Site>(scanner, port)),
      alarm_(clock.make_alarm()),
      soon_(clock.make_alarm()) {
    look_at(false);
    for (const daemon::FaultPlan& plan : plans) {
        const std::uint64_t id = runs_.size() + 1;
        runs_.push_back(std::make_unique<daemon::FaultRun>(*site_, id, plan, plan.seed.value_or(id),
                                                           std::nullopt));
    }
    port_.set_hook(this);
    advance();
    settle();
}

ProxyFaults::~ProxyFaults() {
    port_.set_hook(nullptr);
}

bool ProxyFaults::any() const {
    return std::ranges::any_of(runs_, [](const auto& run) { return !run->gone(); });
}

void ProxyFaults::look_at(bool serving) {
    site_->now = {.scan = scan_, .serving = serving, .time = clock_.now()};
    site_->key = static_cast<std::uint64_t>(scan_);
    site_->request.clear();
}

void ProxyFaults::look_at(const Send& message, std::uint64_t& replies) {
    site_->request = message.bytes.substr(0, message.bytes.find('\n'));
    const bool scan = message.kind == Send::Kind::scan;
    site_->key = scan ? static_cast<std::uint64_t>(scan_) : reply_keys + ++replies;
}

std::optional<protocol::Status> ProxyFaults::refuse(const protocol::Request& request) {
    look_at(false);
    site_->request = request.echo;
    advance();
    const std::string_view code = code_of(request.echo);
    const bool boots = std::exchange(asked_, code) == code && code == "RB";  // two in a row
    for (const auto& run : runs_) {
        run->meet_request(code);
        if (boots) run->meet_boot();
    }
    settle_soon();
    std::optional<protocol::Status> status;
    for (const auto& run : runs_) {
        if (run->acting() && !status) status = run->acting()->refuse(request, run->scene());
    }
    return status;
}

std::vector<Send> ProxyFaults::leave(const protocol::Speaker& from, Send message) {
    const bool scan = message.kind == Send::Kind::scan;
    if (scan) {
        ++scan_;
        look_at(true);
        advance();
        settle();
    }
    look_at(message, replies_);
    std::vector<Send> leaving;
    leaving.push_back(std::move(message));
    for (const auto& run : runs_) {
        if (daemon::FaultEffect* const effect = run->changing_messages())
            effect->messages(from, leaving, run->scene());
    }
    for (Send& part : leaving)
        change_bytes(part);
    std::erase_if(leaving, [](const Send& part) { return part.bytes.empty(); });
    return leaving;
}

void ProxyFaults::change_bytes(Send& message) {
    look_at(message, replies_sent_);
    for (const auto& run : runs_) {
        if (run->acting()) run->acting()->bytes(message, run->scene());
    }
}

void ProxyFaults::forget(const protocol::Speaker& from) {
    for (const auto& run : runs_) {
        if (daemon::FaultEffect* const effect = run->changing_messages()) effect->forget(from);
    }
}

void ProxyFaults::connected(daemon::Port& port) {
    look_at(false);
    for (const auto& run : runs_) {
        if (run->acting()) run->acting()->connected(port, run->scene());
    }
}

void ProxyFaults::advance() {
    for (const auto& run : runs_)
        run->advance();
}

void ProxyFaults::settle() {
    bool settled = false;
    for (const auto& run : runs_)
        settled = run->settle() || settled;
    if (settled) compose();
    wait();
}

void ProxyFaults::settle_soon() {
    if (std::ranges::any_of(runs_, [](const auto& run) { return run->unsettled(); }))
        soon_->set(clock_.now(), [this] { settle(); });
}

void ProxyFaults::compose() {
    daemon::LineState line;
    for (const auto& run : runs_) {
        if (run->acting()) run->acting()->line(line);
    }
    if (line != line_) port_.set_line(line);
    line_ = line;
}

void ProxyFaults::wait() {
    std::optional<sim::Time> next;
    for (const auto& run : runs_) {
        if (const auto at = run->schedule().next_time({})) next = std::min(next.value_or(*at), *at);
    }
    if (!next) return alarm_->cancel();
    alarm_->set(*next, [this] {
        look_at(false);
        advance();
        settle();
    });
}

}  // namespace scipd::tools
