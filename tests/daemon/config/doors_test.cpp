// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The keys that say who may come in.
#include <filesystem>

#include <gmock/gmock.h>
#include <grp.h>

#include "tests/daemon/config/config_fixture.h"

namespace scipd::daemon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;
namespace fs = std::filesystem;

const std::string secret = "0123456789abcdef";

class DoorsTest : public ConfigFixture {
  protected:
    DoorsTest() { write_token(secret + "\n\n"); }

    void write_token(const std::string& text, fs::perms mode = fs::perms(0640)) const {
        fs::permissions(dir_.write("token", text), mode);
    }

    /// In line 3 of a configuration.
    static std::string rooted(const std::string& text) {
        return "scene: room.sdf\nrobots: {r: {sensors: {s: {pty: auto, model: UST-10LX}}}}\n" +
               text;
    }
};

TEST_F(DoorsTest, AMapSaysWhereHttpListensAndForWhom) {
    const Config config = parse(rooted("http: {listen: 0.0.0.0:8080, token_file: token}"));
    EXPECT_EQ(config.http, (Address{"0.0.0.0", 8080}));
    EXPECT_EQ(config.http_token, secret);
    const Config loopback = parse(rooted("http: {listen: localhost:0}"));
    EXPECT_EQ(loopback.http, (Address{"127.0.0.1", 0}));
    EXPECT_EQ(loopback.http_token, "");
}

TEST_F(DoorsTest, WhatOtherMachinesReachNeedsAToken) {
    EXPECT_THAT(faults(rooted("http: 0.0.0.0:8080")),
                ElementsAre("rig.yaml:3: http: other machines reach 0.0.0.0:8080: in a "
                            "configuration, http: {listen: ADDRESS:PORT, token_file: FILE} lets in "
                            "who has the token; or use 127.0.0.1"));
    EXPECT_THAT(faults(rooted("http:\n  listen: \"[::]:0\"")),
                ElementsAre(StartsWith("rig.yaml:4: http.listen: other machines reach [::]:0")));
    for (const char* address : {"127.0.0.1:0", "127.8.0.1:0", "localhost:0", "'[::1]:0'", "none"})
        EXPECT_THAT(faults(rooted("http: " + std::string(address))), IsEmpty()) << address;
}

TEST_F(DoorsTest, ATokenIsLongAndForNobodyElse) {
    const auto why = [&] {
        return faults(rooted("http: {listen: 0.0.0.0:80, token_file: token}"));
    };
    const std::string place = "rig.yaml:3: http.token_file: ";
    write_token(secret, fs::perms(0644));
    EXPECT_THAT(why(), ElementsAre(place + "others may read or write 'token'; `chmod o= FILE` "
                                           "forbids it"));
    write_token(secret, fs::perms(0660));
    EXPECT_THAT(why(), ElementsAre(place + "its group may write 'token'; `chmod g-w FILE` forbids "
                                           "it"));
    write_token("root:$y$j9T$0123456789abcdef:20000:0:99999:7:::\ndaemon:*:20000:0:99999:7:::\n");
    EXPECT_THAT(why(), ElementsAre(place + "'token' has more than one line; a file with a secret "
                                           "holds nothing else"));
    for (const std::string& text : {std::string(), secret.substr(1), secret + " x",
                                    std::string(1025, 'x'), secret + "\x80"}) {
        write_token(text);
        EXPECT_THAT(why(), ElementsAre(StartsWith(place + "the first line of 'token' must be")));
    }
    write_token(secret + "\r\n");
    EXPECT_EQ(parse(rooted("http: {listen: 0.0.0.0:80, token_file: token}")).http_token, secret);
}

TEST_F(DoorsTest, TellWhatIsMissingOrUnknown) {
    EXPECT_THAT(faults(rooted("http: {token_file: token}")),
                ElementsAre("rig.yaml:3: http: needs listen: ADDRESS:PORT"));
    EXPECT_THAT(faults(rooted("http: {listen: 127.0.0.1:0, token_file: no}")),
                ElementsAre("rig.yaml:3: http.token_file: there is no file 'no'"));
    EXPECT_THAT(faults(rooted("control:\n  socket: c.sock\n  group: no-such-group")),
                ElementsAre("rig.yaml:5: control.group: there is no group 'no-such-group'; "
                            "`getent group` lists them"));
}

TEST_F(DoorsTest, TheControlSocketMayHaveAGroup) {
    const group* const root = ::getgrgid(0);
    ASSERT_NE(root, nullptr);
    const Config config =
        parse(rooted("control: {socket: c.sock, group: " + std::string(root->gr_name) + "}"));
    EXPECT_EQ(config.control, dir_.path() / "c.sock");
    EXPECT_EQ(config.control_group, 0U);
    EXPECT_EQ(parse(rooted("control: c.sock")).control_group, std::nullopt);
}

TEST_F(DoorsTest, FilesMayBeReadFromTheFoldersOfTheConfigurationAndItsScene) {
    dir_.write("worlds/room.sdf", "");
    EXPECT_THAT(parse("scene: worlds/room.sdf\nrobots: {r: {sensors: {s: {pty: auto, model: "
                      "UST-10LX}}}}")
                    .allow,
                ElementsAre(dir_.path(), dir_.path() / "worlds"));
    EXPECT_THAT(parse(rooted("allow: [worlds, /tmp]")).allow,
                ElementsAre(dir_.path() / "worlds", "/tmp"));
    EXPECT_THAT(parse(rooted("allow: []")).allow, IsEmpty());
    EXPECT_THAT(faults(rooted("allow: worlds")),
                ElementsAre("rig.yaml:3: allow: must be a list of folders, such as [worlds]"));
    EXPECT_THAT(faults(rooted("allow: [nowhere, room.sdf]")),
                ElementsAre("rig.yaml:3: allow: there is no file 'nowhere'",
                            "rig.yaml:3: allow: 'room.sdf' is a file; name its folder"));
}

}  // namespace
}  // namespace scipd::daemon
