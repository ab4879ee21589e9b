// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Sectors of a scan: what is on the window, or shines into it.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "daemon/config/numbers.h"
#include "daemon/device/device.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_values.h"

namespace scipd::daemon {
namespace {

using sim::Cause;
using sim::Reading;

/// Dirt on the window is as near as the housing.
constexpr float window_m = 0.03F;

sim::Expected<int> parse_step(std::string_view text) {
    return parse_whole(text, 0, 100'000);
}

/// Effects on a sector of steps, both ends included; without one, on all.
struct Sector {
    std::vector<int> steps;

    [[nodiscard]] bool has(int step) const {
        return steps.empty() || (step >= steps[0] && step <= steps[1]);
    }
};

void check_sector(const Sector& sector, const sim::YamlField& fault, sim::YamlFaults& faults,
                  bool needed) {
    if (sector.steps.empty() && !needed) return;
    if (sector.steps.size() != 2 || sector.steps[0] > sector.steps[1])
        faults.add(fault, "needs steps: the first and the last, such as [400, 500]");
}

/// Tells whoever has taken the steps of another model.
void begin_sector(const Sector& sector, FaultScene& scene) {
    const sim::SensorSpec& optics = scene.device().optics();
    if (sector.steps.empty()) return;
    if (sector.steps[1] >= optics.first_step && sector.steps[0] <= optics.last_step) return;
    scene.touched({.what = "nothing is changed: the scanner measures the steps from " +
                           std::to_string(optics.first_step) + " to " +
                           std::to_string(optics.last_step)});
}

/// Puts one reading into the place of all of a beam.
template <class Change>
void change_sector(sim::Scan& scan, const sim::SensorSpec& optics, const Sector& sector,
                   FaultScene& scene, const std::string& what, Change change) {
    FaultTouch touch{.what = what};
    sim::PerBeam<Reading> echoes;
    for (std::size_t beam = 0; beam < scan.readings.size(); ++beam) {
        const int step = optics.first_step + static_cast<int>(beam);
        const bool changed = sector.has(step) && change(step, scan.readings[beam]);
        if (changed) touch.steps.push_back(step);
        if (scan.every_echo.empty()) continue;
        if (changed) {
            echoes.add(scan.readings[beam]);
        } else {
            for (const Reading& echo : scan.every_echo[beam])
                echoes.add(echo);
        }
        echoes.finish_beam();
    }
    scan.every_echo = std::move(echoes);
    if (!touch.steps.empty()) scene.touched(std::move(touch));
}

class DirtyWindow : public FaultEffect {
  public:
    enum class Reads { near, weak, nothing };
    static constexpr std::pair<std::string_view, Reads> all_reads[] = {
        {"near", Reads::near}, {"weak", Reads::weak}, {"nothing", Reads::nothing}};
    struct Members : Sector {
        Reads reads = Reads::near;
    };
    static constexpr Member<Members> members[] = {
        {"steps", read_list<&Members::steps, parse_step>},
        {"reads", read_as<&Members::reads, parse_word<all_reads>>},
    };
    static void check(const Members& read, const sim::YamlField& fault, sim::YamlFaults& faults) {
        check_sector(read, fault, faults, true);
    }

    explicit DirtyWindow(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override { begin_sector(members_, scene); }
    void read(sim::Scan& scan, const sim::SensorSpec& optics, FaultScene& scene) override {
        change_sector(scan, optics, members_, scene, "the window is dirty",
                      [&](int, Reading& reading) {
                          reading = read_through_dirt(reading);
                          return true;
                      });
    }

  private:
    [[nodiscard]] Reading read_through_dirt(const Reading& clean) const {
        if (members_.reads == Reads::near)
            return {.range_m = window_m,
                    .signal = clean.signal,
                    .intensity = clean.intensity,
                    .cause = Cause::measured};
        return {.cause = members_.reads == Reads::weak ? Cause::too_dark : Cause::nothing};
    }

    Members members_;
};

class BlindSector : public FaultEffect {
  public:
    struct Members : Sector {};
    static constexpr Member<Members> members[] = {
        {"steps", read_list<&Members::steps, parse_step>},
    };
    static void check(const Members& read, const sim::YamlField& fault, sim::YamlFaults& faults) {
        check_sector(read, fault, faults, true);
    }

    explicit BlindSector(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override { begin_sector(members_, scene); }
    void read(sim::Scan& scan, const sim::SensorSpec& optics, FaultScene& scene) override {
        change_sector(scan, optics, members_, scene, "the sector is blind",
                      [](int, Reading& reading) {
                          reading = {};
                          return true;
                      });
    }

  private:
    Members members_;
};

/// Other light: here and there a range that is anywhere.
class Salt : public FaultEffect {
  public:
    struct Members : Sector {
        double rate = 0.01;
    };
    static constexpr Member<Members> members[] = {
        {"steps", read_list<&Members::steps, parse_step>},
        {"rate", read_as<&Members::rate, parse_share>},
    };
    static void check(const Members& read, const sim::YamlField& fault, sim::YamlFaults& faults) {
        check_sector(read, fault, faults, false);
    }

    explicit Salt(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override { begin_sector(members_, scene); }
    void read(sim::Scan& scan, const sim::SensorSpec& optics, FaultScene& scene) override {
        change_sector(
            scan, optics, members_, scene, "other light is read", [&](int step, Reading& reading) {
                const auto n = 2 * static_cast<std::uint32_t>(step);
                if (scene.chance(n) >= members_.rate) return false;
                reading.range_m = static_cast<float>(scene.chance(n + 1) * optics.max_range_m);
                reading.cause = Cause::measured;
                return true;
            });
    }

  private:
    Members members_;
};

/// A sector reads one range, whatever is there: the given one, or that of the first scan.
class StuckSector : public FaultEffect {
  public:
    struct Members : Sector {
        std::optional<double> range_m;
    };
    static constexpr Member<Members> members[] = {
        {"steps", read_list<&Members::steps, parse_step>},
        {"range_m", read_as<&Members::range_m, parse_length>},
    };
    static void check(const Members& read, const sim::YamlField& fault, sim::YamlFaults& faults) {
        check_sector(read, fault, faults, true);
    }

    explicit StuckSector(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override { begin_sector(members_, scene); }
    void read(sim::Scan& scan, const sim::SensorSpec& optics, FaultScene& scene) override {
        if (first_.empty()) first_ = scan.readings;
        change_sector(scan, optics, members_, scene, "the readings are stuck",
                      [&](int step, Reading& reading) {
                          reading = first_[static_cast<std::size_t>(step - optics.first_step)];
                          if (!members_.range_m) return true;
                          reading.range_m = static_cast<float>(*members_.range_m);
                          reading.cause = Cause::measured;
                          return true;
                      });
    }

  private:
    Members members_;
    std::vector<Reading> first_;
};

}  // namespace

std::span<const FaultKind> window_kinds() {
    static constexpr FaultKind kinds[] = {
        kind_of<DirtyWindow>("dirty", "scans", "dirt on the window covers a sector"),
        kind_of<BlindSector>("blind", "scans", "a sector sees nothing"),
        kind_of<Salt>("interference", "scans", "other light is read here and there"),
        kind_of<StuckSector>("stick", "scans", "a sector reads one range all the time"),
    };
    return kinds;
}

}  // namespace scipd::daemon
