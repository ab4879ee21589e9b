// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipd writes its log to a pipe that nobody reads.
#include <array>
#include <csignal>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/end_to_end/in_square_room.h"

namespace scipd::tests {
namespace {

class FullPipe {
  public:
    FullPipe() {
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
        const std::string bytes(static_cast<std::size_t>(::fcntl(ends_[1], F_GETPIPE_SZ)), '.');
        if (::write(ends_[1], bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
            throw std::runtime_error("the pipe is not full");
    }
    ~FullPipe() {
        ::close(ends_[0]);
        ::close(ends_[1]);
    }
    FullPipe(const FullPipe&) = delete;
    FullPipe& operator=(const FullPipe&) = delete;

    [[nodiscard]] int descriptor() const { return ends_[1]; }

  private:
    std::array<int, 2> ends_{};
};

TEST(Log, ThatNobodyReadsHoldsNobodyUp) {
    const TempDir directory;
    const FullPipe error;
    DaemonProcess daemon(directory, on_tcp(), {.error = error.descriptor()});
    ASSERT_NE(daemon.ready_line(), "");
    ScannerWire wire = ScannerWire::tcp(daemon.port());
    EXPECT_EQ(wire.ask(stream_of_one_beam), "00");
    std::uint32_t stamp_ms = wire.next_scan().stamp_ms;
    for (int i = 0; i < 40; ++i) {
        daemon.signal(SIGHUP);  // warns, as there is no configuration to read again
        EXPECT_EQ(daemon.get("/sensors").size(), 1U);
        const std::uint32_t next_ms = wire.next_scan().stamp_ms;
        ASSERT_EQ(turns_between(stamp_ms, next_ms), 1);
        stamp_ms = next_ms;
    }
    daemon.signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0);
}

}  // namespace
}  // namespace scipd::tests
