// SPDX-License-Identifier: Apache-2.0
/// Triangles from an STL file, ASCII or binary. A binary one has 50 bytes a triangle after its head of 84; what has
/// another length is ASCII if it begins with "solid" and holds no zero. Source: Burns, Automated Fabrication (Prentice
/// Hall, 1993), section 6.5.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "numerics/surface/triangle.hpp"

namespace talus {

/// The triangles in the order of the file, in its unit, of patch 0; normals follow from the order of the corners, those
/// of the file are not read. \throws FileError if it cannot be read; InputError for a file that is no STL, with the
/// line and the triangle (from 1) at which it ends to be one, or the bytes that are expected and those that are there
std::vector<Triangle> read_stl(const std::filesystem::path& path);

/// The same from the content of a file. \param name of the file, for messages
std::vector<Triangle> stl_triangles(std::string_view content, std::string_view name);

}  // namespace talus
