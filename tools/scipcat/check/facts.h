// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a scanner says of itself, as far as it can be read: the checks go by it. It is read with
// leniency, since whether VV, PP and II are as they should be is checked elsewhere. A value; no
// thread rule.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace scipd::tools::checks {

/// Which products have something in common on the wire.
enum class Line {
    urg,                  ///< URG, UBG, UHG
    utm_usb,              ///< UTM and UXM on USB
    ethernet_multi_echo,  ///< UTM and UXM on Ethernet
    ust,
    other,  ///< none that is known here
    any,    ///< in a table: each of them
};

struct Facts {
    std::map<std::string, std::string> texts;  ///< of VV, PP and II, by their keys
    std::set<std::string> commands;            ///< the scan commands and others that it knows
    Line line = Line::other;
    int amin = 0;
    int amax = 0;
    int afrt = 0;
    int ares = 0;
    int scan_rpm = 0;

    [[nodiscard]] std::string text(const std::string& key) const;
    [[nodiscard]] bool knows(const std::string& command) const { return commands.count(command); }
    /// A turn as SCAN says; 100 ms where it says nothing.
    [[nodiscard]] double period_ms() const;
    [[nodiscard]] int steps() const { return amax - amin + 1; }
};

/// Takes in the lines KEY:VALUE;s of a reply to VV, PP or II, whatever their sums.
void take_texts(Facts& facts, std::string_view reply);

/// Works out the line and the figures from the texts.
void conclude(Facts& facts);

}  // namespace scipd::tools::checks
