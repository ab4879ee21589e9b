// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_console.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include <sdf/Console.hh>

namespace scipd::sim {
namespace {

std::mutex& one_at_a_time() {
    static std::mutex mutex;
    return mutex;
}

void add_once(std::string text, std::vector<std::string>& texts) {
    if (std::ranges::find(texts, text) == texts.end()) texts.push_back(std::move(text));
}

}  // namespace

SdfConsole::SdfConsole()
    : turn_(one_at_a_time()), stderr_before_(std::cerr.rdbuf(on_stderr_.rdbuf())) {
    sdf::Console::Instance()->GetMsgStream().SetStream(&text_);
    console_bridge::useOutputHandler(this);
}

SdfConsole::~SdfConsole() {
    sdf::Console::Instance()->GetMsgStream().SetStream(nullptr);
    console_bridge::restorePreviousOutputHandler();
    std::cerr.rdbuf(stderr_before_);
}

void SdfConsole::log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/,
                     int /*line*/) {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) add_once(text, from_urdfdom_.faults);
    if (level == console_bridge::CONSOLE_BRIDGE_LOG_WARN) add_once(text, from_urdfdom_.warnings);
}

SdfConsole::Said SdfConsole::take() {
    Said said = std::exchange(from_urdfdom_, {});
    // A message begins with `ESC[1;33mWarning [Utils.cc:129]ESC[0m `, or the same with Error, and
    // may have several lines.
    bool fault = false;
    std::string message;
    const auto finish = [&] {
        if (!message.empty()) add_once(message, fault ? said.faults : said.warnings);
        message.clear();
    };
    for (std::string line; std::getline(text_, line);) {
        const auto end = line.find("\x1b[0m ");
        if (line.starts_with('\x1b') && end != line.npos) {
            finish();
            fault = line.find("mError ") < end;
            message = line.substr(end + 5);
        } else if (!message.empty() && !line.empty()) {
            message += ' ' + line;
        }
    }
    finish();
    text_ = {};
    on_stderr_ = {};
    return said;
}

}  // namespace scipd::sim
