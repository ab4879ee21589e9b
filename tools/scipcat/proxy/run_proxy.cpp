// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/proxy/run_proxy.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "daemon/clock/wall_clock.h"
#include "daemon/config/values.h"
#include "daemon/link/client_watch.h"
#include "daemon/link/pty_port.h"
#include "daemon/link/tcp_port.h"
#include "tools/options.h"
#include "tools/scipcat/proxy/proxy_faults.h"
#include "tools/scipcat/proxy/relay.h"
#include "tools/scipcat/proxy/second_thread.h"
#include "tools/scipcat/proxy/twin.h"
#include "tools/scipcat/proxy/twin_daemon.h"

namespace scipd::tools {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;

/// Standard output is for the one who reads along; news go to standard error.
void log_to_standard_error() {
    spdlog::set_default_logger(spdlog::stderr_logger_mt("scipcat"));
    spdlog::set_pattern("%H:%M:%S.%e %v");
}

std::shared_ptr<daemon::Port> make_port(asio::io_context& io, const ProxyWanted& wanted) {
    try {
        if (!wanted.pty.empty())
            return std::make_shared<daemon::PtyPort>(io.get_executor(), fs::absolute(wanted.pty));
        const auto address = daemon::parse_listener(wanted.listen);
        if (!address || !*address)
            throw WrongInput("--listen " + wanted.listen + ": " +
                             (address ? "must be ADDR:PORT" : address.error().why));
        return std::make_shared<daemon::TcpPort>(io.get_executor(), **address);
    } catch (const WrongInput&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw WrongInput(error.what());
    }
}

bool is_configuration(const std::string& twin) {
    return fs::is_regular_file(twin);
}

void tell_rate(int bits_per_second, bool set) {
    const char* const but = set ? "" : ", which its tty cannot do";
    spdlog::info("the scanner goes on at {} bits a second{}", bits_per_second, but);
}

class Proxy final : private daemon::ClientWatch {
  public:
    Proxy(const ProxyWanted& wanted, const ProxyEar& ear);
    ~Proxy() override;
    Proxy(const Proxy&) = delete;
    Proxy& operator=(const Proxy&) = delete;

    void run();

  private:
    // ClientWatch
    void came(const std::string& from) override;
    void waits(const std::string& from, const std::string& served) override;
    void left(protocol::LinkKind from, daemon::Leaving why) override;

    void make_twin();
    void hear(bool to_scanner, std::string_view bytes);
    /// On the second thread.
    void look(const Heard& heard);
    void lost(const std::string& why);
    void tell_ready() const;
    void tell_twin() const;

