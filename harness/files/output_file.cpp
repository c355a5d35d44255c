// SPDX-License-Identifier: MIT
#include "harness/files/output_file.hpp"

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
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/files/deferred_signals.hpp"
#include "harness/files/file_identity.hpp"

namespace octocell {
namespace {

[[noreturn]] void refuse(const std::string& path, int error) {
  throw InputError(fmt::format("cannot write {}: {}", path, std::strerror(error)));
}

/// An open file. Unless it is kept, the destructor closes it, and removes it if it has a name.
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

  /// These functions return 0 or an errno.
  int write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) return errno;
      if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
  }
  int sync() const {
    // EINVAL means that this kind of file cannot be synced.
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

void write_bytes(const FileToWrite& from, const OutputFile& file) {
  from.write([&](std::span<const std::byte> bytes) {
    if (const int error = file.write(bytes)) refuse(from.path, error);
  });
}

void write_directly(const FileToWrite& from) {
  OutputFile file(::open(from.path.c_str(), O_WRONLY | O_CLOEXEC), "");
  if (file.descriptor() < 0) refuse(from.path, errno);
  write_bytes(from, file);
  if (const int error = file.close()) refuse(from.path, error);
}

/// Creates a file in the target's folder, so on the same file system, where rename() is atomic.
OutputFile create_beside(const std::string& path, const std::string& target, mode_t permissions) {
  const std::filesystem::path folder = std::filesystem::path(target).parent_path();
  for (int attempt = 0;; ++attempt) {
    const std::string name =
        (folder / fmt::format(".octocell-{}-{}.tmp", ::getpid(), attempt)).string();
    const int flags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
    const int descriptor = ::open(name.c_str(), flags, permissions);
    if (descriptor >= 0) return {descriptor, name};
    if (errno != EEXIST) refuse(path, errno);
  }
}

/// The file that exists at a path.
struct Existing {
  struct stat status;
  bool can_be_replaced;  // it has a name that another file can take over
};

/// Returns the file that `path` names, without links.
std::string target_of(const std::string& path) {
  std::error_code error;
  const std::filesystem::path resolved = std::filesystem::canonical(path, error);
  return error ? follow_links(path) : resolved.string();
}

/// Returns none if nothing exists there. Throws for a folder, and for a file that may not be
/// written: rename() would replace even a file that its owner made read-only.
std::optional<Existing> what_stands_at(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) refuse(path, errno);
    return std::nullopt;
  }
  if (S_ISDIR(status.st_mode)) refuse(path, EISDIR);
  if (!S_ISREG(status.st_mode)) return Existing{status, false};
  if (::access(path.c_str(), W_OK) != 0) refuse(path, errno);
  // An open file may have lost its name; /dev/stdout can lead to such a file.
  struct stat named = {};
  const bool has_a_name = ::stat(target_of(path).c_str(), &named) == 0 &&
                          named.st_dev == status.st_dev && named.st_ino == status.st_ino;
  return Existing{status, has_a_name && status.st_nlink > 0};
}

/// A complete file beside its target, ready to replace it.
class Replacement {
 public:
  Replacement(const FileToWrite& from, const std::optional<Existing>& existing)
      : path_(from.path),
        target_(target_of(from.path)),
        file_(create_beside(path_, target_,
                            existing ? existing->status.st_mode & 0700 : mode_t{0666})) {
    if (existing) take_over(existing->status);
    write_bytes(from, file_);
    if (const int error = file_.sync()) refuse(path_, error);
    if (const int error = file_.close()) refuse(path_, error);
  }
  void take_effect() {
    if (const int error = file_.rename_to(target_)) refuse(path_, error);
  }

 private:
  /// Takes over owner and permissions. At no time are the permissions wider than those of the
  /// replaced file. The owner is set first, because a change of owner may clear permissions. Only
  /// root can give a file to another owner. If the group differs, too, it gets no permissions.
  void take_over(const struct stat& status) {
    const int file = file_.descriptor();
    const bool has_owner = ::fchown(file, status.st_uid, status.st_gid) == 0;
    const bool has_group = has_owner || ::fchown(file, static_cast<uid_t>(-1), status.st_gid) == 0;
    const mode_t kept = has_owner ? 07777 : has_group ? 0777 : 0707;
    if (::fchmod(file, status.st_mode & kept) != 0) refuse(path_, errno);
  }

  std::string path_;
  std::string target_;
  OutputFile file_;
};

/// Throws unless all files have different names.
void require_separate(std::span<const FileToWrite> files) {
  std::vector<NamedFile> outputs;
  for (const FileToWrite& file : files) outputs.push_back({"another output", file.path});
  require_separate_files({}, outputs);
}

}  // namespace

void write_whole_files(std::span<const FileToWrite> files) {
  require_separate(files);
  std::vector<std::pair<const FileToWrite*, std::optional<Existing>>> to_replace;
  for (const FileToWrite& file : files) {
    const std::optional<Existing> existing = what_stands_at(file.path);
    if (!existing || existing->can_be_replaced) {
      to_replace.emplace_back(&file, existing);
    } else {
      write_directly(file);
    }
  }
  if (to_replace.empty()) return;
  const DeferredSignals until_no_temporary_is_left;
  std::deque<Replacement> replacements;
  for (const auto& [file, existing] : to_replace) replacements.emplace_back(*file, existing);
  for (Replacement& replacement : replacements) replacement.take_effect();
}

void write_whole_file(const std::string& path, std::string_view text) {
  const FileToWrite file = {path,
                            [text](const ByteSink& sink) { sink(std::as_bytes(std::span(text))); }};
  write_whole_files({&file, 1});
}

void require_writable(const std::string& path) {
  if (path.empty()) refuse(path, ENOENT);
  const std::optional<Existing> existing = what_stands_at(path);
  if (existing && !existing->can_be_replaced) return;
  const std::string folder = std::filesystem::path(target_of(path)).parent_path().string();
  if (::access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0) refuse(path, errno);
}

}  // namespace octocell
