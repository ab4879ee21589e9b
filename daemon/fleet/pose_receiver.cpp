// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/pose_receiver.h"

#include <chrono>
#include <utility>

#include <boost/asio/post.hpp>
#include <spdlog/spdlog.h>

#include "daemon/fleet/pose_frame.h"
#include "daemon/poses/some_lines.h"

namespace scipd::daemon {
namespace {

// A hundred frames of ten thousand poses: more than a second of them helps nobody.
constexpr std::size_t most_waiting_bytes = 128 << 20;
constexpr std::size_t most_senders = 1000;

}  // namespace

PoseReceiver::PoseReceiver(const boost::asio::any_io_executor& executor, World& world,
                           PoseIntake& intake, const Clock& clock, bool in_steps, Hooks hooks)
    : executor_(executor),
      world_(world),
      intake_(intake),
      clock_(clock),
      in_steps_(in_steps),
      hooks_(std::move(hooks)) {}

// Too many names are one sender: who makes them up gets no more that way.
PoseReceiver::Sender& PoseReceiver::sender_of(std::string_view name) {
    const auto known = senders_.find(name);
    if (known != senders_.end()) return known->second;
    return senders_[senders_.size() < most_senders ? std::string(name) : std::string{}];
}

void PoseReceiver::take_frame(std::string_view sender, std::string_view frame) {
    if (waiting_bytes_ + frame.size() > most_waiting_bytes) {
        ++dropped_;
        return tell("more poses come than can be taken");
    }
    waiting_bytes_ += frame.size();
    frames_.push_back({&sender_of(sender), std::string(frame)});
    if (frames_.size() == 1) work();
}

void PoseReceiver::work() {
    Frame& frame = frames_.front();
    const std::string_view rest = std::string_view(frame.text).substr(frame.taken);
    frame.taken +=
        take_some_lines(rest, [&](std::string_view line) { take_line(line, *frame.sender); });
    if (frame.taken == frame.text.size()) {
        waiting_bytes_ -= frame.text.size();
        frames_.pop_front();
    }
    if (frames_.empty()) return;
    boost::asio::post(executor_, [this, alive = std::weak_ptr(alive_)] {
        if (!alive.expired()) work();
    });
}

void PoseReceiver::take_line(std::string_view text, Sender& sender) {
    if (sim::says_nothing(text)) return;
    if (const auto admitted = intake_.admit(sender.rate); !admitted)
        return tell(admitted.error().why);
    auto line = sim::parse_pose_line(text);
    if (!line) return tell(line.error().why);
    if (line->robot.empty() && line->model.empty())
        return tell("it must name its robot or model, since many read it");
    if (!address(*line) || !hooks_.matters(*line)) return;
    if (in_steps_) return put(*line);
    hand_on(*line, [&] { return intake_.take(*line, {}, sender.clock, clock_.now()); });
}

/// Whether it is about anything here; a robot of another daemon is its body.
bool PoseReceiver::address(sim::PoseLine& line) const {
    if (!line.robot.empty() && world_.robot(line.robot) == nullptr)
        line.model = hooks_.body_of(std::exchange(line.robot, {}));
    return !line.robot.empty() || world_.model(line.model) != nullptr;
}

void PoseReceiver::take_step(std::string_view lines, sim::Time time) {
    for (sim::PoseLine& line : poses_in(lines)) {
        if (!address(line) || !hooks_.matters(line)) continue;
        hand_on(line, [&] { return intake_.take_at(time, line, {}); });
    }
}

template <class Take>
void PoseReceiver::hand_on(const sim::PoseLine& line, Take take) {
    taking_ = true;
    const sim::Expected<> taken = take();
    taking_ = false;
    if (!taken) return tell(taken.error().why);
    if (!line.model.empty()) hooks_.moved(line.model);
}

// A little before now, since the next step may have a pose of this very moment.
void PoseReceiver::put(sim::PoseLine line) {
    line.time.reset();
    const sim::Time since = clock_.now() - sim::Time(in_steps_ ? 1 : 0);
    hand_on(line, [&] { return intake_.take_at(since, line, {}); });
}

// What stands there already need not jump: its sender's next pose may be of a moment before.
void PoseReceiver::take_place(sim::PoseLine line) {
    if (!address(line) || !line.robot.empty()) return;
    if (world_.model_pose(line.model, clock_.now()) != line.pose) put(std::move(line));
}

void PoseReceiver::tell(const std::string& refusal) {
    const auto others = refusals_told_.admit(std::chrono::steady_clock::now());
    if (others) spdlog::warn("pose from the broker refused: {}{}", refusal, *others);
}

}  // namespace scipd::daemon
