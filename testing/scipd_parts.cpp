// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/scipd_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "testing/pose_json.h"
#include "testing/scipd_inside.h"
#include "testing/scipd_values.h"

namespace scipd::testing {
namespace {

/// A drive: poses at times, read from a TUM file.
class TumDrive {
  public:
    /// Throws ScipdError with the line that is wrong.
    explicit TumDrive(const std::filesystem::path& path);

    [[nodiscard]] double seconds() const { return knots_.back().time_s; }
    /// Evenly between the poses of the file; `time_s` counts from its first.
    [[nodiscard]] Json pose_at(double time_s) const;

  private:
    struct Knot {
        double time_s;
        Json pose;
    };
    std::vector<Knot> knots_;
};

/// t tx ty tz qx qy qz qw. False: the line is another one.
bool read(const std::string& line, std::array<double, 8>& numbers) {
    std::istringstream words(line);
    for (double& number : numbers)
        words >> number;
    return words && (words >> std::ws).eof();
}

TumDrive::TumDrive(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw ScipdError(path.string() + " cannot be read");
    const auto refuse = [&](std::size_t number, const std::string& why) -> ScipdError {
        return ScipdError{path.string() + ":" + std::to_string(number) + ": " + why};
    };
    double first_s = 0;
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        if (const auto text = line.find_first_not_of(" \t\r");
            text == line.npos || line[text] == '#')
            continue;
        std::array<double, 8> is{};
        if (!read(line, is))
            throw refuse(number,
                         "is no line of TUM (t tx ty tz qx qy qz qw), the only format that "
                         "is read here; scipctl pose play reads others");
        if (knots_.empty()) first_s = is[0];
        const double time_s = is[0] - first_s;
        if (!knots_.empty() && time_s <= knots_.back().time_s)
            throw refuse(number, "the times of a drive must grow");
        knots_.push_back(
            {time_s, {{"xyz", {is[1], is[2], is[3]}}, {"q", {is[4], is[5], is[6], is[7]}}}});
    }
    if (knots_.empty()) throw ScipdError(path.string() + ": holds no pose");
}

Json TumDrive::pose_at(double time_s) const {
    const auto after = std::ranges::upper_bound(knots_, time_s, {}, &Knot::time_s);
    if (after == knots_.begin()) return knots_.front().pose;
    if (after == knots_.end()) return knots_.back().pose;
    const Knot& before = *(after - 1);
    return between(before.pose, after->pose,
                   (time_s - before.time_s) / (after->time_s - before.time_s));
}

/// Text as a part of XML.
std::string escaped(const std::string& text) {
    std::string xml;
    for (const char c : text) {
        switch (c) {
            case '<':
                xml += "&lt;";
                break;
            case '&':
                xml += "&amp;";
                break;
            case '"':
                xml += "&quot;";
                break;
            default:
                xml += c;
        }
    }
    return xml;
}

std::string sdf_of(const std::string& name, const Box& box) {
    const auto [x, y, z] = box.size_m;
    if (!(x > 0 && y > 0 && z > 0))
        throw std::invalid_argument("a box has three lengths in metres above 0");
    const auto text = [](double number) { return Json(number).dump(); };
    const std::string material =
        box.material.empty() ? ""
                             : "<scipd:material>" + escaped(box.material) + "</scipd:material>";
    return "<model name=\"" + escaped(name) +
           "\" xmlns:scipd=\"urn:scipd:sdf\"><link name=\"body\"><visual name=\"box\"><pose>0 0 " +
           text(z / 2) + " 0 0 0</pose>" + material + "<geometry><box><size>" + text(x) + " " +
           text(y) + " " + text(z) + "</size></box></geometry></visual></link></model>";
}

/// Adds what is to be added to the request.
struct Filling {
    const std::string& name;
    Json& request;

