// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How a daemon finds its place in a world that others may share already, before it serves.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <spdlog/spdlog.h>

#include "daemon/fleet/shared_world.h"
#include "daemon/fleet/topics.h"
#include "daemon/fleet/world_hash.h"

namespace scipd::daemon {

using Kind = Topic::Kind;

namespace {

// A broker that is being started with the daemon, or is busy, has so long to answer.
constexpr auto patience = std::chrono::seconds(10);
// A daemon that runs says who it is within one turn of its event loop.
constexpr auto patience_with_daemons = std::chrono::seconds(3);

double unix_s() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

}  // namespace

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
    forget_the_silent();
    check_scene();
    if (!kept_.scene || kept_.scene->hash != scene_.hash) {
        found_world(kept_.scene.has_value());
        require_answer(link_.run_until(synced, patience));
        // Another daemon may have done the same at the same time; whoever was last is right.
        if (kept_.scene && kept_.scene->hash != scene_.hash)
            throw std::runtime_error(other_world_text());
    }
    if (kept_.scene) scene_ = *kept_.scene;
    edits_.begin(base, kept_.models);
    return {SharedEdits::edits_for(base, kept_.models), age()};
}

/// Daemons whose notes keep this one from serving.
std::vector<std::string> SharedWorld::in_the_way() const {
    const bool differs = kept_.scene && kept_.scene->hash != scene_.hash;
    std::vector<std::string> names;
    for (const auto& [name, note] : kept_.daemons) {
        if (!note.lost && (differs || name == name_)) names.push_back(name);
    }
    return names;
}

// A note may be left over, or made up. It is taken away, and a daemon that is there says at once
// who it is.
void SharedWorld::forget_the_silent() {
    const std::vector<std::string> asked = in_the_way();
    if (asked.empty()) return;
    for (const std::string& name : asked) {
        kept_.daemons.erase(name);
        link_.publish(topics_.of(Kind::daemon, name), "", {.surely = true, .kept = true});
    }
    const auto all_answer = [&] { return in_the_way().size() == asked.size(); };
    if (link_.run_until(all_answer, patience_with_daemons)) return;
    for (const std::string& name : asked) {
        if (kept_.daemons.contains(name)) continue;
        spdlog::warn("{}: the broker kept a note of a daemon that does not answer; it is forgotten",
                     topics_.of(Kind::daemon, name));
    }
}

/// Throws std::runtime_error where this daemon cannot be one of those who serve.
void SharedWorld::check_scene() const {
    const auto same_name = kept_.daemons.find(name_);
    if (same_name != kept_.daemons.end() && !same_name->second.lost) {
        throw std::runtime_error("there is a daemon " + name_ + " on " + same_name->second.host +
                                 "; take another fleet.name");
    }
    const bool differs = kept_.scene && kept_.scene->hash != scene_.hash;
    if (differs && kept_.serving_other_than(instance_) != nullptr)
        throw std::runtime_error(other_world_text());
}

std::string SharedWorld::other_world_text() const {
    return other_world(*kept_.scene, scene_, config_.world) + "; where no daemon has the other, `" +
           command_to_clear(config_, topics_.of(Kind::scene)) + "` has it forgotten";
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

}  // namespace scipd::daemon
