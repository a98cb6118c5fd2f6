// SPDX-License-Identifier: Apache-2.0
#include "base/try_in_child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "base/error.h"
#include "base/fork.h"
#include "base/sanitizer.h"
#include "base/whole_io.h"

namespace floorproof {
namespace {

// Exit statuses of the child, beside 0: it answered.
constexpr int kThrew = 101, kNoMemory = 102, kGaveUp = 103;

void Limit(int resource, rlim_t most) {
  rlimit limit{};
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0) return;
  limit.rlim_cur = std::min(most, limit.rlim_max);
  setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

// Beyond what the process holds already.
void LimitData([[maybe_unused]] std::size_t more_bytes) {
#ifndef FP_ADDRESS_SANITIZER  // whose own mappings RLIMIT_DATA does not bound
  unsigned long pages = 0;
  if (std::FILE* statm = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(statm, "%*u %*u %*u %*u %*u %lu", &pages) != 1) pages = 0;
    std::fclose(statm);
  }
  Limit(RLIMIT_DATA, pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + more_bytes);
#endif
}

[[noreturn]] void Work(int answers, pid_t parent, const std::function<std::string()>& work,
                       const TrialLimits& limits) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kGaveUp);                            // it died before
  for (const int number : {SIGINT, SIGHUP}) signal(number, SIG_IGN);  // the parent's to answer
  for (const int number : {SIGTERM, SIGPIPE, SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGXCPU})
    signal(number, SIG_DFL);
  const int null = open("/dev/null", O_WRONLY);
  dup2(null, STDOUT_FILENO), dup2(null, STDERR_FILENO);
  // A library that ends the process must not run the parent's own exit handlers.
  std::atexit([] { _exit(kGaveUp); });
  std::set_new_handler(EndForWantOfMemory);
  Limit(RLIMIT_CORE, 0);
  Limit(RLIMIT_CPU, static_cast<rlim_t>(limits.cpu_s));
  LimitData(limits.memory_bytes);
  std::string answer;
  try {
    answer = work();
  } catch (const std::bad_alloc&) {
    EndForWantOfMemory();
  } catch (...) {
    _exit(kThrew);
  }
  _exit(WriteAll(answers, answer.data(), answer.size()) ? 0 : kGaveUp);
}

// To the end of the pipe, or until the time is over: false.
bool ReadAnswer(int answers, int wall_s, std::string& text) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(wall_s);
  char buffer[1 << 14];
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) return false;
    pollfd fd{answers, POLLIN, 0};
    const int ready = poll(&fd, 1, static_cast<int>(left.count()));
    if (ready < 0 && errno != EINTR) return true;
    if (ready <= 0) continue;
    const ssize_t n = read(answers, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    text.append(buffer, static_cast<std::size_t>(n));
  }
}

std::string HowItFailed(int status, bool in_time, const TrialLimits& limits) {
  if (!in_time) return "took more than " + std::to_string(limits.wall_s) + " s";
  if (WIFSIGNALED(status)) {
    if (WTERMSIG(status) == SIGXCPU)
      return "took more than " + std::to_string(limits.cpu_s) + " s of processor time";
    return std::string("crashed (") + strsignal(WTERMSIG(status)) + ")";
  }
  if (WEXITSTATUS(status) == kNoMemory)
    return "needed more than " + std::to_string(limits.memory_bytes >> 20) + " MiB";
  return "gave up";
}

}  // namespace

void EndForWantOfMemory() { _exit(kNoMemory); }

TrialOutcome TryInChild(const std::function<std::string()>& work, const TrialLimits& limits) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw InternalError(std::string("no pipe: ") + std::strerror(errno));
  const pid_t parent = getpid();
  const pid_t child = Fork();
  if (child < 0) {
    const int error = errno;
    close(ends[0]), close(ends[1]);
    throw InternalError(std::string("no child process: ") + std::strerror(error));
  }
  if (child == 0) {
    close(ends[0]);
    Work(ends[1], parent, work, limits);
  }
  close(ends[1]);
  TrialOutcome outcome;
  std::string text;
  const bool in_time = ReadAnswer(ends[0], limits.wall_s, text);
  close(ends[0]);
  if (!in_time) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR)  // who ignores SIGCHLD never learns how a child ended
      throw InternalError(std::string("lost a child process: ") + std::strerror(errno));
  if (in_time && WIFEXITED(status) && WEXITSTATUS(status) == 0)
    outcome.answer = std::move(text);
  else
    outcome.failure = HowItFailed(status, in_time, limits);
  return outcome;
}

}  // namespace floorproof
