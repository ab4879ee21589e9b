// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <nlohmann/json.hpp>

#include "tools/scipcat/check/check_report.h"

namespace scipd::tools::checks {
namespace {

using Json = nlohmann::ordered_json;

/// Programs know four verdicts: a check that was skipped is one that does not apply.
std::string_view verdict_of(const Finding& finding) {
    const bool skipped = finding.verdict == Verdict::skipped;
    return name_of(skipped ? Verdict::not_applicable : finding.verdict);
}

Json json_of(const Result& result) {
    return {{"id", result.check->id},
            {"name", result.check->title},
            {"source", result.check->source},
            {"verdict", verdict_of(result.finding)},
            {"why", result.finding.why},
            {"sent", result.sent},
            {"got", result.got}};
}

}  // namespace

std::string as_json(const CheckReport& report) {
    Json device = {{"target", report.target}};
    for (const auto& [key, name] : {std::pair{"MODL", "model"},
                                    {"PROD", "product"},
                                    {"VEND", "vendor"},
                                    {"FIRM", "firmware"},
                                    {"PROT", "protocol"},
                                    {"SERI", "serial"}})
        device[name] = report.facts.text(key);
    Json checks = Json::array();
    for (const Result& result : report.results)
        checks.push_back(json_of(result));
    Json document = {{"device", device}, {"checks", checks}, {"nearest", nullptr}};
    if (const auto& nearest = report.nearest)
        document["nearest"] = {
            {"model", nearest->model}, {"alike", nearest->alike}, {"of", nearest->of}};
    document["failed"] = report.count(Verdict::fail);
    return document.dump(2, ' ', true, Json::error_handler_t::replace) + "\n";
}

}  // namespace scipd::tools::checks
