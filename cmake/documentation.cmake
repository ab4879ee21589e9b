# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# README.md, docs/ and scenes/ as they are installed. packaging/installed_pages.py makes the links of their pages lead
# to what is installed; without Python they lead to the sources.

find_package(Python3 COMPONENTS Interpreter)
set(doc ${CMAKE_INSTALL_DATADIR}/doc/scipd)
set(kept PATTERN "*.py" EXCLUDE)

if(Python3_Interpreter_FOUND)
  set(kept ${kept} PATTERN "*.md" EXCLUDE)
  set(pages ${CMAKE_BINARY_DIR}/packaging/pages)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS README.md docs/*.md scenes/*.md)
  add_custom_command(
    OUTPUT ${pages}/made
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/packaging/installed_pages.py ${CMAKE_SOURCE_DIR} ${pages}
    COMMAND ${CMAKE_COMMAND} -E touch ${pages}/made
    DEPENDS ${sources} ${CMAKE_SOURCE_DIR}/packaging/installed_pages.py
    VERBATIM)
  add_custom_target(documentation ALL DEPENDS ${pages}/made)
  install(DIRECTORY ${pages}/doc/scipd/ DESTINATION ${doc} COMPONENT scipd)
  install(DIRECTORY ${pages}/scipd/scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/scipd/scenes COMPONENT scipd)
else()
  install(FILES README.md DESTINATION ${doc} COMPONENT scipd)
endif()
install(DIRECTORY docs DESTINATION ${doc} COMPONENT scipd ${kept})
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/scipd/scenes COMPONENT scipd ${kept})
