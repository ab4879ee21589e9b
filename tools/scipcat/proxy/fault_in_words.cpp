// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <string_view>
#include <variant>

#include <nlohmann/json.hpp>

#include "daemon/faults/fault_kind.h"
#include "daemon/faults/read_fault.h"
#include "sim/text/near_word.h"
#include "sim/text/quote.h"
#include "tools/member_text.h"
#include "tools/options.h"
#include "tools/scipcat/proxy/proxy_faults.h"

namespace scipd::tools {
namespace {

using Json = nlohmann::ordered_json;
using daemon::FaultPlan;

/// At commas that are in no brackets.
std::vector<std::string> parts_of(const std::string& words) {
    std::vector<std::string> parts{""};
    int depth = 0;
    for (const char c : words) {
        depth += (c == '[' || c == '{') - (c == ']' || c == '}');
        if (c == ',' && depth == 0) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

std::vector<std::string_view> names_of_kinds() {
    std::vector<std::string_view> names;
    for (const daemon::FaultKind* const kind : daemon::wire_kinds())
        names.push_back(kind->name);
    return names;
}

std::string no_such_kind(const std::string& kind, const std::vector<std::string_view>& names) {
    const auto near = sim::meant(kind, names);
    return "--fault: " + sim::quote(kind) + " touches neither bytes nor messages" +
           (near ? "; did you mean " + std::string(*near) + "?" : ".") +
           " These do: " + sim::listed(names);
}

/// Why a proxy cannot do it; empty: it can.
std::string beyond_a_proxy(const FaultPlan& plan, const Json& fault) {
    const bool ends_connections = plan.kind->name == "cut" || plan.kind->name == "hangup";
    if (fault.contains("boot") && fault["boot"] != false)
        return "boot: only an emulated scanner boots on purpose";
    if (ends_connections && std::holds_alternative<daemon::ForScans>(plan.end))
        return "for: needs s, since no scans pass meanwhile";
    return "";
}

}  // namespace

FaultPlan fault_in_words(const std::string& words) {
    const auto parts = parts_of(words);
    const std::string& kind = parts.front();
    const auto names = names_of_kinds();
    if (std::ranges::find(names, kind) == names.end()) throw WrongInput(no_such_kind(kind, names));
    Json fault{{"kind", kind}};
    for (std::size_t i = 1; i < parts.size(); ++i)
        add_member(fault, parts[i], "ms=50, bytes.rate=0.01 or for.s=2");
    const auto plan = daemon::parse_fault(fault.dump(), daemon::wire_kinds());
    const std::string why =
        !plan ? plan.error().field + (plan.error().field.empty() ? "" : ": ") + plan.error().why
              : beyond_a_proxy(*plan, fault);
    if (!why.empty()) throw WrongInput("--fault " + kind + ": " + why);
    return *plan;
}

}  // namespace scipd::tools
