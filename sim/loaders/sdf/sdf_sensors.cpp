// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_sensors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/sdf_document.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

constexpr std::array<std::string_view, 4> lidar_types{"ray", "gpu_ray", "lidar", "gpu_lidar"};

/// What is wrong with a sensor.
struct SensorFault : std::runtime_error {
    using std::runtime_error::runtime_error;
};

bool is_named(const XMLElement& element, std::string_view name) {
    return attribute(element, "name") == name;
}

/// The name of the model that holds the link, after those of all models around it.
std::string whole_name_of_model(const XMLElement& link) {
    std::string name;
    const auto* at = link.Parent();
    for (; at != nullptr && at->ToElement() != nullptr; at = at->Parent()) {
        const XMLElement& parent = *at->ToElement();
        if (parent.Name() != std::string_view{"model"}) break;
        name = attribute(parent, "name") + (name.empty() ? "" : "::" + name);
    }
    return name;
}

std::vector<double> numbers_in(const XMLElement& element) {
    std::vector<double> numbers;
    const char* at = element.GetText() == nullptr ? "" : element.GetText();
    for (char* end = nullptr;; at = end) {
        const double number = std::strtod(at, &end);
        if (end == at) break;
        numbers.push_back(number);
    }
    if (std::string_view{at}.find_first_not_of(" \t\r\n") != std::string_view::npos) {
        throw SensorFault("<" + std::string{element.Name()} + "> has " + quote(at) +
                          " where a number is wanted");
    }
    return numbers;
}

const XMLElement& child_of(const XMLElement& element, const char* name) {
    const auto* child = element.FirstChildElement(name);
    if (child == nullptr) {
        throw SensorFault("has no <" + std::string{name} + "> in its <" + element.Name() + ">");
    }
    return *child;
}

/// The number of a child; `otherwise` where there is none.
double number_in(const XMLElement& element, const char* name,
                 std::optional<double> otherwise = {}) {
    if (otherwise && element.FirstChildElement(name) == nullptr) return *otherwise;
    const auto numbers = numbers_in(child_of(element, name));
    if (numbers.size() != 1 || std::isnan(numbers[0])) {
        throw SensorFault("<" + std::string{name} + "> must be one number");
    }
    return numbers[0];
}

/// The number of samples or rows. SDF multiplies <samples> by <resolution>.
int count_in(const XMLElement& scan, double otherwise) {
    constexpr double most = 1e6;
    const double count =
        std::round(number_in(scan, "samples", otherwise) * number_in(scan, "resolution", 1.0));
    if (!(count >= 1.0 && count <= most)) throw SensorFault("<samples> must be 1 to 1000000");
    return static_cast<int>(count);
}

void check(const Lidar& lidar) {
    // Files often round a full turn up.
    constexpr double turn_rad = 2.0 * std::numbers::pi + 0.01;
    const double view_rad = lidar.max_angle_rad - lidar.min_angle_rad;
    if (!(view_rad >= 0.0 && view_rad <= turn_rad)) {
        throw SensorFault(
            "<max_angle> must be <min_angle> or more, by a turn at most; they are in radians");
    }
    if (!(lidar.min_range_m >= 0.0 && lidar.min_range_m < lidar.max_range_m)) {
        throw SensorFault("<min> in its <range> must be 0 or more, and <max> above it");
    }
    if (!(lidar.rate_hz >= 0.0 && std::isfinite(lidar.rate_hz))) {
        throw SensorFault("<update_rate> must not be negative");
    }
}

Lidar lidar_of(const XMLElement& sensor) {
    const auto* ray = sensor.FirstChildElement("lidar");
    if (ray == nullptr) ray = sensor.FirstChildElement("ray");
    if (ray == nullptr) throw SensorFault("has neither <lidar> nor <ray>");
    const XMLElement& scan = child_of(*ray, "scan");
    const XMLElement& row = child_of(scan, "horizontal");
    const auto* vertical = scan.FirstChildElement("vertical");
    const XMLElement& range = child_of(*ray, "range");
    constexpr double samples_of_sdf = 640.0;
    const Lidar lidar{.samples = count_in(row, samples_of_sdf),
                      .rows = vertical == nullptr ? 1 : count_in(*vertical, 1.0),
                      .min_angle_rad = number_in(row, "min_angle"),
                      .max_angle_rad = number_in(row, "max_angle"),
                      .min_range_m = number_in(range, "min"),
                      .max_range_m = number_in(range, "max"),
                      .rate_hz = number_in(sensor, "update_rate", 0.0)};
    check(lidar);
    return lidar;
}

/// libsdformat refuses a world for a frame that refers to nothing.
bool has_frame(const XMLElement& model, std::string_view name) {
    constexpr std::array<std::string_view, 5> kinds{"link", "frame", "joint", "model", "include"};
    const auto inner = name.find("::");
    const std::string_view first = name.substr(0, inner);
    for (const auto* child = model.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
        const std::string_view kind = child->Name();
        if (std::ranges::find(kinds, kind) == kinds.end()) continue;
        const auto* own = child->FirstChildElement("name");
        if (kind == "include"
                ? own != nullptr && own->GetText() != nullptr && first == own->GetText()
                : is_named(*child, first)) {
            if (inner == name.npos || kind == "include") return true;
            if (kind == "model") return has_frame(*child, name.substr(inner + 2));
        }
        // Gazebo Classic saves links named MODEL::LINK.
        if (is_named(*child, name)) return true;
    }
    return name == "__model__";
}

