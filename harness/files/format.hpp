// SPDX-License-Identifier: MIT
// What a file's name says about its contents.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace octocell {

/// The kinds of files that Octocell reads. A table is lines of numbers: CSV or other text.
enum class Format : std::uint8_t { npy, table, pqr };
inline constexpr std::array<std::string_view, 3> kFormatNames = {"npy", "table", "pqr"};
constexpr std::string_view name_of(Format f) { return kFormatNames[static_cast<std::size_t>(f)]; }

/// Their suffixes, as help and messages show them.
inline constexpr std::string_view kOwnSuffixes =
    ".npy, .csv, .tsv, .txt, .dat, .xyzr, .spheres, .pqr, also with .gz";

/// Returns the format of that name. Throws InputError that lists the known names.
Format format_named(std::string_view name);

/// Returns the format that the suffix tells, if there is one. A final .gz is ignored.
std::optional<Format> format_by_suffix(const std::string& path);

/// Returns the file's name without folder, suffix, and .gz or the like.
std::string stem_of(const std::string& path);

/// Returns how to convert a file of another format, for a suffix that is known: "octocell-import
/// reads this format: octocell-import a.pdb -o a.npy". Empty for an unknown suffix.
std::string way_out_by_suffix(const std::string& path);

}  // namespace octocell
