// SPDX-License-Identifier: Apache-2.0
// Files that hold a secret, in the shapes that secrets come in, and the scenarios that name such a
// file wherever a scenario can name one. No message about them may hold the secret.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace floorproof {

inline const std::string kSecret = "ghpSECRET123";

// Name: content.
std::map<std::string, std::string> SecretFiles();

// Scenarios with the word FILE where a file's name goes; FILE.yaml and FILE.xml where its ending
// decides how it is read.
std::vector<std::string> ScenariosNaming();

}  // namespace floorproof
