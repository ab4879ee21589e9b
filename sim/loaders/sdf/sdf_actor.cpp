// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Reads an <actor>.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <tinyxml2.h>

#include "sim/loaders/actors/actor_walk.h"
#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/sdf_world.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"
#include "sim/world/reach.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t most_waypoints = 10'000;
constexpr Time closest = std::chrono::milliseconds(1);
constexpr double latest_s = 1e9;
/// Two poses closer than this are the same place, typed twice.
constexpr double same_place_m = 1e-3;

std::optional<double> number_in(const XMLElement* element) {
    const auto numbers = parse_numbers(text_of(element), 1);
    return numbers ? std::optional(numbers->front()) : std::nullopt;
}

/// A pose as SDF writes it; nothing if it cannot be read or lies too far out.
std::optional<Pose> pose_in(const XMLElement* element) {
    if (element == nullptr) return Pose{};
    const char* format = element->Attribute("rotation_format");
    const bool as_quaternion = format != nullptr && format == std::string_view{"quat_xyzw"};
    const auto n = parse_numbers(text_of(element), as_quaternion ? 7 : 6);
    if (!n) return std::nullopt;
    const glm::dvec3 at_m{(*n)[0], (*n)[1], (*n)[2]};
    if (!plausible_position(at_m)) return std::nullopt;
    if (as_quaternion) {
        const glm::dquat turn{(*n)[6], (*n)[3], (*n)[4], (*n)[5]};
        if (!(glm::length(turn) > 1e-6)) return std::nullopt;
        return Pose{at_m, glm::normalize(turn)};
    }
    const double unit = element->BoolAttribute("degrees") ? std::numbers::pi / 180.0 : 1.0;
    return pose_from_rpy(at_m, unit * glm::dvec3{(*n)[3], (*n)[4], (*n)[5]});
}

bool is_true(const XMLElement* element, bool otherwise) {
    const std::string text = text_of(element);
    if (text.find_first_not_of(" \t\r\n") == text.npos) return otherwise;
    return text.find("true") != text.npos || text.find('1') != text.npos;
}

class ActorReader {
  public:
    ActorReader(const XMLElement& actor, const SdfSheet& sheet, SceneDraft& draft)
        : actor_(actor), sheet_(sheet), draft_(draft) {}

    Actor read() {
        Actor read;
        const auto* element = actor_.FirstChildElement("pose");
        if (const auto pose = pose_in(element)) {
            read.pose = *pose;
        } else {
            warn(*element,
                 "has a <pose> that is not six finite numbers within 1e7 m; it is left out");
        }
        read.skin = skin();
        read.script = read_script(read.pose);
        if (read.script != nullptr) return read;
        if (const auto* plugin = actor_.FirstChildElement("plugin")) {
            warn(*plugin, "is moved by a <plugin> in Gazebo and stands here, until poses move it");
        }
        return read;
    }

  private:
    /// Nothing if its links show it.
    std::optional<NamedMesh> skin() {
        const auto* skin = actor_.FirstChildElement("skin");
        const bool has_body = actor_.FirstChildElement("link") != nullptr ||
                              actor_.FirstChildElement("include") != nullptr;
        if (skin == nullptr && has_body) return std::nullopt;
        NamedMesh mesh{{"", sheet_.folder}, {}};
        if (skin == nullptr) return mesh;
        mesh.file.uri = SdfValues(*skin, sheet_.dialect).text("filename").value_or("");
        const auto* scale = skin->FirstChildElement("scale");
        if (scale == nullptr) return mesh;
        const double times = number_in(scale).value_or(0.0);
        if (times > 0.0) mesh.view.scale = glm::dvec3{times};
        if (!(times > 0.0))
            warn(*scale, "has a <scale> of " + quote(text_of(scale)) + "; 1 is taken");
        return mesh;
    }

    SharedScript read_script(const Pose& pose) {
        const auto* script = actor_.FirstChildElement("script");
        if (script == nullptr || !is_true(script->FirstChildElement("auto_start"), true)) return {};
        std::vector<ActorTrajectory> trajectories;
        for (const XMLElement& trajectory : Children(*script, "trajectory")) {
            if (auto read = read_trajectory(trajectory)) trajectories.push_back(std::move(*read));
        }
        if (trajectories.empty()) return {};
        std::ranges::stable_sort(trajectories, {}, &ActorTrajectory::id);
        warn_of_origin(*script, pose, trajectories.front().waypoints.front().pose);
        auto walk = walk_of(trajectories, delay_of(*script),
                            is_true(script->FirstChildElement("loop"), true));
        if (walk == nullptr) warn(*script, "has a script of more than 4e9 s; it stands still");
        return walk;
    }

