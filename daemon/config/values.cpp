// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/values.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <arpa/inet.h>
#include <sys/un.h>

#include "daemon/config/numbers.h"
#include "daemon/models/registry.h"
#include "sim/backends/registry.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/text/name.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

using sim::quote;

constexpr int most_poses_per_sweep = 100'000;

[[noreturn]] void refuse(const std::string& sentence) {
    throw std::invalid_argument(sentence);
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
    std::vector<std::string_view> parts;
    for (;;) {
        const auto comma = text.find(',');
        parts.push_back(text.substr(0, comma));
        if (comma == text.npos) return parts;
        text.remove_prefix(comma + 1);
    }
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

fs::path absolute_path(std::string_view text, const fs::path& base) {
    if (text.empty()) refuse("must be a path, not empty");
    if (text.find('\0') != text.npos) refuse("must be a path, not " + quote(text));
    return (fs::absolute(base) / fs::path{text}).lexically_normal();
}

}  // namespace

std::string parse_name(std::string_view text) {
    const bool legal = !text.empty() && text.size() <= sim::longest_name && text.front() != '.' &&
                       std::all_of(text.begin(), text.end(), is_legal_in_names);
    if (!legal) {
        refuse(quote(text) +
               " is no name: use up to 64 letters, digits, _ - and ., not beginning with a dot");
    }
    return std::string{text};
}

Model parse_model(std::string_view text) {
    return find_model(text);
}

std::string parse_backend(std::string_view text) {
    if (text == auto_backend || sim::find_backend(text) != nullptr) return std::string{text};
    std::string choices{auto_backend};
    for (const sim::BackendRow& backend : sim::backends())
        choices += ", " + std::string{backend.name};
    refuse("this build has no backend " + quote(text) + "; use " + choices);
}

sim::BetweenPixels parse_between_pixels(std::string_view text) {
    if (text == "nearest") return sim::BetweenPixels::nearest;
    if (text == "interpolate") return sim::BetweenPixels::interpolate;
    if (text == "exact") return sim::BetweenPixels::exact;
    refuse("must be nearest, interpolate or exact, not " + quote(text));
}

sim::Accuracy parse_accuracy(std::string_view text) {
    if (text == "ideal") return sim::Accuracy::ideal;
    if (text == "sensor") return sim::Accuracy::sensor;
    if (text == "material") refuse("material is not built yet; use sensor or ideal");
    refuse("must be sensor or ideal, not " + quote(text));
}

Timing parse_timing(std::string_view text) {
    if (text == "real") return Timing::real;
    if (text == "ideal") return Timing::ideal;
    refuse("must be real or ideal, not " + quote(text));
}

PowerUp parse_power_up(std::string_view text) {
    if (text == "scip2.0") return PowerUp::scip2;
    if (text == "scip1.1") return PowerUp::scip1;
    if (text == "boot") return PowerUp::boot;
    refuse("must be scip2.0, scip1.1 or boot, not " + quote(text));
}

bool parse_on_close(std::string_view text) {
    if (text == "keep" || text == "stop") return text == "stop";
    refuse("must be keep or stop, not " + quote(text));
}

std::optional<int> parse_motion(std::string_view text) {
    if (text == "beam") return {};
    const auto poses = parse_integer<int>(text);
    if (!poses || *poses < 1 || *poses > most_poses_per_sweep) {
        refuse("must be beam or a number of poses per sweep, 1 to 100000, not " + quote(text));
    }
    return poses;
}

std::uint64_t parse_seed(std::string_view text) {
    const auto seed = parse_integer<std::uint64_t>(text);
    if (!seed) {
        refuse("must be a whole number from 0 to 18446744073709551615, not " + quote(text));
    }
    return *seed;
}

sim::SdfGeometry parse_geometry(std::string_view text) {
    if (text == "visual") return sim::SdfGeometry::visual;
    if (text == "collision") return sim::SdfGeometry::collision;
    refuse("must be visual or collision, not " + quote(text));
}

bool parse_switch(std::string_view text) {
    if (text == "true" || text == "false") return text == "true";
    refuse("must be true or false, not " + quote(text));
}

ClockKind parse_clock(std::string_view text) {
    if (text == "wall") return ClockKind::wall;
    if (text == "poses") return ClockKind::poses;
    refuse("must be wall or poses, not " + quote(text));
}

sim::Pose parse_pose(std::string_view text) {
    const auto parts = split_at_commas(text);
    if (parts.size() != 3 && parts.size() != 6) {
        refuse("must be X,Y,YAW or X,Y,Z,ROLL,PITCH,YAW, not " + quote(text));
    }
    const double x_m = parse_metres(parts[0]);
    const double y_m = parse_metres(parts[1]);
    if (parts.size() == 3) {
        return sim::pose_from_rpy({x_m, y_m, 0.0}, {0.0, 0.0, parse_radians(parts[2])});
    }
    return sim::pose_from_rpy(
        {x_m, y_m, parse_metres(parts[2])},
        {parse_radians(parts[3]), parse_radians(parts[4]), parse_radians(parts[5])});
}

Address parse_address(std::string_view text) {
    const auto colon = text.rfind(':');
    const auto host = numeric_host(text.substr(0, colon));
    const auto port =
        colon == text.npos ? std::nullopt : parse_integer<std::uint16_t>(text.substr(colon + 1));
    if (!host || !port) {
        refuse("must be ADDRESS:PORT such as 127.0.0.1:10940, [::1]:10940 or localhost:0, not " +
               quote(text));
    }
    return {*host, *port};
}

std::optional<Address> parse_listener(std::string_view text) {
    if (text == "none") return {};
    return parse_address(text);
}

std::optional<PtyConfig> parse_pty(std::string_view text, const fs::path& base) {
    if (text == "none") return {};
    if (text == "auto") return PtyConfig{};
    return PtyConfig{absolute_path(text, base)};
}

PoseSource parse_pose_source(std::string_view text, const fs::path& base) {
    using Kind = PoseSource::Kind;
    if (text == "-") return {.kind = Kind::standard_input, .address = {}, .file = {}};
    if (text.starts_with("udp:")) {
        return {.kind = Kind::udp, .address = parse_address(text.substr(4)), .file = {}};
    }
    return {.kind = Kind::file, .address = {}, .file = parse_file(text, base)};
}

fs::path parse_file(std::string_view text, const fs::path& base) {
    auto file = absolute_path(text, base);
    std::error_code error;
    if (!fs::exists(file, error)) refuse("there is no file " + quote(file.native()));
    const auto why = sim::why_no_file(file);
    if (!why.empty()) refuse(quote(file.native()) + ' ' + why + "; name a file");
    return file;
}

fs::path parse_scene(std::string_view text, const fs::path& base) {
    auto folder = absolute_path(text, base);
    std::error_code error;
    return fs::is_directory(folder, error) ? folder : parse_file(text, base);
}

fs::path parse_socket(std::string_view text, const fs::path& base) {
    auto path = absolute_path(text, base);
    if (path.native().size() >= sizeof(sockaddr_un::sun_path)) {
        refuse("must be shorter: a socket's path has at most 107 bytes, this has " +
               std::to_string(path.native().size()));
    }
    return path;
}

}  // namespace scipd::daemon
