// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>

namespace octocell {

/// As long as one of these lives, signals that would end the program wait, so that it can finish a
/// file first. Then they take their usual effect. This holds for the whole process, whichever
/// thread they reach. (Signals that the program's own fault raises do not wait; they would be
/// raised again at once.)
class DeferredSignals {
 public:
  DeferredSignals() {
    struct sigaction remember = {};
    remember.sa_handler = [](int signal) { pending() = signal; };
    remember.sa_flags = SA_RESTART;
    pending() = 0;
    for (int signal = 1; signal < kSignals; ++signal) {
      is_deferred_[signal] = ends_the_program(signal);
      if (is_deferred_[signal]) sigaction(signal, &remember, nullptr);
    }
  }
  ~DeferredSignals() {
    for (int signal = 1; signal < kSignals; ++signal) {
      if (is_deferred_[signal]) sigaction(signal, &before_[signal], nullptr);
    }
    if (pending() != 0) std::raise(pending());
  }
  DeferredSignals(const DeferredSignals&) = delete;
  DeferredSignals& operator=(const DeferredSignals&) = delete;

 private:
  static constexpr int kSignals = NSIG;

  /// Returns true if the signal would end the program or run a handler. Stores its present action.
  bool ends_the_program(int signal) {
    for (const int kept : {SIGKILL, SIGSTOP, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP,
                           SIGSYS, SIGCHLD, SIGCONT, SIGTSTP, SIGTTIN, SIGTTOU, SIGURG, SIGWINCH}) {
      if (signal == kept) return false;
    }
    return sigaction(signal, nullptr, &before_[signal]) == 0 &&
           before_[signal].sa_handler != SIG_IGN;
  }

  static volatile std::sig_atomic_t& pending() {
    static volatile std::sig_atomic_t signal = 0;
    return signal;
  }

  struct sigaction before_[kSignals];
  bool is_deferred_[kSignals] = {};
};

}  // namespace octocell
