// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Plays every dialogue, and sees to it that together they miss neither a command nor a model. That
// the player itself can say no is tested first.
#include "tests/protocol/dialogue.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "protocol/command_table.h"
#include "tests/protocol/test_profile.h"

namespace scipd::protocol {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string head = "# source: made up for this test\nmodel: TEST\ntiming: ideal\n";

std::string played(const std::string& text) {
    return play(parse_dialogue("it", head + text), test_profile());
}

std::string refused(const std::string& text) {
    try {
        (void)parse_dialogue("it", text);
    } catch (const std::invalid_argument& fault) {
        return fault.what();
    }
    return {};
}

TEST(DialoguePlayer, AgreesWhenAllBytesDo) {
    EXPECT_THAT(played("> BM\n< BM\n< 00P\n<\nat 100 ms\n>> QT\\r\\n\n< QT\n< 00P\n<\n"),
                IsEmpty());
}

TEST(DialoguePlayer, NamesTheLineThatDiffers) {
    EXPECT_THAT(played("> BM\n< BM\n< 02R\n<\n"),
                HasSubstr("it:6: expected \"02R\", but there came \"00P\""));
    EXPECT_THAT(played("> BM\n< BM \n< 00P\n<\n"), HasSubstr("it:5: "));
}

TEST(DialoguePlayer, MissesWhatDoesNotCome) {
    EXPECT_THAT(played("> BM\n< BM\n< 00P\n<\n<\n"),
                HasSubstr("it:8: expected \"\", but nothing more came"));
    EXPECT_THAT(played("at 5 ms\n< BM\n"),
                HasSubstr("it:5: expected \"BM\", but nothing more came"));
}

TEST(DialoguePlayer, RefusesWhatNobodyExpects) {
    EXPECT_THAT(played("> BM\n< BM\n< 00P\n"), HasSubstr("it:6: more came than expected"));
    EXPECT_THAT(played("> BM\n"),
                HasSubstr("it:4: at 0 ms nothing is expected, but there came \"BM"));
    EXPECT_THAT(played("> BM\nat 5 ms\n"), HasSubstr("it:5: at 0 ms nothing is expected"));
    EXPECT_THAT(played("> BM\n> QT\n"), HasSubstr("it:5: at 0 ms nothing is expected"));
}

TEST(DialoguePlayer, HoldsEveryByteToItsInstant) {
    const std::string stream = "distance: 1000\n> MD0002000201001\n< MD0002000201001\n< 00P\n<\n";
    const std::string scan = "< MD0002000201000\n< 99b\n< 00000\n< 0?X7\n<\n";
    EXPECT_THAT(played(stream + "at 18.75 ms\n" + scan), IsEmpty());
    EXPECT_THAT(played(stream + "at 18.74 ms\n" + scan), HasSubstr("nothing more came"));
    EXPECT_THAT(played(stream + "at 18.76 ms\n" + scan),
                HasSubstr("at 18.75 ms nothing is expected"));
}

TEST(DialoguePlayer, HoldsTheLinkToWhatIsSaid) {
    const std::string reboot = "> RB\n< RB\n< 01Q\n<\n> RB\n< RB\n< 00P\n<\nat 1000 ms\n";
    EXPECT_THAT(played(reboot + "link drops\n"), IsEmpty());
    EXPECT_THAT(played(reboot), HasSubstr("the link drops or changes its rate"));
    EXPECT_THAT(played(reboot + "rate 19200\n"), HasSubstr("which are not just this"));
    EXPECT_THAT(played("link drops\n"), HasSubstr("it:4: the link does 0 things"));
}

TEST(DialogueParser, DemandsASource) {
    EXPECT_THAT(refused(""), HasSubstr("it:1: "));
    EXPECT_THAT(refused("model: TEST\n"), HasSubstr("it:1: the first line must say"));
    EXPECT_THAT(refused("# a comment\n# source: too late, this one\nmodel: TEST\n"),
                HasSubstr("it:1: "));
    EXPECT_THAT(refused("# source: \nmodel: TEST\n"), HasSubstr("it:1: "));
}

TEST(DialogueParser, SaysWhatItDoesNotUnderstand) {
    EXPECT_THAT(refused(head + "whatever\n"), HasSubstr("it:4: not understood: whatever"));
    EXPECT_THAT(refused(head + "> VV\ntiming: real\n"), HasSubstr("it:5: not understood"));
    EXPECT_THAT(refused(head + "at soon\n"), HasSubstr("it:4: "));
    EXPECT_THAT(refused(head + "<VV\n"), HasSubstr("it:4: "));
    EXPECT_THAT(refused(head + "> \\q\n"), HasSubstr("it:4: the escapes are"));
    EXPECT_THAT(refused(head + "> \\x0\n"), HasSubstr("it:4: "));
    EXPECT_THAT(refused("# source: made up for this test\n> VV\n"),
                HasSubstr("it: names no model"));
}

std::vector<std::filesystem::path> dialogue_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(SCIPD_DIALOGUES)) {
        if (entry.path().extension() == ".txt") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

class DialogueFile : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(DialogueFile, IsAnsweredByteForByte) {
    const Dialogue dialogue = read_dialogue(GetParam());
    EXPECT_EQ(play(dialogue, daemon::find_model(dialogue.model).profile), "");
}

INSTANTIATE_TEST_SUITE_P(All, DialogueFile, ::testing::ValuesIn(dialogue_files()),
                         [](const auto& file) {
                             std::string name = file.param.stem().string();
                             std::replace_if(
                                 name.begin(), name.end(),
                                 [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                             return name;
                         });

std::set<std::string_view> commands_said(const Dialogue& dialogue) {
    DeviceProfile profile = daemon::find_model(dialogue.model).profile;
    profile.io_lines |= dialogue.io_lines;
    std::set<std::string_view> commands;
    for (const Step& step : dialogue.steps) {
        const auto* say = std::get_if<Say>(&step.what);
        const Command* command = say == nullptr ? nullptr : find_command(say->bytes, profile);
        if (command != nullptr) commands.insert(command->code);
    }
    return commands;
}

TEST(Dialogues, MissNoModelAndNoCommandOfAnyFamily) {
    std::set<std::string> models;
    std::map<Family, std::set<std::string_view>> commands;
    for (const auto& file : dialogue_files()) {
        const Dialogue dialogue = read_dialogue(file);
        const DeviceProfile& profile = daemon::find_model(dialogue.model).profile;
        models.insert(profile.name + "@" + profile.release);
        commands[profile.family].merge(commands_said(dialogue));
    }
    for (const daemon::Model& model : daemon::models()) {
        const std::string name = model.profile.name + "@" + model.profile.release;
        EXPECT_TRUE(models.contains(name)) << name << " is in no dialogue";
        for (const Command& command : command_table()) {
            const Family family = model.profile.family;
            if (!command.gate(family).known()) continue;
            EXPECT_TRUE(commands[family].contains(command.code))
                << command.code << " is in no dialogue with a model of the family of " << name;
        }
    }
}

std::set<std::string> statuses_heard(const Dialogue& dialogue) {
    std::set<std::string> heard;
    for (const Step& step : dialogue.steps) {
        const auto* hear = std::get_if<Hear>(&step.what);
        if (hear == nullptr) continue;
        std::string_view rest = hear->bytes;
        while (!rest.empty()) {
            heard.emplace(rest.substr(rest.find('\n') + 1, 2));
            rest.remove_prefix(std::min(rest.find("\n\n"), rest.size() - 2) + 2);
        }
    }
    return heard;
}

TEST(Dialogues, MissNoStatus) {
    std::set<std::string> heard;
    for (const auto& file : dialogue_files())
        heard.merge(statuses_heard(read_dialogue(file)));
    for (const auto status : {"00", "01", "02", "03", "04", "05", "06", "07", "10", "21", "50",
                              "98", "99", "0C", "0D", "0E", "0F", "0G", "0H", "0L", "0M"})
        EXPECT_TRUE(heard.contains(status)) << status;
    // Nothing leads to these: see protocol/status.h.
    for (const auto status : {"0A", "0B", "0I"})
        EXPECT_FALSE(heard.contains(status)) << status;
}

// A row of the table in the files of a state, whose names say what family and what state.
TEST(Dialogues, MissNoStateOfAnyCommand) {
    constexpr std::pair<Family, std::string_view> families[] = {{Family::urg, "a1"},
                                                                {Family::utm_usb, "a2"},
                                                                {Family::ethernet_multi_echo, "b"},
                                                                {Family::ust, "c"}};
    for (const auto& [family, letters] : families) {
        for (const std::string_view state : state_names) {
            const bool old = !is_ethernet(family);
            // Only the multi-echo models on Ethernet answer while they boot, and old models cannot
            // sleep.
            if ((state == "booting" && family != Family::ethernet_multi_echo) ||
                (state == "asleep" && old))
                continue;
            const std::string name = "states_" + std::string(letters) + "_" + std::string(state);
            std::set<std::string_view> said;
            for (const auto& file : dialogue_files()) {
                if (file.stem().string().starts_with(name))
                    said.merge(commands_said(read_dialogue(file)));
            }
            for (const Command& command : command_table()) {
                if (!command.gate(family).known()) continue;
                EXPECT_TRUE(said.contains(command.code))
                    << "no " << name << "*.txt says " << command.code;
            }
        }
    }
}

}  // namespace
}  // namespace scipd::protocol
