# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Debian packages: `cpack` in the build folder of the release preset makes scipd, scipd-tools, libscipd-dev and
# python3-scipd. Each is the component of its name, and PACKAGE-debian. packaging/README.md tells what lies there.

set(SCIPD_MAINTAINER "" CACHE STRING "Who makes the packages: NAME <ADDRESS>")
set(SCIPD_HOMEPAGE "" CACHE STRING "Where people find the sources")
set(SCIPD_REVISION 1 CACHE STRING "Of the packages of one version of scipd")

set(packaging ${CMAKE_SOURCE_DIR}/packaging)
set(made ${CMAKE_BINARY_DIR}/packaging)

# What only Debian wants is a component of its own, which is in no plain installation: nobody loses a configuration in
# /etc by cmake --install.
string(TIMESTAMP package_date "%Y-%m-%dT%H:%M:%S" UTC)
execute_process(COMMAND date --utc --rfc-email --date ${package_date} OUTPUT_VARIABLE package_date
                OUTPUT_STRIP_TRAILING_WHITESPACE)
cmake_host_system_information(RESULT DISTRIB QUERY DISTRIB_INFO)
configure_file(${packaging}/changelog.Debian.in ${made}/changelog.Debian @ONLY)
set(packages scipd scipd-tools libscipd-dev python3-scipd)
foreach(package ${packages})
  install(FILES ${packaging}/copyright ${made}/changelog.Debian DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          COMPONENT ${package}-debian EXCLUDE_FROM_ALL)
  install(FILES ${CMAKE_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          COMPONENT ${package}-debian EXCLUDE_FROM_ALL RENAME changelog)
  install(FILES ${packaging}/${package}/lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
          COMPONENT ${package}-debian EXCLUDE_FROM_ALL RENAME ${package})
endforeach()
install(FILES ${packaging}/scipd/scipd.yaml DESTINATION /etc/scipd COMPONENT scipd-debian EXCLUDE_FROM_ALL)

install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libscipd-dev COMPONENT libscipd-dev
        PATTERN ci EXCLUDE PATTERN ros2 EXCLUDE)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL "")
foreach(package ${packages})
  foreach(component ${package} ${package}-debian)
    list(APPEND CPACK_COMPONENTS_ALL ${component})
    string(TOUPPER ${component} component)
    set(CPACK_COMPONENT_${component}_GROUP ${package})
  endforeach()
endforeach()
set(CPACK_SET_DESTDIR ON) # /etc/scipd does not lie below /usr
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${packaging}/finish.cmake)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT ${SCIPD_MAINTAINER})
set(CPACK_PROJECT_CONFIG_FILE ${packaging}/check_maintainer.cmake)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${SCIPD_REVISION})
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE ${SCIPD_HOMEPAGE})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# A component's name is in capitals in these names.
set(CPACK_DEBIAN_SCIPD_PACKAGE_NAME scipd)
set(CPACK_DEBIAN_SCIPD_PACKAGE_SECTION science)
set(CPACK_DEBIAN_SCIPD_DESCRIPTION "laser scanner that exists only in software
scipd is a Hokuyo laser scanner as far as any program can tell. It speaks
SCIP over TCP and over a tty, and casts its ranges in a 3D world, from
wherever the robot is at the moment each beam is fired. Unmodified drivers
and robot software run against it on a desk or in tests.

This package has the daemon, worlds and the documentation.")
# The unit has a user of its own.
set(CPACK_DEBIAN_SCIPD_PACKAGE_DEPENDS "systemd | systemd-standalone-sysusers | systemd-sysusers")
# The depth backend looks for these when it runs. Without them scipd casts rays.
set(CPACK_DEBIAN_SCIPD_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri, libopengl0, scipd-tools")
set(CPACK_DEBIAN_SCIPD_PACKAGE_CONTROL_EXTRA
    ${packaging}/scipd/conffiles ${packaging}/scipd/postinst ${packaging}/scipd/prerm ${packaging}/scipd/postrm)

set(CPACK_DEBIAN_SCIPD-TOOLS_PACKAGE_NAME scipd-tools)
set(CPACK_DEBIAN_SCIPD-TOOLS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_SCIPD-TOOLS_DESCRIPTION "tools for SCIP laser scanners and for scipd
scipcat records and draws the scans of any SCIP scanner, real or emulated.
scipctl moves the robots and the world of a running scipd and shows what it
does. scipfit makes of a recording a model of the scanner that made it.
scipbench compares how fast the ways to compute ranges are.")
# scipbench has scipd-read, which is in scipd, read worlds.
set(CPACK_DEBIAN_SCIPD-TOOLS_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri, libopengl0, scipd")

set(CPACK_DEBIAN_LIBSCIPD-DEV_PACKAGE_NAME libscipd-dev)
set(CPACK_DEBIAN_LIBSCIPD-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBSCIPD-DEV_DESCRIPTION "SCIP protocol and range sensor simulation of scipd
Static libraries and headers. scipd::protocol speaks SCIP as a scanner or as
a host, without sockets and clocks. scipd::sim loads worlds and casts scans
in them. scipd::testing starts a scipd for a test, and has it fail.")
# What scipdConfig.cmake looks for.
set(needed libembree-dev libexpected-dev libglm-dev libtinyxml2-dev libyaml-cpp-dev nlohmann-json3-dev
           "pkgconf | pkg-config")
if(depth_FOUND)
  list(APPEND needed libepoxy-dev)
endif()
list(JOIN needed ", " CPACK_DEBIAN_LIBSCIPD-DEV_PACKAGE_DEPENDS)
# scipd-read reads worlds for programs, too.
set(CPACK_DEBIAN_LIBSCIPD-DEV_PACKAGE_RECOMMENDS scipd)
# The fixture of scipd::testing.
set(CPACK_DEBIAN_LIBSCIPD-DEV_PACKAGE_SUGGESTS libgtest-dev)

set(CPACK_DEBIAN_PYTHON3-SCIPD_PACKAGE_NAME python3-scipd)
set(CPACK_DEBIAN_PYTHON3-SCIPD_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-SCIPD_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON3-SCIPD_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PYTHON3-SCIPD_DESCRIPTION "scipd for tests in Python, with a plugin for pytest
A test starts laser scanners of its own, puts the robot anywhere, moves the
world, and has a scanner fail in the middle of the run. All ends with the test.
A failed test keeps the log, the conversation and a recording.")
set(CPACK_DEBIAN_PYTHON3-SCIPD_PACKAGE_DEPENDS "python3:any (>= 3.9)")
# It can use a scipd that lies elsewhere.
set(CPACK_DEBIAN_PYTHON3-SCIPD_PACKAGE_RECOMMENDS scipd)
set(CPACK_DEBIAN_PYTHON3-SCIPD_PACKAGE_SUGGESTS python3-pytest)
set(CPACK_DEBIAN_PYTHON3-SCIPD_PACKAGE_CONTROL_EXTRA
    ${packaging}/python3-scipd/postinst ${packaging}/python3-scipd/prerm)

include(CPack)
