// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/shared_world.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <utility>

#include <spdlog/spdlog.h>

#include "daemon/fleet/topics.h"

namespace scipd::daemon {

using Kind = Topic::Kind;

namespace {

constexpr std::array kept_kinds{Kind::scene, Kind::daemon, Kind::model, Kind::places};

}  // namespace

SharedWorld::SharedWorld(const boost::asio::any_io_executor& executor, const FleetConfig& config,
                         const Parts& parts)
    : config_(config),
      name_(config.name.empty() ? usual_name() : config.name),
      instance_(new_instance()),
      topics_(config.world),
      who_{.name = name_,
           .instance = instance_,
           .in_steps = parts.lockstep != nullptr,
           .host = host_name()},
      troubles_(config),
      link_(executor, config, "scipd-" + instance_,
            {topics_.of(Kind::daemon, name_), text_of(lost(who_))},
            {.connected = [this] { ask_for_all(); },
             .message = [this](const MqttMessage& message) { take(message); },
             .lost = [this](const std::string& why) { tell_of_loss(why); }}),
      poses_(executor, link_, topics_, name_,
             {.world = parts.world,
              .intake = parts.intake,
              .clock = parts.clock,
              .body_of = [this](const std::string& robot) { return body_of(robot); },
              .lockstep = parts.lockstep,
              .near_m = config.near_m}),
      edits_(link_, topics_,
             {.edit = parts.edit,
              .changed = [this](const std::string& model) { poses_.forget(model); },
              .differs =
                  [this](const std::string& model, const std::string& why) {
                      set_trouble(topics_.of(Kind::model, model), why);
                  }}) {}

SharedWorld::~SharedWorld() {
    stop();
}

void SharedWorld::tell_of_loss(const std::string& why) {
    lost_ = true;
    spdlog::warn("the broker {} is lost: {}; what others move stays until it is back",
                 text_of(config_.broker), why);
}

void SharedWorld::serve(const Config& config, const std::map<std::string, std::string>& not_made) {
    who_.bodies.clear();
    who_.sensors = 0;
    for (const RobotConfig& robot : config.robots) {
        who_.bodies[robot.name] = robot.body;
        who_.sensors += int(robot.sensors.size());
    }
    const bool begins = !std::exchange(serving_, true);
    if (!begins) edits_.try_again();
    edits_.differ(not_made);
    if (begins) poses_.begin();
    poses_.serve(config.robots);
    if (begins) {
        put_places(true);
        link_.begin();
        spdlog::info("shares the world {} by {}, as {}", config_.world, text_of(config_.broker),
                     name_);
    }
    say_who();
}

SharedStatus SharedWorld::status() const {
    const auto others = std::ranges::count_if(kept_.daemons, [&](const auto& entry) {
        return !entry.second.lost && entry.first != name_;
    });
    SharedStatus status{.broker = text_of(config_.broker),
                        .world = config_.world,
                        .name = name_,
                        .connected = link_.connected(),
                        .daemons = static_cast<std::uint64_t>(others),
                        .trouble = {},
                        .frames_dropped = poses_.dropped()};
    if (!troubles_.text().empty()) status.trouble = troubles_.text();
    return status;
}

void SharedWorld::stop() {
    if (!std::exchange(serving_, false)) return link_.stop();
    poses_.stop();
    link_.publish(topics_.of(Kind::daemon, name_), "", {.surely = true, .kept = true});
    link_.stop();
}

std::string SharedWorld::body_of(const std::string& robot) const {
    for (const auto& [name, note] : kept_.daemons) {
        const auto found = note.bodies.find(robot);
        if (found != note.bodies.end() && !found->second.empty()) return found->second;
    }
    return {};
}

// What the broker keeps comes first, and then the mark.
void SharedWorld::ask_for_all() {
    kept_ = {};
    for (const Kind kind : kept_kinds)
        link_.subscribe(topics_.all(kind));
    link_.subscribe(topics_.of(Kind::poses));
    if (who_.in_steps) link_.subscribe(topics_.of(Kind::time));
    poses_.ask_vehicles();
    link_.subscribe(topics_.of(Kind::marker, instance_));
    mark();
}

void SharedWorld::mark() {
    link_.publish(topics_.of(Kind::marker, instance_), std::to_string(++marks_), {.surely = true});
}

void SharedWorld::take(const MqttMessage& message) {
    const auto topic = topics_.read(message.topic);
    if (!topic) return poses_.take_vehicle(std::string(message.topic), message.payload);
    if (topic->kind == Kind::marker) {
        marks_seen_ = std::max(marks_seen_, std::atoi(std::string(message.payload).c_str()));
        if (marks_seen_ == marks_ && serving_) come_back();
    } else if (!serving_ || marks_seen_ < marks_) {
        kept_.take(*topic, message.payload);
    } else {
        take_news(*topic, message.payload);
    }
}

void SharedWorld::take_news(const Topic& topic, std::string_view text) {
    if (topic.kind == Kind::poses) return poses_.take(text);
    if (topic.kind == Kind::time) return poses_.take_step(text);
    if (topic.kind == Kind::model) return edits_.take(topic.name, std::string(text));
    const auto known = kept_.daemons.find(topic.name);
    const auto before = known == kept_.daemons.end() ? DaemonNote{} : known->second;
    kept_.take(topic, text);
    if (topic.kind == Kind::daemon)
        take_daemon(topic.name, before.name.empty() ? nullptr : &before);
    if (topic.kind == Kind::scene) take_scene();
}

bool SharedWorld::is_other_world() const {
    return kept_.scene && kept_.scene->hash != scene_.hash;
}

// Whoever may write at the broker can say that it is another world. Who serves goes on with the
// one it has, and takes up what it has missed once it is that again.
void SharedWorld::take_scene() {
    const bool changes = set_scene_trouble();
    if (is_other_world()) return;
    if (!kept_.scene) say_scene();
    if (changes) ask_for_all();
}

bool SharedWorld::set_scene_trouble() {
    return set_trouble(topics_.of(Kind::scene),
                       is_other_world() ? other_world(*kept_.scene, scene_, config_.world) : "");
}

bool SharedWorld::set_trouble(const std::string& topic, const std::string& why) {
    if (!troubles_.set(topic, why)) return false;
    who_.trouble = troubles_.text();
    if (serving_) say_who();
    return true;
}

void SharedWorld::take_daemon(const std::string& name, const DaemonNote* before) {
    const auto found = kept_.daemons.find(name);
    const DaemonNote* const now = found == kept_.daemons.end() ? nullptr : &found->second;
    if (name == name_) return take_own_note(now);
    const bool was_there = before != nullptr && !before->lost;
    const bool is_there = now != nullptr && !now->lost;
    if (is_there && !was_there) {
        tell("daemon " + name + " has joined");
        poses_.say_all();
    }
    if (is_there || !was_there) return;
    now == nullptr ? tell("daemon " + name + " has left")
                   : tell("daemon " + name + " is lost", spdlog::level::warn);
}

// Who runs does not argue with another one of its name: both would say who they are for ever.
void SharedWorld::take_own_note(const DaemonNote* now) {
    // The will of a connection that was replaced meanwhile, or somebody has tidied up.
    if (now == nullptr || now->lost) return say_who();
    const bool is_another = now->instance != instance_;
    troubles_.set(topics_.of(Kind::daemon, name_),
                  is_another ? "another daemon, on " + now->host +
                                   ", is called so, too; give one another fleet.name"
                             : "");
    if (!is_another && std::exchange(who_.trouble, troubles_.text()) != troubles_.text()) say_who();
}

// A dozen daemons may well start at once, but not thousands.
void SharedWorld::tell(const std::string& text, spdlog::level::level_enum level) {
    constexpr std::size_t most_a_second = 20;
    if (news_.admit(most_a_second)) return spdlog::log(level, "{}", text);
    if (const auto others = left_out_.admit(std::chrono::steady_clock::now()))
        spdlog::warn("more daemons come and go than are told{}", *others);
}

// After a time without the broker.
void SharedWorld::come_back() {
    if (std::exchange(lost_, false)) spdlog::info("the broker {} is back", text_of(config_.broker));
    set_scene_trouble();
    if (kept_.scene && !is_other_world()) {
        edits_.take_all(kept_.models);
        put_places(false);
    } else if (!kept_.scene) {
        // It has forgotten all, and so has nobody else. The scene comes last: where it is, all is.
        edits_.say_all();
        say_scene();
    }
    poses_.say_all();
    say_who();
}

void SharedWorld::put_places(bool with_own) {
    link_.unsubscribe(topics_.all(Kind::places));
    poses_.put(kept_.places, with_own);
}

void SharedWorld::say_who() {
    link_.publish(topics_.of(Kind::daemon, name_), text_of(who_), {.surely = true, .kept = true});
}

void SharedWorld::say_scene() {
    link_.publish(topics_.of(Kind::scene), text_of(scene_), {.surely = true, .kept = true});
}

}  // namespace scipd::daemon
