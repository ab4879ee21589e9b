// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/scan_stream.h"

#include <algorithm>
#include <deque>
#include <unordered_map>
#include <utility>

#include "daemon/control/documents.h"
#include "daemon/control/reading.h"

namespace scipd::daemon {
namespace {

/// Of one sensor: a third of a second of a UST-10LX. Others do not count: many of them measure at
/// the same instant.
constexpr std::size_t most_queued = 16;

/// Of all sensors together; beyond, each may have one message queued, however many and large they
/// are, so that none is heard at the cost of another.
constexpr std::size_t most_queued_bytes = std::size_t{64} << 20U;

/// The pose is that of the beam in the middle.
Json document_of(const std::string& sensor, const ScanRecord& record) {
    const sim::Scan& cast = *record.cast;
    const auto& poses = cast.world_from_sensor;
    return {{"sensor", sensor},
            {"scan", cast.revolution},
            {"time_s", seconds(record.told(cast.start))},
            {"stamp_ms", record.stamp_ms},
            {"pose", pose_document(poses[poses.size() / 2])},
            {"first_step", record.sent.first_step},
            {"front_step", record.front_step},
            {"steps_per_turn", record.steps_per_turn},
            {"sent_mm", record.sent.distance},
            {"intensity", record.sent.intensity}};
}

}  // namespace

/// One client.
class ScanStream::Subscriber : public Conversation {
  public:
    Subscriber(ScanStream& stream, std::string sensor, WebSocket& socket)
        : stream_(stream), sensor_(std::move(sensor)), socket_(socket) {
        stream_.subscribers_.push_back(this);
        stream_.follow_all();
    }
    ~Subscriber() override {
        std::erase(stream_.subscribers_, this);
        stream_.follow_all();
    }

    /// Nobody has anything to say here.
    std::size_t take(std::string_view rest) override { return rest.size(); }

    [[nodiscard]] bool wants(const std::string& sensor) const {
        return sensor_.empty() || sensor_ == sensor;
    }

    [[nodiscard]] bool has_room_for(const Tap& tap) {
        forget_what_has_left();
        const auto queued = queued_of_.find(&tap);
        if (queued == queued_of_.end()) return true;
        return queued->second < most_queued && queued_bytes_ < most_queued_bytes;
    }
    void send(const Tap& tap, const std::shared_ptr<const std::string>& message) {
        queued_.push_back({&tap, message->size()});
        queued_bytes_ += message->size();
        ++queued_of_[&tap];
        socket_.send(message);
    }

  private:
    /// The tap is a name only: it may be gone.
    struct Queued {
        const Tap* tap;
        std::size_t bytes;
    };

    /// Messages leave in the order in which they were sent, and only the stream sends any.
    void forget_what_has_left() {
        while (queued_.size() > socket_.queued()) {
            const Queued& left = queued_.front();
            queued_bytes_ -= left.bytes;
            const auto of_tap = queued_of_.find(left.tap);
            if (--of_tap->second == 0) queued_of_.erase(of_tap);
            queued_.pop_front();
        }
    }

    ScanStream& stream_;
    std::string sensor_;
    WebSocket& socket_;
    std::deque<Queued> queued_;
    std::size_t queued_bytes_ = 0;
    std::unordered_map<const Tap*, std::size_t> queued_of_;
};

ScanStream::Tap::Tap(ScanStream& stream, std::string sensor, Device& device)
    : stream_(stream), sensor_(std::move(sensor)), watch_([this, &device](bool wanted) {
          if (!wanted) return device.watch(nullptr);
          device.watch([this](const ScanRecord& record) {
              stream_.send(*this, [&] { return text_of(document_of(sensor_, record)); });
          });
      }) {
    stream_.taps_.push_back(this);
    stream_.follow(*this);
}

ScanStream::Tap::Tap(ScanStream& stream, std::string name, StaringSensor& sensor)
    : stream_(stream), sensor_(std::move(name)), watch_([this, &sensor](bool wanted) {
          if (!wanted) return sensor.watch(nullptr);
          sensor.watch([this](const StaringRecord& record) {
              stream_.send(*this, [&] { return reading_text(sensor_, record); });
          });
      }) {
    stream_.taps_.push_back(this);
    stream_.follow(*this);
}

ScanStream::Tap::~Tap() {
    std::erase(stream_.taps_, this);
    watch_(false);
}

std::unique_ptr<Conversation> ScanStream::subscribe(const std::string& sensor, WebSocket& socket) {
    return std::make_unique<Subscriber>(*this, sensor, socket);
}

void ScanStream::follow(Tap& tap) {
    tap.watch_(std::ranges::any_of(
        subscribers_, [&](const Subscriber* client) { return client->wants(tap.sensor_); }));
}

void ScanStream::follow_all() {
    for (Tap* tap : taps_)
        follow(*tap);
}

void ScanStream::send(Tap& tap, const std::function<std::string()>& tell) {
    std::shared_ptr<const std::string> message;
    for (Subscriber* client : subscribers_) {
        if (!client->wants(tap.sensor_)) continue;
        if (!client->has_room_for(tap)) {
            ++tap.lost_;
            continue;
        }
        if (!message) message = std::make_shared<const std::string>(tell());
        client->send(tap, message);
    }
}

}  // namespace scipd::daemon