    const ProxyWanted& wanted_;
    const ProxyEar& ear_;
    asio::io_context io_{1};
    daemon::WallClock clock_{io_.get_executor()};
    std::vector<daemon::FaultPlan> plans_;
    std::optional<TwinDaemon> twin_daemon_;
    SecondThread second_{[this](const Heard& heard) { look(heard); }};
    std::optional<Twin> twin_;  ///< lives there
    Relay relay_;
    std::shared_ptr<daemon::Port> port_;
    std::optional<ProxyFaults> faults_;
};

Proxy::Proxy(const ProxyWanted& wanted, const ProxyEar& ear)
    : wanted_(wanted),
      ear_(ear),
      relay_(io_.get_executor(), wanted.target, wanted.open, clock_,
             {.heard = [this](bool to_scanner, std::string_view bytes) { hear(to_scanner, bytes); },
              .opened = [] { spdlog::info("the scanner is there"); },
              .rate = tell_rate,
              .lost = [this](const std::string& why) { lost(why); }}) {
    for (const std::string& words : wanted.faults)
        plans_.push_back(fault_in_words(words));
    if (!wanted.twin.empty()) make_twin();
    port_ = make_port(io_, wanted);
}

Proxy::~Proxy() {
    if (port_) port_->stop();
    second_.finish([this] { twin_.reset(); });
}

// Who listens takes longer than a driver may wait: a scan is written, or compared, in a millisecond
// or two.
void Proxy::hear(bool to_scanner, std::string_view bytes) {
    if (!ear_ && wanted_.twin.empty()) return;
    second_.hand_over(to_scanner ? Heard::What::to_scanner : Heard::What::from_scanner, bytes);
}

void Proxy::look(const Heard& heard) {
    if (heard.what == Heard::What::driver_came) return twin_->come();
    if (heard.what == Heard::What::driver_left) return twin_->leave();
    const bool to_scanner = heard.what == Heard::What::to_scanner;
    if (ear_) ear_(to_scanner, heard.time, heard.bytes);
    if (twin_) twin_->hear(to_scanner, heard.time, heard.bytes);
}

void Proxy::make_twin() {
    Target target;
    if (is_configuration(wanted_.twin)) {
        twin_daemon_.emplace(wanted_.twin);
        target = twin_daemon_->target();
    } else {
        try {
            target = parse_target(wanted_.twin);
        } catch (const std::invalid_argument& error) {
            throw WrongInput(std::string("--twin: ") + error.what() +
                             ", or the file of a configuration");
        }
    }
    const auto changed = [this](const TwinChange& change) {
        std::cout << (wanted_.json ? json_of(change) : sentence_of(change)) << '\n' << std::flush;
    };
    const auto news = [](const std::string& sentence) { spdlog::info("{}", sentence); };
    twin_.emplace(second_.executor(), target, wanted_.open, wanted_.tolerance_mm,
                  Twin::Hooks{.changed = changed, .news = news});
}

void Proxy::run() {
    asio::signal_set signals(io_, SIGINT, SIGTERM);
    signals.async_wait([this](const boost::system::error_code& error, int) {
        if (!error) io_.stop();
    });
    port_->set_watch(this);
    port_->serve(relay_, {});
    if (!plans_.empty()) {
        faults_.emplace(plans_, wanted_.scanner, *port_, clock_);
        relay_.set_faults(&*faults_);
    }
    tell_ready();
    io_.run();
    second_.finish([this] {
        tell_twin();
        twin_.reset();
    });
}

void Proxy::came(const std::string& from) {
    spdlog::info("a driver {}", from.empty() ? "opens the tty" : "connects from " + from);
    if (!wanted_.twin.empty()) second_.hand_over(Heard::What::driver_came);
    relay_.open();
}

void Proxy::waits(const std::string& from, const std::string& served) {
    spdlog::info("a driver from {} waits until {} disconnects: a scanner serves one at a time",
                 from, served);
}

void Proxy::left(protocol::LinkKind /*from*/, daemon::Leaving why) {
    if (why == daemon::Leaving::closed) spdlog::info("the driver is gone");
    if (!wanted_.twin.empty()) second_.hand_over(Heard::What::driver_left);
}

// A TCP connection ends by itself, once all is sent. A tty hangs up, as that of a scanner that is
// unplugged, and is there again at once.
void Proxy::lost(const std::string& why) {
    spdlog::info("the scanner is gone: {}", why);
    if (port_->kind() == protocol::LinkKind::tty) port_->cut(daemon::Cut::rst);
}

void Proxy::tell_ready() const {
    const std::string place = port_->address();
    if (wanted_.json) {
        const nlohmann::ordered_json ready{{"ready", true}, {"listen", place}};
        std::cout << ready.dump() << '\n' << std::flush;
        return;
    }
    std::cout << "listens at " << place << " for " << wanted_.scanner << '\n' << std::flush;
}

void Proxy::tell_twin() const {
    if (!twin_) return;
    spdlog::info("{} scans held against the twin's", twin_->compared());
}

}  // namespace

void run_proxy(const ProxyWanted& wanted, const ProxyEar& ear) {
    // A driver or scanner that is gone is told by error codes.
    std::signal(SIGPIPE, SIG_IGN);
    log_to_standard_error();
    Proxy proxy(wanted, ear);
    proxy.run();
}

}  // namespace scipd::tools
