// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/scan_stream.h"

#include <algorithm>
#include <utility>

#include <malloc.h>

#include "daemon/api/fault_text.h"
#include "daemon/api/measurement_text.h"
#include "daemon/device/device.h"
#include "daemon/device/staring_sensor.h"

namespace scipd::daemon {
namespace {

/// It does not pay to give less than this back to the system.
constexpr std::size_t much = std::size_t{8} << 20U;

/// That wait for the I/O thread: as many as a backlog keeps, and of faults what many do at once.
constexpr std::size_t most_scans = 16;
constexpr std::size_t most_faults = 256;

}  // namespace

template <class Record, class Sensor>
ScanStream::Tap::Watch ScanStream::Tap::watch_of(Sensor& sensor) {
    return [this, &sensor](bool wanted) {
        if (!wanted) return sensor.watch(nullptr);
        sensor.watch(
            [&stream = stream_, source = source_, lane = lane_](const Record& record) mutable {
                if (lane.loses_next()) return;
                std::string text = reading_text(source->name, record);
                const std::size_t bytes = text.size();
                lane.post(bytes, [&stream, source, text = std::move(text)]() mutable {
                    stream.send(source, std::move(text));
                });
            });
    };
}

/// One client. Has one message at a time on its way.
class ScanStream::Subscriber : public Conversation {
  public:
    Subscriber(ScanStream& stream, std::string sensor, WebSocket& socket)
        : stream_(stream),
          sensor_(std::move(sensor)),
          socket_(socket),
          next_(stream.backlog_.end()) {
        stream_.subscribers_.push_back(this);
        stream_.follow_all();
    }
    ~Subscriber() override {
        std::erase(stream_.subscribers_, this);
        stream_.follow_all();
        const std::size_t before = stream_.backlog_.bytes();
        stream_.forget_what_all_have();
        // The allocator would keep it.
        if (before - stream_.backlog_.bytes() > much) malloc_trim(0);
    }

    /// Nobody has anything to say here.
    std::size_t take(std::string_view rest) override { return rest.size(); }

    void left() override {
        on_its_way_ = false;
        go_on();
    }

    void go_on() {
        if (on_its_way_) return;
        const Backlog::Message* message = stream_.backlog_.from(next_);
        while (message != nullptr && !wants(message->source->name))
            message = stream_.backlog_.from(++next_);
        if (message == nullptr) return;
        ++next_;
        on_its_way_ = true;
        socket_.send(message->text);
    }

    [[nodiscard]] bool wants(const std::string& sensor) const {
        return sensor_.empty() || sensor_ == sensor;
    }
    /// The first message that it has not been sent.
    [[nodiscard]] Backlog::Number next() const { return next_; }

  private:
    ScanStream& stream_;
    std::string sensor_;
    WebSocket& socket_;
    Backlog::Number next_;
    bool on_its_way_ = false;
};

ScanStream::Tap::Tap(ScanStream& stream, std::string name, Watch watch)
    : stream_(stream),
      source_(std::make_shared<Backlog::Source>(Backlog::Source{.name = std::move(name)})),
      lane_(stream.ways_.to_stream, most_scans, stream.load_),
      faults_source_(std::make_shared<Backlog::Source>(Backlog::Source{.name = source_->name})),
      watch_(std::move(watch)) {
    stream_.taps_.push_back(this);
    stream_.follow(*this);
}

ScanStream::Tap::Tap(ScanStream& stream, std::string name, Device& device)
    : Tap(stream, std::move(name), watch_of<ScanRecord>(device)) {}

ScanStream::Tap::Tap(ScanStream& stream, std::string name, StaringSensor& sensor)
    : Tap(stream, std::move(name), watch_of<StaringRecord>(sensor)) {}

ScanStream::Tap::~Tap() {
    std::erase(stream_.taps_, this);
    watch_(false);
    if (faults_ != nullptr) faults_->watch(nullptr);
}

void ScanStream::Tap::follow(FaultLog& faults) {
    faults_ = &faults;
    faults.watch(
        [&stream = stream_, source = faults_source_,
         lane = Lane(stream_.ways_.to_stream, most_faults)](const FaultLogEntry& entry) mutable {
            if (lane.loses_next()) return;
            lane.post(0, [&stream, source, event = fault_event(source->name, entry)] {
                stream.tell_fault(source, event);
            });
        });
}

ScanStream::ScanStream(SharedLimits limits) : ScanStream(std::move(limits), Ways{}) {}

ScanStream::ScanStream(SharedLimits limits, Ways ways)
    : ways_(std::move(ways)),
      backlog_([this](Backlog::Number number,
                      const Backlog::Message& message) { count_lost(number, message); },
               std::move(limits)) {}

std::unique_ptr<Conversation> ScanStream::subscribe(const std::string& sensor, WebSocket& socket) {
    return std::make_unique<Subscriber>(*this, sensor, socket);
}

void ScanStream::follow(Tap& tap) {
    tap.watch_(wanted(tap.source_->name));
}

bool ScanStream::wanted(const std::string& sensor) const {
    return std::ranges::any_of(subscribers_,
                               [&](const Subscriber* client) { return client->wants(sensor); });
}

void ScanStream::follow_all() {
    ways_.to_sensors([this] {
        for (Tap* tap : taps_)
            follow(*tap);
    });
}

// A sensor is watched as long as somebody wants its scans.
void ScanStream::send(const std::shared_ptr<Backlog::Source>& source, std::string message) {
    backlog_.add(source, std::move(message));
    for (Subscriber* client : subscribers_)
        client->go_on();
    forget_what_all_have();
}

void ScanStream::tell_fault(const std::shared_ptr<Backlog::Source>& source,
                            const std::string& event) {
    if (wanted(source->name)) send(source, R"({"fault":)" + event + '}');
    if (on_fault_) on_fault_(event);
}

void ScanStream::count_lost(Backlog::Number number, const Backlog::Message& message) {
    Backlog::Source& source = *message.source;
    source.lost += static_cast<std::uint64_t>(
        std::ranges::count_if(subscribers_, [&](const Subscriber* client) {
            return client->next() <= number && client->wants(source.name);
        }));
}

void ScanStream::forget_what_all_have() {
    Backlog::Number first = backlog_.end();
    for (const Subscriber* client : subscribers_)
        first = std::min(first, client->next());
    backlog_.forget_before(first);
}

}  // namespace scipd::daemon
