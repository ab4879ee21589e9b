# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Runs the generators of scenes/ into FOLDER and compares byte for byte.

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
foreach(script make_office_map.py make_rescue_maze.py make_trajectories.py)
  execute_process(COMMAND ${PYTHON} ${SCENES}/${script} ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
endforeach()

file(GLOB written RELATIVE ${FOLDER} ${FOLDER}/*)
list(LENGTH written count)
if(NOT count EQUAL 7)
  message(FATAL_ERROR "seven files expected, there are: ${written}")
endif()
foreach(name IN LISTS written)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${FOLDER}/${name} ${SCENES}/${name}
                  RESULT_VARIABLE differs)
  if(differs)
    message(FATAL_ERROR "scenes/${name} is not what its generator writes; run it again")
  endif()
endforeach()
