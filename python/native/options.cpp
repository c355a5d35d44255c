// SPDX-License-Identifier: MIT
#include "python/native/options.hpp"

#include <nanobind/stl/string.h>

#include <chrono>
#include <exception>
#include <string>

namespace octocell::python {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBetweenSignals = std::chrono::milliseconds(50);

/// Lets Python handle signals. Returns true if that raised an exception, which stays set.
bool has_signal() {
  const nb::gil_scoped_acquire gil;
  return PyErr_CheckSignals() != 0;
}

nb::object exception_for(const Error& error) {
  const nb::object make = nb::module_::import_("octocell._errors").attr("exception_for");
  nb::object sphere = nb::none();
  if (error.sphere()) sphere = nb::int_(*error.sphere());
  return make(static_cast<int>(error.kind()), std::string(error.what()), sphere);
}

void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Error& error) {
    if (PyErr_Occurred() != nullptr) return;  // what a handler of a signal raised
    const nb::object exception = exception_for(error);
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
  }
}

}  // namespace

Options SearchOptions::for_library() const {
  Options options = {
      .threads = threads, .sorted = sorted, .device = on_gpu ? Device::cuda : Device::cpu};
  if (flags) options.flags = span_of<Flags>(*flags);
  options.stop = [next = Clock::now() + kBetweenSignals]() mutable {
    const auto now = Clock::now();
    if (now < next) return false;
    next = now + kBetweenSignals;
    return has_signal();
  };
  return options;
}

void translate_errors() { nb::register_exception_translator(translate); }

}  // namespace octocell::python
