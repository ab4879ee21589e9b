// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

namespace scipd::tools {

/// Each component is from 0 to 1.
struct Colour {
    double red;
    double green;
    double blue;
    double opacity = 1.0;
};

namespace colours {
inline constexpr Colour paper{1.0, 1.0, 1.0};
inline constexpr Colour ground{0.957, 0.965, 0.973};
inline constexpr Colour free_space{1.0, 1.0, 1.0};
inline constexpr Colour frame{0.78, 0.81, 0.84};
inline constexpr Colour ring{0.45, 0.52, 0.60, 0.42};
inline constexpr Colour view_edge{0.45, 0.52, 0.60, 0.70};
inline constexpr Colour ink{0.10, 0.13, 0.17};
inline constexpr Colour faint_ink{0.38, 0.43, 0.49};
inline constexpr Colour wall{0.05, 0.29, 0.55};
inline constexpr Colour joint{0.05, 0.29, 0.55, 0.45};
inline constexpr Colour scanner{0.86, 0.27, 0.13};
}  // namespace colours

/// matplotlib's viridis, from dark violet over green to yellow. It also prints well in grey, and
/// colour-blind people can read it. `share` from 0 to 1.
[[nodiscard]] Colour viridis(double share);

}  // namespace scipd::tools
