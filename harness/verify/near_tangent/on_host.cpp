// SPDX-License-Identifier: MIT
#include <cstdint>
#include <system_error>
#include <thread>
#include <vector>

#include "harness/verify/near_tangent/near_tangent.hpp"

namespace octocell::near_tangent {

Tally try_on_host(Family family, std::uint64_t begin, std::uint64_t end, int threads) {
  const auto stride = static_cast<std::uint64_t>(threads);
  std::vector<Tally> tallies(stride);
  {
    std::vector<std::jthread> workers;
    for (std::uint64_t t = 0; t < stride; ++t) {
      const auto share = [&, t] { tallies[t] = try_pairs(family, begin + t, end, stride); };
      try {
        workers.emplace_back(share);
      } catch (const std::system_error&) {
        share();  // the system gives no more threads
      }
    }
  }
  Tally sum;
  for (const Tally& tally : tallies) add(sum, tally);
  return sum;
}

}  // namespace octocell::near_tangent
