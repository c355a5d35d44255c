// SPDX-License-Identifier: MIT
// The variants of the radix sort on a GPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/cuda/cuda.cuh"
#include "harness/bench/sort/gpu_sort_check.cuh"
#include "impl_cuda_custom/radix_sort/radix_sort.cuh"

namespace octocell::cuda_custom {
namespace {

using cuda::check;
using cuda::DeviceArray;

constexpr std::uint32_t kPoison = 0xababababu;
constexpr std::uint64_t kGuardWords = 64;
constexpr Variant kVariants[] = {Variant::one_bit_split, Variant::digit_passes,
                                 Variant::reduce_then_scan, Variant::onesweep};
constexpr int kBits[] = {0, 1, 5, 8, 9, 11, 12, 17, 20, 24, 30, 32};

enum class Keys : std::uint8_t { random, sorted, reversed, constant, few_distinct, greatest };
constexpr Keys kKinds[] = {Keys::random,   Keys::sorted,       Keys::reversed,
                           Keys::constant, Keys::few_distinct, Keys::greatest};

/// The same on host and device: item i's key, below 2^bits.
__host__ __device__ std::uint32_t key_of(Keys kind, int bits, std::uint32_t i, std::uint32_t n) {
  if (bits == 0) return 0;
  std::uint32_t hash = (i + 1) * 0x9e3779b9u;
  hash = (hash ^ hash >> 15) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  hash ^= hash >> 16;
  const std::uint32_t greatest = 0xffffffffu >> (32 - bits);
  const std::uint64_t ascending = std::uint64_t{i} * (std::uint64_t{greatest} + 1) / n;
  switch (kind) {
    case Keys::random:
      return hash >> (32 - bits);
    case Keys::sorted:
      return static_cast<std::uint32_t>(ascending);
    case Keys::reversed:
      return greatest - static_cast<std::uint32_t>(ascending);
    case Keys::constant:
      return greatest / 3;
    case Keys::few_distinct:
      return hash % 7 * (greatest / 7);
    case Keys::greatest:
      return greatest;
  }
  return 0;
}

__global__ void fill_kernel(std::uint32_t* keys, std::uint32_t* values, Keys kind, int bits,
                            std::uint32_t n) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= n) return;
  keys[i] = key_of(kind, bits, i, n);
  values[i] = i;
}

/// Two sides whose memory is a little too long, so that what is written beyond the end shows.
class Arena {
 public:
  Arena(Variant variant, std::uint64_t capacity, int bits)
      : sort_(variant, capacity, bits), bits_(bits) {
    side_words_ = words_of_side(capacity);
    for (int side : {0, 1}) {
      memory_[side].allocate(side_words_ + kGuardWords);
      arrays_[side] = arrays_in(memory_[side].data(), capacity);
    }
    input_.allocate(capacity + 1);
    scratch_words_ = (sort_.scratch_bytes() + 3) / 4;
    scratch_.allocate(scratch_words_ + kGuardWords);
    count_.allocate(1);
    faults_.allocate(1);
    check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
  }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  ~Arena() { cudaStreamDestroy(stream_); }

  /// Queues everything; `count` may be beyond the capacity, and `here` is how many must be sorted.
  void start(Keys kind, std::uint64_t count, std::uint32_t here) {
    here_ = here;
    for (int side : {0, 1}) poison(memory_[side], side_words_ + kGuardWords);
    poison(scratch_, scratch_words_ + kGuardWords);
    check(cudaMemcpyAsync(count_.data(), &count, sizeof(count), cudaMemcpyDefault, stream_));
    const unsigned blocks = here / 256 + 1;
    const KeysAndValues front = arrays_[0];
    fill_kernel<<<blocks, 256, 0, stream_>>>(front.keys, front.values, kind, bits_, here);
    check(cudaGetLastError());
    check(cudaMemcpyAsync(input_.data(), front.keys, std::uint64_t{here} * 4, cudaMemcpyDefault,
                          stream_));
    sort_.launch(front, arrays_[1], count_.data(), scratch_.data(), stream_);
  }

  /// "none", or what is wrong first.
  std::string fault() {
    bench::SortFaults found;
    check(cudaMemsetAsync(faults_.data(), 0, sizeof(found), stream_));
    const KeysAndValues sorted = result();
    bench::find_sort_faults_kernel<<<here_ / 256 + 1, 256, 0, stream_>>>(
        input_.data(), sorted.keys, sorted.values, here_, faults_.data());
    check(cudaGetLastError());
    check(cudaMemcpyAsync(&found, faults_.data(), sizeof(found), cudaMemcpyDefault, stream_));
    check(cudaStreamSynchronize(stream_));
    if (found.foreign != 0) return std::to_string(found.foreign) + " pairs not of the input";
    if (found.disordered != 0) return std::to_string(found.disordered) + " pairs not in order";
    for (const Words& memory : memory_) {
      if (!is_poison(memory, side_words_)) return "written beyond end";
    }
    if (!is_poison(scratch_, scratch_words_)) return "written beyond the scratch memory";
    return "none";
  }

