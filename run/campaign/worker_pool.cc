// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/worker_pool.h"

#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <map>
#include <new>
#include <vector>

#include "base/error.h"
#include "base/fork.h"
#include "base/watched_call.h"
#include "base/whole_io.h"

namespace floorproof {
namespace {

constexpr int kPoll_ms = 100;
constexpr int kTries = 2;

std::string HowItEnded(int status) {
  if (WIFSIGNALED(status)) return std::string("killed by ") + strsignal(WTERMSIG(status));
  return "ended with status " + std::to_string(WEXITSTATUS(status));
}

// In the child: answers jobs until the parent closes the pipe. Never returns; what `work` throws
// ends the process here, before it could unwind into the parent's own code.
[[noreturn]] void Serve(int jobs, int answers,
                        const std::function<std::string(Job)>& work) noexcept {
  Job job = 0;
  while (ReadAll(jobs, &job, sizeof job)) {
    const std::string answer = work(job);
    const std::uint64_t size = answer.size();
    if (!WriteAll(answers, &size, sizeof size) || !WriteAll(answers, answer.data(), size)) break;
  }
  _exit(0);
}

// A call for each worker, in memory that this process and its children share.
class SharedCalls {
 public:
  explicit SharedCalls(std::size_t n) : size_(std::max<std::size_t>(n, 1) * sizeof(WatchedCall)) {
    memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED)
      throw InternalError(std::string("no shared memory: ") + std::strerror(errno));
    for (std::size_t i = 0; i < n; ++i) new (&(*this)[i]) WatchedCall;
  }
  ~SharedCalls() { munmap(memory_, size_); }
  SharedCalls(const SharedCalls&) = delete;
  SharedCalls& operator=(const SharedCalls&) = delete;
  WatchedCall& operator[](std::size_t i) { return static_cast<WatchedCall*>(memory_)[i]; }

 private:
  std::size_t size_;
  void* memory_;
};

class Pool {
 public:
  Pool(int workers, const PoolCallbacks& callbacks)
      : callbacks_(callbacks),
        workers_(static_cast<std::size_t>(workers)),
        calls_(workers_.size()) {
    for (std::size_t i = 0; i < workers_.size(); ++i) workers_[i].call = &calls_[i];
  }
  ~Pool() {
    for (Worker& worker : workers_) End(worker, SIGKILL);
  }

  void Run() {
    for (Worker& worker : workers_)
      if (!Feed(worker)) break;
    while (in_flight() > 0 && !callbacks_.stop()) {
      std::vector<pollfd> fds;
      for (const Worker& worker : workers_)
        fds.push_back({worker.busy ? worker.answers : -1, POLLIN, 0});
      const bool answered = poll(fds.data(), fds.size(), kPoll_ms) > 0;
      for (std::size_t i = 0; i < fds.size(); ++i) {
        if (answered && fds[i].revents != 0)
          Answer(workers_[i]);
        else if (workers_[i].busy)
          EndWhereOverdue(workers_[i]);
      }
    }
  }

 private:
  struct Worker {
    pid_t pid = -1;
    int jobs = -1, answers = -1;  // the parent's ends
    bool busy = false;
    Job job = 0;
    WatchedCall* call = nullptr;  // that it is in
  };

  int in_flight() const {
    int n = 0;
    for (const Worker& worker : workers_) n += worker.busy;
    return n;
  }

  // Gives the worker its next job; false when there is none.
  bool Feed(Worker& worker) {
    std::optional<Job> job;
    if (again_.empty()) {
      job = callbacks_.next();
    } else {
      job = again_.front();
      again_.pop_front();
    }
    if (!job) return false;
    if (worker.pid < 0) Start(worker);
    worker.job = *job;
    worker.busy = true;
    // Where the worker is gone already, its answer's end says so.
    WriteAll(worker.jobs, &worker.job, sizeof worker.job);
    return true;
  }

