// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scipd for a test begins: where it listens, what it is, and why it does not.
#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing/find_program.h"
#include "testing/scipd_command.h"
#include "testing/scipd_test.h"
#include "tests/support/temp_dir.h"
#include "tests/testing/room.h"

namespace {

using namespace scipd::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Starting = ScipdTest;

/// What a call throws, as text.
template <class Error, class Call>
std::string thrown_by(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

TEST_F(Starting, ListensWhereItSays) {
    Scipd& scipd = start({.world = room});
    EXPECT_EQ(scipd.host(), "127.0.0.1");
    EXPECT_GT(scipd.port(), 0);
    EXPECT_TRUE(std::filesystem::exists(scipd.tty()));
    EXPECT_TRUE(std::filesystem::is_socket(scipd.control()));
    EXPECT_THAT(scipd.http(), HasSubstr("http://127.0.0.1:"));
    EXPECT_THAT(scipd.sensors(), ElementsAre("robot/scanner"));
    EXPECT_EQ(scipd.ask("GET", "/health"), Json({{"ready", true}, {"alive", true}}));
    EXPECT_EQ(scipd.ask("GET", "/sensors/robot/scanner").at("model"), "UST-10LX");
    EXPECT_THAT(scipd.ask("GET", "/metrics").get<std::string>(), HasSubstr("scipd_"));
    EXPECT_FALSE(scipd.exit_code());
}

TEST_F(Starting, TakesAConfiguration) {
    const Json mount{{"xyz", {0, 0, 0.3}}};
    const Json front{{"model", "UST-10LX"}, {"tcp", "127.0.0.1:0"}, {"mount", mount}};
    const Json rear{{"model", "URG-04LX"}, {"pty", "auto"}, {"mount", mount}};
    const Json sensors{{"front", front}, {"rear", rear}};
    const Json config{{"scene", room.string()}, {"robots", {{"cart", {{"sensors", sensors}}}}}};
    Scipd& scipd = start({.config = config, .seed = 3});
    EXPECT_THAT(scipd.sensors(), ElementsAre("cart/front", "cart/rear"));
    EXPECT_GT(scipd.port("front"), 0);
    EXPECT_THROW((void)scipd.port("rear"), std::invalid_argument);
    EXPECT_THROW((void)scipd.robot("other"), std::invalid_argument);
    EXPECT_NEAR(scipd.scan("rear").at(0).value(), 3.0, 0.1);
    EXPECT_TRUE(scipd.scan("rear").intensities.empty());
    scipd.robot().set_pose({1, 0, 0});
    EXPECT_NEAR(scipd.robot("cart").pose().x_m, 1, 1e-9);
}

TEST_F(Starting, SaysWhyItDoesNot) {
    EXPECT_THAT(thrown_by<ScipdNotReady>([] { Scipd scipd({.world = "nowhere.sdf"}); }),
                AllOf(HasSubstr("ended with exit code 2"), HasSubstr("nowhere.sdf")));
    EXPECT_THAT(thrown_by<ScipdNotReady>([] { Scipd scipd({.model = "UST-99"}); }),
                HasSubstr("UST-99"));
    EXPECT_THAT(thrown_by<std::invalid_argument>(
                    [] { Scipd scipd({.config = "rig.yaml", .accuracy = "ideal"}); }),
                HasSubstr("it stands there"));
}

TEST(CommandLine, LeavesToArgsWhatTheyHave) {
    const Options options{.world = "w.sdf", .args = {"--mount=0,0,1,0,0,0", "--pty", "none"}};
    EXPECT_THAT(command_for(options, "scipd", "/f"),
                ElementsAre("scipd", "--control", "/f/control.sock", "--http", "127.0.0.1:0",
                            "--clock", "wall", "--scene", "w.sdf", "--model", "UST-10LX", "--tcp",
                            "127.0.0.1:0", "--mount=0,0,1,0,0,0", "--pty", "none"));
}

/// Has a variable of the environment for the time of a test.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* const before = std::getenv(name)) before_ = before;
        ::setenv(name, value.c_str(), 1);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }

  private:
    const char* name_;
    std::optional<std::string> before_;
};

TEST(Program, IsWhatSCIPDNamesThenOnThePathThenBesideTheTest) {
    const scipd::tests::TempDir folder;
    const auto make = [&](const std::string& name) {
        const auto file = folder.write(name, "#!/bin/sh\n");
        permissions(file, std::filesystem::perms::owner_all);
        return file;
    };
    const auto named = make("a/mine");
    const auto on_path = make("b/scipd");
    const Variable path("PATH", (folder.path() / "b").string());
    const Variable nobody("SCIPD", "");
    EXPECT_EQ(find_program(), on_path);
    {
        const Variable ours("SCIPD", named);
        EXPECT_EQ(find_program(), named);
        const Variable nowhere("SCIPD", "/nowhere/scipd");
        EXPECT_THAT(thrown_by<ScipdNotFound>([] { (void)find_program(); }),
                    HasSubstr("SCIPD names /nowhere/scipd"));
    }
    std::filesystem::remove(on_path);
    const auto here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    EXPECT_EQ(find_program(), here / "scipd");
}

}  // namespace
