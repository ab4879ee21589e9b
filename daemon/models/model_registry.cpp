// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/model_registry.h"

#include <stdexcept>

#include "daemon/models/products.h"
#include "sim/text/near_word.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

std::string full_name(const Model& model) {
    return model.profile.name + "@" + model.profile.release;
}

// Each product once, however many firmwares it has.
std::vector<std::string_view> products() {
    std::vector<std::string_view> names;
    for (const Model& model : models()) {
        if (names.empty() || names.back() != model.profile.name)
            names.emplace_back(model.profile.name);
    }
    return names;
}

/// Null where there is none of that name.
const Model* search(std::string_view name) {
    for (const Model& model : models()) {
        if (name == model.profile.name || name == full_name(model)) return &model;
    }
    return nullptr;
}

std::string no_model(std::string_view name) {
    const std::vector<std::string_view> names = products();
    const auto near = sim::meant(name, names);
    return "there is no model \"" + std::string(name) + "\"" +
           (near ? "; did you mean " + std::string(*near) + "? The" : "; the") + " models are " +
           sim::listed(names) + "; `scipd --list-models` shows their firmware";
}

}  // namespace

const std::vector<Model>& models() {
    static const std::vector<Model> all = {
        urg_04lx_3_1_04(),    urg_04lx_3_3_00(), urg_04lx_ug01(),     ubg_04lx_f01(),
        uhg_08lx(),           utm_30lx(),        utm_30lx_ew(),       uxm_30lx_e(),
        uxm_30lx_ew(),        uxm_30lxh_ewa(),   ust_05lx(),          ust_10lx(),
        ust_10lx_h01(),       ust_10lx_h02(),    ust_20lx(),          ust_20lx_h01(),
        ust_30lx(),           ust_30lc("1.0.1"), ust_30lc("4.0.2-A"), ust_30lc("4.0.3"),
        ust_30lc("4.1.0b-A"),
    };
    return all;
}

sim::Expected<Model> model_named(std::string_view name) {
    if (const Model* const model = search(name)) return *model;
    return sim::refuse(no_model(name));
}

const Model& find_model(std::string_view name) {
    if (const Model* const model = search(name)) return *model;
    throw std::invalid_argument(no_model(name));
}

}  // namespace scipd::daemon
