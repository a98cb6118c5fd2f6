// SPDX-License-Identifier: Apache-2.0
#include "validate/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "base/interrupt.h"
#include "env/scene/wheel_collider.h"

namespace floorproof {

void RunParallel(int n, int jobs, const std::function<void(int)>& run) {
  InstallWheelCollider();  // MuJoCo's table is global: before there are threads
  std::atomic<int> next = 0;
  std::exception_ptr first;
  std::mutex guard;
  const auto work = [&] {
    for (int i = next++; i < n && !Interrupted(); i = next++) {
      try {
        run(i);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (!first) first = std::current_exception();
        next = n;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int k = 1; k < std::min(jobs, n); ++k) threads.emplace_back(work);
    work();
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace floorproof
