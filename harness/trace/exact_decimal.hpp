// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/overlap.hpp"

namespace octocell::trace {

/// Returns all decimal digits of a square in units of 2^-298, as the integer test makes it:
/// "2.5", "0.0625". Every such number has a finite decimal expansion.
std::string exact_decimal(const exact::Square& value);

}  // namespace octocell::trace
