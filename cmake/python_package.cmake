# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# The package for Python as Debian has it, python3-scipd: modules, and the metadata by which pytest finds the plugin.
# Others take the wheel that tools/wheel makes: this folder is on the path of Debian's Python alone, and so it is in no
# plain installation.

set(modules lib/python3/dist-packages)
set(dist_info ${CMAKE_BINARY_DIR}/packaging/scipd-${PROJECT_VERSION}.dist-info)
configure_file(${CMAKE_SOURCE_DIR}/packaging/python3-scipd/METADATA.in ${dist_info}/METADATA @ONLY)
configure_file(${CMAKE_SOURCE_DIR}/packaging/python3-scipd/entry_points.txt ${dist_info}/entry_points.txt COPYONLY)
install(DIRECTORY python/src/scipd DESTINATION ${modules} COMPONENT python3-scipd EXCLUDE_FROM_ALL
        FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY ${dist_info} DESTINATION ${modules} COMPONENT python3-scipd EXCLUDE_FROM_ALL)
install(DIRECTORY examples/ci examples/ros2 DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-scipd/examples
        COMPONENT python3-scipd EXCLUDE_FROM_ALL PATTERN "__pycache__" EXCLUDE)
