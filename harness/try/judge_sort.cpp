// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/try/judge_stage.hpp"

namespace octocell::hand_in {
namespace {

using Words = std::vector<std::uint32_t>;
using Cause = std::optional<judge::Cause>;

constexpr std::uint32_t kUnwritten = 0xf1f1f1f1U;  // of Room
constexpr std::array<std::size_t, 9> kBlocks = {16, 32, 64, 128, 256, 512, 1024, 2048, 4096};

std::optional<std::size_t> first_difference(const Words& a, const Words& b) {
  const auto at = std::ranges::mismatch(a, b).in1;
  if (at == a.end()) return std::nullopt;
  return static_cast<std::size_t>(at - a.begin());
}

/// Returns the words without their control bits.
Words spheres_of(Words objects) {
  for (std::uint32_t& object : objects) object &= OCTOCELL_SPHERE;
  return objects;
}

Words in_order(Words words) {
  std::ranges::sort(words);
  return words;
}

/// Whether [0, end) is sorted as if there were no more.
bool is_sorted_up_to(const Words& got, const Words& input, std::size_t end) {
  const auto last = static_cast<std::ptrdiff_t>(end);
  Words first(input.begin(), input.begin() + last);
  std::ranges::sort(first);
  return std::equal(first.begin(), first.end(), got.begin());
}

/// Whether each block of `size` is sorted, and the blocks are not merged.
bool is_sorted_in_blocks(const Words& got, const Words& input, std::size_t size) {
  if (got.size() <= size) return false;
  for (std::size_t begin = 0; begin < got.size(); begin += size) {
    const auto from = static_cast<std::ptrdiff_t>(begin);
    const auto to = static_cast<std::ptrdiff_t>(std::min(begin + size, got.size()));
    Words block(input.begin() + from, input.begin() + to);
    std::ranges::sort(block);
    if (!std::equal(block.begin(), block.end(), got.begin() + from)) return false;
  }
  return true;
}

Cause cause_in_blocks(const Words& got, const Words& input) {
  for (const std::size_t size : kBlocks) {
    const std::size_t whole = got.size() / size * size;
    if (whole != 0 && whole != got.size() && is_sorted_up_to(got, input, whole)) {
      return list_cause("last block missing",
                        fmt::format("the first {} entries are sorted as if there were no more: "
                                    "those behind the last whole block of {} are left out",
                                    whole, size));
    }
    if (is_sorted_in_blocks(got, input, size)) {
      return list_cause("blocks not merged",
                        fmt::format("each block of {} is sorted by itself", size));
    }
  }
  return std::nullopt;
}

/// The ids are a permutation of the right ones, but in another order.
Cause cause_of_order(const Words& got, const Words& input, std::uint32_t key_bits) {
  if (got == input) return list_cause("nothing sorted", "the ids are as they were");
  if (std::ranges::is_sorted(got, {},
                             [](std::uint32_t id) { return static_cast<std::int32_t>(id); }))
    return list_cause("signed keys", "ids of 2^31 and more come first: compared as signed numbers");
  if (std::ranges::is_sorted(got, std::greater()))
    return list_cause("descending", "the largest id comes first");
  const Entries entries = {input, input};
  for (std::uint32_t bits = key_bits; bits-- > 1;) {
    const std::uint32_t mask = (1U << bits) - 1;
    if (!std::ranges::is_sorted(got, {}, [&](std::uint32_t id) { return id & mask; })) continue;
    return list_cause(
        "high bits missing",
        fmt::format("sorted by the lowest {} bits of the ids only; they have {}", bits, key_bits));
  }
  if (Cause cause = cause_in_blocks(got, input)) return cause;
  for (std::uint32_t bits = 1; bits < key_bits; ++bits) {
    if (!std::ranges::is_sorted(got, {}, [&](std::uint32_t id) { return id >> bits; })) continue;
    return list_cause(
        "a pass not stable",
        fmt::format("sorted by the bits from {} up, but not by those below: a pass over a higher "
                    "digit does not keep the order of the pass before it",
                    bits));
  }
  return std::nullopt;
}

Cause cause_of_ids(const Words& got, const Words& input, std::uint32_t key_bits) {
  const auto unwritten = static_cast<std::size_t>(std::ranges::count(got, kUnwritten));
  if (Cause cause = cause_in_blocks(got, input)) return cause;
  if (unwritten != 0)
    return list_cause("not written", fmt::format("{} entries were never written", unwritten));
  if (in_order(got) == in_order(input)) return cause_of_order(got, input, key_bits);
  return list_cause("ids lost",
                    "the ids are not those of the input: several entries went to the "
                    "same place, or to none");
}

Cause cause_of_objects(const Words& got, const StageArrays& expected) {
  const Words& right = expected.sorted.objects;
  if (got == expected.unsorted.objects)
    return list_cause("objects not carried along",
                      "the ids are sorted, the objects are as they were");
  if (got == spheres_of(got) && right != spheres_of(right))
    return list_cause("control bits lost", "bits 28 to 31 of all objects are 0");
  if (spheres_of(got) == spheres_of(right)) {
    return list_cause("control bits changed", "the objects differ in bits 28 to 31 only");
  }
  if (in_order(got) != in_order(right)) {
    return list_cause("objects lost",
                      "the objects are not those of the input: several went to the "
                      "same place, or to none");
  }
  // The same objects: are they those of their ids?
  std::vector<std::pair<std::uint32_t, std::uint32_t>> has;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> should;
  for (std::size_t k = 0; k < got.size(); ++k) {
    has.emplace_back(expected.sorted.ids[k], got[k]);
    should.emplace_back(expected.sorted.ids[k], right[k]);
  }
  std::ranges::sort(has);
  std::ranges::sort(should);
  if (has == should)
    return list_cause("not stable", "entries of the same id do not keep their order");
  return list_cause("objects of other ids", "objects stand beside ids that are not theirs");
}

}  // namespace

StageJudgement judge_sort(const Entries& got, const StageArrays& expected) {
  const Entries& right = expected.sorted;
  for (const auto& [name, has, should] : {std::tuple("ids", &got.ids, &right.ids),
                                          std::tuple("objects", &got.objects, &right.objects)}) {
    if (has->size() == should->size()) continue;
    return {WrongEntry{name, 0, fmt::format("{} entries", should->size()),
                       fmt::format("{} entries", has->size())}};
  }
  if (const auto at = first_difference(got.ids, right.ids)) {
    return {
        WrongEntry{"ids", *at, fmt::format("{}", right.ids[*at]), fmt::format("{}", got.ids[*at])},
        cause_of_ids(got.ids, expected.unsorted.ids, expected.key_bits)};
  }
  if (const auto at = first_difference(got.objects, right.objects)) {
    return {
        WrongEntry{"objects", *at, object_text(right.objects[*at]), object_text(got.objects[*at])},
        cause_of_objects(got.objects, expected)};
  }
  return {};
}

}  // namespace octocell::hand_in
