// SPDX-License-Identifier: MIT
#include "impl_thrust/threads.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <latch>
#include <thread>
#include <vector>

namespace octocell::on_thrust {
namespace {

/// Starts all threads at once, because that is how they will be needed.
int try_threads(int count) {
  std::latch enough(1);
  std::vector<std::jthread> threads;
  threads.reserve(static_cast<std::size_t>(count - 1));
  try {
    while (static_cast<int>(threads.size()) < count - 1) {
      threads.emplace_back([&enough] { enough.wait(); });
    }
  } catch (const std::exception&) {
    // The system gives no more threads.
  }
  enough.count_down();
  return 1 + static_cast<int>(threads.size());
}

}  // namespace

int threads_to_be_had(int count) {
  static std::atomic<int> known = 1;  // OpenMP keeps the threads that it has started
  if (count > known) known = std::max(known.load(), try_threads(count));
  return std::min(count, known.load());
}

}  // namespace octocell::on_thrust
