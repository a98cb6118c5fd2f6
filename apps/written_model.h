// SPDX-License-Identifier: Apache-2.0
// The MJCF files that `robot` writes: whole or not at all, and never over what somebody else wrote.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace floorproof {

// Writes the MJCF made of a URDF. What stands there must be such a file that nobody has changed, or
// it is refused (InputError); limits measured of the same model stay in it. Returns whether it held
// limits of another model, which are gone.
bool WriteConverted(const std::filesystem::path& out, const std::string& mjcf);

// Where the limits of `robot_files` (ReadRobot's, the MJCF first) are written: `out`, or into the
// MJCF itself where that is empty or the same. Throws InputError where nothing can be written
// there, the MJCF's text has no place for them, or what stands there is another model.
std::filesystem::path PlaceForLimits(const std::vector<std::filesystem::path>& robot_files,
                                     const std::filesystem::path& out);

// Writes the MJCF `file` with these limits in it (MeasuredElements) to `target`, its
// PlaceForLimits.
void WriteLimits(const std::filesystem::path& file, const std::filesystem::path& target,
                 const std::string& elements);

}  // namespace floorproof
