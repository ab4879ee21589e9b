// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A place for one effect to act in, without an injector; and an effect from what a user writes.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "daemon/faults/fault_kind.h"
#include "sim/loaders/file/load_error.h"
#include "sim/random.h"

namespace scipd::daemon {

class FakeScene : public FaultScene {
  public:
    explicit FakeScene(std::uint64_t seed = 1, Device* device = nullptr,
                       std::vector<Port*> ports = {})
        : key_{.seed = seed}, device_(device), ports_(std::move(ports)) {}

    [[nodiscard]] Device& device() override { return *device_; }
    void boot() override { ++boots; }
    [[nodiscard]] std::span<Port* const> ports() override { return ports_; }
    [[nodiscard]] std::int64_t scan() const override {
        return static_cast<std::int64_t>(key_.scan);
    }
    [[nodiscard]] double chance(std::uint32_t n) const override {
        return (sim::Chance(key_).even(n) + 1.0) / 2.0;
    }
    [[nodiscard]] protocol::Uptime stamped() const override { return {}; }
    void touched(FaultTouch touch) override { touches.push_back(std::move(touch)); }

    /// The next message is under way.
    void go_on() { ++key_.scan; }

    std::vector<FaultTouch> touches;
    int boots = 0;

  private:
    sim::ChanceKey key_;
    Device* device_;
    std::vector<Port*> ports_;
};

/// `members`: a map in YAML. Throws sim::LoadError with what is wrong.
inline std::unique_ptr<FaultEffect> effect_of(const std::string& kind, const std::string& members) {
    sim::YamlFaults faults("test");
    const sim::YamlField fault{.key = {}, .path = {}, .line = 1, .value = YAML::Load(members)};
    const FaultKind* const row = find_fault_kind(kind);
    if (!row) throw std::logic_error("there is no " + kind);
    std::vector<std::string_view> keys = row->keys();
    keys.insert(keys.end(), {"for", "until"});
    const sim::YamlSection section(fault, keys, faults);
    const MakeEffect make = row->read(fault, section, faults);
    faults.throw_if_any();
    return make();
}

/// What is wrong with these members.
inline std::string refusal(const std::string& kind, const std::string& members) {
    try {
        (void)effect_of(kind, members);
    } catch (const sim::LoadError& error) {
        return error.what();
    }
    return "none";
}

}  // namespace scipd::daemon
