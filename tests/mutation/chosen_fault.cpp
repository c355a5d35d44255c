// SPDX-License-Identifier: MIT
// Chooses the fault of this run: OCTOCELL_FAULT in the environment. Linked only to programs of the
// build with faults. OCTOCELL_FAULT=list prints the names.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/mutation/faults.hpp"

namespace octocell::faults {
namespace {

struct Known {
  Fault fault;
  const char* name;
  const char* what;
};
constexpr Known kKnown[] = {
#define OCTOCELL_FAULT_ROW(name, what) {Fault::name, #name, what},
    OCTOCELL_FAULT_TABLE(OCTOCELL_FAULT_ROW)
#undef OCTOCELL_FAULT_ROW
};

[[noreturn]] void list_and_exit() {
  for (const Known& known : kKnown) std::printf("%s\t%s\n", known.name, known.what);
  std::exit(0);
}

[[noreturn]] void refuse(const char* name) {
  std::fprintf(stderr, "octocell: OCTOCELL_FAULT=%s: no such fault; OCTOCELL_FAULT=list has all\n",
               name);
  std::exit(2);
}

Fault choose() {
  const char* const name = std::getenv("OCTOCELL_FAULT");
  if (name == nullptr || *name == '\0') return Fault::none;
  if (std::string_view(name) == "list") list_and_exit();
  for (const Known& known : kKnown) {
    if (std::string_view(name) == known.name) return known.fault;
  }
  refuse(name);
}

}  // namespace

const Fault chosen = choose();

}  // namespace octocell::faults
