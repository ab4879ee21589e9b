// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The world of these tests.
#pragma once

#include <filesystem>

inline const std::filesystem::path room = SCENES "/square_room.sdf";
