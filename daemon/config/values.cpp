// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/values.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <vector>

#include <arpa/inet.h>
#include <sys/un.h>

#include "daemon/config/numbers.h"
#include "daemon/models/model_registry.h"
#include "sim/backends/registry.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/text/likely_unit.h"
#include "sim/text/name.h"
#include "sim/text/quote.h"

namespace scipd::daemon {

using sim::Expected;

namespace {

namespace fs = std::filesystem;

using sim::quote;
using sim::refuse;

constexpr int most_poses_per_sweep = 100'000;

std::vector<std::string_view> split_at_commas(std::string_view text) {
    std::vector<std::string_view> parts;
    for (;;) {
        const auto comma = text.find(',');
        parts.push_back(text.substr(0, comma));
        if (comma == text.npos) return parts;
        text.remove_prefix(comma + 1);
    }
}

/// Whether this number of X,Y,YAW or of X,Y,Z,ROLL,PITCH,YAW is an angle.
bool is_angle(std::size_t index, std::size_t count) {
    return index + 1 == count || index >= 3;
}

bool is_legal_in_names(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
}

/// The numeric form of what stands before the port, or nothing.
std::optional<std::string> numeric_host(std::string_view text) {
    if (text == "localhost") return "127.0.0.1";
    const bool bracketed = text.size() > 2 && text.front() == '[' && text.back() == ']';
    std::string host{bracketed ? text.substr(1, text.size() - 2) : text};
    if (host.find('\0') != host.npos) return {};
    in6_addr address{};
    if (inet_pton(bracketed ? AF_INET6 : AF_INET, host.c_str(), &address) != 1) return {};
    return host;
}

Expected<fs::path> absolute_path(std::string_view text, const fs::path& base) {
    if (text.empty()) return refuse("must be a path, not empty");
    if (text.find('\0') != text.npos) return refuse("must be a path, not " + quote(text));
    return (fs::absolute(base) / fs::path{text}).lexically_normal();
}

}  // namespace

Expected<std::string> parse_name(std::string_view text) {
    const bool legal = !text.empty() && text.size() <= sim::longest_name && text.front() != '.' &&
                       std::all_of(text.begin(), text.end(), is_legal_in_names);
    if (!legal) {
        return refuse(
            quote(text) +
            " is no name: use up to 64 letters, digits, _ - and ., not beginning with a dot");
    }
    return std::string{text};
}

Expected<Model> parse_model(std::string_view text) {
    return model_named(text);
}

Expected<std::string> parse_backend(std::string_view text) {
    if (text == auto_backend || sim::find_backend(text) != nullptr) return std::string{text};
    std::string choices{auto_backend};
    for (const sim::BackendRow& backend : sim::backends())
        choices += ", " + std::string{backend.name};
    return refuse("this build has no backend " + quote(text) + "; use " + choices);
}

Expected<sim::BetweenPixels> parse_between_pixels(std::string_view text) {
    if (text == "nearest") return sim::BetweenPixels::nearest;
    if (text == "interpolate") return sim::BetweenPixels::interpolate;
    if (text == "exact") return sim::BetweenPixels::exact;
    return refuse("must be nearest, interpolate or exact, not " + quote(text));
}

Expected<sim::Accuracy> parse_accuracy(std::string_view text) {
    if (text == "ideal") return sim::Accuracy::ideal;
    if (text == "sensor") return sim::Accuracy::sensor;
    if (text == "material") return sim::Accuracy::material;
    return refuse("must be ideal, sensor or material, not " + quote(text));
}

std::string_view name_of(sim::Accuracy accuracy) {
    switch (accuracy) {
        case sim::Accuracy::ideal:
            return "ideal";
        case sim::Accuracy::sensor:
            return "sensor";
        case sim::Accuracy::material:
            break;
    }
    return "material";
}

Expected<sim::EchoChoice> parse_echo_choice(std::string_view text) {
    if (text == "first") return sim::EchoChoice::first;
    if (text == "strongest") return sim::EchoChoice::strongest;
    if (text == "last") return sim::EchoChoice::last;
    return refuse("must be first, strongest or last, not " + quote(text));
}

Expected<Timing> parse_timing(std::string_view text) {
    if (text == "real") return Timing::real;
    if (text == "ideal") return Timing::ideal;
    return refuse("must be real or ideal, not " + quote(text));
}

Expected<PowerUp> parse_power_up(std::string_view text) {
    if (text == "scip2.0") return PowerUp::scip2;
    if (text == "scip1.1") return PowerUp::scip1;
    if (text == "boot") return PowerUp::boot;
    return refuse("must be scip2.0, scip1.1 or boot, not " + quote(text));
}

Expected<bool> parse_on_close(std::string_view text) {
    if (text == "keep" || text == "stop") return text == "stop";
    return refuse("must be keep or stop, not " + quote(text));
}

Expected<std::optional<int>> parse_motion(std::string_view text) {
    if (text == "beam") return std::nullopt;
    const auto poses = parse_integer<int>(text);
    if (!poses || *poses < 1 || *poses > most_poses_per_sweep) {
        return refuse("must be beam or a number of poses per sweep, 1 to 100000, not " +
                      quote(text));
    }
    return poses;
}

Expected<std::uint64_t> parse_seed(std::string_view text) {
    const auto seed = parse_integer<std::uint64_t>(text);
    if (!seed) {
        return refuse("must be a whole number from 0 to 18446744073709551615, not " + quote(text));
    }
    return *seed;
}

Expected<std::pair<std::string, std::string>> parse_xacro_argument(std::string_view text) {
    constexpr std::string_view is = ":=";
    const auto at = text.find(is);
    if (at == text.npos || at == 0)
        return refuse("must be NAME:=VALUE, such as lidar_angle:=40, not " + quote(text));
    // The program ignores an argument whose value is empty, and fails if there is a second :=.
    const std::string_view value = text.substr(at + is.size());
    if (value.find_first_not_of(' ') == value.npos || value.find(is) != value.npos)
        return refuse("must have a value, which has no := in it");
    return std::pair{std::string(text.substr(0, at)), std::string(value)};
}

Expected<sim::SdfGeometry> parse_geometry(std::string_view text) {
    if (text == "visual") return sim::SdfGeometry::visual;
    if (text == "collision") return sim::SdfGeometry::collision;
    return refuse("must be visual or collision, not " + quote(text));
}

Expected<bool> parse_switch(std::string_view text) {
    if (text == "true" || text == "false") return text == "true";
    return refuse("must be true or false, not " + quote(text));
}

Expected<ClockKind> parse_clock(std::string_view text) {
    if (text == "wall") return ClockKind::wall;
    if (text == "poses") return ClockKind::poses;
    return refuse("must be wall or poses, not " + quote(text));
}

Expected<sim::Pose> parse_pose(std::string_view text) {
    const auto parts = split_at_commas(text);
    if (parts.size() != 3 && parts.size() != 6)
        return refuse("must be X,Y,YAW or X,Y,Z,ROLL,PITCH,YAW, not " + quote(text));
    std::array<double, 6> numbers{};  // X, Y, Z, ROLL, PITCH, YAW
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto number =
            is_angle(i, parts.size()) ? parse_radians(parts[i]) : parse_metres(parts[i]);
        if (!number) return tl::unexpected(number.error());
        numbers[i + 1 == parts.size() ? 5 : i] = *number;
    }
    const auto& [x_m, y_m, z_m, roll_rad, pitch_rad, yaw_rad] = numbers;
    return sim::pose_from_rpy({x_m, y_m, z_m}, {roll_rad, pitch_rad, yaw_rad});
}

