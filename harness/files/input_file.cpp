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
  if (!S_ISREG(status.st_mode)) return "is not a regular file";
  return status.st_size == 0 ? "is empty" : "";
}

}  // namespace

InputFile::InputFile(std::string path) : path_(std::move(path)) {
  struct stat status = {};
  // Checks before open(), which would wait for a writer if this is a pipe.
  if (stat(path_.c_str(), &status) != 0) refuse(std::strerror(errno));
  if (const std::string_view flaw = flaw_of(status); !flaw.empty()) refuse(flaw);
  descriptor_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) refuse(std::strerror(errno));
  size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void InputFile::read(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t got = ::read(descriptor_, bytes.data(), bytes.size());
    if (got == 0) refuse("became shorter while it was read");
    if (got < 0 && errno != EINTR) refuse(std::strerror(errno));
    if (got > 0) bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

void InputFile::refuse(std::string_view message) const {
  throw InputError(fmt::format("{}: {}", path_, message));
}

void InputFile::refuse(std::size_t line, std::string_view message) const {
  throw InputError(fmt::format("{}:{}: {}", path_, line, message));
}

}  // namespace octocell
