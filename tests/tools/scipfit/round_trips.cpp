// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// `scipfit_round_trips [COUNT [FIRST]]`: fits so many synthetic recordings, 200 by default, from
// the seed FIRST on, and prints how often the truth lies within the intervals.
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>

#include "tests/tools/scipfit/round_trip.h"

int main(int argc, char** argv) {
    using namespace scipd::tests;
    const int count = argc > 1 ? std::atoi(argv[1]) : 200;
    const int first = argc > 2 ? std::atoi(argv[2]) : 1;
    RoundTrip result;
    for (int seed = first; seed < first + count; ++seed)
        make_round_trip(static_cast<std::uint64_t>(seed), result);
    Hits all;
    std::cout << std::fixed << std::setprecision(3);
    for (const auto& [parameter, hits] : result.parameters) {
        double sum = 0.0;
        double squares = 0.0;
        for (const double off : hits.off) {
            sum += off;
            squares += off * off;
        }
        std::cout << parameter << ": " << hits.inside << " of " << hits.all << " ("
                  << static_cast<double>(hits.inside) / hits.all << "), mean " << sum / hits.all
                  << ", rms " << std::sqrt(squares / hits.all) << " half intervals\n";
        all.inside += hits.inside;
        all.all += hits.all;
    }
    std::cout << "all: " << static_cast<double>(all.inside) / all.all << " of " << all.all
              << "; numbers for what cannot be known: " << result.unknown_told
              << ", wrong smoothing: " << result.wrong_smoothing
              << ", wrong lattice: " << result.wrong_lattice << '\n';
}
