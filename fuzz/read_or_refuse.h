// SPDX-License-Identifier: Apache-2.0
// What must hold for any bytes whatever: a reader takes them, or throws InputError with one line of
// bounded length. Any other exception, a crash, a leak, a hang or too much memory is a finding.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

#include "base/error.h"

namespace floorproof {

// Prints why and aborts, which libFuzzer reports with the input.
[[noreturn]] inline void Finding(const std::string& what) {
  std::fprintf(stderr, "FINDING: %s\n", what.c_str());
  std::abort();
}

inline void ReadOrRefuse(const std::function<void()>& read) {
  try {
    read();
  } catch (const InputError& e) {
    const std::string_view line = e.what();
    if (line.empty() || line.size() > 2000) Finding("a message of no or too great length");
    for (const char c : line)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
        Finding("more than one line, or control characters: " + std::string(line));
  }
}

// A folder of this process for files that readers open by name; in memory where there is /dev/shm.
inline const std::filesystem::path& Folder() {
  static const std::filesystem::path folder = [] {
    std::error_code error;
    std::filesystem::path root = "/dev/shm";
    if (!std::filesystem::is_directory(root, error)) root = std::filesystem::temp_directory_path();
    root /= "floorproof_fuzz." + std::to_string(getpid());
    std::filesystem::create_directories(root);
    std::atexit([] { std::filesystem::remove_all(Folder()); });
    return root;
  }();
  return folder;
}

inline std::filesystem::path Save(const char* name, std::string_view bytes) {
  const auto path = Folder() / name;
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

inline std::string_view View(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace floorproof
