// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What is there: the scene, other scenes in its place, and models that come, go and move.
#pragma once

#include "daemon/api/routes.h"

namespace scipd::daemon {

void get_scene(Call&& call);
void put_scene(Call&& call);
void post_model(Call&& call);
void delete_model(Call&& call);
void get_model_pose(Call&& call);
void put_model_pose(Call&& call);

}  // namespace scipd::daemon
