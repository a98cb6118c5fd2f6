// SPDX-License-Identifier: Apache-2.0
#include "tests/bad_input/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace floorproof {
namespace {

void Limit(int resource, rlim_t most) {
  const rlimit limit = {most, most};
  setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

double Seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

[[noreturn]] void BecomeChild(const ChildMain& main, const std::vector<std::string>& words,
                              const std::filesystem::path& folder, int out, int err,
                              const ChildLimits& limits) noexcept {
  const int null = open("/dev/null", O_RDONLY);
  dup2(null, 0), dup2(out, 1), dup2(err, 2);
  for (const int number : {SIGINT, SIGTERM}) signal(number, SIG_DFL);  // whatever ctest inherited
  Limit(RLIMIT_CPU, static_cast<rlim_t>(limits.cpu_s));
  Limit(RLIMIT_CORE, 0);
  if (limits.file_bytes) {
    signal(SIGXFSZ, SIG_IGN);  // the write fails instead
    Limit(RLIMIT_FSIZE, *limits.file_bytes);
  }
  alarm(static_cast<unsigned>(limits.wall_s));  // survives exec
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  if (chdir(folder.c_str()) != 0) _exit(127);
  std::exit(main(static_cast<int>(words.size()), argv.data()));
}

// What a process that has ended left in a pipe, which holds 64 KiB: more than it has to say here.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() { close(ends_[0]), close(ends_[1]); }
  int in() const { return ends_[1]; }
  std::string TakeText() const {
    fcntl(ends_[0], F_SETFL, O_NONBLOCK);
    std::string text(1 << 17, '\0');
    const ssize_t size = read(ends_[0], text.data(), text.size());
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
  }

 private:
  int ends_[2];
};

}  // namespace

ChildResult RunForked(const ChildMain& main, const std::vector<std::string>& arguments,
                      const std::filesystem::path& folder, const ChildLimits& limits) {
  std::vector<std::string> words = {"floorproof"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Pipe out, err;
  std::fflush(nullptr);  // what waits to be written is the parent's to write
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) BecomeChild(main, words, folder, out.in(), err.in(), limits);
  int code = 0;
  rusage used{};
  if (wait4(child, &code, 0, &used) != child) throw std::runtime_error("wait4 failed");
  ChildResult result;
  if (WIFEXITED(code)) result.status = WEXITSTATUS(code);
  if (WIFSIGNALED(code)) result.signal = WTERMSIG(code);
  result.cpu_s = Seconds(used.ru_utime) + Seconds(used.ru_stime);
  result.most_mb = static_cast<double>(used.ru_maxrss) / 1024;
  result.out = out.TakeText();
  result.err = err.TakeText();
  return result;
}

ChildResult RunChild(const std::string& program, const std::vector<std::string>& arguments,
                     const std::filesystem::path& folder, const ChildLimits& limits) {
  const auto become = [&](int, char** argv) -> int {
    execv(program.c_str(), argv);
    _exit(127);
  };
  return RunForked(become, arguments, folder, limits);
}

}  // namespace floorproof
