// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/mounting.h"

#include <algorithm>
#include <string_view>

#include "daemon/config/sensor.h"
#include "daemon/models/best_fit.h"
#include "sim/expected.h"
#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {
namespace {

using Frames = std::vector<const sim::Frame*>;

bool is_of(MountKind kind, const sim::Frame& frame) {
    switch (kind) {
        case MountKind::link:
            return frame.sensor.empty();
        case MountKind::sensor:
            return !frame.sensor.empty();
        case MountKind::lidar:
            return frame.lidar.has_value();
        case MountKind::any:
            break;
    }
    return true;
}

std::string_view name_of(MountKind kind) {
    switch (kind) {
        case MountKind::link:
            return "link or frame";
        case MountKind::sensor:
            return "sensor";
        case MountKind::lidar:
            return "lidar";
        case MountKind::any:
            break;
    }
    return "link, frame or sensor";
}

bool ends_with_name(std::string_view whole, std::string_view end) {
    if (!whole.ends_with(end)) return false;
    whole.remove_suffix(end.size());
    return whole.empty() || whole.ends_with("::");
}

/// All places of that kind, in that model where it is known.
Frames places_for(const NamedMount& mount, const sim::Scene& scene) {
    Frames all;
    for (const sim::Frame& frame : scene.frames) {
        const bool there = mount.model.empty() || scene.models[frame.model].name == mount.model;
        if (there && is_of(mount.kind, frame)) all.push_back(&frame);
    }
    return all;
}

/// The places that the name may mean. A whole name means one.
Frames meant(const Frames& all, std::string_view name) {
    const auto whole = std::ranges::find(all, name, &sim::Frame::name);
    if (whole != all.end()) return {*whole};
    Frames found;
    std::ranges::copy_if(all, std::back_inserter(found), [&](const sim::Frame* frame) {
        return ends_with_name(frame->name, name);
    });
    return found;
}

std::string names_of(const Frames& frames) {
    constexpr std::size_t most = 32;
    std::string text;
    for (std::size_t i = 0; i < std::min(frames.size(), most); ++i)
        text += (i == 0 ? "" : ", ") + frames[i]->name;
    if (frames.size() > most) text += " and " + std::to_string(frames.size() - most) + " more";
    return text.empty() ? "none" : text;
}

/// The only place that has the name; never null. A fault says what there is.
sim::Expected<const sim::Frame*> find_place(const NamedMount& mount, const sim::Scene& scene,
                                            const std::string& file) {
    const Frames all = places_for(mount, scene);
    const Frames found = meant(all, mount.name);
    if (found.size() == 1) return found.front();
    if (found.size() > 1) {
        return sim::refuse("\"" + mount.name + "\" may be one of several in " + file + ": " +
                           names_of(found) + "; write one of these");
    }
    const std::string where =
        mount.model.empty() ? file : "model \"" + mount.model + "\" of " + file;
    return sim::refuse(where + " has no " + std::string{name_of(mount.kind)} + " \"" + mount.name +
                       "\"; there are: " + names_of(all));
}

/// What a user should know of a scanner in the place of this lidar.
std::string notice(const std::string& name, const Model& model, const sim::Frame& frame) {
    const Model& best = best_fit(*frame.lidar);
    const auto unlike = [&](const Model& other) {
        const std::string text = differences(other, *frame.lidar);
        return text.empty() ? "" : ": " + text;
    };
    if (misfit(model, *frame.lidar) > misfit(best, *frame.lidar)) {
        return name + ": " + best.profile.name + " would fit " + frame.name + " better than " +
               model.profile.name + unlike(best) + "; " + model.profile.name + " has" +
               unlike(model).erase(0, 1);
    }
    return name + ": of all models " + model.profile.name + " fits " + frame.name + " best" +
           unlike(model);
}

/// Mounts the sensors of all robots, one after the other.
class Mounting {
  public:
    Mounting(Config& config, const sim::Scene& scene, const KnownSensors& mounted)
        : config_(config), scene_(scene), mounted_(mounted) {}

