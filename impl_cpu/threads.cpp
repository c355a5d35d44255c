// SPDX-License-Identifier: MIT
#include "impl_cpu/threads.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <exception>
#include <functional>
#include <latch>
#include <memory>
#include <thread>
#include <vector>

namespace octocell::cpu {

/// Not asio's own thread_pool: if the system cannot make a thread, its constructor waits forever
/// for the threads that were made, which wait for work.
struct Threads::Pool {
  explicit Pool(int count) {
    threads.reserve(static_cast<std::size_t>(count));
    try {
      for (int t = 0; t < count; ++t) threads.emplace_back([this] { context.run(); });
    } catch (const std::exception&) {
      // The system gives no more threads. Those that exist do the work.
    }
  }
  ~Pool() {
    work.reset();
    for (std::thread& thread : threads) thread.join();
  }
  boost::asio::io_context context;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work{
      context.get_executor()};
  std::vector<std::thread> threads;
};

Threads::Threads(int count)
    : asked_(std::max(count, 1)),
      pool_(asked_ > 1 ? std::make_unique<Pool>(asked_ - 1) : nullptr),
      count_(pool_ ? 1 + static_cast<int>(pool_->threads.size()) : 1) {}

Threads::~Threads() = default;

void Threads::run(const std::function<void(int)>& task) {
  std::latch done(count_ - 1);
  for (int t = 1; t < count_; ++t) {
    boost::asio::post(pool_->context, [&, t] {
      task(t);
      done.count_down();
    });
  }
  task(0);
  done.wait();
}

}  // namespace octocell::cpu
