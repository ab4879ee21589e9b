// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/device/device.h"

#include <algorithm>
#include <string>
#include <utility>

#include "daemon/config/sensor_config.h"
#include "daemon/device/unit.h"
#include "protocol/device_profile.h"
#include "protocol/ideal.h"
#include "protocol/reply_grid.h"
#include "protocol/session.h"
#include "protocol/settings.h"
#include "sim/fnv1a.h"

namespace scipd::daemon {
namespace {

// The rate of the serial line can be set for good by the user, as II says.
void power_up_at(int bit_rate, protocol::DeviceProfile& profile) {
    const auto place = std::ranges::find(profile.bit_rates, bit_rate);
    if (place == profile.bit_rates.end()) return;
    std::rotate(profile.bit_rates.begin(), place, place + 1);
    profile.bit_rate = std::to_string(bit_rate) + "[bps]<-Default setting by user";
}

/// A configured scanner's words about itself once it is switched on: its model's profile, with the
/// timing and the bit rate that the configuration asks for.
protocol::DeviceProfile powered_profile(const SensorConfig& config, const Unit& unit) {
    protocol::DeviceProfile profile = config.model.profile;
    profile.serial = unit.serial;
    if (config.timing == Timing::ideal) profile = protocol::ideal(profile);
    profile.scan_period = unit.turn(profile.scan_period);
    if (config.link.baud) power_up_at(*config.link.baud, profile);
    return profile;
}

}  // namespace

/// One client, known to the device for as long as it lives.
class Device::ServedClient final : public Endpoint::Client {
  public:
    ServedClient(Device& device, std::function<void()> on_actions, protocol::LinkKind link)
        : session_(device.profile_, device.state_, link),
          on_actions_(std::move(on_actions)),
          kind_(link == protocol::LinkKind::tty ? DeviceLog::By::tty_client
                                                : DeviceLog::By::tcp_client),
          device_(device) {
        session_.set_hook(device_.hook_);
        device_.clients_.push_back(this);
    }
    ServedClient(const ServedClient&) = delete;
    ServedClient& operator=(const ServedClient&) = delete;
    ~ServedClient() override {
        session_.close();
        device_.told_.laser(device_.state_.laser_on(), DeviceLog::By::leaving_client);
        add(session_.refused(), device_.counts_.refused);
        std::erase(device_.clients_, this);
    }

    [[nodiscard]] protocol::Session& session() override { return session_; }
    [[nodiscard]] const protocol::Session& session() const { return session_; }

    void receive(std::string_view bytes) override {
        session_.receive(bytes, device_.uptime());
        device_.serve_latest(*this);
    }
    [[nodiscard]] std::optional<sim::Time> wake_at() const override {
        const auto at = session_.wake_at();
        if (!at) return std::nullopt;
        return device_.device_clock_.world_time(*at);
    }
    void wake() override {
        session_.advance(device_.uptime());
        device_.serve_latest(*this);
    }

    /// Tells it that its session may have something to send.
    void tell() const { on_actions_(); }
    [[nodiscard]] DeviceLog::By kind() const { return kind_; }

