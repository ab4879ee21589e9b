// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/server.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <system_error>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "daemon/api/routes.h"
#include "daemon/config/config_file.h"
#include "daemon/config/run_directory.h"
#include "daemon/link/path_hold.h"
#include "daemon/plan/config_changes.h"
#include "daemon/rig/served.h"
#include "daemon/rig/simulation.h"
#include "daemon/service/service_notify.h"
#include "daemon/web/live_page.h"
#include "daemon/web/page_files.h"

namespace scipd::daemon {

namespace asio = boost::asio;

namespace {

/// What systemd waits for beside the world: a broker, say, and the backends that are measured.
constexpr std::chrono::minutes beside_the_world{5};

/// Logs how to send poses where time waits for them. In a fleet other daemons forward theirs.
void note_that_time_waits(const Config& config) {
    const bool fed = std::ranges::any_of(
        config.robots, [](const RobotConfig& robot) { return robot.poses.has_value(); });
    if (config.clock == ClockKind::wall || config.fleet || fed) return;
    spdlog::info(
        "clock: poses: time stands still until poses come, and no robot has a source of them; "
        "start with --poses SOURCE, run scipctl pose stream, or send them to the WebSocket /poses");
}

}  // namespace

Server::Server(const Options& options)
    : options_(options),
      signals_(io_, SIGHUP),
      rig_(io_.get_executor(), options_.config.clock, &handed_, options_.threads),
      sensors_(rig_, running_,
               [this](RigPlan&& plan) {
                   spdlog::info("requested over the control API: {}", run_as(std::move(plan)));
               }),
      service_(io_.get_executor(), served(rig_.simulation())),
      control_(
          io_.get_executor(),
          [this](const HttpRequest& request, Respond respond) {
              route(api_, request, std::move(respond));
          },
          [this](const HttpRequest& request) { return open_socket(api_, request); },
          rig_.simulation().limits) {
    RigPlan plan = load_first();
    signals_.add(SIGINT);
    signals_.add(SIGTERM);
    warn_of_unneeded(plan.config);
    // The control socket next: if another scipd has it, its ttys are not touched either.
    listen_for_control();
    if (options_.config.http) listen_for_http(*options_.config.http);
    const Config config = plan.config;
    const auto unlike_the_others = plan.unlike_the_others;
    rig_.apply(std::move(plan));
    if (shared_) shared_->serve(config, unlike_the_others);
    running_ = config;
    api_.run_as(running_, sensors_);
    rig_.simulation().choose_backends();
    note_that_time_waits(config);
    wait_for_signal();
}

// It loads the world before it opens anything: meanwhile SIGINT and SIGTERM end the program, and
// nothing is left behind. SIGHUP waits. It loads on another thread: the memory of the world is then
// in the part of the heap that other threads have, so that this one does not wait while the memory
// is given back.
RigPlan Server::load_first() {
    service_notify::loading("loads " + options_.config.scene.string(),
                            options_.config.limits.load_time + beside_the_world);
    JoinWorld join;
    if (options_.config.fleet) {
        share_world(*options_.config.fleet);
        join = [this](const sim::Scene& base) { return shared_->join(base); };
    }
    const Running running = rig_.running();
    return std::async(std::launch::async,
                      [&] { return make_plan(options_.config, running, {}, join); })
        .get();
}

void Server::share_world(const FleetConfig& config) {
    Simulation& simulation = rig_.simulation();
    shared_.emplace(
        io_.get_executor(), config,
        SharedWorld::Parts{simulation.world, simulation.intake, simulation.clock,
                           simulation.lockstep.get(), [this](SceneEdit edit, EditDone done) {
                               api_.edit_here(std::move(edit), std::move(done));
                           }});
    api_.share(&*shared_);
}

// The first scipd has the control socket that nobody has named; those started after it make their
// own.
void Server::listen_for_control() {
    const std::filesystem::path& named = options_.config.control;
    control_socket_ = first_control_socket();
    remove_leftovers(run_directory());
    if (!named.empty()) {
        make_folder(named.parent_path());
        return listen_at_control();
    }
    make_run_directory();
    const auto listen_beside = [this] {
        control_socket_.replace_filename("control-" + std::to_string(::getpid()) + ".sock");
        listen_at_control();
    };
    try {
        listen_at_control();
    } catch (const PathHeld&) {
        listen_beside();
    } catch (const SocketTaken&) {
        listen_beside();
    }
}

std::filesystem::path Server::first_control_socket() const {
    const std::filesystem::path& named = options_.config.control;
    return named.empty() ? usual_control_socket() : named;
}

void Server::listen_at_control() {
    hold_control();
    control_.listen(control_socket_, options_.config.control_group, handed_.at(control_socket_));
}

// Where scipd can make no file, it can make no socket either, and listen() says so; but it can take
// one that systemd has made there.
void Server::hold_control() {
    try {
        control_hold_.emplace(control_socket_);
    } catch (const std::system_error&) {
        control_hold_.reset();
    }
}

void Server::listen_for_http(const Address& address) {
    const Gate gate(options_.config.http_token, is_of_page);
    const Address taken = control_.listen(address, gate, handed_.at(address));
    http_ = text_of(taken);
    if (!page_files().empty()) spdlog::info("the page is at http://{}/", text_of(from_here(taken)));
    if (!is_loopback(address)) {
        spdlog::warn(
            "the control API listens on {}: other machines can use it with the token, at an "
            "address of this machine, not at a name",
            *http_);
    }
}

std::string Server::ready_line() const {
    nlohmann::ordered_json line{{"ready", true}, {"sensors", nlohmann::json::array()}};
    const auto or_null = [](const std::optional<std::string>& text) {
        return text ? nlohmann::json(*text) : nullptr;
    };
    for (const SensorReport& sensor : api_.report().sensors) {
        line["sensors"].push_back(nlohmann::ordered_json{{"name", sensor.name},
                                                         {"model", sensor.model},
                                                         {"tcp", or_null(sensor.tcp)},
                                                         {"pty", or_null(sensor.pty)}});
    }
    line["control"] = control_socket_;
    line["http"] = or_null(http_);
    for (const auto& [robot, address] : rig_.pose_addresses())
        line["poses"][robot] = "udp:" + text_of(address);
    constexpr bool ascii = true;  // what a path holds does a terminal no harm
    return line.dump(-1, ' ', ascii, nlohmann::json::error_handler_t::replace);
}

// Before anything is opened: such a socket may be why that fails.
void Server::warn_of_unneeded(const Config& config) const {
    std::vector<std::string> addresses;
    for (const RobotConfig& robot : config.robots) {
        for (const SensorConfig& sensor : robot.sensors)
            if (sensor.tcp) addresses.push_back(text_of(*sensor.tcp));
    }
    // A reload changes neither this nor the control socket.
    if (options_.config.http) addresses.push_back(text_of(*options_.config.http));
    for (const std::string& warning : handed_.unneeded(addresses, first_control_socket()))
        spdlog::warn("{}", warning);
}

void Server::run() {
    service_.ready();
    io_.run();
}

void Server::wait_for_signal() {
    signals_.async_wait([this](const boost::system::error_code& error, int signal) {
        if (error) return;
        if (signal == SIGHUP) {
            reload();
            return wait_for_signal();
        }
        spdlog::info("stopped ({})", signal == SIGINT ? "SIGINT" : "SIGTERM");
        stop();
    });
}

void Server::reload() {
    if (!options_.config_file) {
        spdlog::warn("SIGHUP: started from options, so there is no configuration to read again");
        service_.reloading("nothing");
        return service_.reloaded("scipd was started from options");
    }
    service_.reloading(options_.config_file->string());
    asked_again_ = std::exchange(loading_, true);
    if (!asked_again_) load_again();
}

void Server::load_again() {
    Simulation& simulation = rig_.simulation();
    simulation.worker.add([this, &simulation] {
        return [this, running = rig_.running(), stop = simulation.worker.stopping(),
                join = shared_ ? shared_->rejoining() : JoinWorld{}]() -> Worker::Finish {
            const auto task = std::make_shared<std::packaged_task<Next()>>(
                [&] { return load_next(options_, running, stop, join); });
            (*task)();
            return [this, task] { take_up(task->get_future()); };
        };
    });
}

Server::Next Server::load_next(const Options& options, const Running& running,
                               const std::stop_token& stop, const JoinWorld& join) {
    const Config& started = options.config;
    Config config = load_config(*options.config_file);
    options.overrides.put_into(config);
    const auto set_at_the_start = [](const Config& of) {
        return std::tie(of.control, of.control_group, of.http, of.http_token, of.clock, of.fleet);
    };
    const bool asks_for_a_start = set_at_the_start(config) != set_at_the_start(started);
    config.clock = started.clock;
    return {make_plan(std::move(config), running, stop, join), asks_for_a_start};
}

void Server::take_up(std::future<Next> loaded) {
    try {
        Next next = loaded.get();
        const std::string changes = run_as(std::move(next.plan));
        if (next.asks_for_a_start) {
            spdlog::warn(
                "SIGHUP: control, http with its token, clock and fleet stay as they are until "
                "scipd "
                "is started again");
        }
        warn_of_unneeded(running_);
        spdlog::info("SIGHUP: {} is running now; {}", options_.config_file->string(), changes);
        service_.reloaded();
    } catch (const std::exception& error) {
        spdlog::error("SIGHUP: nothing was changed, since\n{}", error.what());
        service_.reloaded(error.what());
    }
    loading_ = false;
    if (asked_again_) reload();
}

std::string Server::run_as(RigPlan&& plan) {
    const Config config = plan.config;
    const Config was = as_it_reads(running_, rig_.simulation().stations);
    const auto unlike_the_others = plan.unlike_the_others;
    const std::chrono::duration<double, std::milli> still = rig_.apply(std::move(plan));
    spdlog::debug("all sensors stood still for {:.1f} ms", still.count());
    if (shared_) shared_->serve(config, unlike_the_others);
    rig_.simulation().choose_backends();
    std::string changes = changes_between(was, config);
    running_ = config;
    return changes;
}

void Server::stop() {
    service_.stopping();
    control_.close();
    if (shared_) shared_->stop();
    rig_.stop();
}

}  // namespace scipd::daemon
