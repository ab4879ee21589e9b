// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/topics.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <random>

#include <unistd.h>

namespace scipd::daemon {
namespace {

struct Row {
    Topic::Kind kind;
    std::string_view word;
    bool has_name;
};

constexpr std::array<Row, 8> rows{{{Topic::Kind::poses, "poses", false},
                                   {Topic::Kind::places, "places", true},
                                   {Topic::Kind::model, "models", true},
                                   {Topic::Kind::scene, "scene", false},
                                   {Topic::Kind::daemon, "daemons", true},
                                   {Topic::Kind::marker, "markers", true},
                                   {Topic::Kind::time, "time", false},
                                   {Topic::Kind::ack, "acks", true}}};

const Row& row_of(Topic::Kind kind) {
    return *std::ranges::find(rows, kind, &Row::kind);
}

bool stays(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == ':';
}

std::string escaped(std::string_view name) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string text;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (stays(c)) {
            text += c;
        } else {
            text += {'%', digits[byte / 16U], digits[byte % 16U]};
        }
    }
    return text;
}

std::optional<std::string> unescaped(std::string_view text) {
    std::string name;
    while (!text.empty()) {
        if (stays(text.front())) {
            name += text.front();
            text.remove_prefix(1);
            continue;
        }
        unsigned char byte = 0;
        const bool whole = text.size() >= 3 && text.front() == '%';
        if (!whole) return std::nullopt;
        const char* const end = text.data() + 3;
        if (std::from_chars(text.data() + 1, end, byte, 16).ptr != end) return std::nullopt;
        name += static_cast<char>(byte);
        text.remove_prefix(3);
    }
    return name;
}

}  // namespace

std::string Topics::of(Topic::Kind kind, std::string_view name) const {
    const Row& row = row_of(kind);
    std::string text = root_ + std::string(row.word);
    return row.has_name ? text + "/" + escaped(name) : text;
}

std::string Topics::all(Topic::Kind kind) const {
    const Row& row = row_of(kind);
    return root_ + std::string(row.word) + (row.has_name ? "/+" : "");
}

std::optional<Topic> Topics::read(std::string_view topic) const {
    if (!topic.starts_with(root_)) return std::nullopt;
    topic.remove_prefix(root_.size());
    const auto slash = topic.find('/');
    const auto row = std::ranges::find(rows, topic.substr(0, slash), &Row::word);
    if (row == rows.end() || row->has_name != (slash != topic.npos)) return std::nullopt;
    if (!row->has_name) return Topic{row->kind, {}};
    const auto name = unescaped(topic.substr(slash + 1));
    if (!name || name->empty()) return std::nullopt;
    return Topic{row->kind, *name};
}

std::string host_name() {
    std::array<char, 65> name{};
    if (::gethostname(name.data(), name.size() - 1) != 0) return "host";
    return name.data();
}

std::string usual_name() {
    return host_name() + "-" + std::to_string(::getpid());
}

std::string new_instance() {
    std::random_device chance;
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x%08x", chance(), chance());
    return digits.data();
}

}  // namespace scipd::daemon
