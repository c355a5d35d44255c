// SPDX-License-Identifier: MIT
#include "impl_cpu/threads.hpp"

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>
#include <latch>

namespace octocell::cpu {

struct Threads::Pool {
  explicit Pool(int count) : threads(static_cast<std::size_t>(count)) {}
  ~Pool() { threads.join(); }
  boost::asio::thread_pool threads;
};

Threads::Threads(int count)
    : count_(std::max(count, 1)),
      pool_(count_ > 1 ? std::make_unique<Pool>(count_ - 1) : nullptr) {}

Threads::~Threads() = default;

void Threads::run(const std::function<void(int)>& task) {
  std::latch done(count_ - 1);
  for (int t = 1; t < count_; ++t) {
    boost::asio::post(pool_->threads, [&, t] {
      task(t);
      done.count_down();
    });
  }
  task(0);
  done.wait();
}

}  // namespace octocell::cpu
