// SPDX-License-Identifier: Apache-2.0
#include "base/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/error.h"
#include "base/file_output.h"
#include "base/fork.h"
#include "base/params.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kPoll_ms = 50;
// For what was killed to be gone. One that became another user's cannot be killed, one that waits
// for a disk may be late.
constexpr std::chrono::seconds kDying(2);
constexpr std::size_t kKeptWords = 4096;  // bytes
constexpr std::string_view kPrefix = "floorproof-exchange-";
constexpr const char* kTemporary = "tmp";  // the program's TMPDIR, within the folder
// A younger folder may not be locked yet by the process that makes it.
constexpr std::chrono::minutes kYoung(1);

// Locked as long as a process uses the folder. -1: another process uses it, it is gone, or
// the file system has no locks.
int LockFolder(const fs::path& folder) {
  const int lock = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock < 0 || flock(lock, LOCK_EX | LOCK_NB) == 0) return lock;
  close(lock);
  return -1;
}

// Removes this user's folders whose process and guard were both killed.
void RemoveStale(const fs::path& in) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(in, ignored)) {
    if (!entry.path().filename().string().starts_with(kPrefix)) continue;
    struct stat status {};
    if (lstat(entry.path().c_str(), &status) != 0 || !S_ISDIR(status.st_mode) ||
        status.st_uid != geteuid() ||
        fs::file_time_type::clock::now() - entry.last_write_time(ignored) < kYoung)
      continue;
    const int lock = LockFolder(entry.path());
    if (lock < 0) continue;
    fs::remove_all(entry.path(), ignored);
    close(lock);
  }
}

// What came of the program: written once, by the program itself if it could not be started.
struct Report {
  bool started = false;
  int value = 0;   // a wait status, or an errno
  pid_t left = 0;  // one of its processes that would not die
};

struct Pipe {
  int read = -1, write = -1;
  // `shut`: both ways, and shutdown(2) ends it whoever has inherited an end.
  explicit Pipe(bool shut = false) {
    int ends[2];
    if ((shut ? socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends)
              : pipe2(ends, O_CLOEXEC)) != 0)
      throw InternalError(std::string("no pipe: ") + std::strerror(errno));
    read = ends[0], write = ends[1];
  }
  ~Pipe() { CloseRead(), CloseWrite(); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void CloseRead() { Close(read); }
  void CloseWrite() { Close(write); }
  static void Close(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }
};