  std::vector<std::uint32_t> keys() const { return read(result().keys, here_); }
  std::vector<std::uint32_t> values() const { return read(result().values, here_); }

 private:
  using Words = DeviceArray<std::uint32_t>;
  void poison(const Words& words, std::uint64_t size) {
    check(cudaMemsetAsync(words.data(), 0xab, size * 4, stream_));
  }
  KeysAndValues result() const { return arrays_[sort_.result_side()]; }
  std::vector<std::uint32_t> read(const std::uint32_t* from, std::uint64_t size) const {
    std::vector<std::uint32_t> words(size);
    check(cudaMemcpyAsync(words.data(), from, size * 4, cudaMemcpyDefault, stream_));
    check(cudaStreamSynchronize(stream_));
    return words;
  }
  bool is_poison(const Words& words, std::uint64_t begin) const {
    const auto guard = read(words.data() + begin, kGuardWords);
    return std::all_of(guard.begin(), guard.end(), [](std::uint32_t w) { return w == kPoison; });
  }

  RadixSort sort_;
  int bits_;
  std::uint32_t here_ = 0;
  std::uint64_t side_words_ = 0;
  std::uint64_t scratch_words_ = 0;
  Words input_;
  Words memory_[2];
  KeysAndValues arrays_[2];
  Words scratch_;
  DeviceArray<std::uint64_t> count_;
  DeviceArray<bench::SortFaults> faults_;
  cudaStream_t stream_ = nullptr;
};

class RadixSortOnDevice : public testing::TestWithParam<Variant> {
 protected:
  void SetUp() override {
    int devices = 0;
    const cudaError_t result = cudaGetDeviceCount(&devices);
    if (result != cudaSuccess || devices == 0) {
      GTEST_SKIP() << "no CUDA device: " << cudaGetErrorString(result);
    }
  }
  [[nodiscard]] bool is_fast() const { return GetParam() >= Variant::reduce_then_scan; }
  static std::uint64_t free_bytes() {
    std::size_t free = 0;
    std::size_t total = 0;
    check(cudaMemGetInfo(&free, &total));
    return free;
  }
};

/// Around warps, and around the tiles of all variants.
std::vector<std::uint32_t> awkward_sizes() {
  std::vector<std::uint32_t> sizes = {0, 1, 2, 31, 32, 33};
  for (const std::uint32_t tile :
       {1024u, 2048u, 4096u, 8192u, 10240u, 16384u, 20480u, 2 * 20480u}) {
    for (const std::uint32_t n : {tile - 1, tile, tile + 1}) sizes.push_back(n);
  }
  return sizes;
}

TEST_P(RadixSortOnDevice, SortsEveryWidthOrderAndSize) {
  for (const int bits : kBits) {
    for (const std::uint32_t n : awkward_sizes()) {
      Arena arena(GetParam(), n, bits);
      for (const Keys kind : kKinds) {
        arena.start(kind, n, n);
        ASSERT_EQ(arena.fault(), "none")
            << "bits " << bits << ", n " << n << ", keys " << static_cast<int>(kind);
      }
    }
  }
}

/// The capacity decides which tile size onesweep takes, so the sizes meet them all.
TEST_P(RadixSortOnDevice, SortsFewerPairsThanThereIsRoomFor) {
  for (const std::uint32_t capacity : {100'000u, 1u << 20, 1u << 22, 5'000'000u}) {
    for (const int bits : {1, 5, 8, 9, 17, 20, 32}) {
      Arena arena(GetParam(), capacity, bits);
      for (const std::uint32_t n : awkward_sizes()) {
        for (const Keys kind : {Keys::random, Keys::greatest}) {
          arena.start(kind, n, n);
          ASSERT_EQ(arena.fault(), "none")
              << "bits " << bits << ", n " << n << ", capacity " << capacity;
        }
      }
    }
  }
}

TEST_P(RadixSortOnDevice, SortsNoMoreThanThereIsRoomFor) {
  for (const std::uint64_t count : {std::uint64_t{5001}, std::uint64_t{1} << 40}) {
    Arena arena(GetParam(), 5000, 17);
    arena.start(Keys::random, count, 5000);
    EXPECT_EQ(arena.fault(), "none") << count;
  }
}

TEST_P(RadixSortOnDevice, AgreesWithAStableSortOnTheHost) {
  constexpr std::uint32_t n = 30'000;
  for (const int bits : {5, 11, 32}) {
    Arena arena(GetParam(), n, bits);
    arena.start(Keys::few_distinct, n, n);
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) { return key_of(Keys::few_distinct, bits, i, n); };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    EXPECT_EQ(arena.values(), order) << bits;
    std::transform(order.begin(), order.end(), order.begin(), key);
    EXPECT_EQ(arena.keys(), order) << bits;
  }
}

