# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# cpack runs this first. Debian wants to know who made a package, and nobody else can say so.

if(NOT CPACK_PACKAGE_CONTACT MATCHES "^[^<>]+ <[^<>@ ]+@[^<>@ ]+>$")
  message(FATAL_ERROR "Say who makes these packages: cmake --preset release -DSCIPD_MAINTAINER='NAME <ADDRESS>'")
endif()
