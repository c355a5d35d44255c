// SPDX-License-Identifier: MIT
#include "harness/try/compile.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/try/child.hpp"
#include "harness/try/output_of.hpp"
#include "harness/try/python_runner.hpp"

namespace octocell::hand_in {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr std::chrono::seconds kCompileTime{120};

std::string variable(const char* name, const char* otherwise) {
  const char* const value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

/// $CUDACXX, the PATH, or $CUDA_HOME. Throws CannotJudge.
std::string nvcc() {
  Words places = {variable("CUDACXX", "")};
  const std::string path = variable("PATH", "");
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find(':', begin), path.size());
    places.push_back(path.substr(begin, end - begin) + "/nvcc");
    begin = end + 1;
  }
  places.push_back(variable("CUDA_HOME", "/usr/local/cuda") + "/bin/nvcc");
  for (const std::string& place : places) {
    if (access(place.c_str(), X_OK) == 0) return place;
  }
  throw CannotJudge("does not compile",
                    "there is no nvcc here: not in $CUDACXX, the PATH or $CUDA_HOME/bin");
}

std::string this_program() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).string();
}

/// The folder of octocell_plugin.h: that of the sources, or beside an installed program's.
std::string include_folder() {
  std::error_code error;
  const fs::path sources = OCTOCELL_PLUGIN_INCLUDE;
  if (fs::exists(sources, error)) return sources.string();
  return (fs::path(this_program()).parent_path().parent_path() / "include/octocell").string();
}

Words compiler_command(const std::string& file, const std::string& suffix, bool sanitize,
                       const std::string& library) {
  Words command;
  if (suffix == ".cu") {
    command = {nvcc(), "-std=c++20", "-O2", "-Xcompiler", "-fPIC", "-shared"};
    if (sanitize) command.emplace_back("-lineinfo");
  } else {
    command = {variable("CXX", "c++"), "-std=c++20", "-O2", "-fPIC", "-shared", "-pthread"};
    if (sanitize) {
      command.insert(command.end(), {"-O1", "-g", "-fno-omit-frame-pointer",
                                     "-fsanitize=address,undefined", "-fno-sanitize-recover=all"});
    }
  }
  command.insert(command.end(), {"-I", include_folder(), file, "-o", library});
  return command;
}

/// The runner is no sanitized program, so the sanitizer's library must be loaded before all others.
Words with_address_sanitizer() {
  const std::string compiler = variable("CXX", "c++");
  for (const char* name : {"libasan.so", "libclang_rt.asan-x86_64.so"}) {
    const Output found =
        output_of({compiler, fmt::format("-print-file-name={}", name)}, kCompileTime);
    const std::string path(trim(std::string_view(found.text).substr(0, found.text.find('\n'))));
    if (path.find('/') == std::string::npos) continue;
    return {"env", "LD_PRELOAD=" + path, "ASAN_OPTIONS=detect_leaks=0:print_legend=0"};
  }
  throw CannotJudge("no sanitizer", fmt::format("{} has no libasan.so", compiler));
}

Words with_compute_sanitizer() {
  if (access("/dev/nvidiactl", F_OK) != 0)
    throw CannotJudge("no sanitizer", "compute-sanitizer needs a GPU, and there is none here");
  const std::string tool = (fs::path(nvcc()).parent_path() / "compute-sanitizer").string();
  if (access(tool.c_str(), X_OK) != 0)
    throw CannotJudge("no sanitizer", "there is no compute-sanitizer beside nvcc");
  return {tool, "--error-exitcode", "86", "--print-limit", "1"};
}

/// Returns the words before the command that has the sanitizer in it.
Words sanitizer_for(const std::string& suffix) {
  if (suffix == ".cpp") return with_address_sanitizer();
  if (suffix == ".cu") return with_compute_sanitizer();
  throw CannotJudge("no sanitizer",
                    fmt::format("--sanitize is for .cpp and .cu, not for {}", suffix));
}

/// The first line that names an error, else the first line.
std::string first_error(std::string_view output) {
  std::string_view first;
  while (!output.empty()) {
    const std::size_t end = std::min(output.find('\n'), output.size());
    const std::string_view line = output.substr(0, end);
    if (first.empty()) first = line;
    if (line.find("error") != std::string_view::npos) return std::string(line);
    output.remove_prefix(std::min(end + 1, output.size()));
  }
  return std::string(first);
}

void compile(const Words& command) {
  const Output output = output_of(command, kCompileTime);
  if (output.timed_out)
    throw CannotJudge("does not compile", fmt::format("not within {} s", kCompileTime.count()));
  if (output.exit_code != 0) {
    throw CannotJudge("does not compile",
                      fmt::format("{}: {}", command.front(), printable(first_error(output.text))));
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "octocell-try-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw LimitError(fmt::format("no folder {}", name));
  path_ = name;
  // The hand-in may run as another user.
  fs::permissions(path_, fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_exec);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

Program prepare_program(const std::string& file, Function function, const std::string& python,
                        bool sanitize, const TemporaryFolder& folder) {
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    throw InputError(fmt::format("{}: no such file", printable(file)));
  const std::string path = fs::absolute(file).string();
  const std::string suffix = lower_case(fs::path(file).extension().string());
  const bool is_compiled = suffix == ".cpp" || suffix == ".cu";
  if (!is_compiled && suffix != ".so" && suffix != ".py")
    throw InputError(fmt::format("{}: expected .cpp, .cu, .so or .py", printable(file)));

  Program program;
  if (sanitize) program.command = sanitizer_for(suffix);
  const std::string name(name_of(function));
  if (suffix == ".py") {
    // It keeps its user, because others may not read packages of root's own.
    program.command = {python, "-c", kPythonRunner, path, name};
    return program;
  }
  std::string library = path;
  if (is_compiled) {
    library = (folder.path() / "hand_in.so").string();
    program.compiled_with = compiler_command(path, suffix, sanitize, library);
    compile(program.compiled_with);
  }
  const Words runner = {this_program(), "run-hand-in", library, name};
  program.command.insert(program.command.end(), runner.begin(), runner.end());
  program.reads = {this_program(), library};
  program.may_change_user = true;
  return program;
}

}  // namespace octocell::hand_in
