// SPDX-License-Identifier: Apache-2.0
#include "render/picture_processes.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <string>

#include "base/error.h"
#include "base/fork.h"
#include "base/whole_io.h"

namespace floorproof {
namespace {

constexpr char kDrawn = 'd', kFailed = 'f';

// One byte; 0: the other end is gone.
char ReadByte(int line) {
  char byte = 0;
  return ReadAll(line, &byte, 1) ? byte : '\0';
}

std::string ReadRest(int line) {
  std::string text;
  while (const char byte = ReadByte(line)) text += byte;
  return text;
}

}  // namespace

PictureProcesses::PictureProcesses(std::size_t pictures, std::size_t bytes_each, int processes,
                                   const std::function<Draw()>& make)
    : pictures_(pictures),
      bytes_each_(bytes_each),
      processes_(static_cast<std::size_t>(std::max(1, processes))) {
  void* shared = mmap(nullptr, processes_ * kSlots * bytes_each_, PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED)
    throw InternalError(std::string("no memory to draw in: ") + std::strerror(errno));
  shared_ = static_cast<std::uint8_t*>(shared);
  const pid_t parent = getpid();
  for (std::size_t number = 0; number < processes_; ++number) {
    int ends[2];
    pid_t pid = -1;
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0) {
      Own(ends[0]), Own(ends[1]);
      pid = Fork();
      if (pid == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(1);  // it died before
        CloseAllOwnBut({ends[1]});
        Work(number, ends[1], make);
      }
      CloseOwn(ends[1]);
      if (pid < 0) CloseOwn(ends[0]);
    }
    if (pid < 0) {
      const std::string why = std::strerror(errno);
      End();
      throw InternalError("no process to draw with: " + why);
    }
    children_.push_back({pid, ends[0]});
  }
}

PictureProcesses::~PictureProcesses() { End(); }

void PictureProcesses::End() {
  for (const Child& child : children_) kill(child.pid, SIGKILL);
  for (const Child& child : children_) {
    CloseOwn(child.line);
    while (waitpid(child.pid, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  children_.clear();
  if (shared_ != nullptr) munmap(shared_, processes_ * kSlots * bytes_each_);
  shared_ = nullptr;
}

std::uint8_t* PictureProcesses::Slot(std::size_t i) const {
  const std::size_t number = i % processes_, turn = i / processes_;
  return shared_ + (number * kSlots + turn % kSlots) * bytes_each_;
}

void PictureProcesses::Work(std::size_t number, int line,
                            const std::function<Draw()>& make) const noexcept {
  for (const int ignored : {SIGINT, SIGHUP}) signal(ignored, SIG_IGN);  // the parent's
  signal(SIGTERM, SIG_DFL);
  std::string why;
  try {
    const Draw draw = make();
    for (std::size_t i = number; i < pictures_; i += processes_) {
      if (i / processes_ >= kSlots && ReadByte(line) == '\0') _exit(0);
      draw(i, Slot(i));
      if (!WriteAll(line, &kDrawn, 1)) _exit(0);
    }
    // The libraries' own clearing up is nobody's gain.
    _exit(0);
  } catch (const std::exception& e) {
    why = e.what();
  } catch (...) {
    why = "it failed";
  }
  why.insert(why.begin(), kFailed);
  WriteAll(line, why.data(), why.size());
  _exit(1);
}

const std::uint8_t* PictureProcesses::Next() {
  if (next_ >= pictures_) throw InternalError("there is no further picture");
  if (next_ > 0) {  // the last one's slot is free
    const char byte = 'r';
    send(children_[(next_ - 1) % processes_].line, &byte, 1, MSG_NOSIGNAL);  // it may be done
  }
  const Child& child = children_[next_ % processes_];
  const char said = ReadByte(child.line);
  if (said == kFailed) throw InternalError(ReadRest(child.line));
  if (said != kDrawn) throw InternalError("a process that draws the film has died");
  return Slot(next_++);
}

}  // namespace floorproof
