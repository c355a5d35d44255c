// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>

namespace octocell {

/// While one of these lives, Ctrl-C and its like wait: what must be whole is finished first. Then
/// they take the effect they would have had. For the whole process, whichever thread they reach.
class DeferredSignals {
 public:
  DeferredSignals() {
    struct sigaction remember = {};
    remember.sa_handler = [](int signal) { pending() = signal; };
    remember.sa_flags = SA_RESTART;
    pending() = 0;
    for (int k = 0; k < kCount; ++k) sigaction(kSignals[k], &remember, &before_[k]);
  }
  ~DeferredSignals() {
    for (int k = 0; k < kCount; ++k) sigaction(kSignals[k], &before_[k], nullptr);
    if (pending() != 0) std::raise(pending());
  }
  DeferredSignals(const DeferredSignals&) = delete;
  DeferredSignals& operator=(const DeferredSignals&) = delete;

 private:
  static constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
  static constexpr int kCount = 3;

  static volatile std::sig_atomic_t& pending() {
    static volatile std::sig_atomic_t signal = 0;
    return signal;
  }

  struct sigaction before_[kCount];
};

}  // namespace octocell
