// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The families of scanners, and what only some models of a family have. The command table says what
// each of them understands.
#pragma once

namespace scipd::protocol {

/// Models of a family accept the same commands in the same states.
enum class Family {
    urg,                  ///< URG, UBG and UHG: SCIP 2.0, distances of two and three characters
    utm_usb,              ///< UTM-30LX and UXM-30LX-E on USB: SCIP 2.0 with intensity
    ethernet_multi_echo,  ///< UTM-30LX-EW and UXM-30LX-EW: several echoes a step
    ust,                  ///< UST: Ethernet, SCIP 2.2, one echo, distances of three characters only
};
inline constexpr int family_count = 4;

[[nodiscard]] constexpr bool is_ethernet(Family family) {
    return family == Family::ethernet_multi_echo || family == Family::ust;
}

/// What some models of a family have and others have not.
enum class Feature {
    common,        ///< all have it
    multi_echo,    ///< HD HE ND NE
    microseconds,  ///< %TM %MD %ME
    io_lines,      ///< GF GG MF MG
};

}  // namespace scipd::protocol