// In the program's process, up to where it begins.
[[noreturn]] void Become(const ProgramCall& call, const fs::path& temporary, int reports,
                         int errors, pid_t guard) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != guard) _exit(127);  // it died before
  setpgid(0, 0);
  for (const int number : {SIGINT, SIGHUP, SIGTERM, SIGPIPE, SIGCHLD}) signal(number, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (null >= 0) dup2(null, STDIN_FILENO), dup2(null, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  std::vector<char*> words;
  for (const std::string& word : call.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  setenv("TMPDIR", temporary.c_str(), 1);
  if (call.folder.empty() || chdir(call.folder.c_str()) == 0) execvp(words[0], words.data());
  const Report report{false, errno, 0};
  static_cast<void>(!write(reports, &report, sizeof report));
  _exit(127);
}

// Kills the program's group, then the guard's children: the program, which may have left its group,
// and whatever else has become one since its parents died.
Report EndAll(pid_t program) {
  Report report{true, 0, program};
  kill(-program, SIGKILL);  // until it is reaped, nobody else has its number
  kill(program, SIGKILL);
  const std::string list = "/proc/self/task/" + std::to_string(getpid()) + "/children";
  for (const auto end = Clock::now() + kDying;; usleep(1000)) {
    int status = 0;
    pid_t reaped = 0;
    while ((reaped = waitpid(-1, &status, WNOHANG)) > 0) {
      if (reaped == program) report.value = status;
      if (reaped == report.left) report.left = 0;
    }
    if (reaped < 0) return report;
    if (std::FILE* children = std::fopen(list.c_str(), "re"); children != nullptr) {
      for (int child = 0; std::fscanf(children, "%d", &child) == 1; report.left = child)
        kill(child, SIGKILL);
      std::fclose(children);
    }
    if (report.left == 0 || Clock::now() >= end) return report;
  }
}

bool HasEnded(pid_t program) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(program), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == program;
}

void Tell(int& reports, const Report& report) {
  static_cast<void>(!write(reports, &report, sizeof report));
  Pipe::Close(reports);
}

// In the guard: starts the program and says how it ended; tidies up when `control` is shut, or its
// host is gone: then somebody may have inherited the other end, and holds it open.
[[noreturn]] void Guard(const ProgramCall& call, const fs::path& folder, pid_t host, int control,
                        int reports, int errors) noexcept {
  for (const int number : {SIGINT, SIGHUP, SIGTERM, SIGPIPE}) signal(number, SIG_IGN);
  signal(SIGCHLD, SIG_DFL);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  CloseAllBut({control, reports, errors});
  const pid_t guard = getpid();
  const pid_t program = fork();
  if (program == 0) Become(call, folder / kTemporary, reports, errors, guard);
  Report report{program > 0, program > 0 ? 0 : errno, 0};
  if (program > 0) setpgid(program, program);  // whoever of the two is first
  close(errors);
  bool over = program < 0;
  // Looks ever less often, and is late by a tenth of the program's time at most.
  for (int waited_ms = 0, wait_ms = 1;; waited_ms = std::min(waited_ms + wait_ms, 1000)) {
    wait_ms = std::clamp(waited_ms / 10, 1, 50);
    if (!over && HasEnded(program)) {
      over = true;
      report = EndAll(program);
    }
    if (over && reports >= 0) Tell(reports, report);
    pollfd told{control, POLLIN, 0};
    if (poll(&told, 1, wait_ms) > 0 || getppid() != host) break;
  }
  if (!over) Tell(reports, EndAll(program));
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  _exit(0);
}

// None: its writer is gone, or has not written.
std::optional<Report> ReadReport(int reports) {
  Report report;
  pollfd told{reports, POLLIN, 0};
  if (poll(&told, 1, 0) <= 0 || read(reports, &report, sizeof report) != sizeof report) return {};
  return report;
}

std::string HowItEnded(const Report& report) {
  if (!report.started) return std::string("cannot be started: ") + std::strerror(report.value);
  if (WIFSIGNALED(report.value))
    return std::string("was killed (") + strsignal(WTERMSIG(report.value)) + ")";
  if (WEXITSTATUS(report.value) == 0) return "";
  return "ended with status " + std::to_string(WEXITSTATUS(report.value));
}

void AddWhoIsLeft(const Report& report, std::string& failure) {
  if (report.left == 0) return;
  failure += (failure.empty() ? "left process " : ", and left process ") +
             std::to_string(report.left) + ", which cannot be ended";
}

// Takes what is there; false at the end of the pipe.
bool TakeWords(int errors, std::string& words) {
  char buffer[1 << 14];
  const ssize_t n = read(errors, buffer, sizeof buffer);
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  words.append(buffer, static_cast<std::size_t>(n));
  if (words.size() > kKeptWords) words.erase(0, words.size() - kKeptWords);
  return n > 0;
}

}  // namespace

std::string WhyNoProgram(const std::string& program, const fs::path& folder) {
  const auto why_not = [](const fs::path& file) -> std::string {
    std::error_code error;
    if (!fs::exists(file, error)) return "no such program";
    if (fs::is_directory(file, error)) return "is a folder, not a program";
    if (!fs::is_regular_file(file, error)) return "is a pipe or a device, not a program";
    return access(file.c_str(), X_OK) == 0 ? "" : "is not executable (chmod +x makes it so)";
  };
  if (program.find('/') != std::string::npos) return why_not(folder / program);
  const char* path = std::getenv("PATH");
  std::string left = path != nullptr ? path : "/bin:/usr/bin";
  for (left += ':'; !left.empty(); left.erase(0, left.find(':') + 1))
    if (why_not(folder / left.substr(0, left.find(':')) / program).empty()) return "";
  return "no such program in PATH; one of the scenario's folder is named ./" + program;
}