void check_pose(const XMLElement& pose, const XMLElement& model) {
    const auto numbers = numbers_in(pose);
    const std::size_t wanted = attribute(pose, "rotation_format") == "quat_xyzw" ? 7 : 6;
    const bool finite = std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); });
    if (!finite || (!numbers.empty() && numbers.size() != wanted)) {
        throw SensorFault("<pose> must be " + std::to_string(wanted) + " numbers");
    }
    for (const char* reference : {"relative_to", "frame"}) {
        const std::string name = attribute(pose, reference);
        if (!name.empty() && !has_frame(model, name)) {
            throw SensorFault("its <pose> is relative to " + quote(name) + ", which is no frame");
        }
    }
}

/// Offers the sensors of one document.
class Offer {
  public:
    Offer(const std::filesystem::path& file, std::vector<FoundSensor>& found)
        : file_(file), found_(found) {}

    void add_models(XMLElement& parent) {
        for (auto* model = parent.FirstChildElement("model"); model != nullptr;
             model = model->NextSiblingElement("model")) {
            add_models(*model);
            std::set<std::string> names;
            for (auto* link = model->FirstChildElement("link"); link != nullptr;
                 link = link->NextSiblingElement("link"))
                add_link(*model, *link, names.insert(attribute(*link, "name")).second);
        }
    }
    std::vector<std::string> warnings() && { return std::move(warnings_); }

  private:
    void add_link(XMLElement& model, XMLElement& link, bool is_first_of_name) {
        for (auto* sensor = link.FirstChildElement("sensor"); sensor != nullptr;
             sensor = sensor->NextSiblingElement("sensor")) {
            const int line = sensor->IntAttribute(line_mark, sensor->GetLineNum());
            sensor->DeleteAttribute(line_mark);
            const std::string type = attribute(*sensor, "type");
            const bool is_lidar = std::ranges::find(lidar_types, type) != lidar_types.end();
            if (found_.size() >= most_sensors) {
                if (!std::exchange(told_, true)) warn(line, link, *sensor, SensorFault(too_many));
                continue;
            }
            try {
                if (!is_first_of_name) throw SensorFault("its link is not the first of this name");
                add(model, link, *sensor,
                    {printable(type, longest_type),
                     is_lidar ? std::optional(lidar_of(*sensor)) : std::nullopt});
            } catch (const SensorFault& fault) {
                // For sensors that are not lidars, scipd needs only the pose, so faults get no
                // warning.
                if (is_lidar) warn(line, link, *sensor, fault);
            }
        }
    }

    void add(XMLElement& model, const XMLElement& link, const XMLElement& sensor,
             FoundSensor found) {
        const auto* pose = sensor.FirstChildElement("pose");
        if (pose != nullptr) check_pose(*pose, model);
        const std::string own_name = attribute(sensor, "name");
        if (own_name.empty()) throw SensorFault("has no name");
        const std::string link_name = attribute(link, "name");
        if (link_name.empty()) throw SensorFault("its link has no name");
        const std::string name = link_name + std::string{stands_for_colons} + own_name;
        if (!names_.emplace(&model, name).second) {
            throw SensorFault("is not the first of this name in its link");
        }
        auto* frame = model.InsertNewChildElement("frame");
        frame->SetAttribute("name", name.c_str());
        frame->SetAttribute("attached_to", link_name.c_str());
        if (pose != nullptr) frame->InsertEndChild(pose->DeepClone(model.GetDocument()));
        frame->InsertNewChildElement(sensor_mark)
            ->SetText(static_cast<std::uint64_t>(found_.size()));
        found_.push_back(std::move(found));
    }

    void warn(int line, const XMLElement& link, const XMLElement& sensor,
              const SensorFault& fault) {
        warnings_.push_back(file_.string() + ':' + std::to_string(line) + ": sensor " +
                            quote(attribute(sensor, "name")) + " of link " +
                            quote(attribute(link, "name")) + " of model " +
                            quote(whole_name_of_model(link)) + ": " + fault.what() +
                            "; no scanner can be mounted there, but no range depends on it");
    }

    static constexpr std::size_t longest_type = 40;
    /// The library's time grows with the square of the number of frames in a model.
    static constexpr std::size_t most_sensors = 4000;
    static constexpr const char* too_many = "is one of more than 4000 sensors, here and elsewhere";

    const std::filesystem::path& file_;
    std::vector<FoundSensor>& found_;
    std::set<std::pair<const XMLElement*, std::string>> names_;  ///< of frames, by model
    std::vector<std::string> warnings_;
    bool told_ = false;
};

}  // namespace

std::vector<std::string> offer_sensors(XMLElement& root, const std::filesystem::path& file,
                                       std::vector<FoundSensor>& found) {
    Offer offer{file, found};
    offer.add_models(root);
    for (auto* world = root.FirstChildElement("world"); world != nullptr;
         world = world->NextSiblingElement("world"))
        offer.add_models(*world);
    return std::move(offer).warnings();
}

}  // namespace scipd::sim