  private:
    protocol::Session session_;
    std::function<void()> on_actions_;
    DeviceLog::By kind_;
    Device& device_;
};

Device::Device(const std::string& robot, const SensorConfig& config, std::uint64_t seed,
               World& world, Clock& clock)
    : chance_{.seed = seed, .sensor = sim::fnv1a<std::uint64_t>(sensor_name(robot, config.name))},
      unit_(config, chance_),
      profile_(powered_profile(config, unit_)),
      patience_(config.wait_for_poses),
      clock_(clock),
      world_(world),
      device_clock_(clock.now(), config.clock.ppm.value_or(unit_.clock_ppm)),
      sweep_(world, robot, config, unit_.scanner(config, profile_, chance_)),
      timing_(sweep_.optics(), config.clock.phase.value_or(sim::Time::zero())),
      cold_start_(config.power_up == PowerUp::boot),
      told_(sweep_.name(), clock_),
      bit_rate_told_(protocol::bit_rate_of(state_.settings(), profile_)) {
    // The wall clock goes on meanwhile. What it reads by now would move stamps against the mirror.
    constexpr protocol::Uptime at_power_up{};
    if (config.power_up == PowerUp::scip1) state_.power_up_in_scip1(at_power_up);
    if (config.power_up == PowerUp::boot) state_.boot(at_power_up, profile_.boot_time);
    state_.set_clock(at_power_up, std::chrono::milliseconds(config.clock.start_ms));
    boots_told_ = state_.boots();
    told_.know(state_.laser_on());
    state_.set_mirror_origin(timing_.start(0));
    follow_motor();
    sweep_.know_own_lamp(*this);
    world_.light().lamps().add(*this);
}

Device::~Device() {
    world_.light().lamps().remove(*this);
}

protocol::Uptime Device::uptime() const {
    return device_clock_.device_time(clock_.now());
}

void Device::read_as(const SensorConfig& config) {
    sweep_.read_as(unit_.scanner(config, profile_, chance_), config.interference);
}

std::unique_ptr<Endpoint::Client> Device::connect(std::function<void()> on_actions,
                                                  protocol::LinkKind link) {
    return std::make_unique<ServedClient>(*this, std::move(on_actions), link);
}

sim::ChanceKey Device::chance(sim::Purpose purpose) const {
    sim::ChanceKey key = chance_;
    key.purpose = purpose;
    return key;
}

void Device::set_hook(DeviceHook* hook) {
    hook_ = hook;
    for (ServedClient* client : clients_)
        client->session().set_hook(hook);
}

void Device::set_late(sim::Time late) {
    if (late < late_) punctual_from_ = clock_.now();
    late_ = late;
}

void Device::change(const Change& change) {
    const protocol::Grid mirror = protocol::mirror_of(state_, profile_);
    const int boots = state_.boots();
    change(state_, uptime());
    // Another speed holds from the next pass on, as with CR; a boot has its own.
    const bool other_speed = protocol::mirror_of(state_, profile_).tick != mirror.tick;
    if (other_speed && state_.boots() == boots) state_.set_mirror_origin(mirror.after(uptime()));
    follow_motor();
    notice_boot();
    told_.laser(state_.laser_on(), DeviceLog::By::fault);
    bit_rate_told_ = protocol::bit_rate_of(state_.settings(), profile_);
    tell_clients();
}

SensorCounts Device::counts() const {
    SensorCounts counts = counts_;
    for (const ServedClient* client : clients_)
        add(client->session().refused(), counts.refused);
    return counts;
}

bool Device::driven() const {
    return std::ranges::any_of(clients_,
                               [](const auto* client) { return client->session().measuring(); });
}

void Device::watch(std::function<void(const ScanRecord&)> watcher, WatchedBy who) {
    watchers_.set(who, std::move(watcher));
    if (watchers_.any() && on_wanted_) on_wanted_();
}

std::int64_t Device::next_revolution() const {
    const sim::Time now = clock_.now();
    std::int64_t revolution = timing_.latest_complete(uptime());
    while (revolution < 0 || leaves(revolution) <= now)
        ++revolution;
    return revolution;
}

sim::Time Device::leaves(std::int64_t revolution) const {
    return late_ + device_clock_.world_time(
                       protocol::scan_leaves(timing_.complete(revolution), state_, profile_));
}

protocol::Uptime Device::start_of(std::int64_t revolution) const {
    return timing_.start(revolution);
}

sim::SharedScan Device::latest_scan() const {
    return log_.latest() ? log_.latest()->cast : nullptr;
}

bool Device::poses_known(std::int64_t revolution) const {
    return sweep_.poses_known(device_clock_.world_time(timing_.complete(revolution)));
}

// Its speed changes by CR, RS and boot.
void Device::follow_motor() {
    if (replay_) return;
    const protocol::Grid mirror = protocol::mirror_of(state_, profile_);
    timing_.turn_from(mirror.origin, mirror.tick);
}

// Faults may have to do with other sensors.
bool Device::stands_alone() const {
    return hook_ == nullptr && sweep_.stands_alone();
}

void Device::turn_complete(std::int64_t revolution) {
    latest_turn_ = revolution;
    begin_replay(revolution, watchers_.any());
    if (replay_) turn_as_recorded(revolution + 1);
    if (hook_ != nullptr) {
        hook_->turn(revolution);
        if (hook_ != nullptr && !hook_->serves(revolution)) return tell_clients();
    }
    if (!shows(revolution)) return tell_clients();
    std::vector<ServedClient*> takers;
    for (ServedClient* client : clients_) {
        if (client->session().turn_complete({.start = start_of(revolution)}))
            takers.push_back(client);
    }
    if (!takers.empty()) {
        const protocol::ScanView scan = measure(revolution).sent.view();
        for (ServedClient* client : takers)
            client->session().take(scan, uptime());
        told_.laser(state_.laser_on(), DeviceLog::By::last_scan);
        ++counts_.scans;
        if (leaves(revolution) >= punctual_from_)
            counts_.lateness.add(clock_.now() - leaves(revolution));
    }
    if (watchers_.any()) watchers_.tell(measure(revolution));
    // A client that has not taken it may wait in vain, because another one has switched the laser
    // off.
    tell_clients();
}

void Device::serve_latest(ServedClient& client) {
    protocol::Session& session = client.session();
    begin_replay(next_revolution() - 1, false);
    // Once a request is answered, the one behind it may want the latest scan as well.
    for (std::int64_t revolution = next_revolution() - 1;
         revolution >= 0 && shows(revolution) &&
         session.waits_for({.start = start_of(revolution)}) &&
         (patience_ == sim::Time::zero() || poses_known(revolution)) &&
         (hook_ == nullptr || hook_->serves(revolution));) {
        session.take(measure(revolution).sent.view(), uptime());
    }
    follow_motor();
    if (session.measuring() && on_wanted_) on_wanted_();
    const int bit_rate = protocol::bit_rate_of(state_.settings(), profile_);
    const bool booted = boots_told_ != state_.boots();
    notice_boot();
    told_.laser(state_.laser_on(), client.kind());
    const bool changed = std::exchange(bit_rate_told_, bit_rate) != bit_rate;
    if (booted || changed) tell_clients(&client);
}

void Device::notice_boot() {
    if (std::exchange(boots_told_, state_.boots()) == state_.boots()) return;
    told_.booted(state_.laser_on());
    if (hook_ != nullptr) hook_->booted();
}

void Device::tell_clients(const ServedClient* knows) {
    for (ServedClient* client : clients_) {
        if (client == knows) continue;
        client->session().advance(uptime());
        client->tell();
    }
    follow_motor();
}

}  // namespace scipd::daemon
