// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/models/registry.h"

#include <stdexcept>

#include "daemon/models/urg_04lx.h"
#include "daemon/models/ust.h"
#include "daemon/models/ust_30lc.h"
#include "daemon/models/utm_30lx.h"
#include "daemon/models/utm_30lx_ew.h"
#include "daemon/models/uxm_30lx.h"

namespace scipd::daemon {
namespace {

std::string full_name(const Model& model) {
    return model.profile.name + "@" + model.profile.release;
}

std::string choices() {
    std::string text;
    for (const Model& model : models())
        text += (text.empty() ? "" : ", ") + full_name(model);
    return text;
}

}  // namespace

const std::vector<Model>& models() {
    static const std::vector<Model> all = {
        urg_04lx_3_1_04(),   urg_04lx_3_3_00(), utm_30lx(),           utm_30lx_ew(),
        uxm_30lx_e(),        ust_10lx(),        ust_20lx(),           ust_30lc("1.0.1"),
        ust_30lc("4.0.2-A"), ust_30lc("4.0.3"), ust_30lc("4.1.0b-A"),
    };
    return all;
}

const Model& find_model(std::string_view name) {
    for (const Model& model : models()) {
        if (name == model.profile.name || name == full_name(model)) return model;
    }
    throw std::invalid_argument("there is no model \"" + std::string(name) + "\"; the models are " +
                                choices());
}

}  // namespace scipd::daemon