TEST_P(RadixSortOnDevice, SortsAMillionPairsAndOne) {
  constexpr std::uint32_t n = (1u << 20) + 1;
  for (const int bits : kBits) {
    Arena arena(GetParam(), n, bits);
    for (const Keys kind : kKinds) {
      arena.start(kind, n, n);
      ASSERT_EQ(arena.fault(), "none") << "bits " << bits << ", keys " << static_cast<int>(kind);
    }
  }
}

TEST_P(RadixSortOnDevice, AnswersTheSameAHundredTimes) {
  constexpr std::uint32_t n = 1'000'003;
  for (const int bits : {20, 32}) {
    Arena arena(GetParam(), n, bits);
    for (int repetition = 0; repetition < 100; ++repetition) {
      arena.start(Keys::random, n, n);
      ASSERT_EQ(arena.fault(), "none") << "bits " << bits << ", repetition " << repetition;
    }
  }
}

TEST_P(RadixSortOnDevice, TwoStreamsSortAtOnce) {
  constexpr std::uint32_t n = 3'000'000;
  Arena one(GetParam(), n, 20);
  Arena other(GetParam(), n, 32);
  for (int repetition = 0; repetition < 10; ++repetition) {
    one.start(Keys::random, n, n);
    other.start(Keys::few_distinct, n, n);
    ASSERT_EQ(one.fault(), "none");
    ASSERT_EQ(other.fault(), "none");
  }
}

TEST_P(RadixSortOnDevice, SortsSixtyMillionPairs) {
  if (!is_fast()) GTEST_SKIP() << "one of the slow variants";
  constexpr std::uint32_t n = 1u << 26;
  for (const int bits : {8, 17, 20, 30, 32}) {
    Arena arena(GetParam(), n, bits);
    for (const Keys kind : {Keys::random, Keys::constant, Keys::few_distinct}) {
      arena.start(kind, n, n);
      ASSERT_EQ(arena.fault(), "none") << "bits " << bits << ", keys " << static_cast<int>(kind);
    }
  }
}

TEST_P(RadixSortOnDevice, SortsAsManyAsItPromises) {
  if (!is_fast()) GTEST_SKIP() << "one of the slow variants";
  constexpr std::uint32_t n = (1u << 31) - 1;
  if (free_bytes() < std::uint64_t{50} << 30) GTEST_SKIP() << "less than 50 GiB are free";
  Arena arena(GetParam(), n, 20);
  for (const Keys kind : {Keys::random, Keys::constant}) {
    arena.start(kind, n, n);
    EXPECT_EQ(arena.fault(), "none") << static_cast<int>(kind);
  }
}

TEST_P(RadixSortOnDevice, RefusesWhatItCannotSort) {
  EXPECT_THROW(RadixSort(GetParam(), 10, 33), Error);
  EXPECT_THROW(RadixSort(GetParam(), 10, -1), Error);
  EXPECT_THROW(RadixSort(GetParam(), std::uint64_t{1} << 31, 8), LimitError);
}

TEST_P(RadixSortOnDevice, KnowsBeforehandWhereTheResultIs) {
  const RadixSort nothing(GetParam(), 10, 0);
  EXPECT_EQ(nothing.result_side(), 0);
  EXPECT_EQ(nothing.scratch_bytes(), 0U);
  EXPECT_EQ(RadixSort(GetParam(), 10, 1).result_side(), 1);
  EXPECT_EQ(RadixSort(GetParam(), 10, 32).result_side(), 0);
}

std::string name_of_variant(const testing::TestParamInfo<Variant>& variant) {
  constexpr const char* kNames[] = {"one_bit_split", "digit_passes", "reduce_then_scan",
                                    "onesweep"};
  return kNames[static_cast<int>(variant.param)];
}

INSTANTIATE_TEST_SUITE_P(Variants, RadixSortOnDevice, testing::ValuesIn(kVariants),
                         name_of_variant);

}  // namespace
}  // namespace octocell::cuda_custom
