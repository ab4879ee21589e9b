// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// One emulated scanner: the state that its sessions share, its optics in the world, and the scans
// that it makes for whoever asks. Where nobody asks, it casts nothing. It knows no sockets and does
// not wait: ScanLoop tells it when a turn is complete. Lives on its shard; its clients do not
// outlive it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/clock/clock.h"
#include "daemon/config/config.h"
#include "daemon/device/device_hook.h"
#include "daemon/device/device_log.h"
#include "daemon/device/pace.h"
#include "daemon/device/scan_source.h"
#include "daemon/device/sensor_counts.h"
#include "daemon/device/sensor_log.h"
#include "daemon/device/sensor_record.h"
#include "daemon/device/sweep.h"
#include "daemon/device/unit.h"
#include "daemon/device/watchers.h"
#include "daemon/link/endpoint.h"
#include "daemon/replay/replay.h"
#include "daemon/world/world.h"
#include "protocol/device_state.h"
#include "sim/sensor/device_clock.h"
#include "sim/sensor/scan_timing.h"

namespace scipd::daemon {

class Device : public ScanSource, public Endpoint, private Lamp {
  public:
    /// Powered up at this moment. `world` and `clock` must outlive it.
    Device(const std::string& robot, const SensorConfig& config, std::uint64_t seed, World& world,
           Clock& clock);
    /// From now on it shows these scans, and no world. To be called before it has clients.
    void play(Track track, const ReplayConfig& config);
    /// Only of one that plays.
    [[nodiscard]] ReplayStatus replay_status() const;
    ReplayStatus steer_replay(const ReplaySteering& steering);
    ~Device() override;
    [[nodiscard]] std::unique_ptr<Client> connect(std::function<void()> on_actions,
                                                  protocol::LinkKind link) override;
    [[nodiscard]] Clock& clock() override { return clock_; }
    [[nodiscard]] sim::ChanceKey chance(sim::Purpose purpose) const override;
    [[nodiscard]] const protocol::DeviceProfile& profile() const { return profile_; }
    [[nodiscard]] const protocol::DeviceState& state() const { return state_; }
    [[nodiscard]] protocol::Uptime uptime() const;

    /// Changes the device from outside, and tells its clients. Not from within a client's call.
    using Change = std::function<void(protocol::DeviceState& state, protocol::Uptime now)>;
    void change(const Change& change);
    /// From now on scans leave so much later than they should.
    void set_late(sim::Time late);
    /// Null: nobody stands between its mirror and its clients.
    void set_hook(DeviceHook* hook);
    /// Changes what no client waits for. For the hook, from within a call of the device's.
    void amend(const Change& change) { change(state_, uptime()); }
    /// The instant of step 0, on its own clock.
    [[nodiscard]] protocol::Uptime start_of(std::int64_t revolution) const;
    void shift_poses(const PoseShift& shift) { sweep_.shift_poses(shift); }
    [[nodiscard]] sim::Pose world_from_robot() const { return sweep_.robot_at(clock_.now()); }
    [[nodiscard]] const sim::SensorSpec& optics() const { return sweep_.optics(); }
    [[nodiscard]] const std::string& name() const override { return sweep_.name(); }
    /// From the next scan on it sits there on its robot.
    void mount(const sim::Pose& robot_from_sensor) { sweep_.mount(robot_from_sensor); }
    /// And reads with the errors of this configuration. Its clock and its turns stay as they are.
    void read_as(const SensorConfig& config);
    [[nodiscard]] bool driven() const override;
    [[nodiscard]] bool watched() const override { return watchers_.any(); }
    void on_wanted(std::function<void()> callback) override { on_wanted_ = std::move(callback); }

    /// Somebody who sees every scan, whatever clients want; null: nobody.
    void watch(Watchers<ScanRecord>::Watcher watcher, WatchedBy who = WatchedBy::stream);

    void resume() override;
    [[nodiscard]] std::int64_t next_revolution() const override;
    /// At the first tick of the firmware after its last step.
    [[nodiscard]] sim::Time leaves(std::int64_t revolution) const override;
    [[nodiscard]] sim::Time patience() const override { return patience_; }
    [[nodiscard]] bool poses_known(std::int64_t revolution) const override;
    [[nodiscard]] bool stands_alone() const override;
    void turn_complete(std::int64_t revolution) override;
    /// The latest one whose turn was told, which is late where the machine is slow; -1: none.
    [[nodiscard]] std::int64_t latest_turn() const { return latest_turn_; }
    /// But for what links and faults count.
    [[nodiscard]] SensorCounts counts() const;
    [[nodiscard]] sim::SharedScan latest_scan() const;
    [[nodiscard]] const ScanLog& log() const { return log_; }
    void ask_log() { log_.ask(clock_.now()); }
    [[nodiscard]] std::size_t clients() const { return clients_.size(); }
    /// Logs the clients of its ports. They must forget it before the device goes.
    [[nodiscard]] ClientWatch& client_watch() { return told_; }
    /// From now on `clients`, which must outlive this, also counts the clients of this scanner.
    void count_clients_in(std::atomic<int>& clients) { told_.count_in(clients); }

  private:
    class ServedClient;

    /// Answers its requests for the latest scan, or sees to it that this is made.
    void serve_latest(ServedClient& client);
    /// Clients may be waiting for what has just happened. One of them may know already.
    void tell_clients(const ServedClient* knows = nullptr);
    void notice_boot();
    /// As others see it: a light that turns with its mirror, and shines where it measures.
    [[nodiscard]] std::optional<LampBeam> shines(sim::Time time) const override;

    /// Lets the mirror turn as the state says. To be called after whatever may have changed that.
    void follow_motor();
    /// A log that waits for its first client begins with the first turn that one takes.
    void begin_replay(std::int64_t revolution, bool watched);
    /// Lets it turn as it did when the scan of this revolution was recorded.
    void turn_as_recorded(std::int64_t revolution);
    [[nodiscard]] ReplayTurn replay_turn(std::int64_t revolution) const;
    /// Measures a revolution that is complete, if nobody has done so yet.
    const ScanRecord& measure(std::int64_t revolution);
    [[nodiscard]] ScanRecord cast(std::int64_t revolution);
    [[nodiscard]] ScanRecord played(std::int64_t revolution, const Replay::Shown& shown);
    /// Whether there is a scan of this revolution.
    [[nodiscard]] bool shows(std::int64_t revolution) const;

    // Constant after construction.
    sim::ChanceKey chance_;
    Unit unit_;
    protocol::DeviceProfile profile_;
    sim::Time patience_;
    Clock& clock_;
    World& world_;
    sim::DeviceClock device_clock_;
    Sweep sweep_;  ///< but for where it is mounted
    std::optional<Replay> replay_;
    sim::ScanTiming timing_;  ///< in device time: the crystal drives the mirror as well
    bool cold_start_;         ///< it was switched on when it was made; else long ago

    protocol::DeviceState state_;
    std::int64_t latest_turn_ = -1;
    int boots_told_ = 0;  ///< how many boots all clients know of
    DeviceLog told_;
    int bit_rate_told_;                   ///< which rate of the serial line all clients know of
    std::vector<ServedClient*> clients_;  ///< each adds and removes itself
    DeviceHook* hook_ = nullptr;
    sim::Time late_{};
    sim::Time punctual_from_ = sim::Time::min();  ///< what leaves earlier was to be late
    std::function<void()> on_wanted_;
    Watchers<ScanRecord> watchers_;
    Pace pace_;
    ScanLog log_;
    SensorCounts counts_;  ///< without what living sessions have refused
};

}  // namespace scipd::daemon
