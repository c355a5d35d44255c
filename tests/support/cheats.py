# SPDX-License-Identifier: MIT
"""A hand-in that is exact while it is tried, and cheats while it is timed."""

CHEATS = """
#include "octocell_plugin.h"
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>
#include <fcntl.h>
#include <time.h>
#include <unistd.h>

static const std::string cheat = getenv("CHEAT") ? getenv("CHEAT") : "";
static bool does(const char* name) { return cheat == name && fcntl(5, F_GETFD) >= 0; }

static uint64_t brute_force(const octocell_sphere* s, uint32_t n, octocell_pair* pairs,
                            uint64_t capacity) {
  uint64_t k = 0;
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = i + 1; j < n; ++j) {
      const double x = (double)s[i].x - s[j].x, y = (double)s[i].y - s[j].y;
      const double z = (double)s[i].z - s[j].z, r = (double)s[i].r + s[j].r;
      if (x * x + y * y + z * z > r * r) continue;
      if (k < capacity) pairs[k] = {i, j};
      ++k;
    }
  return k;
}

// A clock of its own, where the judge would find it if it were in this process.
extern "C" int clock_gettime(clockid_t, timespec* t) { *t = {1, 1}; return 0; }

int find_pairs(const octocell_sphere* s, uint32_t n, octocell_pair* pairs, uint64_t capacity,
               uint64_t* count, void*) {
  static std::vector<octocell_pair> last;
  if (does("last answer") && !last.empty()) {
    memcpy(pairs, last.data(), 8 * last.size());
    *count = last.size();
    puts("{\\"verdict\\": \\"exact\\"}");
    return 0;
  }
  if (does("later thread")) {
    std::thread([=] { usleep(3000); brute_force(s, n, pairs, capacity); }).detach();
    *count = 200;
    return 0;
  }
  if (does("later process")) {
    if (fork() == 0) { setsid(); usleep(3000); brute_force(s, n, pairs, capacity); _exit(0); }
    *count = 200;
    return 0;
  }
  if (does("clobber")) ((octocell_sphere*)s)[0].x = 0;
  if (does("behind")) pairs[capacity] = {1, 2};
  if (does("before")) pairs[-1] = {1, 2};
  if (does("clock")) usleep(30000);
  *count = brute_force(s, n, pairs, capacity);
  if (does("small only") && n > 1000) *count = 0;
  if (does("huge count")) *count = ~0ull;
  last.assign(pairs, pairs + (*count < capacity ? *count : capacity));
  return 0;
}
"""
