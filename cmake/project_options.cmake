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
  scipd_use_precompiled(${name})
endfunction()

# scipd_alone(sources...): keeps these sources out of the batches of a unity build (presets release and ci). It is for
# sources of one target that define the same name, or that include system headers which conflict.
function(scipd_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

set(SCIPD_COMMON_HEADERS <algorithm> <array> <chrono> <cmath> <filesystem> <functional> <map> <memory> <optional> <span>
                         <stdexcept> <string> <string_view> <utility> <variant> <vector>)

# scipd_precompile(NAME HEADERS headers... LINK libraries...): reads headers once, for all targets of a quick build for
# which SCIPD_PRECOMPILED is NAME. A source still includes what it needs: other builds read each header where it stands.
function(scipd_precompile name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS;LINK")
  file(GENERATE OUTPUT ${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE scipd_options ${arg_LINK})
  target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
endfunction()

function(scipd_use_precompiled name)
  if(SCIPD_PRECOMPILED)
    target_precompile_headers(${name} REUSE_FROM ${SCIPD_PRECOMPILED})
  endif()
endfunction()

# scipd_compile_quickly(): what follows in this folder need not be optimized. GCC compiles nothing faster than with -Og
# (-O0 writes more than it saves), and warns of values that it has lost sight of.
macro(scipd_compile_quickly)
  add_compile_options("$<$<CONFIG:Release>:-Og;-Wno-maybe-uninitialized>")
endmacro()

find_program(lld ld.lld)
if(SCIPD_QUICK_BUILD AND lld)
  # It links in a quarter of the time.
  add_link_options(-fuse-ld=lld)
endif()

# scipd_quick_build(): what follows in this folder computes no scans, so a quick build need not optimize it.
macro(scipd_quick_build)
  if(SCIPD_QUICK_BUILD)
    scipd_compile_quickly()
    if(NOT TARGET scipd_headers)
      scipd_precompile(scipd_headers HEADERS ${SCIPD_COMMON_HEADERS})
    endif()
    set(SCIPD_PRECOMPILED scipd_headers)
  endif()
endmacro()

function(scipd_program name)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE scipd_options)
  scipd_use_precompiled(${name})
endfunction()
