// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/broker/shared_world.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <boost/asio/post.hpp>
#include <spdlog/spdlog.h>

#include "daemon/broker/identity.h"
#include "daemon/broker/world_hash.h"

namespace scipd::daemon {

using Kind = Topic::Kind;

namespace {

// A broker that is being started with the daemon, or is busy, has so long to answer.
constexpr auto patience = std::chrono::seconds(10);

constexpr std::array kept_kinds{Kind::scene, Kind::daemon, Kind::model, Kind::places};

double unix_s() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

}  // namespace

SharedWorld::SharedWorld(const boost::asio::any_io_executor& executor, const BrokerConfig& config,
                         const Parts& parts)
    : executor_(executor),
      config_(config),
      name_(config.name.empty() ? usual_name() : config.name),
      instance_(new_instance()),
      topics_(config.world),
      who_{.name = name_,
           .instance = instance_,
           .in_steps = parts.lockstep != nullptr,
           .host = host_name()},
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
                  [this](const std::string& why) {
                      if (std::exchange(who_.trouble, why) != why) say_who();
                  }}) {}

SharedWorld::~SharedWorld() {
    stop();
}

void SharedWorld::tell_of_loss(const std::string& why) const {
    spdlog::warn("the broker {} is lost: {}; what others move stays until it is back",
                 text_of(config_.broker), why);
}

void SharedWorld::require_answer(bool came) const {
    if (came) return;
    const std::string why =
        link_.connected() ? "it does not let this daemon read its topics" : link_.trouble();
    const std::string text = fmt::format(
        "cannot join the world {0} by the broker {1}: {2}; start the broker first, and "
        "see that its user may read and write scipd/{0}/#",
        config_.world, text_of(config_.broker), why);
    if (link_.connected() || link_.refused()) throw std::runtime_error(text);
    throw NotThereYet(text);
}

JoinedWorld SharedWorld::join(const sim::Scene& base) {
    scene_ = {.hash = content_hash(base), .by = name_, .begun_s = unix_s()};
    const auto synced = [&] { return marks_ > 0 && marks_seen_ == marks_; };
    require_answer(link_.run_until(synced, patience));
    check_scene();
    if (!kept_.scene || kept_.scene->hash != scene_.hash) {
        found_world(kept_.scene.has_value());
        require_answer(link_.run_until(synced, patience));
        // Another daemon may have done the same at the same time; whoever was last is right.
        if (kept_.scene && kept_.scene->hash != scene_.hash)
            throw std::runtime_error(other_world(*kept_.scene, scene_, config_.world));
    }
    if (kept_.scene) scene_ = *kept_.scene;
    edits_.begin(base, kept_.models);
    return {SharedEdits::edits_for(base, kept_.models), age()};
}

/// Throws std::runtime_error where this daemon cannot be one of those who serve.
void SharedWorld::check_scene() {
    const auto same_name = kept_.daemons.find(name_);
    if (same_name != kept_.daemons.end() && !same_name->second.lost) {
        throw std::runtime_error("there is a daemon " + name_ + " on " + same_name->second.host +
                                 "; take another fleet.name");
    }
    const bool differs = kept_.scene && kept_.scene->hash != scene_.hash;
    if (differs && kept_.serving_other_than(instance_) != nullptr)
        throw std::runtime_error(other_world(*kept_.scene, scene_, config_.world));
}

// The first of all says which world it is. What was said of another one counts no more.
void SharedWorld::found_world(bool anew) {
    constexpr MqttDelivery kept{.surely = true, .kept = true};
    for (const auto& [daemon, note] : kept_.daemons)
        link_.publish(topics_.of(Kind::daemon, daemon), "", kept);
    if (anew) {
        for (const auto& [model, text] : kept_.models)
            link_.publish(topics_.of(Kind::model, model), "", kept);
        for (const auto& [sender, text] : kept_.places)
            link_.publish(topics_.of(Kind::places, sender), "", kept);
    }
    say_scene();
    mark();
}

/// How long ago the scripts of the world began. With steps, all begin with the first.
sim::Time SharedWorld::age() const {
    if (who_.in_steps || scene_.begun_s <= 0.0) return {};
    return sim::Time(std::llround(std::clamp(unix_s() - scene_.begun_s, 0.0, 1e9) * 1e9));
}

JoinWorld SharedWorld::rejoining() const {
    return [scene = scene_, texts = edits_.texts(), world = config_.world,
            age = age()](const sim::Scene& base) {
        const SceneNote here{.hash = content_hash(base)};
        if (here.hash != scene.hash) throw std::runtime_error(other_world(scene, here, world));
        return JoinedWorld{SharedEdits::edits_for(base, texts), age};
    };
}

void SharedWorld::serve(const Config& config) {
    who_.bodies.clear();
    who_.sensors = 0;
    for (const RobotConfig& robot : config.robots) {
        who_.bodies[robot.name] = robot.body;
        who_.sensors += int(robot.sensors.size());
    }
    const bool begins = !std::exchange(serving_, true);
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
    if (!who_.trouble.empty()) status.trouble = who_.trouble;
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
    if (topic.kind != Kind::scene) return;
    if (!kept_.scene) return say_scene();
    if (kept_.scene->hash != scene_.hash) fail(other_world(*kept_.scene, scene_, config_.world));
}

void SharedWorld::take_daemon(const std::string& name, const DaemonNote* before) {
    const auto found = kept_.daemons.find(name);
    const DaemonNote* const now = found == kept_.daemons.end() ? nullptr : &found->second;
    if (name == name_) {
        // The will of a connection that was replaced meanwhile, or somebody has tidied up.
        if (now == nullptr || now->lost) return say_who();
        if (now->instance != instance_)
            spdlog::error("another daemon on {} is called {}, too; give one another name",
                          now->host, name);
        return;
    }
    const bool was_there = before != nullptr && !before->lost;
    const bool is_there = now != nullptr && !now->lost;
    if (is_there && !was_there) {
        spdlog::info("daemon {} has joined", name);
        poses_.say_all();
    }
    if (is_there || !was_there) return;
    now == nullptr ? spdlog::info("daemon {} has left", name)
                   : spdlog::warn("daemon {} is lost", name);
}

// After a time without the broker.
void SharedWorld::come_back() {
    if (kept_.scene && kept_.scene->hash != scene_.hash)
        return fail(other_world(*kept_.scene, scene_, config_.world));
    spdlog::info("the broker {} is back", text_of(config_.broker));
    if (kept_.scene) {
        edits_.take_all(kept_.models);
        put_places(false);
    } else {
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

// From within the library nothing may throw.
void SharedWorld::fail(const std::string& why) {
    boost::asio::post(executor_, [why] { throw std::runtime_error(why); });
}

}  // namespace scipd::daemon
