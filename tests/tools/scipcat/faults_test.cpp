// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Whatever is wrong, scipcat says so in one sentence and ends with the right code: 1 failed while
// running, 2 wrong options.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "daemon/models/model_registry.h"
#include "tests/support/scripted_peer.h"
#include "tests/support/temp_dir.h"
#include "tests/tools/scipcat/room.h"
#include "tests/tools/scipcat/scipcat.h"

namespace scipd::tests {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

void expect_failure(const std::vector<std::string>& words, int exit_code,
                    const std::string& sentence) {
    const Outcome outcome = run_scipcat(words);
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, AllOf(StartsWith("scipcat: "), HasSubstr(sentence), EndsWith("\n")));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
}

TEST(ScipcatFaults, OptionsEndWithTwo) {
    expect_failure({}, 2, "name a command; there are: info, record, plot");
    expect_failure({"info"}, 2, "TARGET is required");
    expect_failure({"info", "lidar"}, 2, "\"lidar\" is no scanner: write tcp://HOST:PORT");
    expect_failure({"info", "tcp://a:x"}, 2, "\"tcp://a:x\" is no address");
    expect_failure({"record", "tcp://127.0.0.1:1"}, 2, "--output is required");
    expect_failure({"record", "tcp://127.0.0.1:1", "-o", "room.txt"}, 2,
                   "\"room.txt\" ends in none of .mcap, .ubh, .csv and .jsonl");
    expect_failure({"plot", "tcp://127.0.0.1:1", "-o", "room.gif"}, 2,
                   "\"room.gif\" ends in none of .png and .svg");
    expect_failure({"record", "tcp://127.0.0.1:1", "-o", "a.csv", "-n", "0"}, 2, "--scans");
    expect_failure({"record", "tcp://127.0.0.1:1", "-o", "a.csv", "--cluster", "100"}, 2,
                   "--cluster");
    expect_failure({"info", "tcp://127.0.0.1:1", "--baud", "123"}, 2,
                   "--baud: must be a whole number from 1200 to 4000000, not \"123\"");
    expect_failure({"plot", "tcp://127.0.0.1:1", "--colour", "error"}, 2,
                   "there is no option --colour; did you mean --color?");
}

TEST(ScipcatFaults, HelpEndsWithZero) {
    const Outcome outcome = run_scipcat({"record", "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, HasSubstr("Examples:"));
}

TEST(ScipcatFaults, TellsItsVersion) {
    const Outcome outcome = run_scipcat({"--version"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out, "scipcat " SCIPD_VERSION "\n");
}

TEST(ScipcatFaults, TellsAnUnknownHost) {
    expect_failure({"info", "tcp://no-such-host.invalid:10940"}, 1,
                   "there is no host \"no-such-host.invalid\"");
}

TEST(ScipcatFaults, TellsAClosedPort) {
    const int port = [] {
        const ScriptedPeer gone("");
        const std::string target = gone.target();
        return std::stoi(target.substr(target.rfind(':') + 1));
    }();
    expect_failure(
        {"info", "tcp://127.0.0.1:" + std::to_string(port)}, 1,
        "cannot connect to 127.0.0.1 port " + std::to_string(port) + ": Connection refused");
}

TEST(ScipcatFaults, TellsAMissingTtyAndWhatIsNone) {
    expect_failure({"info", "/dev/no-such-tty"}, 1,
                   "cannot open /dev/no-such-tty: No such file or directory");
    expect_failure({"info", "/dev/null"}, 1, "/dev/null is no tty");
}

TEST(ScipcatFaults, TellsWhoDoesNotSpeakScip) {
    const ScriptedPeer ssh("SSH-2.0-OpenSSH_9.2p1 Debian-2\r\n");
    expect_failure({"info", ssh.target(), "--timeout", "0.1"}, 1,
                   "what answers there does not speak SCIP (waited for QT, heard "
                   "\"SSH-2.0-OpenSSH_9.2p1 Debian-2..\")");
}

TEST(ScipcatFaults, TellsWhoSaysNothing) {
    const ScriptedPeer silent("");
    expect_failure({"info", silent.target(), "--timeout", "0.1"}, 1,
                   "no answer to QT within 100 ms; a scanner serves one client at a time: is "
                   "another program connected?");
}

TEST(ScipcatFaults, TellsWhoHangsUp) {
    const ScriptedPeer gone("", ScriptedPeer::Then::hang_up);
    expect_failure({"info", gone.target()}, 1, "the ");
}

TEST(ScipcatFaults, TellsWhatTheScannerRefusesAndWritesNoFile) {
    const RoomScanner scanner(daemon::find_model("UST-10LX").profile);
    const TempDir directory;
    const auto file = directory.path() / "room.csv";
    expect_failure({"record", scanner.tcp_target(), "-o", file, "--end", "1081"}, 1,
                   "refused MD0000108101000 with status 04: the scanner has no such step");
    expect_failure({"record", scanner.tcp_target(), "-o", file, "--start", "9", "--end", "1"}, 1,
                   "refused MD0009000101000 with status 05: the last step lies before the first");
    expect_failure({"record", scanner.tcp_target(), "-o", file, "--echoes"}, 1,
                   "with status 0F: the scanner does not support the command");
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(ScipcatFaults, TellsAFileThatCannotBeWritten) {
    const RoomScanner scanner(daemon::find_model("UST-10LX").profile);
    expect_failure({"record", scanner.tcp_target(), "-o", "/no/such/folder/room.csv"}, 1,
                   "cannot write /no/such/folder/room.csv: No such file or directory");
    for (const std::string ending : {".png", ".svg"}) {
        expect_failure({"plot", scanner.tcp_target(), "-o", "/no/such/folder/room" + ending}, 1,
                       "cannot write /no/such/folder/room" + ending);
    }
}

}  // namespace
}  // namespace scipd::tests