std::optional<std::string> degrees_in_pose(std::string_view text) {
    const auto parts = split_at_commas(text);
    std::vector<double> angles_rad;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!is_angle(i, parts.size())) continue;
        if (const auto angle_rad = parse_radians(parts[i])) angles_rad.push_back(*angle_rad);
    }
    return sim::degrees_for_radians(angles_rad);
}

Expected<Address> parse_address(std::string_view text) {
    const auto colon = text.rfind(':');
    const auto host = numeric_host(text.substr(0, colon));
    const auto port =
        colon == text.npos ? std::nullopt : parse_integer<std::uint16_t>(text.substr(colon + 1));
    if (!host || !port) {
        return refuse(
            "must be ADDRESS:PORT such as 127.0.0.1:10940, [::1]:10940 or localhost:0, not " +
            quote(text));
    }
    return Address{*host, *port};
}

Expected<std::optional<Address>> parse_listener(std::string_view text) {
    if (text == "none") return std::nullopt;
    return parse_address(text);
}

Expected<std::optional<PtyConfig>> parse_pty(std::string_view text, const fs::path& base) {
    if (text == "none") return std::nullopt;
    if (text == "auto") return PtyConfig{};
    return absolute_path(text, base).map([](const fs::path& link) { return PtyConfig{link}; });
}

Expected<fs::path> parse_file(std::string_view text, const fs::path& base) {
    auto file = absolute_path(text, base);
    if (!file) return file;
    std::error_code error;
    const std::string named = quote(file->native(), sim::whole_path);
    if (!fs::exists(*file, error)) return refuse("there is no file " + named);
    const auto plain = sim::check_plain_file(*file);
    if (!plain) return refuse(named + ' ' + plain.error().why + "; name a file");
    return file;
}

Expected<fs::path> parse_scene(std::string_view text, const fs::path& base) {
    auto folder = absolute_path(text, base);
    std::error_code error;
    const bool is_folder = folder && fs::is_directory(*folder, error);
    return is_folder ? folder : parse_file(text, base);
}

Expected<fs::path> parse_socket(std::string_view text, const fs::path& base) {
    auto path = absolute_path(text, base);
    if (path && path->native().size() >= sizeof(sockaddr_un::sun_path)) {
        return refuse("must be shorter: a socket's path has at most 107 bytes, this has " +
                      std::to_string(path->native().size()));
    }
    return path;
}

}  // namespace scipd::daemon
