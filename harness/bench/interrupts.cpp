// SPDX-License-Identifier: MIT
#include "harness/bench/interrupts.hpp"

#include <csignal>

namespace octocell::bench {
namespace {

volatile std::sig_atomic_t seen = 0;

}  // namespace

void listen_for_interrupts() {
  seen = 0;
  std::signal(SIGINT, [](int) {
    seen = 1;
    std::signal(SIGINT, SIG_DFL);
  });
}

bool interrupted() { return seen != 0; }

}  // namespace octocell::bench
