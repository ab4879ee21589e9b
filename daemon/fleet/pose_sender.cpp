// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/pose_sender.h"

#include <algorithm>
#include <utility>

#include "daemon/fleet/pose_frame.h"

namespace scipd::daemon {

using namespace std::chrono_literals;

namespace {

constexpr auto tick_time = 10ms;

// Those who come later get where things stood so long ago, and then what follows. All places are
// told each time, so that many of them are told less often.
std::chrono::milliseconds places_time(std::size_t places) {
    return std::clamp<std::chrono::milliseconds>(places * 1ms, 50ms, 1s);
}

}  // namespace

PoseSender::PoseSender(const boost::asio::any_io_executor& executor, MqttLink& link,
                       const Topics& topics, std::string name)
    : link_(link), topics_(topics), name_(std::move(name)), timer_(executor) {}

void PoseSender::send(const sim::PoseLine& line) {
    keep(line);
    if (link_.connected()) append_line(frame_, line);
}

void PoseSender::keep(const sim::PoseLine& line) {
    const bool is_model = !line.model.empty();
    sim::PoseLine& place = places_[{is_model, is_model ? line.model : line.robot}];
    place = line;
    place.time = std::chrono::system_clock::now().time_since_epoch();
    place.velocity.reset();
    places_changed_ = true;
    wake();
}

void PoseSender::forget(const std::string& model) {
    if (places_.erase({true, model}) == 0) return;
    places_changed_ = true;
    wake();
}

void PoseSender::say_all(std::optional<sim::Time> now) {
    for (const auto& [name, place] : places_) {
        sim::PoseLine line = place;
        line.time = now;
        append_line(frame_, line);
    }
    places_changed_ = true;
    places_kept_ = {};
    wake();
}

void PoseSender::wake() {
    if (std::exchange(awake_, true)) return;
    timer_.expires_after(tick_time);
    timer_.async_wait([this](const boost::system::error_code& error) {
        if (!error) tick();
    });
}

void PoseSender::tick() {
    awake_ = false;
    if (!link_.connected()) return frame_.clear();
    send_frame();
    keep_places();
}

// A broker that is too slow gets the newest poses alone.
void PoseSender::send_frame() {
    if (frame_.empty()) return;
    if (link_.congested()) {
        ++dropped_;
    } else {
        link_.publish(topics_.of(Topic::Kind::poses), frame_head(name_) + frame_, {});
    }
    frame_.clear();
}

void PoseSender::keep_places() {
    if (!places_changed_) return;
    const auto now = std::chrono::steady_clock::now();
    if (link_.congested() || now - places_kept_ < places_time(places_.size())) return wake();
    places_kept_ = now;
    places_changed_ = false;
    std::string frame;
    for (const auto& [name, place] : places_)
        append_line(frame, place);
    link_.publish(topics_.of(Topic::Kind::places, name_), frame, {.surely = true, .kept = true});
}

}  // namespace scipd::daemon
