// SPDX-License-Identifier: Apache-2.0
// Pictures that several processes draw at once, and one takes in their order: a context of GL draws
// in one thread, and llvmpipe's own threads share little of the work of small pictures.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace floorproof {

class PictureProcesses {
 public:
  // Draws picture i into `pixels`. A process is asked for every n-th, ascending.
  using Draw = std::function<void(std::size_t i, std::uint8_t* pixels)>;

  // `make` is called in each of the `processes`; what it throws, and what drawing throws, is thrown
  // by Next(). Throws InternalError where no process can be made.
  PictureProcesses(std::size_t pictures, std::size_t bytes_each, int processes,
                   const std::function<Draw()>& make);
  ~PictureProcesses();  // ends them
  PictureProcesses(const PictureProcesses&) = delete;
  PictureProcesses& operator=(const PictureProcesses&) = delete;

  // The next picture's pixels, which stand until the next call. At most `pictures` times. Throws
  // InternalError with what a process says, or how it ended.
  const std::uint8_t* Next();

 private:
  struct Child {
    pid_t pid = 0;
    int line = -1;  // on it it says that a picture is drawn, and is told that a slot is free
  };
  static constexpr std::size_t kSlots = 3;  // pictures that a process may be ahead

  std::uint8_t* Slot(std::size_t i) const;
  [[noreturn]] void Work(std::size_t number, int line,
                         const std::function<Draw()>& make) const noexcept;
  void End();

  std::size_t pictures_, bytes_each_, processes_, next_ = 0;
  std::uint8_t* shared_ = nullptr;
  std::vector<Child> children_;
};

}  // namespace floorproof
