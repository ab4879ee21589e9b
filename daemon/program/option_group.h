// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How options of the command line are added. At the start, on the only thread.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "sim/expected.h"

namespace scipd::daemon {

/// Adds options of one group. The text of each goes through a parser of daemon/config.
class Group {
  public:
    Group(CLI::App& app, std::string title) : app_(app), title_(std::move(title)) {}

    CLI::Option* add(const std::string& name, const std::string& value, const std::string& help,
                     std::function<sim::Expected<>(const std::string&)> take) {
        const auto callback = [name, take = std::move(take)](const CLI::results_t& said) {
            for (const std::string& text : said) {
                const auto taken = take(text);
                if (!taken) throw CLI::ValidationError(name, taken.error().why);
            }
            return true;
        };
        return app_.add_option(name, callback, help)->type_name(value)->group(title_);
    }

    CLI::Option* add_flag(const std::string& name, bool& flag, const std::string& help) {
        return app_.add_flag(name, flag, help)->group(title_);
    }

  private:
    CLI::App& app_;
    std::string title_;
};

template <class Value, class Target>
sim::Expected<> put(sim::Expected<Value> value, Target& target) {
    return value.map([&](const Value& good) { target = good; });
}

}  // namespace scipd::daemon
