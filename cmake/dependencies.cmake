# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# All third-party libraries. All come from Debian 12 or 13 (tools/install lists the packages).

find_package(Threads REQUIRED)
find_package(Boost 1.74 CONFIG REQUIRED) # its own file: CMake 3.30 warns of its FindBoost
find_package(glm REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tl-expected REQUIRED)
find_package(CLI11 REQUIRED)
find_package(spdlog REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(tinyxml2 REQUIRED IMPORTED_TARGET tinyxml2)
pkg_check_modules(turbojpeg REQUIRED IMPORTED_TARGET libturbojpeg)
pkg_check_modules(tiff REQUIRED IMPORTED_TARGET libtiff-4)
pkg_check_modules(assimp REQUIRED IMPORTED_TARGET assimp)
pkg_check_modules(seccomp REQUIRED IMPORTED_TARGET libseccomp)
pkg_check_modules(prometheus REQUIRED IMPORTED_TARGET prometheus-cpp-core)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(mosquitto REQUIRED IMPORTED_TARGET libmosquitto)
pkg_check_modules(systemd REQUIRED IMPORTED_TARGET libsystemd)
find_package(BZip2 REQUIRED)
pkg_check_modules(lz4 REQUIRED IMPORTED_TARGET liblz4)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(sqlite3 REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(pcap REQUIRED IMPORTED_TARGET libpcap)
pkg_check_modules(tins REQUIRED IMPORTED_TARGET libtins)
find_package(Ceres REQUIRED)
find_path(stb_folder stb/stb_image.h REQUIRED) # headers only

# Takes Embree 4 if there is one, else Embree 3 (Debian 12). sim/backends/embree.cpp builds with both.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3.13 REQUIRED)
endif()
message(STATUS "Embree ${embree_VERSION}")

# Only tests need these.
function(scipd_find_test_packages missing)
  set(names "")
  foreach(package GTest benchmark mrpt-hwdrivers Python3)
    find_package(${package} QUIET)
    if(NOT ${package}_FOUND)
      list(APPEND names ${package})
    endif()
  endforeach()
  list(JOIN names ", " names)
  set(${missing} "${names}" PARENT_SCOPE)
endfunction()

if(NOT BUILD_TESTING)
  set(SCIPD_TESTS OFF)
endif()
if(SCIPD_TESTS)
  scipd_find_test_packages(missing)
  if(missing AND SCIPD_TESTS STREQUAL "AUTO")
    message(NOTICE "No tests: they need ${missing}, which `tools/install test` installs")
    set(SCIPD_TESTS OFF)
  elseif(missing)
    message(FATAL_ERROR "The tests need ${missing}: run `tools/install test`, or configure with -DSCIPD_TESTS=AUTO")
  endif()
endif()

# Tests hold the reader of SDF to libsdformat where the system has it, as Debian 12 does and 13 does not.
pkg_check_modules(sdformat QUIET IMPORTED_TARGET sdformat12)
if(SCIPD_TESTS AND NOT sdformat_FOUND)
  message(STATUS "No libsdformat 12: nothing holds the reader of SDF to it")
endif()

# GDAL is large, so it is optional. Without it scipd leaves elevation models out of worlds, and says so.
pkg_check_modules(gdal IMPORTED_TARGET gdal)

# What poses of other programs come by. Without one of these scipd tells what is missing where somebody asks for it.
pkg_check_modules(cyclonedds IMPORTED_TARGET CycloneDDS>=0.10) # ROS 2
set(gz_transport "") # Gazebo, whichever generation there is
foreach(generation gz-transport14 gz-transport13 gz-transport12 ignition-transport11)
  if(NOT gz_transport)
    find_package(${generation} QUIET)
    if(${generation}_FOUND)
      set(gz_transport ${generation}::${generation})
      message(STATUS "Gazebo's transport: ${generation}")
    endif()
  endif()
endforeach()

# Without these headers the depth backend is not built, and scipd says so. Programs look for EGL itself when they run,
# so that a machine without it still has the other backends.
pkg_check_modules(epoxy IMPORTED_TARGET epoxy)
pkg_check_modules(egl egl)
if(epoxy_FOUND AND egl_FOUND)
  set(depth_FOUND ON)
else()
  set(depth_FOUND OFF)
  message(STATUS "No libepoxy or no EGL: building without the depth backend")
endif()
