// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/scan_stream.h"

#include <algorithm>
#include <utility>

#include "daemon/control/documents.h"
#include "daemon/control/reading.h"

namespace scipd::daemon {
namespace {

/// A third of a second of a UST-10LX.
constexpr std::size_t most_queued = 16;

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
    void take(std::string_view) override {}

    [[nodiscard]] bool wants(const std::string& sensor) const {
        return sensor_.empty() || sensor_ == sensor;
    }
    [[nodiscard]] WebSocket& socket() const { return socket_; }

  private:
    ScanStream& stream_;
    std::string sensor_;
    WebSocket& socket_;
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
    for (const Subscriber* client : subscribers_) {
        if (!client->wants(tap.sensor_)) continue;
        if (client->socket().queued() >= most_queued) {
            ++tap.lost_;
            continue;
        }
        if (!message) message = std::make_shared<const std::string>(tell());
        client->socket().send(message);
    }
}

}  // namespace scipd::daemon