  void Start(Worker& worker) {
    int jobs[2], answers[2];
    if (!OwnPipe(jobs)) throw InternalError(std::string("no pipe: ") + std::strerror(errno));
    if (!OwnPipe(answers)) {
      const int error = errno;
      CloseOwn(jobs[0]), CloseOwn(jobs[1]);
      throw InternalError(std::string("no pipe: ") + std::strerror(error));
    }
    const pid_t parent = getpid();
    worker.call->until_ns = 0;  // of the one before, which is gone
    const pid_t pid = Fork();
    if (pid < 0) {
      const int error = errno;
      for (const int end : {jobs[0], jobs[1], answers[0], answers[1]}) CloseOwn(end);
      throw InternalError(std::string("no worker process: ") + std::strerror(error));
    }
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) _exit(0);  // it died before
      signal(SIGINT, SIG_IGN);
      signal(SIGHUP, SIG_IGN);
      signal(SIGTERM, SIG_DFL);
      signal(SIGPIPE, SIG_DFL);
      // The other workers' ends, or a worker would outlive the pipe's closing; the lock on the
      // campaign's folder, or it would outlive the parent's.
      CloseAllOwnBut({jobs[0], answers[1]});
      TellCallsTo(worker.call);
      Serve(jobs[0], answers[1], callbacks_.work);
    }
    CloseOwn(jobs[0]);
    CloseOwn(answers[1]);
    worker = {pid, jobs[1], answers[0], false, 0, worker.call};
  }

  void Answer(Worker& worker) {
    std::uint64_t size = 0;
    std::string answer;
    bool whole = ReadAll(worker.answers, &size, sizeof size);
    if (whole) {
      answer.resize(size);
      whole = ReadAll(worker.answers, answer.data(), size);
    }
    worker.busy = false;
    const Job job = worker.job;
    if (whole) {
      tries_.erase(job);
      callbacks_.done(job, std::move(answer));
    } else {
      const std::string how = End(worker, SIGKILL);
      if (++tries_[job] < kTries)
        again_.push_back(job);
      else
        callbacks_.crashed(job, "its process was " + how + ", twice");
    }
    Feed(worker);
  }

  void EndWhereOverdue(Worker& worker) {
    const auto why = Overdue(*worker.call);
    if (!why) return;
    End(worker, SIGKILL);
    worker.busy = false;
    tries_.erase(worker.job);
    callbacks_.hung(worker.job, *why);
    Feed(worker);
  }

  // Reaps the worker, killing it where it lives; how it ended.
  std::string End(Worker& worker, int signal_number) {
    if (worker.pid < 0) return "";
    CloseOwn(worker.jobs);
    CloseOwn(worker.answers);
    int status = 0;
    // One that died by itself is a zombie by now, or about to be: its answers' end was closed.
    bool reaped = false;
    for (int i = 0; i < 20 && !worker.busy && !reaped; ++i) {
      reaped = waitpid(worker.pid, &status, WNOHANG) == worker.pid;
      if (!reaped) usleep(1000);
    }
    if (!reaped) {  // else its number may be another's by now
      kill(worker.pid, signal_number);
      while (waitpid(worker.pid, &status, 0) < 0 && errno == EINTR) {
      }
    }
    worker.pid = -1;
    return HowItEnded(status);
  }

  const PoolCallbacks& callbacks_;
  std::vector<Worker> workers_;
  SharedCalls calls_;
  std::deque<Job> again_;
  std::map<Job, int> tries_;
};

}  // namespace

void RunInWorkers(int workers, const PoolCallbacks& callbacks) {
  // A worker that dies between two jobs closes the pipe that the next is written to.
  struct sigaction ignore {};
  struct sigaction before {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, &before);
  try {
    Pool(workers, callbacks).Run();
  } catch (...) {
    sigaction(SIGPIPE, &before, nullptr);
    throw;
  }
  sigaction(SIGPIPE, &before, nullptr);
}

}  // namespace floorproof
