// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How often a terminal is open, as inotify tells it: who comes first, and who goes last. The kernel
// drops events that nobody reads in time. Then the terminal itself is asked, until the count is
// right again. Lives on its shard.
#pragma once

#include <filesystem>
#include <functional>
#include <utility>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

namespace scipd::daemon {

class TtyOpens {
  public:
    explicit TtyOpens(const boost::asio::any_io_executor& executor) : events_(executor) {}

    /// Counts the opens of this terminal from now on, in place of another one. Throws
    /// std::system_error.
    void begin(const std::filesystem::path& terminal);
    void end();

    [[nodiscard]] bool any() const { return opens_ > 0; }

    /// What has happened since the last look.
    struct News {
        bool opened = false;  ///< somebody has come where nobody was
        bool closed = false;  ///< the last one has gone; another one may have come
        /// Whoever has it open has written, and nobody before has: all that can be read is theirs.
        bool next_was_heard = false;
        bool last_has_written = false;  ///< who has gone may have
    };
    /// Whether somebody else has the terminal open now: it closes the terminal and opens it again,
    /// once each.
    using Ask = std::function<bool()>;
    /// `unread`: whether bytes have come that nobody has looked at. Asked where the last one has
    /// gone.
    [[nodiscard]] News look(const Ask& somebody_else, const Ask& unread);

    /// Calls it once, when there may be news; with an error after end().
    template <class Call>
    void async_wait(Call call) {
        events_.async_wait(boost::asio::posix::stream_descriptor::wait_read, std::move(call));
    }

  private:
    struct Writes {
        bool last = false;    ///< by whoever has it open
        bool before = false;  ///< by whoever has closed it
    };

    /// False: the kernel has dropped events.
    [[nodiscard]] bool read(News& news, Writes& writes);
    void count_anew(const Ask& somebody_else);

    boost::asio::posix::stream_descriptor events_;
    int watch_ = -1;  ///< what the terminal's own events are marked with
    int opens_ = 0;
    int closes_ = 0;       ///< that were read, since it was last set to 0
    bool missed_ = false;  ///< events: the count may be wrong
};

}  // namespace scipd::daemon
