// SPDX-License-Identifier: MIT
#include "harness/scenes/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <filesystem>
#include <optional>
#include <utility>

#include "harness/interface/error.hpp"
#include "harness/scenes/deferred_signals.hpp"

namespace octocell {
namespace {

using Parts = std::span<const std::span<const std::byte>>;

[[noreturn]] void refuse(const std::string& path, int error) {
  throw InputError(fmt::format("cannot write {}: {}", path, std::strerror(error)));
}

/// An open file that is closed, and removed if it has a name, unless kept.
class OutputFile {
 public:
  OutputFile(int descriptor, std::string name_to_remove)
      : descriptor_(descriptor), name_to_remove_(std::move(name_to_remove)) {}
  ~OutputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!name_to_remove_.empty()) ::unlink(name_to_remove_.c_str());
  }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// All below return 0 or an errno.
  int write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) return errno;
      if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
  }
  int sync() const {
    // EINVAL: this kind of file cannot be synced.
    return ::fsync(descriptor_) == 0 || errno == EINVAL ? 0 : errno;
  }
  int close() {
    const int result = ::close(std::exchange(descriptor_, -1));
    return result == 0 ? 0 : errno;
  }
  int rename_to(const std::string& path) {
    if (std::rename(name_to_remove_.c_str(), path.c_str()) != 0) return errno;
    name_to_remove_.clear();
    return 0;
  }

 private:
  int descriptor_;
  std::string name_to_remove_;
};

void write_parts(const std::string& path, const OutputFile& file, Parts parts) {
  for (const auto& part : parts) {
    if (const int error = file.write(part)) refuse(path, error);
  }
}

void write_directly(const std::string& path, Parts parts) {
  OutputFile file(::open(path.c_str(), O_WRONLY | O_CLOEXEC), "");
  if (file.descriptor() < 0) refuse(path, errno);
  write_parts(path, file, parts);
  if (const int error = file.close()) refuse(path, error);
}

/// A new file in the target's folder, hence on its file system, where rename() is atomic.
OutputFile create_beside(const std::string& path, const std::string& target) {
  const std::filesystem::path folder = std::filesystem::path(target).parent_path();
  for (int attempt = 0;; ++attempt) {
    const std::string name =
        (folder / fmt::format(".octocell-{}-{}.tmp", ::getpid(), attempt)).string();
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return {descriptor, name};
    if (errno != EEXIST) refuse(path, errno);
  }
}

/// `path`, or what it leads to if it is a symbolic link to a file.
std::string resolve_link(const std::string& path) {
  std::error_code error;
  const std::filesystem::path resolved = std::filesystem::canonical(path, error);
  return error ? path : resolved.string();
}

/// A complete file that waits beside its target.
class Replacement {
 public:
  Replacement(const FileToWrite& to, const struct stat* existing)
      : path_(to.path), target_(resolve_link(to.path)), file_(create_beside(to.path, target_)) {
    write_parts(path_, file_, to.parts);
    if (existing != nullptr && ::fchmod(file_.descriptor(), existing->st_mode & 07777) != 0) {
      refuse(path_, errno);
    }
    if (const int error = file_.sync()) refuse(path_, error);
    if (const int error = file_.close()) refuse(path_, error);
  }
  void take_effect() {
    if (const int error = file_.rename_to(target_)) refuse(path_, error);
  }

 private:
  std::string path_;
  std::string target_;
  OutputFile file_;
};

/// What stands there, if anything does. Throws for a folder, and for a file that may not be
/// written: rename() would replace one that its owner made read-only.
std::optional<struct stat> what_stands_at(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) refuse(path, errno);
    return std::nullopt;
  }
  if (S_ISDIR(status.st_mode)) refuse(path, EISDIR);
  if (S_ISREG(status.st_mode) && ::access(path.c_str(), W_OK) != 0) refuse(path, errno);
  return status;
}

}  // namespace

void write_whole_files(std::span<const FileToWrite> files) {
  std::vector<std::pair<const FileToWrite*, std::optional<struct stat>>> to_replace;
  for (const FileToWrite& file : files) {
    const std::optional<struct stat> status = what_stands_at(file.path);
    if (!status || S_ISREG(status->st_mode)) {
      to_replace.emplace_back(&file, status);
    } else {
      write_directly(file.path, file.parts);
    }
  }
  if (to_replace.empty()) return;
  const DeferredSignals until_no_temporary_is_left;
  std::deque<Replacement> replacements;
  for (const auto& [file, status] : to_replace) {
    replacements.emplace_back(*file, status ? &*status : nullptr);
  }
  for (Replacement& replacement : replacements) replacement.take_effect();
}

}  // namespace octocell
