// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/view_stream.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include "daemon/api/view_request.h"
#include "daemon/api/world_view.h"
#include "daemon/device/device.h"
#include "daemon/device/staring_sensor.h"
#include "daemon/http/problem.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using namespace std::chrono_literals;

/// Screens show 60 pictures a second, and nobody sees more than 30 poses.
constexpr auto least_between_frames = 16ms;
constexpr sim::Time between_looks = 33ms;

/// A page that has read nothing for so long is cut. Where its part is missing to others, sooner.
constexpr sim::Time patience = 10s;
constexpr sim::Time short_patience = 1s;

std::string frame_of(const std::string& name, const ScanRecord& record, const Device& device,
                     ViewDepth depth) {
    const auto& profile = device.profile();
    const ScannerIdentity identity{.model = profile.model,
                                   .serial = profile.serial,
                                   .firmware = profile.firmware,
                                   .dmin_mm = profile.dmin_mm,
                                   .nearest_mm = profile.nearest_mm,
                                   .farthest_mm = profile.dmax_mm,
                                   .rpm = profile.scan_rpm};
    return view_frame(name, record, identity, depth);
}

std::string frame_of(const std::string& name, const StaringRecord& record, const StaringSensor&,
                     ViewDepth depth) {
    return view_frame(name, record, depth);
}

}  // namespace

/// Whether enough time has passed since it last said so.
class ViewStream::Pacer {
  public:
    bool is_due() {
        const auto now = std::chrono::steady_clock::now();
        if (now - last_ < least_between_frames) return false;
        last_ = now;
        return true;
    }

  private:
    std::chrono::steady_clock::time_point last_{};
};

class ViewStream::Page : public Conversation {
  public:
    Page(ViewStream& stream, WebSocket& socket, const Look& look)
        : stream_(stream), socket_(socket), look_(look), next_fault_(stream.faults_.end()) {
        stream_.pages_.push_back(this);
    }
    ~Page() override {
        std::erase(stream_.pages_, this);
        if (!wanted_.empty()) stream_.follow_all();
    }

    // All of it: what it may be is small.
    std::size_t take(std::string_view rest) override {
        const auto request = parse_view_request(rest);
        if (!request) {
            say(problem(400, request.error().why, request.error().field).body);
            return rest.size();
        }
        if (request->ack_poses) poses_on_their_way_ = false;
        if (request->ack) drawn(*request->ack);
        if (request->scans) want(*request->scans);
        return rest.size();
    }

    void left() override {
        --unread_;
        last_read_ = stream_.wall_.now();
        tell_faults();
    }

    /// None where it does not want to see the sensor.
    [[nodiscard]] ViewDepth wants(const std::string& sensor) const {
        const auto found = wanted_.find(sensor);
        return found == wanted_.end() ? ViewDepth::none : found->second;
    }
    /// None where it has one on its way, too.
    [[nodiscard]] ViewDepth can_take(const std::string& sensor) const {
        return on_their_way_.contains(sensor) ? ViewDepth::none : wants(sensor);
    }
    void show(const std::string& sensor, std::uint32_t number, const Unsent::Message& frame) {
        on_their_way_[sensor] = number;
        count();
        socket_.send_bytes(frame);
    }
    void look_around() {
        tell_faults();
        if (poses_on_their_way_ || !stream_.has_room(0)) return;
        const WorldView now = look_();
        if (const auto news = motion_.news(now)) say(*news);
        const auto moved = motion_.moved(now);
        poses_on_their_way_ = moved.has_value();
        if (moved) say(*moved);
    }
    /// Not while it has others to read.
    void tell_faults() {
        if (unread_ > 0) return;
        const Backlog::Message* faults = stream_.faults_.from(next_fault_);
        if (faults == nullptr) return;
        ++next_fault_;
        send(faults->text);
    }
    [[nodiscard]] bool has_read_nothing_for(sim::Time time) const {
        return unread_ > 0 && stream_.wall_.now() - last_read_ > time;
    }
    void cut() { socket_.cut(); }

  private:
    void say(std::string text) { send(stream_.unsent_.hold(std::move(text))); }
    void send(const Unsent::Message& message) {
        count();
        socket_.send(message);
    }
    void count() {
        if (unread_++ == 0) last_read_ = stream_.wall_.now();
    }
    void drawn(std::uint32_t number) {
        const auto found = std::ranges::find_if(
            on_their_way_, [&](const auto& frame) { return frame.second == number; });
        if (found == on_their_way_.end()) return;
        const std::string sensor = found->first;
        on_their_way_.erase(found);
        stream_.order(sensor);
    }

    void want(const ViewRequest::Scans& scans) {
        wanted_ = scans;
        stream_.follow_all();
        for (const auto& wanted : wanted_) {
            const std::string& sensor = wanted.first;
            const bool is_there = std::ranges::any_of(
                stream_.taps_, [&](const Tap* tap) { return tap->name_ == sensor; });
            if (!is_there)
                say(problem(404, "there is no sensor \"" + sim::printable(sensor) + "\"", "scans")
                        .body);
        }
    }

