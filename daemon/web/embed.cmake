# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# cmake -DSOURCE=page_files.cpp -DFILES="a;b;c" -P embed.cmake: writes a source that takes in the bytes of each file.
# The source has the hashes of the files, so it changes, and is compiled, whenever one of them does.

set(bytes "")
set(symbols "")
set(table "")
set(number 0)
foreach(file IN LISTS FILES)
  cmake_path(GET file FILENAME name)
  file(SHA256 ${file} hash)
  string(SUBSTRING ${hash} 0 16 hash)
  string(APPEND bytes "scipd_page_${number}:\n.incbin \"${file}\"\nscipd_page_${number}_end:\n.byte 0\n")
  string(APPEND symbols "extern const char scipd_page_${number}[], scipd_page_${number}_end[];\n")
  string(APPEND table "    {\"${name}\", \"${hash}\", {scipd_page_${number}, scipd_page_${number}_end}},\n")
  math(EXPR number "${number} + 1")
endforeach()

file(WRITE ${SOURCE} "// Made by daemon/web/embed.cmake.
#include \"daemon/web/page_files.h\"

asm(R\"(.section .rodata
${bytes}.text
)\");

extern \"C\" {
${symbols}}

namespace scipd::daemon {

std::span<const PageFile> page_files() {
    static const PageFile files[] = {
${table}    };
    return files;
}

}  // namespace scipd::daemon
")
