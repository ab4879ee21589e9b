// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whole scans that are missing, late, old or displaced.
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "daemon/config/numbers.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_values.h"

namespace scipd::daemon {
namespace {

/// Every scan reads what the first one read.
class FrozenScans : public FaultEffect {
  public:
    using Members = NoMembers;
    static constexpr auto& members = no_members;
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit FrozenScans(const Members&) {}

    void read(sim::Scan& scan, const sim::SensorSpec&, FaultScene& scene) override {
        if (!first_) {
            first_ = {scan.readings, scan.every_echo};
        } else {
            scan.readings = first_->readings;
            scan.every_echo = first_->every_echo;
        }
        scene.touched({.what = "the readings are those of the first scan"});
    }

  private:
    struct Readings {
        std::vector<sim::Reading> readings;
        sim::PerBeam<sim::Reading> every_echo;
    };
    std::optional<Readings> first_;
};

class MissingScans : public FaultEffect {
  public:
    struct Members {
        double rate = 1.0;
    };
    static constexpr Member<Members> members[] = {
        {"rate", read_as<&Members::rate, parse_share>},
    };
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit MissingScans(const Members& members) : members_(members) {}

    bool serves(FaultScene& scene) override {
        if (scene.chance(0) >= members_.rate) return true;
        if (std::exchange(last_told_, scene.scan()) != scene.scan())
            scene.touched({.what = "the scan is missing"});
        return false;
    }

  private:
    Members members_;
    std::int64_t last_told_ = -1;
};

class LateScans : public FaultEffect {
  public:
    struct Members {
        sim::Time late{};
    };
    static constexpr Member<Members> members[] = {
        {"ms", read_as<&Members::late, parse_wait>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        if (members.late <= sim::Time::zero())
            faults.add(fault, "needs ms: how much later scans leave");
    }

    explicit LateScans(const Members& members) : members_(members) {}

    [[nodiscard]] sim::Time late() const override { return members_.late; }
    bool serves(FaultScene& scene) override {
        if (std::exchange(last_told_, scene.scan()) != scene.scan())
            scene.touched({.what = "the scan leaves late"});
        return true;
    }

  private:
    Members members_;
    std::int64_t last_told_ = -1;
};

/// The encoder has lost count: what stands at a step was measured at another one.
class ShiftedScans : public FaultEffect {
  public:
    struct Members {
        int by = 0;
    };
    static sim::Expected<int> parse_by(std::string_view text) {
        return parse_whole(text, -10'000, 10'000);
    }
    static constexpr Member<Members> members[] = {
        {"by", read_as<&Members::by, parse_by>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        if (members.by == 0) faults.add(fault, "needs by: how many steps, not 0");
    }

    explicit ShiftedScans(const Members& members) : members_(members) {}

    void read(sim::Scan& scan, const sim::SensorSpec&, FaultScene& scene) override {
        const sim::Scan before = scan;
        const auto beams = static_cast<std::int64_t>(before.readings.size());
        const auto from = [&](std::int64_t beam) {
            return static_cast<std::size_t>(((beam - members_.by) % beams + beams) % beams);
        };
        scan.every_echo = {};
        for (std::int64_t beam = 0; beam < beams; ++beam) {
            scan.readings[static_cast<std::size_t>(beam)] = before.readings[from(beam)];
            if (before.every_echo.empty()) continue;
            for (const sim::Reading& echo : before.every_echo[from(beam)])
                scan.every_echo.add(echo);
            scan.every_echo.finish_beam();
        }
        scene.touched(
            {.what = "the readings stand " + std::to_string(members_.by) + " steps farther on"});
    }

  private:
    Members members_;
};

/// As with drivers that take intensity for broken after one wrong sum: here it is.
class NoIntensity : public FaultEffect {
  public:
    using Members = NoMembers;
    static constexpr auto& members = no_members;
    static void check(const Members&, const sim::YamlField&, sim::YamlFaults&) {}

    explicit NoIntensity(const Members&) {}

    void read(sim::Scan& scan, const sim::SensorSpec&, FaultScene& scene) override {
        for (sim::Reading& reading : scan.readings)
            reading.intensity = 0.0F;
        sim::PerBeam<sim::Reading> dark;
        for (std::size_t beam = 0; beam < scan.every_echo.beams(); ++beam) {
            for (sim::Reading echo : scan.every_echo[beam]) {
                echo.intensity = 0.0F;
                dark.add(echo);
            }
            dark.finish_beam();
        }
        scan.every_echo = std::move(dark);
        scene.touched({.what = "all intensities are 0"});
    }
};

}  // namespace

std::span<const FaultKind> scan_kinds() {
    static constexpr FaultKind kinds[] = {
        kind_of<FrozenScans>("freeze", "scans", "every scan has the readings of the first one"),
        kind_of<MissingScans>("skip", "scans", "scans are missing"),
        kind_of<LateScans>("late", "scans", "scans leave late"),
        kind_of<ShiftedScans>("shift", "scans", "readings stand at other steps"),
        kind_of<NoIntensity>("intensity", "scans", "all intensities are 0"),
    };
    return kinds;
}

}  // namespace scipd::daemon
