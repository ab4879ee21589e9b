# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# What other projects get from find_package(scipd): the targets scipd::protocol, scipd::sim and scipd::testing, and the
# headers below. Other headers may change at any time, and are not installed.

set(component libscipd-dev)
set(headers_folder ${CMAKE_INSTALL_INCLUDEDIR}/scipd)
set(archives_folder ${CMAKE_INSTALL_LIBDIR}/scipd)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/scipd)

# scipd_exports(EXPORTED PARTS libraries... HEADERS files...): scipd::EXPORTED is all the parts together. A part may
# need libraries that are named by an earlier call or by this one.
function(scipd_exports exported)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PARTS;HEADERS")
  add_library(scipd_exported_${exported} INTERFACE)
  set_target_properties(scipd_exported_${exported} PROPERTIES EXPORT_NAME ${exported})
  target_link_libraries(scipd_exported_${exported} INTERFACE ${arg_PARTS})
  target_compile_features(scipd_exported_${exported} INTERFACE cxx_std_20)
  target_include_directories(scipd_exported_${exported} INTERFACE $<INSTALL_INTERFACE:${headers_folder}>)
  install(TARGETS scipd_exported_${exported} ${arg_PARTS} EXPORT scipd
          ARCHIVE DESTINATION ${archives_folder} COMPONENT ${component})
  foreach(header ${arg_HEADERS})
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${header} DESTINATION ${headers_folder}/${folder} COMPONENT ${component})
  endforeach()
endfunction()

scipd_exports(
  protocol
  PARTS scipd_protocol scipd_client
  HEADERS # a scanner's side: begin with session.h
          protocol/acquisition.h
          protocol/action.h
          protocol/command.h
          protocol/device_profile.h
          protocol/device_state.h
          protocol/family.h
          protocol/gate.h
          protocol/line_reader.h
          protocol/refusal.h
          protocol/reply.h
          protocol/request.h
          protocol/scan_view.h
          protocol/session.h
          protocol/session_hook.h
          protocol/settings.h
          protocol/speaker.h
          protocol/state.h
          protocol/status.h
          protocol/status_counts.h
          protocol/step_window.h
          protocol/subscription.h
          protocol/uptime.h
          # a host's side: begin with client/driver.h
          protocol/client/decoder.h
          protocol/client/device_info.h
          protocol/client/driver.h
          protocol/client/error.h
          protocol/client/message.h
          protocol/client/scan_message.h
          protocol/client/scan_request.h
          protocol/client/status_text.h
          protocol/client/transport.h)

scipd_exports(
  sim
  PARTS scipd_sim_text scipd_sim_random scipd_sim_world scipd_sim_backends scipd_sim_sensor scipd_sim_loaders
  HEADERS # what is there: begin with world/scene.h
          sim/expected.h
          sim/random.h
          sim/time.h
          sim/world/anchor.h
          sim/world/bounds.h
          sim/world/lidar.h
          sim/world/lit_world.h
          sim/world/material.h
          sim/world/material_library.h
          sim/world/medium.h
          sim/world/mesh.h
          sim/world/pose.h
          sim/world/pose_track.h
          sim/world/reflection.h
          sim/world/scene.h
          sim/world/shape.h
          sim/world/surface.h
          # files into worlds: begin with loaders/scene_file.h
          sim/loaders/file/allowed_folder.h
          sim/loaders/file/load_error.h
          sim/loaders/file/load_limits.h
          sim/loaders/file/loaded_scene.h
          sim/loaders/file/new_model.h
          sim/loaders/map/map_options.h
          sim/loaders/materials/materials_file.h
          sim/loaders/mesh/mesh_file.h
          sim/loaders/poses/trajectory.h
          sim/loaders/poses/trajectory_file.h
          sim/loaders/scene_file.h
          sim/loaders/sdf/sdf_options.h
          # how rays meet the world: begin with backends/registry.h
          sim/backends/backend_row.h
          sim/backends/choice.h
          sim/backends/depth_options.h
          sim/backends/fan.h
          sim/backends/range_backend.h
          sim/backends/registry.h
          # what looks at it: begin with sensor/scanner.h
          sim/sensor/aggregation.h
          sim/sensor/beam_pattern.h
          sim/sensor/curve.h
          sim/sensor/echo.h
          sim/sensor/error_model.h
          sim/sensor/footprint.h
          sim/sensor/noise_law.h
          sim/sensor/per_beam.h
          sim/sensor/reading.h
          sim/sensor/scan.h
          sim/sensor/scan_timing.h
          sim/sensor/scanner.h
          sim/sensor/sensor_spec.h
          sim/sensor/spec_curves.h
          sim/sensor/staring.h
          sim/sensor/unit_bias.h)

scipd_exports(
  testing
  PARTS scipd_testing scipd_control_client
  HEADERS # a scipd for tests: begin with scipd.h, or with scipd_test.h, which needs GoogleTest
          testing/scan_recording.h
          testing/scipd.h
          testing/scipd_options.h
          testing/scipd_parts.h
          testing/scipd_test.h
          testing/scipd_values.h)

set(scipd_optional_modules "")
if(depth_FOUND)
  string(APPEND scipd_optional_modules " epoxy")
endif()
include(CMakePackageConfigHelpers)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/scipdConfig.cmake.in ${CMAKE_BINARY_DIR}/scipdConfig.cmake
                              INSTALL_DESTINATION ${config_folder} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change what is there.
write_basic_package_version_file(${CMAKE_BINARY_DIR}/scipdConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/scipdConfig.cmake ${CMAKE_BINARY_DIR}/scipdConfigVersion.cmake
        DESTINATION ${config_folder} COMPONENT ${component})
install(EXPORT scipd FILE scipdTargets.cmake NAMESPACE scipd:: DESTINATION ${config_folder} COMPONENT ${component})
