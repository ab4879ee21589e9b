// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/doors.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include <grp.h>

#include "daemon/config/secret_file.h"
#include "daemon/config/values.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> http_keys{"listen", "token_file"};
constexpr std::array<std::string_view, 2> control_keys{"socket", "group"};
constexpr std::size_t shortest_token = 16;
constexpr std::size_t longest_token = 1024;

bool is_visible(char c) {
    return c > ' ' && c <= '~';
}

sim::Expected<std::string> check_token(const fs::path& file, std::string token) {
    if (token.size() >= shortest_token && token.size() <= longest_token &&
        std::ranges::all_of(token, is_visible)) {
        return token;
    }
    return sim::refuse("the first line of " + sim::quote(file.native(), sim::whole_path) +
                       " must be a token of 16 to 1024 letters, digits and signs of ASCII, "
                       "without spaces; `openssl rand -hex 32` makes one");
}

sim::Expected<std::string> parse_token_file(std::string_view text, const fs::path& base) {
    return parse_file(text, base).and_then([](const fs::path& file) {
        return secret_in(file).and_then(
            [&](std::string token) { return check_token(file, std::move(token)); });
    });
}

sim::Expected<unsigned> parse_group(const std::string& name) {
    std::array<char, 16'384> buffer{};
    group entry{};
    group* found = nullptr;
    ::getgrnam_r(name.c_str(), &entry, buffer.data(), buffer.size(), &found);
    if (found != nullptr) return found->gr_gid;
    return sim::refuse("there is no group " + sim::quote(name) + "; `getent group` lists them");
}

sim::Expected<fs::path> parse_folder(const std::string& text, const fs::path& base) {
    return parse_scene(text, base).and_then([](fs::path folder) -> sim::Expected<fs::path> {
        if (fs::is_directory(folder)) return folder;
        return sim::refuse(sim::quote(folder.native(), sim::whole_path) +
                           " is a file; name its folder");
    });
}

std::string needs_a_token(const Address& address) {
    return "other machines reach " + text_of(address) +
           ": in a configuration, http: {listen: ADDRESS:PORT, token_file: FILE} lets in who has "
           "the token; or use 127.0.0.1";
}

}  // namespace

sim::Expected<std::optional<Address>> parse_http(std::string_view text) {
    auto listen = parse_listener(text);
    if (listen && *listen && !is_loopback(**listen)) return sim::refuse(needs_a_token(**listen));
    return listen;
}

void read_http(const sim::YamlField& field, const fs::path& base, Config& config,
               sim::YamlFaults& faults) {
    if (!field.value.IsMap()) {
        return faults.take(field, sim::text_of(field.value).and_then(parse_http), config.http);
    }
    const sim::YamlSection section{field, http_keys, faults};
    const sim::YamlField* const listen = section.find("listen");
    if (!listen) return faults.add(field, "needs listen: ADDRESS:PORT");
    section.read("listen", config.http, parse_listener);
    section.read("token_file", config.http_token,
                 [&](const std::string& text) { return parse_token_file(text, base); });
    if (config.http && !is_loopback(*config.http) && !section.find("token_file"))
        faults.add(*listen, needs_a_token(*config.http));
}

void read_control(const sim::YamlField& field, const fs::path& base, Config& config,
                  sim::YamlFaults& faults) {
    const auto parse = [&](const std::string& text) { return parse_socket(text, base); };
    if (!field.value.IsMap()) {
        return faults.take(field, sim::text_of(field.value).and_then(parse), config.control);
    }
    const sim::YamlSection section{field, control_keys, faults};
    section.read("socket", config.control, parse);
    section.read("group", config.control_group, parse_group);
}

void read_allow(const sim::YamlField& field, const fs::path& base, Config& config,
                sim::YamlFaults& faults) {
    if (!field.value.IsSequence())
        return faults.add(field, "must be a list of folders, such as [worlds]");
    config.allow.clear();
    for (const YAML::Node& item : field.value) {
        fs::path& folder = config.allow.emplace_back();
        const auto parse = [&](const std::string& text) { return parse_folder(text, base); };
        faults.take(field, sim::text_of(item).and_then(parse), folder);
    }
}

}  // namespace scipd::daemon
