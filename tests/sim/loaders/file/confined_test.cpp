// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/confined.h"

#include <csignal>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/sanitized.h"

namespace scipd::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const Confines roomy{.processor_time = std::chrono::seconds{20},
                     .memory_bytes = std::size_t{1} << 30};

std::string outcome(const Confines& confines, const std::function<void(std::FILE*)>& work) {
    try {
        const File file = run_confined(confines, work);
        std::string text(100, '\0');
        text.resize(std::fread(text.data(), 1, text.size(), file.get()));
        return text;
    } catch (const std::runtime_error& error) {
        return std::string("error: ") + error.what();
    }
}

TEST(Confined, handsOverWhatWasWritten) {
    EXPECT_EQ(outcome(roomy, [](std::FILE* out) { std::fputs("all of it", out); }), "all of it");
    EXPECT_EQ(outcome(roomy, [](std::FILE*) {}), "");
}

TEST(Confined, handsOverWhatWasThrownAndNothingElse) {
    EXPECT_EQ(outcome(roomy,
                      [](std::FILE* out) {
                          std::fputs("a beginning that is longer than the reason", out);
                          std::fflush(out);
                          throw std::runtime_error("the reason");
                      }),
              "error: the reason");
}

TEST(Confined, changesNothingHere) {
    int touched = 0;
    EXPECT_EQ(outcome(roomy, [&](std::FILE*) { touched = 1; }), "");
    EXPECT_EQ(touched, 0);
}

// The other end of a connection that is closed here meanwhile is told so.
TEST(Confined, keepsNoFileOpenButItsOwn) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const auto open_there = [&](std::FILE* out) {
        const bool any = fcntl(ends[0], F_GETFD) >= 0 || fcntl(ends[1], F_GETFD) >= 0;
        std::fputs(any ? "open" : "closed", out);
    };
    EXPECT_EQ(outcome(roomy, open_there), "closed");
    EXPECT_GE(fcntl(ends[0], F_GETFD), 0);
    close(ends[0]);
    close(ends[1]);
}

// sdf::Exception is such a thing; past it the child would go on as if it were this process.
TEST(Confined, endsWithWhatIsNoException) {
    EXPECT_THAT(outcome(roomy, [](std::FILE*) { throw 42; }),
                StartsWith("error: ended with an unknown"));
}

TEST(Confined, survivesACrash) {
    EXPECT_THAT(outcome(roomy,
                        [](std::FILE*) {
                            // By hand and by default, since sanitizers have a handler of their own.
                            std::signal(SIGSEGV, SIG_DFL);
                            std::raise(SIGSEGV);
                        }),
                HasSubstr("crashes the library that reads it (signal 11)"));
}

TEST(Confined, endsWhatNeverEnds) {
    const Confines short_of_time{.processor_time = std::chrono::seconds{1},
                                 .memory_bytes = roomy.memory_bytes};
    EXPECT_THAT(outcome(short_of_time,
                        [](std::FILE*) {
                            volatile bool goes_on = true;
                            while (goes_on)
                                continue;
                        }),
                HasSubstr("takes more than 1 s of processor time"));
}

/// What waits for ever and takes no processor time: a FIFO, a disk that does not answer.
void wait_for_ever(std::FILE* /*out*/) {
    while (true)
        pause();
}

TEST(Confined, endsWhatWaitsForEver) {
    Confines short_of_time = roomy;
    short_of_time.wall_time = std::chrono::milliseconds{50};
    EXPECT_THAT(outcome(short_of_time, wait_for_ever),
                StartsWith("error: was not read within 1 s"));
}

TEST(Confined, endsWhatNobodyWaitsForAnyMore) {
    std::stop_source stop;
    Confines stoppable = roomy;
    stoppable.stop = stop.get_token();
    const std::jthread asks([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds{50});
        stop.request_stop();
    });
    EXPECT_EQ(outcome(stoppable, wait_for_ever), "error: was not read to its end");
}

std::size_t open_descriptors() {
    const std::filesystem::directory_iterator all{"/proc/self/fd"};
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

TEST(Confined, leavesNothingOpenAndNobodyBehind) {
    Confines short_of_time = roomy;
    short_of_time.wall_time = std::chrono::milliseconds{1};
    const auto before = open_descriptors();
    for (int i = 0; i < 10; ++i) {
        (void)outcome(short_of_time, wait_for_ever);
        (void)outcome(roomy, [](std::FILE*) { throw std::runtime_error("x"); });
        (void)outcome(roomy, [](std::FILE*) {});
    }
    EXPECT_EQ(open_descriptors(), before);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
}

TEST(Confined, opensFewFilesAtOnce) {
    EXPECT_EQ(outcome(roomy,
                      [](std::FILE* out) {
                          int count = 0;
                          while (count < 10'000 && open("/dev/null", O_RDONLY) >= 0)
                              ++count;
                          std::fputs(count < 1025 ? "few" : "many", out);
                      }),
              "few");
}

TEST(Confined, refusesMemoryPastItsLimit) {
    if (tests::sanitized) GTEST_SKIP() << tests::sanitizers_want_memory;
    EXPECT_THAT(outcome(roomy,
                        [](std::FILE* out) {
                            const std::string large(std::size_t{3} << 30, 'x');
                            std::fwrite(large.data(), 1, 100, out);
                        }),
                StartsWith("error: takes more than 1073 MB of memory"));
}

}  // namespace
}  // namespace scipd::sim
