// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/json/scan_json.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

/// Without ".0" where a number is whole.
OrderedJson number_of(double value) {
    const bool whole = std::abs(value) < 1e15 && value == std::trunc(value);
    return whole ? OrderedJson(static_cast<std::int64_t>(value)) : OrderedJson(value);
}

/// The first of each step; 0 where a step has none.
OrderedJson firsts(const RecordedScan& scan,
                   std::span<const double> (RecordedScan::*values_of)(std::size_t) const) {
    OrderedJson list = OrderedJson::array();
    for (std::size_t step = 0; step < scan.steps(); ++step) {
        const auto values = (scan.*values_of)(step);
        list.push_back(number_of(values.empty() ? 0.0 : values.front()));
    }
    return list;
}

OrderedJson echoes_of(const RecordedScan& scan) {
    OrderedJson steps = OrderedJson::array();
    for (std::size_t step = 0; step < scan.steps(); ++step) {
        const auto ranges = scan.ranges_of(step);
        const auto intensities = scan.intensities_of(step);
        OrderedJson echoes = OrderedJson::array();
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            OrderedJson range = number_of(ranges[i]);
            echoes.push_back(intensities.empty()
                                 ? std::move(range)
                                 : OrderedJson::array({range, number_of(intensities[i])}));
        }
        steps.push_back(std::move(echoes));
    }
    return steps;
}

template <class Value>
void add_known(OrderedJson& object, const char* key, const std::optional<Value>& value) {
    if (value) object[key] = *value;
}

// From here on: reading.

/// A number; null, where a scan in metres has no range, is NaN.
std::optional<double> number_in(const Json& value) {
    if (value.is_number()) return value.get<double>();
    if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
    return std::nullopt;
}

/// Reads members, and keeps what is wrong with the first that is wrong.
class MemberReader {
  public:
    explicit MemberReader(const Json& object) : object_(object) {}

    [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
    [[nodiscard]] const std::optional<Fault>& fault() const { return fault_; }

    template <class Number>
    std::optional<Number> number(const char* key, double low, double high) {
        const auto found = object_.find(key);
        if (found == object_.end() || found->is_null()) return std::nullopt;
        const double value = found->is_number() ? found->get<double>() : NAN;
        if (value >= low && value <= high) return static_cast<Number>(value);
        refuse(key,
               "must be a number from " + number_of(low).dump() + " to " + number_of(high).dump());
        return std::nullopt;
    }

    std::vector<double> numbers(const char* key) {
        std::vector<double> numbers;
        const auto list = object_.find(key);
        const bool is_list = list != object_.end() && list->is_array();
        for (std::size_t i = 0; is_list && i < list->size(); ++i) {
            if (const auto number = number_in((*list)[i])) numbers.push_back(*number);
        }
        if (!is_list || numbers.size() < list->size()) refuse(key, "must be a list of numbers");
        return numbers;
    }

    /// The lists of a list.
    const Json& list(const char* key) {
        static const Json none = Json::array();
        const Json& value = object_.at(key);
        if (value.is_array()) return value;
        refuse(key, "must be a list");
        return none;
    }

    void refuse(const char* key, const std::string& why) {
        if (!fault_) fault_ = Fault{key, std::string(key) + " " + why};
    }

  private:
    const Json& object_;
    std::optional<Fault> fault_;
};

/// Puts the echoes of a step behind those of the one before.
bool append_echoes(const Json& echoes, RecordedScan& scan) {
    if (!echoes.is_array()) return false;
    for (const Json& echo : echoes) {
        const bool pair = echo.is_array() && echo.size() == 2;
        const auto range = number_in(pair ? echo[0] : echo);
        const auto intensity = pair ? number_in(echo[1]) : std::nullopt;
        if (!range || (pair && !intensity)) return false;
        scan.ranges.push_back(*range);
        if (pair) scan.intensities.push_back(*intensity);
    }
    scan.echo_ends.push_back(static_cast<std::uint32_t>(scan.ranges.size()));
    return true;
}

void read_echoes(MemberReader& members, RecordedScan& scan) {
    scan.ranges.clear();
    scan.intensities.clear();
    bool fine = true;
    for (const Json& step : members.list("echoes"))
        fine = fine && append_echoes(step, scan);
    if (!fine || (!scan.intensities.empty() && scan.intensities.size() != scan.ranges.size()))
        members.refuse("echoes", "must have a list for each step, of mm or of [mm, intensity]");
}

void read_values(MemberReader& members, RecordedScan& scan) {
    const bool ours = members.has("distances_mm");
    scan.unit = ours ? RangeUnit::millimetres : RangeUnit::metres;
    scan.ranges = members.numbers(ours ? "distances_mm" : "ranges");
    if (ours && members.has("echoes")) return read_echoes(members, scan);
    if (!members.has("intensities")) return;
    scan.intensities = members.numbers("intensities");
    if (!scan.intensities.empty() && scan.intensities.size() != scan.ranges.size())
        members.refuse("intensities", "must be as many as there are ranges");
}

void read_directions(MemberReader& members, RecordedScan& scan) {
    constexpr double most_steps = 1e6;
    constexpr double most_rad = 100;
    Directions& directions = scan.directions;
    directions.first_step = members.number<int>("first_step", 0, most_steps);
    directions.cluster = members.number<int>("cluster", 1, most_steps).value_or(1);
    directions.first_rad = members.number<double>("first_angle_rad", -most_rad, most_rad);
    directions.increment_rad = members.number<double>("angle_increment_rad", -most_rad, most_rad);
    const auto start = members.number<double>("start_angle", -most_rad, most_rad);
    const auto end = members.number<double>("end_angle", -most_rad, most_rad);
    if (directions.first_rad || !start || !end) return;
    const auto gaps = static_cast<double>(std::max<std::size_t>(scan.steps(), 2) - 1);
    directions.first_rad = start;
    directions.increment_rad = (*end - *start) / gaps;
}

}  // namespace

void add_scan(OrderedJson& object, const RecordedScan& scan) {
    const Directions& directions = scan.directions;
    add_known(object, "stamp_ms", scan.stamp_ms);
    add_known(object, "stamp_us", scan.stamp_us);
    add_known(object, "first_step", directions.first_step);
    object["cluster"] = directions.cluster;
    add_known(object, "first_angle_rad", directions.first_rad);
    add_known(object, "angle_increment_rad", directions.increment_rad);
    object["distances_mm"] = firsts(scan, &RecordedScan::ranges_of);
    if (!scan.intensities.empty())
        object["intensities"] = firsts(scan, &RecordedScan::intensities_of);
    if (scan.has_echoes()) object["echoes"] = echoes_of(scan);
}

Expected<RecordedScan> scan_in(const Json& object) {
    if (!object.is_object()) return refuse("must be a JSON object");
    constexpr double most_exact = 9e15;
    MemberReader members(object);
    RecordedScan scan;
    scan.stamp_ms = members.number<std::uint32_t>("stamp_ms", 0, 0xFFFFFFFF);
    scan.stamp_us = members.number<std::uint64_t>("stamp_us", 0, most_exact);
    read_values(members, scan);
    read_directions(members, scan);
    if (members.fault()) return tl::unexpected(*members.fault());
    return scan;
}

HostTime host_time_of(double seconds) {
    const double us = std::round(std::min(std::max(seconds, -time_limit_s), time_limit_s) * 1e6);
    return HostTime(std::chrono::microseconds(static_cast<std::int64_t>(us)));
}

}  // namespace scipd::sim
