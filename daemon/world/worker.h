// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A second thread for work that takes long, so that no stream waits for it: loading worlds, making
// and measuring backends. It does one thing after the other, in the order they were asked for. When
// all is done, it gives free memory back to the system. Lives on the I/O thread.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <stop_token>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/thread_pool.hpp>

namespace scipd::daemon {

class Worker {
  public:
    /// Takes up the result. Called on the I/O thread.
    using Finish = std::function<void()>;
    /// Called on the worker's thread, and destroyed there. It touches nothing that the I/O thread
    /// uses, and does not throw. What belongs to the I/O thread it moves into the Finish.
    using Work = std::function<Finish()>;
    /// Called on the I/O thread, when all results before it are taken up. It copies into the Work
    /// what that needs of the present state.
    using Begin = std::function<Work()>;

    /// `frees`: whether it gives memory back.
    explicit Worker(boost::asio::any_io_executor io, bool frees = true)
        : io_(std::move(io)), frees_(frees) {}
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// The work leaves the queue where `withdrawn` is requested before it has begun.
    void add(Begin begin, std::stop_token withdrawn = {});
    /// Destroys it on the worker's thread, since large things take long to destroy, too.
    void discard(std::shared_ptr<void> what);
    /// From now on no work is begun and no result is taken up.
    void stop();
    /// Tells work that nobody waits for it any more. Any thread may ask.
    [[nodiscard]] std::stop_token stopping() const { return stopping_.get_token(); }

  private:
    struct Waiting {
        Begin begin;
        std::stop_token withdrawn;
    };

    void forget_withdrawn();
    void next();

    boost::asio::any_io_executor io_;
    bool frees_;
    std::deque<Waiting> waiting_;
    bool busy_ = false;
    std::stop_source stopping_;
    /// Points to null once this has stopped: handlers that were posted to the I/O thread may run
    /// after it is gone.
    std::shared_ptr<Worker*> here_ = std::make_shared<Worker*>(this);
    boost::asio::thread_pool thread_{1};
};

}  // namespace scipd::daemon