    /// In Gazebo Sim, waypoints are relative to the <pose>.
    void warn_of_origin(const XMLElement& script, const Pose& pose, const Pose& first) {
        const bool is_origin = pose == Pose{};
        const double apart_m = glm::distance(pose.translation_m, first.translation_m);
        if (is_origin || apart_m < same_place_m) return;
        warn(script,
             "has waypoints, which scipd reads as poses in the world, as Gazebo Classic does; in "
             "Gazebo Sim they are relative to its <pose>");
    }

    Time delay_of(const XMLElement& script) {
        const auto* element = script.FirstChildElement("delay_start");
        if (element == nullptr) return {};
        const auto delay_s = number_in(element);
        if (delay_s && *delay_s >= 0.0 && *delay_s <= latest_s) return to_time(*delay_s);
        warn(*element, "has a <delay_start> of " + quote(text_of(element)) +
                           ", which is not from 0 to 1e9 s; it does not wait");
        return {};
    }

    std::optional<ActorTrajectory> read_trajectory(const XMLElement& element) {
        ActorTrajectory trajectory{element.IntAttribute("id"), tension_of(element), {}};
        for (const XMLElement& waypoint : Children(element, "waypoint")) {
            if (++waypoints_ > most_waypoints) {
                warn(waypoint, "has more than 10000 waypoints; the rest is left out");
                break;
            }
            if (const auto read = read_waypoint(waypoint)) trajectory.waypoints.push_back(*read);
        }
        put_in_order(element, trajectory.waypoints);
        if (!trajectory.waypoints.empty()) return trajectory;
        warn(element, "has a <trajectory> without waypoints; left out");
        return std::nullopt;
    }

    double tension_of(const XMLElement& element) {
        const char* text = element.Attribute("tension");
        if (text == nullptr) return 0.0;
        const auto number = parse_numbers(text, 1);
        const double tension = number ? std::clamp(number->front(), 0.0, 1.0) : 0.0;
        if (!number || tension != number->front()) {
            warn(element, "has a tension of " + quote(text) + ", which is not from 0 to 1; " +
                              (tension == 0.0 ? "0" : "1") + " is taken");
        }
        return tension;
    }

    std::optional<Waypoint> read_waypoint(const XMLElement& element) {
        const auto* time = element.FirstChildElement("time");
        const auto time_s = time == nullptr ? std::optional(0.0) : number_in(time);
        const auto pose = pose_in(element.FirstChildElement("pose"));
        const bool good = time_s && *time_s >= 0.0 && *time_s <= latest_s;
        if (good && pose) return Waypoint{to_time(*time_s), *pose};
        warn(element,
             good ? "has a waypoint whose <pose> is not six finite numbers within 1e7 m; left out"
                  : "has a waypoint whose <time> is not from 0 to 1e9 s; left out");
        return std::nullopt;
    }

    /// A file may have them in any order. Of several with the same time, Gazebo uses the last.
    void put_in_order(const XMLElement& trajectory, std::vector<Waypoint>& waypoints) {
        const auto earlier = [](const Waypoint& a, const Waypoint& b) { return a.time < b.time; };
        if (!std::ranges::is_sorted(waypoints, earlier)) {
            warn(trajectory, "has waypoints whose times go back; scipd sorts them by time");
            std::ranges::stable_sort(waypoints, earlier);
        }
        std::vector<Waypoint> apart;
        for (Waypoint& waypoint : waypoints) {
            if (waypoint.time < closest) waypoint.time = {};
            if (!apart.empty() && waypoint.time - apart.back().time < closest) apart.pop_back();
            apart.push_back(waypoint);
        }
        if (apart.size() < waypoints.size()) {
            warn(trajectory,
                 "has waypoints less than a millisecond apart; the last of them is taken");
        }
        waypoints = std::move(apart);
    }

    static Time to_time(double seconds) { return Time(std::llround(seconds * 1e9)); }

    /// Gives each kind of warning once for each actor.
    void warn(const XMLElement& at, const std::string& what) {
        if (std::ranges::find(told_, what) != told_.end()) return;
        told_.push_back(what);
        draft_.warn(text_of(sheet_.place(at)) + ": actor " + quote(attribute(actor_, "name")) +
                    ' ' + what);
    }

    const XMLElement& actor_;
    const SdfSheet& sheet_;
    SceneDraft& draft_;
    std::vector<std::string> told_;
    std::size_t waypoints_ = 0;
};

}  // namespace

Actor actor_of(const XMLElement& element, const SdfSheet& sheet, SceneDraft& draft) {
    return ActorReader(element, sheet, draft).read();
}

SdfPart skin_link_of(const Actor& actor, const FilePlace& place) {
    SdfSurface skin{std::string{skin_name}, place};
    skin.geometry = *actor.skin;
    SdfPart link{SdfPart::Kind::link, std::string{skin_name}, place};
    link.surfaces.push_back(std::move(skin));
    return link;
}

}  // namespace scipd::sim
