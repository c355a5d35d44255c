// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>

namespace octocell {

/// While one of these lives, signals that would end the program wait: what must be whole is
/// finished first. Then they take the effect they would have had. For the whole process, whichever
/// thread they reach. (Those that a fault of the program's own raises do not wait; they would be
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

  /// Or runs a handler that somebody has set. Remembers what it did so far.
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