    ViewStream& stream_;
    WebSocket& socket_;
    Look look_;
    ViewRequest::Scans wanted_;
    std::map<std::string, std::uint32_t> on_their_way_;  ///< the frames, by sensor
    bool poses_on_their_way_ = false;
    WorldMotion motion_;
    std::size_t unread_ = 0;  ///< messages
    sim::Time last_read_{};   ///< or when there was nothing to read
    Backlog::Number next_fault_;
};

template <class Record, class Sensor>
void ViewStream::Tap::watch_with(Sensor& sensor) {
    watch_ = [this, &sensor](bool wanted) {
        if (!wanted) return sensor.watch(nullptr, WatchedBy::view);
        const auto make = [&stream = stream_, &sensor, name = name_, order = order_,
                           pacer = Pacer()](const Record& record) mutable {
            if (*order == ViewDepth::none || !pacer.is_due()) return;
            const ViewDepth depth = order->exchange(ViewDepth::none);
            stream.ways_.to_stream(
                [&stream, name, frame = frame_of(name, record, sensor, depth)]() mutable {
                    stream.send(name, std::move(frame));
                });
        };
        sensor.watch(make, WatchedBy::view);
    };
}

ViewStream::Tap::Tap(ViewStream& stream, std::string name, Device& device)
    : stream_(stream), name_(std::move(name)) {
    watch_with<ScanRecord>(device);
    join();
}

ViewStream::Tap::Tap(ViewStream& stream, std::string name, StaringSensor& sensor)
    : stream_(stream), name_(std::move(name)) {
    watch_with<StaringRecord>(sensor);
    join();
}

void ViewStream::Tap::join() {
    stream_.taps_.push_back(this);
    stream_.follow(*this);
}

ViewStream::Tap::~Tap() {
    std::erase(stream_.taps_, this);
    watch_(false);
}

ViewStream::ViewStream(Ways ways, Clock& wall, SharedLimits limits)
    : ways_(std::move(ways)),
      wall_(wall),
      limits_(std::move(limits)),
      next_look_(wall.make_alarm()) {}

ViewStream::~ViewStream() = default;

std::unique_ptr<Conversation> ViewStream::open(WebSocket& page, const Look& look) {
    auto conversation = std::make_unique<Page>(*this, page, look);
    conversation->look_around();
    if (pages_.size() == 1) look_later();
    return conversation;
}

void ViewStream::tell_fault(const std::string& event) {
    if (pages_.empty() || !faults_.add(event)) return;
    for (Page* page : pages_)
        page->tell_faults();
}

void ViewStream::follow_all() {
    ways_.to_sensors([this] {
        for (Tap* tap : taps_)
            follow(*tap);
    });
}

void ViewStream::follow(Tap& tap) const {
    tap.watch_(std::ranges::any_of(
        pages_, [&](const Page* page) { return page->wants(tap.name_) != ViewDepth::none; }));
    order(tap);
}

void ViewStream::order(Tap& tap) const {
    ViewDepth most = ViewDepth::none;
    for (const Page* page : pages_)
        most = std::max(most, page->can_take(tap.name_));
    *tap.order_ = most;
}

void ViewStream::order(const std::string& sensor) const {
    for (Tap* tap : taps_) {
        if (tap->name_ == sensor) order(*tap);
    }
}

void ViewStream::send(const std::string& sensor, std::string frame) {
    if (!has_room(frame.size())) return;
    set_frame_number(frame, ++frames_);
    const Unsent::Message shared = unsent_.hold(std::move(frame));
    for (Page* page : pages_) {
        if (page->can_take(sensor) != ViewDepth::none) page->show(sensor, frames_, shared);
    }
    order(sensor);
}

bool ViewStream::has_room(std::size_t bytes) {
    const std::size_t most = (*limits_)[Limit::websocket_queue_bytes];
    if (unsent_.bytes() == 0 || unsent_.bytes() + bytes <= most) return true;
    if (!std::exchange(lacks_room_, true)) limits_->refuse(Limit::websocket_queue_bytes, "/view");
    return false;
}

void ViewStream::look() {
    faults_.look();
    const bool lacked_room = std::exchange(lacks_room_, false);
    for (Page* page : pages_) {
        page->look_around();
        if (page->has_read_nothing_for(lacked_room ? short_patience : patience)) page->cut();
    }
    if (!lacked_room) return;
    for (Tap* tap : taps_)
        order(*tap);
}

void ViewStream::look_later() {
    next_look_->set(wall_.now() + between_looks, [this] {
        look();
        if (!pages_.empty()) look_later();
    });
}

}  // namespace scipd::daemon
