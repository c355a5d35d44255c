// SPDX-License-Identifier: MIT
#include "harness/try/board.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace octocell::hand_in {
namespace {

int make_memory(std::size_t bytes) {
  const int fd = memfd_create("octocell", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (fd < 0 || ftruncate(fd, static_cast<off_t>(bytes)) != 0)
    throw LimitError(fmt::format("no shared memory: {}", std::strerror(errno)));
  return fd;
}

std::byte* map(int fd, std::size_t bytes, int protection) {
  void* const memory = mmap(nullptr, bytes, protection, MAP_SHARED, fd, 0);
  if (memory == MAP_FAILED)
    throw LimitError(fmt::format("no shared memory: {}", std::strerror(errno)));
  return static_cast<std::byte*>(memory);
}

std::size_t size_of(int fd) {
  struct stat status = {};
  if (fstat(fd, &status) != 0) throw LimitError("no shared memory with the judge");
  return static_cast<std::size_t>(status.st_size);
}

bool is_unwritten(const std::byte* zone) {
  return std::all_of(zone, zone + kRedZoneBytes, [](std::byte b) { return b == kUnwrittenByte; });
}

}  // namespace

Board::Board(std::size_t most_spheres, std::size_t most_pairs)
    : most_spheres_(std::max<std::size_t>(most_spheres, 1)),
      most_pairs_(most_pairs),
      spheres_fd_(make_memory(most_spheres_ * sizeof(Sphere))),
      pairs_fd_(make_memory(pairs_bytes())),
      spheres_(map(spheres_fd_, most_spheres_ * sizeof(Sphere), PROT_READ | PROT_WRITE)),
      pairs_(map(pairs_fd_, pairs_bytes(), PROT_READ | PROT_WRITE)) {
  // Whoever maps the spheres from now on can only read them.
  fcntl(spheres_fd_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_FUTURE_WRITE);
  fcntl(pairs_fd_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW);
}

Board::~Board() {
  munmap(spheres_, most_spheres_ * sizeof(Sphere));
  munmap(pairs_, pairs_bytes());
  close(spheres_fd_);
  close(pairs_fd_);
}

std::size_t Board::pairs_bytes() const {
  return kListAt + most_pairs_ * sizeof(octocell_pair) + kRedZoneBytes;
}

void Board::set(std::span<const Sphere> spheres, std::uint64_t capacity) {
  if (spheres.size() > most_spheres_ || capacity > most_pairs_)
    throw LimitError("this scene is too large to be timed");
  std::memcpy(spheres_, spheres.data(), spheres.size_bytes());
  capacity_ = capacity;
  const std::size_t used = kListAt + capacity * sizeof(octocell_pair) + kRedZoneBytes;
  std::memset(pairs_, static_cast<int>(kUnwrittenByte), used);
}

std::uint64_t Board::count() const {
  std::uint64_t count = 0;
  std::memcpy(&count, pairs_, sizeof(count));
  return count;
}

std::span<const octocell_pair> Board::first(std::uint64_t count) const {
  return {reinterpret_cast<const octocell_pair*>(pairs_ + kListAt), count};
}

bool Board::red_zones_are_whole() const {
  return is_unwritten(pairs_ + kListAt - kRedZoneBytes) &&
         is_unwritten(pairs_ + kListAt + capacity_ * sizeof(octocell_pair));
}

bool Board::holds(std::span<const Sphere> spheres) const {
  return std::memcmp(spheres_, spheres.data(), spheres.size_bytes()) == 0;
}

SeenBoard::SeenBoard() {
  spheres = reinterpret_cast<const octocell_sphere*>(
      map(kSpheresMemory, size_of(kSpheresMemory), PROT_READ));
  std::byte* const memory = map(kPairsMemory, size_of(kPairsMemory), PROT_READ | PROT_WRITE);
  count = reinterpret_cast<std::uint64_t*>(memory);
  pairs = reinterpret_cast<octocell_pair*>(memory + kListAt);
}

}  // namespace octocell::hand_in
