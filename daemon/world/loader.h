// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What takes time, away from the streams: one thread on which worlds are loaded and backends are
// built, one after the other in the order they were asked for. When all is done, memory that is
// free goes back to the system. Used from the I/O thread.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <stop_token>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/thread_pool.hpp>

namespace scipd::daemon {

class Loader {
  public:
    /// Takes up what was loaded; on the I/O thread again.
    using Finish = std::function<void()>;
    /// On the loader's thread, where it also ends: touches nothing that runs, and does not throw.
    /// What it holds of the I/O thread's goes with the Finish, moved.
    using Work = std::function<Finish()>;
    /// On the I/O thread, when all before it is taken up: what the work needs of the present goes
    /// with it.
    using Begin = std::function<Work()>;

    explicit Loader(boost::asio::any_io_executor io) : io_(std::move(io)) {}
    ~Loader();
    Loader(const Loader&) = delete;
    Loader& operator=(const Loader&) = delete;

    /// Leaves the queue where it is withdrawn, on the I/O thread, before it has begun.
    void add(Begin begin, std::stop_token withdrawn = {});
    /// What is large takes long to destroy, too.
    void discard(std::shared_ptr<void> what);
    /// Nothing is begun or taken up any more.
    void stop();
    /// For work that takes long: nobody waits for it any more. On any thread.
    [[nodiscard]] std::stop_token stopping() const { return stopping_.get_token(); }

  private:
    struct Waiting {
        Begin begin;
        std::stop_token withdrawn;
    };

    void forget_withdrawn();
    void next();

    boost::asio::any_io_executor io_;
    std::deque<Waiting> waiting_;
    bool busy_ = false;
    std::stop_source stopping_;
    /// Null once stopped; what was posted to the I/O thread may come after this.
    std::shared_ptr<Loader*> here_ = std::make_shared<Loader*>(this);
    boost::asio::thread_pool thread_{1};
};

}  // namespace scipd::daemon
