// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/http_server.h"

#include <cerrno>
#include <exception>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "daemon/http/http_connection.h"
#include "daemon/http/problem.h"

namespace scipd::daemon {

namespace asio = boost::asio;
namespace fs = std::filesystem;

using asio::ip::tcp;
using boost::system::error_code;
using Local = asio::local::stream_protocol;

/// One place to be connected at; keeps itself alive until it is closed.
class HttpPort {
  public:
    virtual ~HttpPort() = default;
    virtual void close() = 0;
};

namespace {

/// After a failed accept, as when all descriptors are taken: not at once again.
constexpr std::chrono::milliseconds accept_pause{100};

/// So many clients at once are told that there are too many; others only find their connections
/// closed.
constexpr long most_turned_away = 16;

long clients_of(const SharedDoor& door) {
    return door.use_count() - 1;  // the listener's
}

/// Where its client has connected to. A client that has gone meanwhile was nowhere.
Address address_of(const tcp::socket& socket) {
    error_code error;
    const auto here = socket.local_endpoint(error);
    auto host = here.address();
    if (host.is_v6() && host.to_v6().is_v4_mapped()) {
        host = asio::ip::make_address_v4(asio::ip::v4_mapped, host.to_v6());
    }
    return {host.to_string(), here.port()};
}

/// A Unix socket has no gate that asks.
Address address_of(const Local::socket&) {
    return {};
}

template <class Protocol>
class Listener : public HttpPort, public std::enable_shared_from_this<Listener<Protocol>> {
  public:
    Listener(typename Protocol::acceptor acceptor, std::shared_ptr<HttpService> service,
             const HttpDoor& door)
        : service_(std::move(service)),
          door_(std::make_shared<const HttpDoor>(door)),
          way_out_(std::make_shared<const HttpDoor>(door)),
          acceptor_(std::move(acceptor)),
          pause_(acceptor_.get_executor()) {}

    void accept() {
        acceptor_.async_accept([self = this->shared_from_this()](const error_code& error,
                                                                 typename Protocol::socket socket) {
            if (self->service_->closed) return;
            if (error) return self->accept_later();
            self->take_in(std::move(socket));
            self->accept();
        });
    }

    void close() override {
        error_code ignored;
        acceptor_.close(ignored);
        pause_.cancel();
    }

  private:
    void take_in(typename Protocol::socket socket) {
        Limits& limits = *service_->limits;
        if (clients_of(door_) < static_cast<long>(limits[door_->most]))
            return connection(std::move(socket), door_)->read_header();
        const HttpResponse why = problem(503, limits.refuse(door_->most, door_->name));
        if (clients_of(way_out_) < most_turned_away)
            connection(std::move(socket), way_out_)->turn_away(why);
    }

    [[nodiscard]] std::shared_ptr<HttpConnection> connection(typename Protocol::socket socket,
                                                             const SharedDoor& door) const {
        Address here = address_of(socket);
        return std::make_shared<HttpConnection>(std::move(socket), std::move(here), service_, door);
    }

    void accept_later() {
        pause_.expires_after(accept_pause);
        pause_.async_wait([self = this->shared_from_this()](const error_code&) {
            if (!self->service_->closed) self->accept();
        });
    }

    std::shared_ptr<HttpService> service_;
    SharedDoor door_;
    SharedDoor way_out_;  ///< of clients that are turned away
    typename Protocol::acceptor acceptor_;
    asio::steady_timer pause_;
};

/// What a daemon that was killed has left behind.
void remove_stale(const fs::path& path, const asio::any_io_executor& executor) {
    const auto type = fs::symlink_status(path).type();
    if (type == fs::file_type::not_found) return;
    if (type != fs::file_type::socket) throw std::runtime_error("it is there and no socket");
    Local::socket probe{executor};
    error_code error;
    probe.connect(Local::endpoint{path.string()}, error);
    if (!error) throw SocketTaken("another program listens there");
    if (error != asio::error::connection_refused) throw boost::system::system_error{error};
    fs::remove(path);
}

void let_in(const fs::path& socket, std::optional<unsigned> group) {
    if (group && ::lchown(socket.c_str(), static_cast<uid_t>(-1), *group) != 0) {
        throw std::runtime_error("cannot give it to its group: " +
                                 std::generic_category().message(errno));
    }
    fs::permissions(socket, fs::perms(0660));
}

template <class Listen>
void name_failures(const std::string& where, Listen listen) {
    const std::string what = "cannot listen on " + where;
    try {
        listen();
    } catch (const boost::system::system_error& error) {
        require_own_address(what, error.code());
        throw std::runtime_error(what + ": " + error.code().message());
    } catch (const SocketTaken& taken) {
        throw SocketTaken(what + ": " + taken.what());
    } catch (const std::exception& error) {
        throw std::runtime_error(what + ": " + error.what());
    }
}

}  // namespace

HttpServer::HttpServer(asio::any_io_executor executor, HttpHandler handler,
                       OpenWebSocket open_web_socket, SharedLimits limits)
    : executor_(std::move(executor)), service_(std::make_shared<HttpService>()) {
    service_->handler = std::move(handler);
    service_->open_web_socket = std::move(open_web_socket);
    service_->limits = std::move(limits);
}

HttpServer::~HttpServer() {
    close();
}

void HttpServer::make_socket(Local::acceptor& acceptor, const fs::path& socket,
                             std::optional<unsigned> group) {
    remove_stale(socket, executor_);
    acceptor.open(Local{});
    // On Linux the file inherits the mode of its descriptor: at no instant can others open it.
    // The umask takes from that mode, and the file is not of the group yet.
    ::fchmod(acceptor.native_handle(), S_IRUSR | S_IWUSR);
    acceptor.bind(Local::endpoint{socket.string()});
    sockets_.push_back(socket);
    let_in(socket, group);
    acceptor.listen();
}

void HttpServer::listen(const fs::path& socket, std::optional<unsigned> group,
                        std::optional<int> handed) {
    name_failures(socket.string(), [&] {
        Local::acceptor acceptor{executor_};
        if (handed) {
            acceptor.assign(Local{}, *handed);
        } else {
            make_socket(acceptor, socket, group);
        }
        const auto port = std::make_shared<Listener<Local>>(
            std::move(acceptor), service_, HttpDoor{socket.string(), Limit::control_connections});
        port->accept();
        ports_.push_back(port);
    });
}

Address HttpServer::listen(const Address& address, Gate gate, std::optional<int> handed) {
    Address taken;
    name_failures(text_of(address), [&] {
        const tcp::endpoint wanted{asio::ip::make_address(address.host), address.port};
        tcp::acceptor acceptor = handed ? tcp::acceptor{executor_, wanted.protocol(), *handed}
                                        : tcp::acceptor{executor_, wanted};
        taken = {address.host, acceptor.local_endpoint().port()};
        const auto port = std::make_shared<Listener<tcp>>(
            std::move(acceptor), service_,
            HttpDoor{text_of(taken), Limit::http_connections, std::move(gate)});
        port->accept();
        ports_.push_back(port);
    });
    return taken;
}

std::variant<HttpResponse, Converse> HttpServer::no_web_sockets(const HttpRequest&) {
    return problem(404, "there are no WebSockets here");
}

void HttpServer::close() {
    service_->closed = true;
    for (const auto& port : ports_)
        port->close();
    // What ends at once takes itself off the list.
    for (HttpClient* client : std::set(service_->clients))
        client->close();
    ports_.clear();
    for (const auto& socket : sockets_) {
        std::error_code ignored;
        fs::remove(socket, ignored);
    }
    sockets_.clear();
}

}  // namespace scipd::daemon