    std::vector<std::string> run() {
        for (RobotConfig& robot : config_.robots) {
            for (SensorConfig& sensor : robot.sensors) {
                const std::string name = sensor_name(robot.name, sensor.name);
                const bool sits = find_known(mounted_, name, sensor) != nullptr;
                if (sensor.mount && !sits) mount(robot, sensor);
            }
        }
        if (!faults_.empty()) throw sim::LoadError(std::move(faults_));
        return std::move(notices_);
    }

  private:
    void mount(RobotConfig& robot, SensorConfig& sensor) {
        const std::string place =
            config_.place_of("robots." + robot.name + ".sensors." + sensor.name + ".mount");
        sensor.mount->model = robot.body;
        const auto mounted =
            find_place(*sensor.mount, scene_, config_.scene.string())
                .and_then([&](const sim::Frame* frame) { return put_on(*frame, robot, sensor); });
        if (!mounted) faults_.push_back(place + mounted.error().why);
    }

    sim::Expected<> put_on(const sim::Frame& frame, RobotConfig& robot, SensorConfig& sensor) {
        const sim::Model& model = scene_.models[frame.model];
        if (auto taken = take_model(robot, model); !taken) return taken;
        sensor.mount->model = model.name;
        // A sensor's name is that of its link and its own.
        sensor.mount->link =
            frame.sensor.empty() ? frame.name : frame.name.substr(0, frame.name.rfind("::"));
        sensor.robot_from_sensor = frame.model_from_frame * sensor.mount->frame_from_sensor;
        if (!frame.lidar || sensor.staring) return {};
        return look_at(*frame.lidar, robot, sensor, frame);
    }

    /// The robot is this model, or rides on it.
    sim::Expected<> take_model(RobotConfig& robot, const sim::Model& model) {
        const auto [known, is_first] = model_of_.emplace(robot.name, model.name);
        if (!is_first && known->second != model.name) {
            return sim::refuse("lies in model \"" + model.name + "\", another sensor of \"" +
                               robot.name + "\" in \"" + known->second +
                               "\"; give each model a robot of its own");
        }
        if (!is_first) return {};
        if (!robot.pose_given) robot.world_from_robot = model.world_from_model;
        if (!model.movable || !robot.body.empty()) return {};
        for (const RobotConfig& other : config_.robots) {
            if (other.body != model.name) continue;
            return sim::refuse("lies in model \"" + model.name +
                               "\", which is the body of robot \"" + other.name +
                               "\"; make it a sensor of that one");
        }
        robot.body = model.name;
        return {};
    }

    sim::Expected<> look_at(const sim::Lidar& lidar, const RobotConfig& robot, SensorConfig& sensor,
                            const sim::Frame& frame) {
        if (sensor.mount->chooses_model) {
            sensor.model = best_fit(lidar);
            auto checked = check_power_up(sensor.power_up, sensor.model.profile);
            if (!checked) return checked;
        }
        notices_.push_back(notice(sensor_name(robot.name, sensor.name), sensor.model, frame));
        return {};
    }

    Config& config_;
    const sim::Scene& scene_;
    const KnownSensors& mounted_;
    std::map<std::string, std::string> model_of_;  ///< by robot
    std::vector<std::string> faults_;
    std::vector<std::string> notices_;
};

}  // namespace

std::vector<std::string> mount_by_name(Config& config, const sim::Scene& scene,
                                       const KnownSensors& mounted) {
    return Mounting{config, scene, mounted}.run();
}

std::optional<sim::Pose> mounted_again(const NamedMount& mount, const sim::Scene& scene) {
    const Frames found = meant(places_for(mount, scene), mount.name);
    if (found.size() != 1) return std::nullopt;
    return found.front()->model_from_frame * mount.frame_from_sensor;
}

}  // namespace scipd::daemon
