// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/scenario.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "daemon/config/values.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/yaml/yaml_section.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

constexpr std::size_t largest_scenario = 1 << 20;
constexpr std::size_t most_steps = 1000;
constexpr std::array<std::string_view, 2> scenario_keys{"seed", "steps"};
constexpr std::array<std::string_view, 1> sensor_key{"sensor"};

bool is_sensor_name(std::string_view text) {
    const auto slash = text.find('/');
    return slash != text.npos && parse_name(text.substr(0, slash)) &&
           parse_name(text.substr(slash + 1));
}

/// Reads one scenario.
class ScenarioReader {
  public:
    ScenarioReader(const std::optional<std::vector<std::string>>& sensors, const FaultKinds& kinds,
                   sim::YamlFaults& faults)
        : kinds_(kinds), faults_(faults) {
        if (sensors) sensors_.emplace(sensors->begin(), sensors->end());
    }

    Scenario read(const YAML::Node& document);

  private:
    std::vector<ScenarioStep> read_steps(const sim::YamlField& list);
    std::optional<ScenarioStep> read_step(const sim::YamlField& map);
    std::string read_sensor(const sim::YamlField& map);
    [[nodiscard]] sim::Expected<std::string> parse_sensor(const std::string& text) const;

    std::optional<std::vector<std::string_view>> sensors_;
    const FaultKinds& kinds_;
    sim::YamlFaults& faults_;
};

Scenario ScenarioReader::read(const YAML::Node& document) {
    const sim::YamlField whole{{}, {}, 1, document};
    const std::size_t before = faults_.count();
    const sim::YamlSection section{whole, scenario_keys, faults_};
    Scenario scenario;
    section.read("seed", scenario.seed, parse_seed);
    if (const sim::YamlField* const steps = section.find("steps")) {
        scenario.steps = read_steps(*steps);
    } else if (faults_.count() == before) {
        faults_.add(whole, "needs steps, a list of faults");
    }
    return scenario;
}

std::vector<ScenarioStep> ScenarioReader::read_steps(const sim::YamlField& list) {
    std::vector<ScenarioStep> steps;
    const bool right = list.value.IsSequence() && list.value.size() >= 1;
    if (!right || list.value.size() > most_steps) {
        faults_.add(list, "must be a list of 1 to 1000 steps");
        return steps;
    }
    for (std::size_t i = 0; i < list.value.size(); ++i) {
        const YAML::Node item = list.value[i];
        auto step =
            read_step({{}, list.path + "." + std::to_string(i + 1), item.Mark().line + 1, item});
        if (step) steps.push_back(*std::move(step));
    }
    return steps;
}

std::optional<ScenarioStep> ScenarioReader::read_step(const sim::YamlField& map) {
    std::string sensor = read_sensor(map);
    auto fault = read_fault(map, sensor_key, faults_, kinds_);
    if (!fault) return std::nullopt;
    return ScenarioStep{std::move(sensor), *std::move(fault)};
}

std::string ScenarioReader::read_sensor(const sim::YamlField& map) {
    std::string sensor;
    if (!map.value.IsMap()) return sensor;
    if (const auto field = sim::entry_of(map, "sensor")) {
        faults_.take(*field, sim::text_of(field->value).and_then([this](const std::string& text) {
            return parse_sensor(text);
        }),
                     sensor);
    } else {
        faults_.add(map, R"(needs a sensor: ROBOT/SENSOR, or "*" for every scanner)");
    }
    return sensor;
}

sim::Expected<std::string> ScenarioReader::parse_sensor(const std::string& text) const {
    if (text == "*") return text;
    if (!sensors_) {
        if (is_sensor_name(text)) return text;
        return sim::refuse(R"(must be ROBOT/SENSOR, or "*" for every scanner, not )" +
                           sim::quote(text));
    }
    if (std::ranges::find(*sensors_, text) != sensors_->end()) return text;
    const std::string refusal = "there is no scanner " + sim::quote(text);
    if (sensors_->empty()) return sim::refuse(refusal + ", nor any other");
    return sim::refuse(refusal + R"(; there are "*" for every one, )" + sim::listed(*sensors_));
}

}  // namespace

bool Scenario::operator==(const Scenario& other) const {
    const auto same = [](const ScenarioStep& a, const ScenarioStep& b) {
        return a.sensor == b.sensor && a.fault.said == b.fault.said;
    };
    return name == other.name && seed == other.seed && std::ranges::equal(steps, other.steps, same);
}

Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::optional<std::vector<std::string>>& sensors,
                        const FaultKinds& kinds) {
    sim::YamlFaults faults{name};
    if (text.size() > largest_scenario) faults.add(1, {}, "larger than 1 MiB; split it");
    faults.throw_if_any();
    Scenario scenario =
        ScenarioReader{sensors, kinds, faults}.read(sim::parse_yaml(text, "a scenario", faults));
    faults.throw_if_any();
    scenario.name = name;
    return scenario;
}

Scenario load_scenario(const std::filesystem::path& file,
                       const std::optional<std::vector<std::string>>& sensors,
                       const FaultKinds& kinds) {
    const auto text = sim::read_file(file, largest_scenario, "name a scenario of at most 1 MiB");
    return parse_scenario(text, file.string(), sensors, kinds);
}

}  // namespace scipd::daemon
