// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/wire/wire_tap.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <spdlog/spdlog.h>

#include "daemon/device/device.h"
#include "daemon/limits/throttle.h"
#include "daemon/link/line_hook.h"
#include "daemon/link/port.h"
#include "protocol/line_reader.h"
#include "protocol/request.h"
#include "protocol/scip1.h"
#include "protocol/status.h"
#include "protocol/words.h"

namespace scipd::daemon {
namespace {

/// Listens at one port of a scanner, and tells each request and reply in words.
class WireListener : public WireEar {
  public:
    /// `device` must outlive it.
    WireListener(Device& device, std::string client, TakeEntry take);

    void connected() override { reader_.forget(); }
    void heard(std::string_view bytes) override;
    void said(const protocol::Send& message) override;
    void dropped() override;

  private:
    [[nodiscard]] WireEntry begin(std::string_view line, std::size_t bytes) const;
    void explain(const protocol::Request& echo, protocol::Status status, WireEntry& entry) const;
    void explain(const protocol::Scip1Request& echo, char status, WireEntry& entry) const;
    [[nodiscard]] std::optional<std::int64_t> latest_scan() const;

    Device& device_;
    std::string client_;
    TakeEntry take_;
    protocol::LineReader reader_;
};

/// Printable, and not endless.
std::string shown(std::string_view line) {
    constexpr std::size_t most = 160;
    std::string text;
    for (const char c : line.substr(0, most)) {
        if (c >= ' ' && c <= '~') {
            text += c;
            continue;
        }
        std::array<char, 5> escape{};
        std::snprintf(escape.data(), escape.size(), "\\x%02x", static_cast<unsigned char>(c));
        text += escape.data();
    }
    return line.size() > most ? text + ".." : text;
}

/// Takes the first line of a message.
std::string_view take_line(std::string_view& bytes) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    return line;
}

/// The status in the second line of a reply, before its checksum.
std::optional<protocol::Status> status_in(std::string_view line) {
    return line.size() == 3 ? protocol::Status::parse(line.substr(0, 2)) : std::nullopt;
}

bool has_scan(const protocol::Request& echo, protocol::Status status) {
    if (echo.command == nullptr) return false;
    return status == protocol::status::scan_follows ||
           (status == protocol::status::ok && echo.command->brings_one_scan());
}

WireListener::WireListener(Device& device, std::string client, TakeEntry take)
    : device_(device), client_(std::move(client)), take_(std::move(take)) {}

WireEntry WireListener::begin(std::string_view line, std::size_t bytes) const {
    const Clock& clock = device_.clock();
    return {.client = client_,
            .told = clock.origin() + clock.now(),
            .line = shown(line),
            .bytes = bytes};
}

void WireListener::heard(std::string_view bytes) {
    const protocol::DeviceProfile& profile = device_.profile();
    while (auto line = reader_.next(bytes)) {
        WireEntry entry = begin(line->text, line->text.size() + 1);
        entry.from_client = true;
        if (profile.speaks_scip1())
            entry.means = protocol::scip1_request_words(parse_scip1(line->text, profile));
        if (entry.means.empty())
            entry.means = protocol::request_words(parse_request(*std::move(line), profile));
        take_(std::move(entry));
    }
}

void WireListener::said(const protocol::Send& message) {
    std::string_view rest = message.bytes;
    const std::string_view line = take_line(rest);
    WireEntry entry = begin(line, message.bytes.size());
    const std::string_view second = take_line(rest);
    if (const auto status = status_in(second)) {
        explain(protocol::parse_request({std::string(line)}, device_.profile()), *status, entry);
    } else if (second.size() == 1 && device_.profile().speaks_scip1()) {
        explain(protocol::parse_scip1(line, device_.profile()), second.front(), entry);
    } else {
        entry.means = "a reply that a fault has damaged";
    }
    take_(std::move(entry));
}

void WireListener::explain(const protocol::Request& echo, protocol::Status status,
                           WireEntry& entry) const {
    entry.status = status.text();
    entry.means = protocol::reply_words(echo, status);
    entry.explains = protocol::status_words(echo.command, status);
    if (has_scan(echo, status)) entry.scan = latest_scan();
}

void WireListener::explain(const protocol::Scip1Request& echo, char status,
                           WireEntry& entry) const {
    const bool has_scan = echo.kind == protocol::Scip1Request::Kind::scan;
    entry.status = status;
    entry.means = protocol::scip1_reply_words(echo, status);
    entry.explains = protocol::scip1_status_words(status);
    if (has_scan && status == protocol::scip1_status::ok) entry.scan = latest_scan();
}

std::optional<std::int64_t> WireListener::latest_scan() const {
    const auto scan = device_.latest_scan();
    return scan ? std::optional(scan->revolution) : std::nullopt;
}

void WireListener::dropped() {
    WireEntry entry = begin({}, 0);
    entry.means = "the client reads too slowly: the message before this is dropped";
    take_(std::move(entry));
}

TakeEntry both(const TakeEntry& first, const TakeEntry& second) {
    if (!first) return second;
    if (!second) return first;
    return [first, second](WireEntry entry) {
        first(entry);
        second(std::move(entry));
    };
}

class WireLog {
  public:
    explicit WireLog(std::string scanner) : scanner_(std::move(scanner)) {}

    void take(const WireEntry& entry) {
        const auto level = entry.scan ? spdlog::level::trace : spdlog::level::debug;
        if (!spdlog::should_log(level)) return;
        if (const auto suppressed = throttle_.admit(std::chrono::steady_clock::now()))
            spdlog::log(level, "{}: {}{}", scanner_, line_of(entry), *suppressed);
    }

  private:
    std::string scanner_;
    Throttle throttle_{500};
};

}  // namespace

WireTap::WireTap(Device& device, std::vector<std::shared_ptr<Port>> ports, TakeEntry log)
    : device_(device), ports_(std::move(ports)), log_(std::move(log)) {
    listen(nullptr);
}

WireTap::~WireTap() {
    remove_ears();
}

// Another scanner may have the port by now, and listen at it.
void WireTap::remove_ears() {
    for (std::size_t i = 0; i < ears_.size(); ++i) {
        if (ports_[i]->ear() == ears_[i].get()) ports_[i]->set_ear(nullptr);
    }
    ears_.clear();
}

void WireTap::listen(const TakeEntry& wanted) {
    remove_ears();
    const TakeEntry take = both(log_, wanted);
    if (!take) return;
    for (const auto& port : ports_) {
        const bool is_tty = port->kind() == protocol::LinkKind::tty;
        ears_.push_back(std::make_unique<WireListener>(device_, is_tty ? "tty" : "tcp", take));
        port->set_ear(ears_.back().get());
    }
}

TakeEntry wire_log(const std::string& scanner) {
    if (!spdlog::should_log(spdlog::level::debug)) return nullptr;
    const auto log = std::make_shared<WireLog>(scanner);
    return [log](const WireEntry& entry) { log->take(entry); };
}

std::string line_of(const WireEntry& entry) {
    std::string text = entry.client;
    if (entry.from_client) return text + " hears " + entry.line + ": " + entry.means;
    if (!entry.line.empty()) text += " answers " + entry.line;
    if (!entry.status.empty()) text += " with " + entry.status;
    return text + ": " + (entry.explains.empty() ? entry.means : entry.explains);
}

}  // namespace scipd::daemon
