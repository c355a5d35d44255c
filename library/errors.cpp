// SPDX-License-Identifier: MIT
#include "library/errors.hpp"

#include <exception>
#include <new>

#include "include/octocell/error.hpp"

namespace octocell::library {

void throw_as_error() {
  try {
    throw;
  } catch (const Error& error) {
    throw Error(error.what(), error.kind(), error.sphere());
  } catch (const std::bad_alloc&) {
    throw Error("not enough memory for this scene", ErrorKind::memory);
  } catch (const std::exception& error) {
    throw Error(error.what());
  }
}

}  // namespace octocell::library
