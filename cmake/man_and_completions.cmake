# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Man pages, and completions for bash, zsh and fish. The programs' own options, docs/configuration.md and
# docs/running.md are their only source: packaging/make_man.py reads what --help prints, and each program prints its
# completions.

find_package(Python3 COMPONENTS Interpreter)
set(texts ${CMAKE_BINARY_DIR}/packaging)
file(MAKE_DIRECTORY ${texts})

set(man_scripts help_text.py make_man.py markdown_page.py roff.py)
list(TRANSFORM man_scripts PREPEND ${CMAKE_SOURCE_DIR}/packaging/)
set(text_files "")

# scipd_text(FILE DEPENDS files or targets... COMMAND words...): the file is made by the command.
function(scipd_text file)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "DEPENDS;COMMAND")
  add_custom_command(OUTPUT ${texts}/${file} COMMAND ${arg_COMMAND} DEPENDS ${arg_DEPENDS} VERBATIM)
  set(text_files ${text_files} ${texts}/${file} PARENT_SCOPE)
endfunction()

# scipd_man(FILE COMPONENT DEPENDS.. arguments of make_man.py...)
macro(scipd_man file component kind source)
  if(Python3_Interpreter_FOUND)
    scipd_text(${file} DEPENDS ${man_scripts} ${ARGN}
               COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/packaging/make_man.py ${kind} ${source}
                       ${PROJECT_VERSION} ${texts}/${file})
    string(REGEX REPLACE ".*\\." "" section ${file})
    install(FILES ${texts}/${file} DESTINATION ${CMAKE_INSTALL_MANDIR}/man${section} COMPONENT ${component})
  endif()
endmacro()

# scipd_completions(PROGRAM COMPONENT words...): the words make the program print its completions for the shell that
# follows them.
macro(scipd_completions program component)
  foreach(shell bash zsh fish)
    scipd_text(${program}.${shell} DEPENDS ${program}
               COMMAND ${program} ${ARGN} ${shell} > ${texts}/${program}.${shell})
  endforeach()
  install(FILES ${texts}/${program}.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
          COMPONENT ${component} RENAME ${program})
  install(FILES ${texts}/${program}.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
          COMPONENT ${component})
  # The folder of /usr/local that zsh looks into is not the one of Debian's packages.
  install(FILES ${texts}/${program}.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
          COMPONENT not_packaged RENAME _${program})
  install(FILES ${texts}/${program}.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
          COMPONENT ${component}-debian EXCLUDE_FROM_ALL RENAME _${program})
endmacro()

set(tools scipctl scipcat scipfit)
if(TARGET scipbench)
  list(APPEND tools scipbench)
endif()
scipd_man(scipd.1 scipd program $<TARGET_FILE:scipd> scipd ${CMAKE_SOURCE_DIR}/docs/running.md)
scipd_man(scipd.yaml.5 scipd page ${CMAKE_SOURCE_DIR}/docs/configuration.md ${CMAKE_SOURCE_DIR}/docs/configuration.md)
scipd_completions(scipd scipd --completion)
foreach(tool ${tools})
  scipd_man(${tool}.1 scipd-tools program $<TARGET_FILE:${tool}> ${tool})
  scipd_completions(${tool} scipd-tools completion)
endforeach()
add_custom_target(man_and_completions ALL DEPENDS ${text_files})
