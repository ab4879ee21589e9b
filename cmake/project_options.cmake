# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# scipd_library(NAME sources...): one static library per folder, with the project's warnings. Its only include path is
# the project's root, so that every #include names the folder of the header.

add_library(scipd_options INTERFACE)
target_include_directories(scipd_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(scipd_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion
                                               -Wno-sign-conversion -Wno-missing-field-initializers)
if(NOT CMAKE_UNITY_BUILD)
  # In a unity build a local name may equal a name of another source in the same batch.
  target_compile_options(scipd_options INTERFACE -Wshadow)
endif()
if(SCIPD_WARNINGS_AS_ERRORS)
  target_compile_options(scipd_options INTERFACE -Werror)
endif()
if(SCIPD_SANITIZE)
  target_compile_options(scipd_options INTERFACE -fsanitize=${SCIPD_SANITIZE}
                                                 -fno-omit-frame-pointer)
  target_link_options(scipd_options INTERFACE -fsanitize=${SCIPD_SANITIZE})
endif()
if(SCIPD_SANITIZE MATCHES address AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # gcc 12 takes the functions in std::regex for uninitialised under AddressSanitizer (its bug 105562).
  target_compile_options(scipd_options INTERFACE -Wno-maybe-uninitialized)
endif()
if(SCIPD_SANITIZE MATCHES thread AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # gcc warns that ThreadSanitizer does not see fences. Asio uses fences, but also mutexes, which ThreadSanitizer sees.
  target_compile_options(scipd_options INTERFACE -Wno-tsan)
endif()
if(SCIPD_FUZZ)
  # Coverage for all code that a fuzzer drives. Only the fuzz targets link the fuzzer's engine.
  target_compile_options(scipd_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

function(scipd_library name)
  add_library(${name} STATIC ${ARGN})
  # Those who use an installed library have warnings and include paths of their own.
  target_link_libraries(${name} PUBLIC $<BUILD_INTERFACE:scipd_options>)
endfunction()

# scipd_alone(sources...): keeps these sources out of the batches of a unity build (presets release and ci). It is for
# sources of one target that define the same name, or that include system headers which conflict.
function(scipd_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# scipd_compile_quickly(): what follows in this folder need not be optimized. GCC compiles nothing faster than with -Og
# (-O0 writes more than it saves), and warns of values that it has lost sight of.
macro(scipd_compile_quickly)
  add_compile_options("$<$<CONFIG:Release>:-Og;-Wno-maybe-uninitialized>")
endmacro()

# scipd_quick_build(): what follows in this folder computes no scans, so a quick build need not optimize it.
macro(scipd_quick_build)
  if(SCIPD_QUICK_BUILD)
    scipd_compile_quickly()
  endif()
endmacro()

function(scipd_program name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE scipd_options)
endfunction()