ExchangeFolder::ExchangeFolder() {
  std::error_code error;
  const fs::path asked = fs::temp_directory_path(error);
  const fs::path in = fs::absolute(error ? "/tmp" : asked);
  RemoveStale(in);
  std::string name = (in / (std::string(kPrefix) + "XXXXXX")).string();
  if (mkdtemp(name.data()) == nullptr) {
    const std::error_code reason(errno, std::generic_category());
    RefuseToWrite(fs::path(name).parent_path(), reason,
                  "cannot make a folder for temporary files (TMPDIR): " + reason.message());
  }
  path_ = name;
  lock_ = LockFolder(path_);
}

ExchangeFolder::~ExchangeFolder() {
  EndGuard();
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  Pipe::Close(lock_);
}

void ExchangeFolder::EndGuard() {
  if (control_ >= 0) shutdown(control_, SHUT_RDWR);
  Pipe::Close(control_);
  // A guard that the program has stopped, say, is killed, and the program with it.
  for (const auto patience : {kDying * 2, kDying}) {
    for (const auto end = Clock::now() + patience; guard_ > 0 && Clock::now() < end;) {
      const pid_t reaped = waitpid(guard_, nullptr, WNOHANG);
      if (reaped == 0)
        usleep(500);
      else if (reaped > 0 || errno != EINTR)
        guard_ = -1;
    }
    if (guard_ > 0) kill(guard_, SIGKILL);
  }
  guard_ = -1;
}

ProgramOutcome ExchangeFolder::Run(const ProgramCall& call) {
  Pipe control(true), reports, errors;
  std::error_code ignored;
  fs::create_directory(path_ / kTemporary, ignored);
  const pid_t host = getpid();
  const auto end = Clock::now() + std::chrono::duration<double>(call.wall_s);
  guard_ = fork();
  if (guard_ < 0) throw InternalError(std::string("no guard process: ") + std::strerror(errno));
  if (guard_ == 0) Guard(call, path_, host, control.read, reports.write, errors.write);
  std::swap(control_, control.write);
  control.CloseRead(), reports.CloseWrite(), errors.CloseWrite();
  fcntl(errors.read, F_SETFL, O_NONBLOCK);

  ProgramOutcome outcome;
  std::optional<Report> report;
  while (!report) {
    const double left_ms = std::chrono::duration<double, std::milli>(end - Clock::now()).count();
    if (left_ms <= 0) {
      outcome.in_time = false;
      outcome.failure = "took more than " + FormatDouble(call.wall_s) + " s";
      break;
    }
    if (Interrupted()) throw Interruption();
    pollfd fds[] = {{reports.read, POLLIN, 0}, {errors.read, POLLIN, 0}};
    if (poll(fds, 2, static_cast<int>(std::min<double>(kPoll_ms, left_ms + 1))) <= 0) continue;
    if (fds[1].revents != 0 && !TakeWords(errors.read, outcome.last_words)) errors.CloseRead();
    if (fds[0].revents == 0) continue;
    report = ReadReport(reports.read);
    if (!report) {  // the guard was killed, by the program most likely, and the program with it
      outcome.failure = "ended the process that watches it";
      break;
    }
  }
  if (!outcome.in_time) {
    EndGuard();  // what was said until then can be read
    if (const auto late = ReadReport(reports.read)) AddWhoIsLeft(*late, outcome.failure);
  }
  for (bool more = errors.read >= 0; more;) {
    pollfd said{errors.read, POLLIN, 0};
    more = poll(&said, 1, 0) > 0 && TakeWords(errors.read, outcome.last_words);
  }
  if (report) {
    outcome.failure = HowItEnded(*report);
    AddWhoIsLeft(*report, outcome.failure);
  }
  return outcome;
}

}  // namespace floorproof
