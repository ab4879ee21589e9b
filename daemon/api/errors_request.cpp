// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/errors_request.h"

#include <cmath>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "daemon/config/numbers.h"
#include "daemon/config/values.h"
#include "sim/loaders/poses/small_json.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using nlohmann::json;
using sim::Expected;
using Curve = std::vector<sim::BiasPoint>;

constexpr std::size_t most_points = 64;
constexpr const char* wanted_bias =
    R"(must be "none", "unit" or at most 64 {"range_m":..,"bias_m":..}, whose ranges grow)";

Expected<> read_accuracy(const json& value, ReadingErrors& errors) {
    if (!value.is_string())
        return sim::refuse("accuracy", R"(must be "ideal", "sensor" or "material")");
    const auto accuracy = parse_accuracy(value.get_ref<const std::string&>());
    if (!accuracy) return sim::refuse("accuracy", accuracy.error().why);
    errors.accuracy = *accuracy;
    return {};
}

Expected<> read_noise(const json& value, ReadingErrors& errors) {
    const double noise = value.is_number() ? value.get<double>() : -1.0;
    if (!(noise >= 0.0 && noise <= most_noise_factor))
        return sim::refuse("noise",
                           "must be a number from 0 to 100, a factor of the model's noise");
    errors.noise = noise;
    return {};
}

Expected<> read_interference(const json& value, ReadingErrors& errors) {
    if (!value.is_boolean()) return sim::refuse("interference", "must be true or false");
    errors.interference = value;
    return {};
}

bool is_point(const json& value) {
    return value.is_object() && value.size() == 2 && value.contains("range_m") &&
           value.contains("bias_m") && value["range_m"].is_number() && value["bias_m"].is_number();
}

Expected<Curve> curve_in(const json& list) {
    Curve curve;
    for (const json& value : list) {
        if (!is_point(value)) return sim::refuse("bias", wanted_bias);
        const sim::BiasPoint point{value["range_m"], value["bias_m"]};
        const bool grows =
            curve.empty() ? point.range_m >= 0.0 : point.range_m > curve.back().range_m;
        if (!grows || !std::isfinite(point.range_m) || std::abs(point.bias_m) > 1e3)
            return sim::refuse("bias", wanted_bias);
        curve.push_back(point);
    }
    return curve;
}

Expected<> read_bias(const json& value, ReadingErrors& errors) {
    errors.own_bias = value != "unit";
    if (value == "unit" || value == "none") {
        errors.bias.clear();
    } else if (value.is_array() && value.size() <= most_points) {
        auto curve = curve_in(value);
        if (!curve) return tl::unexpected(curve.error());
        errors.bias = *std::move(curve);
    } else {
        return sim::refuse("bias", wanted_bias);
    }
    return {};
}

Expected<> read_member(const std::string& key, const json& value, ReadingErrors& errors) {
    if (key == "accuracy") return read_accuracy(value, errors);
    if (key == "noise") return read_noise(value, errors);
    if (key == "bias") return read_bias(value, errors);
    if (key == "interference") return read_interference(value, errors);
    return sim::refuse(
        sim::printable(key, 64),
        "does not change while scipd runs; accuracy, noise, bias and interference do");
}

Json bias_document(const ReadingErrors& errors) {
    if (!errors.own_bias) return "unit";
    if (errors.bias.empty()) return "none";
    Json list = Json::array();
    for (const auto& [range_m, bias_m] : errors.bias)
        list.push_back({{"range_m", range_m}, {"bias_m", bias_m}});
    return list;
}

}  // namespace

Expected<ReadingErrors> parse_errors(const std::string& body, const ReadingErrors& now) {
    const auto parsed = sim::parse_small_json(body, 8 * static_cast<int>(most_points));
    if (!parsed || !parsed->is_object() || parsed->empty())
        return sim::refuse(R"(the body must be a JSON object such as {"accuracy":"ideal"})");
    ReadingErrors errors = now;
    for (const auto& [key, value] : parsed->items()) {
        if (const auto read = read_member(key, value, errors); !read)
            return tl::unexpected(read.error());
    }
    return errors;
}

Json errors_document(const ReadingErrors& errors) {
    return {{"accuracy", name_of(errors.accuracy)},
            {"noise", errors.noise},
            {"bias", bias_document(errors)},
            {"interference", errors.interference}};
}

using sim::Expected;
using sim::refuse;

Expected<AddedSensor> parse_new_sensor(const std::string& body) {
    auto parsed = sim::parse_ordered_json(body);
    if (!parsed)
        return refuse(parsed.error().field, "the body must be JSON: " + parsed.error().why);
    if (!parsed->is_object() || !parsed->contains("name") || !(*parsed)["name"].is_string()) {
        return refuse("name", R"(the body must be an object such as {"name":"robot/rear",)"
                              R"("model":"UST-10LX","tcp":"127.0.0.1:0"})");
    }
    const std::string name = (*parsed)["name"];
    const auto slash = name.find('/');
    const auto robot = parse_name(name.substr(0, slash));
    const auto sensor = parse_name(slash == name.npos ? "" : name.substr(slash + 1));
    if (slash == name.npos) return refuse("name", "must be ROBOT/SENSOR");
    for (const auto& part : {robot, sensor})
        if (!part) return refuse("name", part.error().why);
    AddedSensor added{.robot = *robot, .name = *sensor};
    if (parsed->contains("pose")) added.robot_pose = (*parsed)["pose"].dump();
    parsed->erase("name");
    parsed->erase("pose");
    added.keys = parsed->dump();
    return added;
}

Expected<> check_files(const AddedSensor& sensor) {
    const auto keys = nlohmann::json::parse(sensor.keys);
    if (keys.contains("replay"))
        return refuse("replay", "names a file of this machine: write it into the configuration");
    if (keys.contains("pty") && keys["pty"] != "auto" && keys["pty"] != "none") {
        return refuse("pty",
                      "must be auto, which makes a link in the run directory, or none; a path is "
                      "for the configuration");
    }
    return {};
}

}  // namespace scipd::daemon
