// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/tty_opens.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include <sys/inotify.h>
#include <sys/poll.h>
#include <unistd.h>

#include "daemon/link/descriptors.h"

namespace scipd::daemon {

// The kernel merges an event with an equal one right before it: of two drivers that open the tty
// while this thread is busy one would be missed. So each of them is told twice, by the folder and
// by the tty, and none is like the one before it. Writes are told by the tty alone: others write to
// other terminals.
void TtyOpens::begin(const std::filesystem::path& terminal) {
    const std::string what = "cannot use " + terminal.string();
    if (events_.is_open()) {
        ::inotify_rm_watch(events_.native_handle(), watch_);
    } else {
        give(events_, ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC), what);
    }
    opens_ = 0;
    missed_ = false;
    const auto watch = [&](const std::filesystem::path& path, std::uint32_t events) {
        return checked(::inotify_add_watch(events_.native_handle(), path.c_str(), events), what);
    };
    watch_ = watch(terminal, IN_OPEN | IN_CLOSE | IN_MODIFY);
    watch(terminal.parent_path(), IN_OPEN | IN_CLOSE);
}

void TtyOpens::end() {
    boost::system::error_code ignored;
    events_.close(ignored);
    opens_ = 0;
    missed_ = false;
}

TtyOpens::News TtyOpens::look(const Ask& somebody_else, const Ask& unread) {
    const bool were_any = any();
    News news;
    Writes writes;
    closes_ = 0;
    bool all = read(news, writes);
    // Bytes of whoever has just come are here before the kernel tells of the write.
    if (all && news.closed && !writes.last && !writes.before && unread() && any()) {
        pollfd told{.fd = events_.native_handle(), .events = POLLIN, .revents = 0};
        constexpr int patience_ms = 1;
        if (::poll(&told, 1, patience_ms) == 1) all = read(news, writes);
    }
    if (!all || (missed_ && closes_ > 0)) {
        count_anew(somebody_else);
        news.closed = news.closed || !any();
        news.opened = news.closed || !were_any;
    }
    news.opened = news.opened && any();
    news.next_was_heard = all && writes.last && !writes.before;
    news.last_has_written = !all || writes.before;
    return news;
}

bool TtyOpens::read(News& news, Writes& writes) {
    alignas(inotify_event) std::array<char, 4096> buffer;
    bool all = true;
    for (;;) {
        const ssize_t count = ::read(events_.native_handle(), buffer.data(), buffer.size());
        if (count <= 0) return all;
        for (ssize_t at = 0; at < count;) {
            inotify_event event;
            std::memcpy(&event, buffer.data() + at, sizeof(event));
            at += static_cast<ssize_t>(sizeof(event) + event.len);
            if ((event.mask & IN_Q_OVERFLOW) != 0) all = false;
            if (event.wd != watch_) continue;
            if ((event.mask & IN_MODIFY) != 0) writes.last = true;
            if ((event.mask & IN_OPEN) != 0 && ++opens_ == 1) news.opened = true;
            if ((event.mask & IN_CLOSE) == 0) continue;
            ++closes_;
            if (opens_ == 0 || --opens_ > 0) continue;
            news.closed = true;
            writes.before = writes.before || std::exchange(writes.last, false);
        }
    }
}

// Where nobody else has it open the count is right again: the answer's own events come behind those
// that were dropped. Else it is known only that it is not 0, and the next close asks again.
void TtyOpens::count_anew(const Ask& somebody_else) {
    constexpr int own = 1;
    News none;
    Writes unknown;
    bool all = true;
    do {
        missed_ = somebody_else();
        opens_ = 0;
        closes_ = 0;
        all = read(none, unknown);
        opens_ = missed_ ? 1 : std::max(0, opens_ - own);
        // Who closed it meanwhile may have been the one.
    } while (!all || (missed_ && closes_ > own));
}

}  // namespace scipd::daemon
