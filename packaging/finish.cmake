# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# cpack runs this when all files of the packages are in place: what Debian wants of them.

file(GLOB texts ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/usr/share/man/man*/*
     ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/usr/share/doc/*/changelog*)
# Debian's own folder of libraries has the machine's name below usr/lib.
file(GLOB archives ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/usr/lib/scipd/*.a
     ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/usr/lib/*/scipd/*.a)
execute_process(COMMAND gzip -9 --no-name ${texts} COMMAND_ERROR_IS_FATAL ANY)
if(archives)
  # python3-scipd alone has none.
  execute_process(COMMAND strip --strip-debug --remove-section=.comment --enable-deterministic-archives ${archives}
                  COMMAND_ERROR_IS_FATAL ANY)
endif()