    void operator()(const Box& box) const { request["sdf"] = sdf_of(name, box); }
    void operator()(const Mesh& mesh) const {
        request["mesh"] = std::filesystem::absolute(mesh.file).string();
        request["scale"] = mesh.scale;
        if (!mesh.material.empty()) request["material"] = mesh.material;
    }
    void operator()(const Sdf& sdf) const { request["sdf"] = sdf.text; }
    void operator()(const ModelFile& model) const {
        request["file"] = std::filesystem::absolute(model.file).string();
    }
};

}  // namespace

Pose Robot::pose() const {
    return pose_in(inside_.running.get(robot_pose_path(name_)));
}

void Robot::set_pose(const Pose& pose) const {
    inside_.clock.place(robot_pose_path(name_), json_of(pose));
}

void Robot::drive_to(const Pose& pose, std::chrono::duration<double> seconds) const {
    const std::string path = robot_pose_path(name_);
    const Json from = inside_.running.get(path);
    const Json to = json_of(pose);
    inside_.clock.move(path, seconds, [&](double share) { return between(from, to, share); });
}

void Robot::play(const std::filesystem::path& trajectory, double speed) const {
    if (!(speed > 0)) throw std::invalid_argument("a drive has a speed above 0");
    const TumDrive drive(trajectory);
    const std::string path = robot_pose_path(name_);
    inside_.clock.place(path, drive.pose_at(0));
    inside_.clock.move(path, std::chrono::duration<double>(drive.seconds() / speed),
                       [&](double share) { return drive.pose_at(share * drive.seconds()); });
}

std::vector<std::string> Scene::add(const std::string& name, const What& what,
                                    const Pose& pose) const {
    Json request{{"name", name}, {"pose", json_of(pose)}};
    std::visit(Filling{name, request}, what);
    return inside_.running.ask("POST", "/scene/models", request).at("warnings");
}

void Scene::move(const std::string& name, const Pose& pose) const {
    inside_.clock.place(model_pose_path(name), json_of(pose));
}

void Scene::remove(const std::string& name) const {
    (void)inside_.running.ask("DELETE", "/scene/models/" + tools::path_segment(name));
}

std::vector<std::string> Scene::load(const std::filesystem::path& world) const {
    const Json request{{"file", std::filesystem::absolute(world).string()}};
    return inside_.running.ask("PUT", "/scene", request).at("warnings");
}

Pose Scene::pose(const std::string& name) const {
    return pose_in(inside_.running.get(model_pose_path(name)));
}

std::vector<std::string> Scene::models() const {
    const Json scene = inside_.running.get("/scene");
    std::vector<std::string> names;
    for (const Json& model : scene.at("models"))
        names.push_back(model.at("name"));
    return names;
}

void Clock::run(std::chrono::duration<double> seconds) const {
    inside_.clock.run(seconds);
}

double Clock::time_s() const {
    return inside_.clock.now_s();
}

void Fault::stop() const try {
    (void)inside_.running.ask("DELETE", path_ + "/" + std::to_string(id_));
} catch (const Refused& refused) {
    if (refused.status() != 404) throw;  // it has ended, and is forgotten
}

std::string Fault::state() const {
    return status().at("state");
}

int Fault::hits() const {
    return status().at("hits");
}

Json Fault::status() const {
    return inside_.running.get(path_ + "/" + std::to_string(id_));
}

std::vector<WireMessage> Wire::messages() const {
    return inside_.wire.messages();
}

std::string Wire::text() const {
    std::string text;
    for (const WireMessage& message : messages()) {
        text += std::to_string(message.time_s) + " " + message.sensor + " " + message.client +
                (message.from_client ? " > " : " < ") + message.line +
                (message.status.empty() ? "" : " " + message.status) + ": " + message.means + "\n";
    }
    return text;
}

WireMessage Wire::wait_for(const std::string& request, std::chrono::milliseconds timeout) const {
    return inside_.wire.wait_for(request, timeout);
}

}  // namespace scipd::testing
