// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// This daemon's part in a world that many share by way of a broker: it joins before it serves, and
// then stays in step. docs/scaling.md has the rules. Lives on the I/O thread, but for join() and
// what rejoining() returns.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <boost/asio/any_io_executor.hpp>
#include <spdlog/common.h>

#include "daemon/api/shared_status.h"
#include "daemon/clock/clock.h"
#include "daemon/config/config.h"
#include "daemon/fleet/join_world.h"
#include "daemon/fleet/kept_messages.h"
#include "daemon/fleet/mqtt_link.h"
#include "daemon/fleet/shared_edits.h"
#include "daemon/fleet/shared_poses.h"
#include "daemon/fleet/topics.h"
#include "daemon/limits/rate.h"
#include "daemon/limits/throttle.h"
#include "daemon/poses/pose_intake.h"
#include "daemon/world/world.h"

namespace scipd::daemon {

class SharedWorld {
  public:
    /// All must outlive it.
    struct Parts {
        World& world;
        PoseIntake& intake;
        const Clock& clock;
        Lockstep* lockstep;  ///< null: on the wall clock
        SharedEdits::EditHere edit;
    };

    SharedWorld(const boost::asio::any_io_executor& executor, const FleetConfig& config,
                const Parts& parts);
    /// As stop().
    ~SharedWorld();

    /// Asks the broker what the world is like; takes seconds where it does not answer. Throws
    /// std::runtime_error. Nothing else runs meanwhile.
    [[nodiscard]] JoinedWorld join(const sim::Scene& base);
    /// Asks again, for a configuration that is read again; any thread may call what this returns.
    [[nodiscard]] JoinWorld rejoining() const;
    /// The configuration runs in the world that was joined, from now on. What others have changed
    /// and could not be made here is told, with why, by model.
    void serve(const Config& config, const std::map<std::string, std::string>& not_made = {});
    /// An edit that somebody asks for here.
    void edit(SceneEdit edit, EditDone done) { edits_.edit(std::move(edit), std::move(done)); }
    [[nodiscard]] SharedStatus status() const;
    void stop();

  private:
    [[nodiscard]] sim::Time age() const;
    void require_answer(bool came) const;
    void tell_of_loss(const std::string& why);
    [[nodiscard]] std::string body_of(const std::string& robot) const;
    void ask_for_all();
    void take(const MqttMessage& message);
    void take_marker();
    void take_news(const Topic& topic, std::string_view text);
    void take_daemon(const std::string& name, const DaemonNote* before);
    void take_own_note(const DaemonNote* now);
    void tell(const std::string& text, spdlog::level::level_enum level = spdlog::level::info);
    [[nodiscard]] std::vector<std::string> in_the_way() const;
    void forget_the_silent();
    void check_scene() const;
    [[nodiscard]] std::string other_world_text() const;
    void found_world(bool anew);
    void come_back();
    void take_scene();
    [[nodiscard]] bool is_other_world() const;
    bool set_scene_trouble();
    bool set_trouble(const std::string& topic, const std::string& why);
    void put_places(bool with_own);
    void say_who();
    void say_scene();
    void mark();

    const FleetConfig config_;
    const std::string name_;
    const std::string instance_;
    const Topics topics_;
    KeptMessages kept_;
    SceneNote scene_;  ///< the base world here
    DaemonNote who_;   ///< this daemon
    Troubles troubles_;
    Rate news_;             ///< of daemons
    Throttle left_out_;     ///< that there is more of it
    bool lost_ = false;     ///< the broker, since it was there last
    int marks_ = 0;         ///< that were set in the stream of messages
    int marks_seen_ = 0;    ///< all that the broker kept before has come
    bool serving_ = false;  ///< else what comes is gathered alone
    MqttLink link_;
    SharedPoses poses_;
    SharedEdits edits_;
};

}  // namespace scipd::daemon
