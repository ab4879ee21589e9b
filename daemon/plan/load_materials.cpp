// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/load_materials.h"

#include <cmath>
#include <memory>
#include <utility>

#include "daemon/config/demo_world.h"
#include "daemon/plan/load_world.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/materials/materials_file.h"

namespace scipd::daemon {
namespace {

void add_from(const std::filesystem::path& file, sim::MaterialLibrary& library) {
    for (sim::MaterialOptics& material : sim::load_materials(file))
        library.add(std::move(material));
}

}  // namespace

LoadedMaterials load_materials(const Config& config) {
    sim::MaterialLibrary library;
    std::vector<std::string> warnings;
    if (const auto stock = stock_materials()) {
        add_from(*stock, library);
    } else {
        warnings.push_back(stock.error().why + "; without it surfaces are matt and white unless " +
                           "the configuration names a file under materials");
        if (config.strict) throw sim::LoadError(std::move(warnings));
    }
    if (!config.materials.empty()) {
        try {
            add_from(config.materials, library);
        } catch (const sim::LoadError& error) {
            throw named_at(config.place_of("materials"), error);
        }
    }
    return {std::make_shared<const sim::MaterialLibrary>(std::move(library)), std::move(warnings)};
}

std::string summary_of(const sim::MaterialLibrary& library) {
    const std::size_t numbers = library.numbers();
    const double share = numbers == 0 ? 0.0
                                      : 100.0 * static_cast<double>(library.assumed()) /
                                            static_cast<double>(numbers);
    return std::to_string(library.materials().size()) + " with " + std::to_string(numbers) +
           " parameters, " + std::to_string(std::lround(share)) +
           " % of them assumed (not measured)";
}

}  // namespace scipd::daemon
