// SPDX-License-Identifier: MIT
// The assembler copies the page's files into the program, so that it needs none of them when it
// runs.
#include <array>
#include <span>
#include <string_view>

#include "harness/trace/step_page.hpp"

/// Defines octocell_page_NAME and octocell_page_NAME_end around the bytes of a file.
#define OCTOCELL_PAGE_FILE(name, path)          \
  asm(".section .rodata\n"                      \
      ".global octocell_page_" #name            \
      "\n"                                      \
      "octocell_page_" #name                    \
      ":\n"                                     \
      ".incbin \"" OCTOCELL_COURSE "/" path     \
      "\"\n"                                    \
      ".global octocell_page_" #name            \
      "_end\n"                                  \
      "octocell_page_" #name                    \
      "_end:\n"                                 \
      ".previous\n");                           \
  extern "C" const char octocell_page_##name[]; \
  extern "C" const char octocell_page_##name##_end[]

OCTOCELL_PAGE_FILE(frame, "page/page.html");
OCTOCELL_PAGE_FILE(style, "page/page.css");
OCTOCELL_PAGE_FILE(wasm, "page/module.wasm");
OCTOCELL_PAGE_FILE(texts, "page/texts.js");
OCTOCELL_PAGE_FILE(steps, "page/steps.js");
OCTOCELL_PAGE_FILE(module, "page/module.js");
OCTOCELL_PAGE_FILE(draw, "page/draw.js");
OCTOCELL_PAGE_FILE(recorded, "page/recorded.js");
OCTOCELL_PAGE_FILE(page, "page/page.js");
OCTOCELL_PAGE_FILE(as_written, "pipeline/1_as_written.cpp");
OCTOCELL_PAGE_FILE(control_bits, "pipeline/6_control_bits.cpp");
OCTOCELL_PAGE_FILE(exact, "pipeline/8_exact.cpp");

#define OCTOCELL_PAGE_TEXT(name) std::string_view(octocell_page_##name, octocell_page_##name##_end)

namespace octocell::trace {

std::string_view page_frame() { return OCTOCELL_PAGE_TEXT(frame); }
std::string_view page_style() { return OCTOCELL_PAGE_TEXT(style); }
std::string_view page_module() { return OCTOCELL_PAGE_TEXT(wasm); }

std::span<const PageFile> page_scripts() {
  static const std::array files = {PageFile{"texts.js", OCTOCELL_PAGE_TEXT(texts)},
                                   PageFile{"steps.js", OCTOCELL_PAGE_TEXT(steps)},
                                   PageFile{"module.js", OCTOCELL_PAGE_TEXT(module)},
                                   PageFile{"draw.js", OCTOCELL_PAGE_TEXT(draw)},
                                   PageFile{"recorded.js", OCTOCELL_PAGE_TEXT(recorded)},
                                   PageFile{"page.js", OCTOCELL_PAGE_TEXT(page)}};
  return files;
}

std::span<const PageFile> page_programs() {
  static const std::array files = {PageFile{"1_as_written.cpp", OCTOCELL_PAGE_TEXT(as_written)},
                                   PageFile{"6_control_bits.cpp", OCTOCELL_PAGE_TEXT(control_bits)},
                                   PageFile{"8_exact.cpp", OCTOCELL_PAGE_TEXT(exact)}};
  return files;
}

}  // namespace octocell::trace
