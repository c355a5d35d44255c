// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <vector>

#include "octocell_stage.h"

namespace {

constexpr uint32_t kDigitBits = 8;
constexpr uint32_t kDigits = 1 << kDigitBits;

struct Entries {
  std::vector<uint32_t> ids;
  std::vector<uint32_t> objects;
};

/// {3, 0, 2} becomes {0, 3, 3}: counts become the places at which each digit begins.
void exclusive_sum(std::vector<uint32_t>& counts) {
  uint32_t before = 0;
  for (uint32_t& count : counts) before += std::exchange(count, before);
}

void sort_by_digit(const Entries& from, Entries& to, uint32_t shift) {
  std::vector<uint32_t> places(kDigits, 0);
  for (const uint32_t id : from.ids) ++places[(id >> shift) % kDigits];
  exclusive_sum(places);
  for (size_t k = 0; k < from.ids.size(); ++k) {
    const uint32_t place = places[(from.ids[k] >> shift) % kDigits]++;
    to.ids[place] = from.ids[k];
    to.objects[place] = from.objects[k];
  }
}

}  // namespace

int sort(const uint32_t* ids, const uint32_t* objects, uint32_t n, uint32_t key_bits,
         uint32_t* sorted_ids, uint32_t* sorted_objects) {
  Entries now = {{ids, ids + n}, {objects, objects + n}};
  Entries next = now;
  for (uint32_t shift = 0; shift < key_bits; shift += kDigitBits) {
    sort_by_digit(now, next, shift);
    std::swap(now, next);
  }
  std::copy(now.ids.begin(), now.ids.end(), sorted_ids);
  std::copy(now.objects.begin(), now.objects.end(), sorted_objects);
  return 0;
}
