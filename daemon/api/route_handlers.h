// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The functions that answer the requests of the control API, one for each method and path.
// routes.cpp has the table that calls them. On the I/O thread.
#pragma once

#include <string>
#include <vector>

#include "daemon/api/api.h"
#include "daemon/api/documents.h"
#include "daemon/api/faults_api.h"
#include "daemon/http/http_message.h"

namespace scipd::daemon {

/// A request on its way to its answer.
struct Call {
    Api& api;
    const HttpRequest& request;      ///< valid until the handler returns
    std::vector<std::string> names;  ///< what the braces of the path stand for, in order
    Respond respond;
};

/// The sensor of a path that begins with /sensors/{robot}/{sensor}.
[[nodiscard]] std::string sensor_of(const Call& call);
/// Answers that there is none of this name.
[[nodiscard]] HttpResponse no_sensor(const std::string& sensor);

// page_routes.cpp
void get_page(Call&& call);
void get_icon(Call&& call);
void get_page_file(Call&& call);

// sensor_routes.cpp
void get_status(Call&& call);
void get_sensors(Call&& call);
void get_sensor(Call&& call);
void patch_sensor(Call&& call);
void get_reading(Call&& call);
void get_truth(Call&& call);
/// As GET tells it; null: there is none of this name.
[[nodiscard]] Json sensor_document(const Api& api, const std::string& sensor);

// new_sensor_routes.cpp
void get_models(Call&& call);
void post_sensor(Call&& call);
void delete_sensor(Call&& call);

// replay_routes.cpp
void get_replay(Call&& call);
void patch_replay(Call&& call);

// recording_routes.cpp
void get_recording(Call&& call);

// metrics_routes.cpp
void get_metrics(Call&& call);
void get_health(Call&& call);

// pose_routes.cpp
void get_robot_pose(Call&& call);
void put_robot_pose(Call&& call);

// scene_routes.cpp
void get_scene(Call&& call);
void put_scene(Call&& call);
void post_model(Call&& call);
void delete_model(Call&& call);
void put_material(Call&& call);
void get_model_pose(Call&& call);
void put_model_pose(Call&& call);

// object_routes.cpp
void get_objects(Call&& call);
void get_mesh(Call&& call);

// saved_routes.cpp
void get_sdf(Call&& call);
void get_configuration(Call&& call);

// media_routes.cpp
void get_media(Call&& call);
void put_media(Call&& call);
void delete_media(Call&& call);

// fault_routes.cpp
void get_fault_kinds(Call&& call);
void post_fault(Call&& call);
void get_faults(Call&& call);
void delete_faults(Call&& call);
void get_fault_log(Call&& call);
void get_fault(Call&& call);
void delete_fault(Call&& call);

// scenario_routes.cpp
void get_scenario(Call&& call);
void put_scenario(Call&& call);
void delete_scenario(Call&& call);

}  // namespace scipd::daemon
