// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/wire_stream.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "daemon/api/documents.h"
#include "daemon/api/lane.h"

namespace scipd::daemon {
namespace {

/// More than these a page does not read in time: at 40 Hz more than a second.
constexpr std::size_t most_on_their_way = 64;
/// A client may ask much at once.
constexpr std::size_t most_waiting = 256;

Json or_null(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

Json entry_document(const std::string& sensor, const WireEntry& entry) {
    return {{"sensor", sensor},
            {"client", entry.client},
            {"time_s", seconds(entry.told)},
            {"from", entry.from_client ? "client" : "scanner"},
            {"line", entry.line},
            {"bytes", entry.bytes},
            {"means", entry.means},
            {"status", or_null(entry.status)},
            {"explains", or_null(entry.explains)},
            {"scan", entry.scan ? Json(*entry.scan) : Json(nullptr)}};
}

}  // namespace

/// One client.
class WireStream::Listener : public Conversation {
  public:
    Listener(WireStream& stream, std::string sensor, WebSocket& socket)
        : stream_(stream), sensor_(std::move(sensor)), socket_(socket) {
        stream_.listeners_.push_back(this);
        stream_.follow_all();
    }
    ~Listener() override {
        std::erase(stream_.listeners_, this);
        stream_.follow_all();
    }

    /// Nobody has anything to say here.
    std::size_t take(std::string_view rest) override { return rest.size(); }
    void left() override { --on_their_way_; }

    [[nodiscard]] bool wants(const std::string& sensor) const { return sensor_ == sensor; }
    void miss(std::uint64_t messages) { missed_ += messages; }
    void tell(Json document) {
        if (on_their_way_ == most_on_their_way) return void(++missed_);
        if (missed_ > 0) document["dropped"] = std::exchange(missed_, 0);
        ++on_their_way_;
        socket_.send(std::make_shared<const std::string>(text_of(document)));
    }

  private:
    WireStream& stream_;
    std::string sensor_;
    WebSocket& socket_;
    std::size_t on_their_way_ = 0;
    std::uint64_t missed_ = 0;
};

WireStream::Tap::Tap(WireStream& stream, std::string name, std::unique_ptr<WireTap> wire)
    : stream_(stream), name_(std::move(name)), wire_(std::move(wire)) {
    stream_.taps_.push_back(this);
    stream_.follow(*this);
}

std::unique_ptr<Conversation> WireStream::open(const std::string& sensor, WebSocket& socket) {
    return std::make_unique<Listener>(*this, sensor, socket);
}

void WireStream::follow_all() {
    ways_.to_sensors([this] {
        for (Tap* tap : taps_)
            follow(*tap);
    });
}

// A listener that stays goes on where it is: it may have heard half a request.
void WireStream::follow(Tap& tap) {
    const bool wanted = std::ranges::any_of(
        listeners_, [&](const Listener* client) { return client->wants(tap.name_); });
    if (std::exchange(tap.listens_, wanted) == wanted) return;
    if (!wanted) return tap.wire_->listen(nullptr);
    tap.wire_->listen([this, name = tap.name_, lane = Lane(ways_.to_stream, most_waiting),
                       lost = std::uint64_t{0}](WireEntry entry) mutable {
        if (lane.loses_next()) return;
        const std::uint64_t missed = lane.lost() - std::exchange(lost, lane.lost());
        lane.post(0, [this, name, entry = std::move(entry), missed] { tell(name, entry, missed); });
    });
}

void WireStream::tell(const std::string& sensor, const WireEntry& entry, std::uint64_t missed) {
    const Json document = entry_document(sensor, entry);
    for (Listener* client : listeners_) {
        if (!client->wants(sensor)) continue;
        client->miss(missed);
        client->tell(document);
    }
}

}  // namespace scipd::daemon
