// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The running program: one io_context, a rig of sensors, the control API and signals. SIGINT and
// SIGTERM end it cleanly. SIGHUP has it read the configuration again, on the worker's thread, so
// that no stream waits for it; a faulty configuration changes nothing. Lives on the I/O thread,
// which is the one that runs it.
#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <stop_token>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>

#include "daemon/fleet/shared_world.h"
#include "daemon/http/http_server.h"
#include "daemon/link/path_hold.h"
#include "daemon/plan/rig_plan.h"
#include "daemon/program/run_options.h"
#include "daemon/rig/rig.h"
#include "daemon/rig/rig_api.h"
#include "daemon/rig/sensor_editor.h"
#include "daemon/service/handed_sockets.h"
#include "daemon/service/service.h"

namespace scipd::daemon {

class Server {
  public:
    /// Everything listens when this returns. Throws what Rig::apply() and HttpServer throw.
    explicit Server(const Options& options);

    /// One JSON document without line end: where everything listens.
    [[nodiscard]] std::string ready_line() const;

    /// Until a signal ends it.
    void run();

  private:
    /// Another configuration, loaded.
    struct Next {
        RigPlan plan;
        bool asks_for_a_start = false;  ///< of what stays as it is while this program runs
    };

    [[nodiscard]] RigPlan load_first();
    void share_world(const FleetConfig& config);
    void listen_for_control();
    void hold_control();
    void listen_for_http(const Address& address);
    void wait_for_signal();
    void reload();
    /// Loads the configuration again on the worker's thread, and takes it up.
    void load_again();
    /// On the worker's thread.
    static Next load_next(const Options& options, const Running& running,
                          const std::stop_token& stop, const JoinWorld& join);
    void take_up(std::future<Next> loaded);
    /// Runs it from now on. Throws what Rig::apply() throws. Returns what it changes, in words.
    std::string run_as(RigPlan&& plan);
    void stop();

    /// Warns of sockets that were handed over and that nobody needs.
    void warn_of_unneeded(const Config& config) const;
    [[nodiscard]] std::filesystem::path first_control_socket() const;
    void listen_at_control();

    const Options options_;  ///< that it was started with
    Config running_;         ///< the latest, which a reload may have read
    const HandedSockets handed_;
    boost::asio::io_context io_{1};
    boost::asio::signal_set signals_;
    Rig rig_;
    SensorEditor sensors_;
    RigApi api_{rig_.simulation()};
    std::optional<SharedWorld> shared_;  ///< nothing: the world is this daemon's alone
    Service service_;
    std::filesystem::path control_socket_;
    std::optional<PathHold> control_hold_;
    HttpServer control_;
    std::optional<std::string> http_;  ///< where the control API is reached by TCP
    bool loading_ = false;
    bool asked_again_ = false;  ///< while loading
};

}  // namespace scipd::daemon
