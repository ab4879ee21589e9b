// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A sensor that knows wrongly where it is.
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "daemon/config/numbers.h"
#include "daemon/device/device.h"
#include "daemon/device/sweep.h"
#include "daemon/faults/fault_kind.h"
#include "daemon/faults/fault_values.h"

namespace scipd::daemon {
namespace {

class WrongPoses : public FaultEffect {
  public:
    enum class How { unsaid, stop, late, jump };
    static constexpr std::pair<std::string_view, How> hows[] = {
        {"stop", How::stop}, {"late", How::late}, {"jump", How::jump}};
    struct Members {
        How how = How::unsaid;
        sim::Time late{};
        std::vector<double> xyz_m{0.0, 0.0, 0.0};
        std::vector<double> rpy_rad{0.0, 0.0, 0.0};
    };
    static constexpr Member<Members> members[] = {
        {"how", read_as<&Members::how, parse_word<hows>>},
        {"ms", read_as<&Members::late, parse_link_delay>},
        {"xyz", read_list<&Members::xyz_m, parse_metres>},
        {"rpy", read_list<&Members::rpy_rad, parse_radians>},
    };
    static void check(const Members& members, const sim::YamlField& fault,
                      sim::YamlFaults& faults) {
        if (members.how == How::unsaid) faults.add(fault, "needs how: stop, late or jump");
        if (members.how == How::late && members.late <= sim::Time::zero())
            faults.add(fault, "needs ms: how late the poses are");
        if (members.xyz_m.size() != 3) faults.add(fault, "xyz must be three numbers, [X, Y, Z]");
        const auto zero = [](double number) { return number == 0.0; };
        if (members.how == How::jump && std::ranges::all_of(members.xyz_m, zero) &&
            std::ranges::all_of(members.rpy_rad, zero))
            faults.add(fault, "needs xyz or rpy: how far the robot jumps");
        if (members.rpy_rad.size() != 3)
            faults.add(fault, "rpy must be three numbers, [ROLL, PITCH, YAW]");
    }

    explicit WrongPoses(const Members& members) : members_(members) {}

    void begin(FaultScene& scene) override {
        stopped_ = scene.device().world_from_robot();
        scene.touched({.what = "the poses that the sensor is cast from are wrong"});
    }
    void poses(PoseShift& shift) const override {
        if (members_.how == How::stop) shift.stopped = stopped_;
        if (members_.how == How::late) shift.late += members_.late;
        if (members_.how == How::jump) shift.jump = jump() * shift.jump;
    }

  private:
    [[nodiscard]] sim::Pose jump() const {
        const std::vector<double>& xyz_m = members_.xyz_m;
        const std::vector<double>& rpy_rad = members_.rpy_rad;
        return sim::pose_from_rpy({xyz_m[0], xyz_m[1], xyz_m[2]},
                                  {rpy_rad[0], rpy_rad[1], rpy_rad[2]});
    }

    Members members_;
    sim::Pose stopped_;
};

}  // namespace

std::span<const FaultKind> pose_kinds() {
    static constexpr FaultKind kinds[] = {
        kind_of<WrongPoses>("poses", "world", "the robot's poses stop, come late or jump"),
    };
    return kinds;
}

}  // namespace scipd::daemon
