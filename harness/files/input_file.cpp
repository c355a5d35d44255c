// SPDX-License-Identifier: MIT
#include "harness/files/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.hpp"

namespace octocell {
namespace {

/// Returns why a file of this kind and size cannot be read; empty if it can.
std::string_view flaw_of(const struct stat& status) {
  if (S_ISDIR(status.st_mode)) return "is a folder, not a file";
  if (!S_ISREG(status.st_mode)) return "is not a regular file; - reads standard input";
  return status.st_size == 0 ? "is empty" : "";
}

}  // namespace

InputFile::InputFile(std::string path) : path_(std::move(path)) {
  if (path_ == kStandardInput) {
    path_ = "standard input";
    descriptor_.number = STDIN_FILENO;
    if (isatty(STDIN_FILENO) != 0) refuse("is a terminal; put a file or a pipe there");
  } else {
    open_file();
  }
  const auto descriptor = [this](std::span<std::byte> bytes) { return read_descriptor(bytes); };
  bytes_ = std::make_unique<PeekedSource>(descriptor);
  if (Gunzip::is_packed(beginning())) {
    size_.reset();
    packed_ = std::move(bytes_);
    gunzip_ = std::make_unique<Gunzip>(
        [this](std::span<std::byte> bytes) { return packed_->read(bytes); });
    bytes_ = std::make_unique<PeekedSource>(
        [this](std::span<std::byte> bytes) { return unpack(bytes); });
  }
  if (beginning().empty()) refuse("is empty");
}

InputFile::Descriptor::~Descriptor() {
  if (number > STDIN_FILENO) close(number);
}

void InputFile::open_file() {
  struct stat status = {};
  // Checks before open(), which would wait for a writer if this is a pipe.
  if (stat(path_.c_str(), &status) != 0) refuse(std::strerror(errno));
  if (const std::string_view flaw = flaw_of(status); !flaw.empty()) refuse(flaw);
  descriptor_.number = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_.number < 0) refuse(std::strerror(errno));
  size_ = static_cast<std::uint64_t>(status.st_size);
}

std::size_t InputFile::read_descriptor(std::span<std::byte> bytes) {
  std::size_t count = 0;
  while (count < bytes.size()) {
    const ssize_t got = ::read(descriptor_.number, bytes.data() + count, bytes.size() - count);
    if (got == 0) break;
    if (got < 0 && errno != EINTR) refuse(std::strerror(errno));
    if (got > 0) count += static_cast<std::size_t>(got);
  }
  return count;
}

std::size_t InputFile::unpack(std::span<std::byte> bytes) {
  try {
    return gunzip_->read(bytes);
  } catch (const GunzipError& damage) {
    refuse(damage.what());
  }
}

void InputFile::refuse(std::string_view message) const {
  throw InputError(fmt::format("{}: {}", path_, message));
}

void InputFile::refuse(std::size_t line, std::string_view message) const {
  throw InputError(fmt::format("{}:{}: {}", path_, line, message));
}

}  // namespace octocell
