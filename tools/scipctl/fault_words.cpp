// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/fault_words.h"

#include <cstdio>
#include <utility>

#include "tools/member_text.h"
#include "tools/scipctl/names.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;

/// An option such as --at scan=12.
void add_option(Json& fault, const std::string& key, const std::string& text,
                const std::string& examples) {
    if (text.empty()) return;
    auto [name, value] = pair_of(text, examples);
    Json map = Json::object();
    const auto colon = name == "request" ? value.find(':') : std::string::npos;
    if (colon != std::string::npos) {
        map["request"] = value.substr(0, colon);
        map["nth"] = value_of(value.substr(colon + 1));
    } else {
        map[name] = name == "request" ? Json(value) : value_of(value);
    }
    fault[key] = std::move(map);
}

}  // namespace

Json fault_of(const FaultWords& words) {
    Json fault{{"kind", words.kind}};
    for (const std::string& member : words.members)
        add_member(fault, member, "ms=50 or bytes.rate=0.01");
    add_option(fault, "at", words.at, "scan=120, time_s=12.5, scans=40, s=1 or request=MD:2");
    add_option(fault, "for", words.how_long, "scans=40 or s=1");
    if (!words.until.empty()) fault["until"] = words.until;
    add_option(fault, "every", words.every, "s=10 or scans=400");
    add_option(fault, "jitter", words.jitter, "s=2 or scans=80");
    if (!words.seed.empty()) fault["seed"] = value_of(words.seed);
    return fault;
}

std::string line_of(const Json& log_entry) {
    const Json& request = log_entry.at("request");
    char place[64];
    std::snprintf(place, sizeof place, "%5llu  %10.3f s  scan %-6lld",
                  log_entry.at("n").get<unsigned long long>(), log_entry.at("time_s").get<double>(),
                  log_entry.at("scan").get<long long>());
    return place + std::string("  fault ") + log_entry.at("id").dump() + " " +
           log_entry.at("kind").get<std::string>() + ": " +
           log_entry.at("what").get<std::string>() +
           (request.is_null() ? "" : "  (" + request.get<std::string>() + ")");
}

}  // namespace scipd::tools
