// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>

namespace octocell {

/// Writes the parts one after another: a regular file whole or not at all, anything else (a
/// device, a pipe) directly. Throws InputError "cannot write PATH: reason".
void write_whole_file(const std::string& path,
                      std::initializer_list<std::span<const std::byte>> parts);

}  // namespace octocell
