// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// named_columns() of pose_columns.h: finds columns by the names that people give them.
#include <algorithm>
#include <cctype>
#include <map>
#include <numbers>

#include "sim/loaders/poses/pose_columns.h"
#include "sim/loaders/poses/pose_line.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

struct Name {
    std::string word;  ///< lower case, blanks and points as underscores
    std::string unit;
};

std::string trimmed_name(std::string_view text) {
    const auto begin = text.find_first_not_of("_ #");
    if (begin == text.npos) return {};
    return std::string(text.substr(begin, text.find_last_not_of("_ ") - begin + 1));
}

/// Splits a name from its unit, as in `timestamp [ns]`, `Time (s)` and `t_ms`.
Name parse_name(std::string_view cell) {
    std::string text(cell);
    std::ranges::transform(text, text.begin(), [](unsigned char c) {
        return c == '.' || c == ' ' ? '_' : static_cast<char>(std::tolower(c));
    });
    if (const auto bracket = text.find_first_of("[("); bracket != text.npos) {
        const auto end = text.find_first_of("])", bracket);
        return {trimmed_name(text.substr(0, bracket)),
                trimmed_name(text.substr(bracket + 1, end - bracket - 1))};
    }
    const std::string name = trimmed_name(text);
    const auto last = name.rfind('_');
    constexpr std::array units{"s", "sec", "secs", "ms", "us", "ns", "m", "rad", "deg"};
    if (last == name.npos || std::ranges::find(units, name.substr(last + 1)) == units.end()) {
        return {name, {}};
    }
    return {name.substr(0, last), name.substr(last + 1)};
}

/// Maps every way to write a column's name to the one that is used below.
const std::map<std::string, std::string, std::less<>>& synonyms() {
    static const auto all = [] {
        std::map<std::string, std::string, std::less<>> names{
            {"t", "t"},         {"time", "t"},    {"timestamp", "t"}, {"stamp", "t"},
            {"yaw", "yaw"},     {"theta", "yaw"}, {"heading", "yaw"}, {"roll", "roll"},
            {"pitch", "pitch"}, {"qw", "qw"}};
        for (const std::string axis : {"x", "y", "z"}) {
            names[axis] = axis;
            for (const std::string before : {"t", "p", "p_", "pos_", "position_", "p_rs_r_"})
                names[before + axis] = axis;
        }
        for (const std::string axis : {"x", "y", "z", "w"}) {
            for (const std::string before : {"q", "q_", "quat_", "orientation_", "q_rs_"})
                names[before + axis] = "q" + axis;
        }
        return names;
    }();
    return all;
}

std::optional<int> time_power(const std::string& unit) {
    if (unit == "s" || unit == "sec" || unit == "secs" || unit == "seconds") return 0;
    if (unit == "ms") return -3;
    if (unit == "us") return -6;
    if (unit == "ns") return -9;
    return {};
}

class Header {
  public:
    Expected<> read(const std::vector<std::string_view>& cells,
                    std::vector<std::string>& not_read) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const Name name = parse_name(cells[i]);
            const auto known = synonyms().find(name.word);
            if (known == synonyms().end()) {
                not_read.push_back(quote(cells[i]));
            } else if (!found_.emplace(known->second, Column{i, printable(trimmed(cells[i]))})
                            .second) {
                return refuse("has two columns for " + known->second + ": " +
                              quote(found_[known->second].name) + " and " + quote(cells[i]));
            } else if (const auto taken = take_unit(known->second, name.unit); !taken) {
                return refuse(quote(cells[i]) + ' ' + taken.error().why);
            }
        }
        for (const char* wanted : {"t", "x", "y"}) {
            if (!found_.contains(wanted)) return missing(wanted);
        }
        if (!has_quaternion() && !find("yaw")) return missing("yaw, or qx, qy, qz and qw");
        leave_one_rotation(not_read);
        return {};
    }

    [[nodiscard]] PoseColumns columns(std::size_t count) const {
        PoseColumns all;
        all.time = *find("t");
        all.time_power = power_;
        all.xy = {*find("x"), *find("y")};
        all.z = find("z");
        if (has_quaternion())
            all.quaternion = {{*find("qx"), *find("qy"), *find("qz"), *find("qw")}};
        all.roll = find("roll");
        all.pitch = find("pitch");
        all.yaw = find("yaw");
        all.radians_per_unit = angle_unit_ == "deg" ? std::numbers::pi / 180.0 : 1.0;
        all.least_count = count;
        return all;
    }

  private:
    static tl::unexpected<Fault> missing(const std::string& what) {
        return refuse("the header has no column " + what +
                      "; name the columns of a pose t, x, y, z and qx, qy, qz, qw, or roll, "
                      "pitch, yaw");
    }

    [[nodiscard]] std::optional<Column> find(const char* name) const {
        const auto found = found_.find(name);
        return found == found_.end() ? std::nullopt : std::optional(found->second);
    }

    [[nodiscard]] bool has_quaternion() const {
        return find("qx") && find("qy") && find("qz") && find("qw");
    }

    /// Where there are both a whole quaternion and angles, the quaternion is read.
    void leave_one_rotation(std::vector<std::string>& not_read) {
        const auto is_spare = [spare_quaternion = !has_quaternion()](const std::string& name) {
            const bool is_angle = name == "roll" || name == "pitch" || name == "yaw";
            return spare_quaternion ? name.starts_with('q') : is_angle;
        };
        for (auto column = found_.begin(); column != found_.end();) {
            if (is_spare(column->first)) {
                not_read.push_back(quote(column->second.name));
                column = found_.erase(column);
            } else {
                ++column;
            }
        }
    }

    Expected<> take_unit(const std::string& name, std::string unit) {
        if (name == "t") {
            power_ = time_power(unit);
            if (!power_ && !unit.empty()) return refuse("must be in s, ms, us or ns");
        } else if (name == "x" || name == "y" || name == "z") {
            if (!unit.empty() && unit != "m") return refuse("must be in metres");
        } else if (!name.starts_with('q')) {
            if (unit.empty()) unit = "rad";
            if (unit != "rad" && unit != "deg") return refuse("must be in rad or deg");
            const bool differs = !angle_unit_.empty() && angle_unit_ != unit;
            if (differs) return refuse("must have the unit of the other angles");
            angle_unit_ = unit;
        }
        return {};
    }

    std::map<std::string, Column, std::less<>> found_;
    std::optional<int> power_;
    std::string angle_unit_;
};

}  // namespace

Expected<PoseColumns> named_columns(const std::vector<std::string_view>& cells,
                                    std::vector<std::string>& not_read) {
    Header header;
    return header.read(cells, not_read).map([&] { return header.columns(cells.size()); });
}

}  // namespace scipd::sim
