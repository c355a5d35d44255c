// SPDX-License-Identifier: MIT
#include "harness/trace/step_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace octocell::trace {
namespace {

using Json = nlohmann::ordered_json;

/// RFC 4648.
std::string base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t three = 0;
    for (std::size_t b = 0; b < 3; ++b) {
      three = three << 8 | (k + b < bytes.size() ? static_cast<unsigned char>(bytes[k + b]) : 0U);
    }
    for (std::size_t d = 0; d < 4; ++d) {
      const bool is_used = d < 2 || k + d - 1 < bytes.size();
      text += is_used ? kDigits[three >> (18 - 6 * d) & 63U] : '=';
    }
  }
  return text;
}

/// Text for a script of HTML: nothing in it ends the script.
std::string script_text(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) {
    text.insert(at + 1, 1, '\\');
  }
  return text;
}

std::string constant(std::string_view name, const Json& value) {
  return fmt::format("const {} = {};\n", name, script_text(value));
}

/// A file's name without folder and ending; a generator as it is.
std::string short_name(const std::string& scene) {
  const std::filesystem::path path(scene);
  return path.has_extension() && scene.find(':') == std::string::npos ? path.stem().string()
                                                                      : scene;
}

Json scenes_of(std::span<const RunTrace> runs) {
  Json scenes = Json::array();
  for (const RunTrace& run : runs) {
    Json trace = to_json(run);
    scenes.push_back({{"name", short_name(run.scene)},
                      {"spheres", trace["spheres"]},
                      {"recorded", std::move(trace)}});
  }
  return scenes;
}

Json programs() {
  Json programs = Json::object();
  for (const PageFile& file : page_programs()) {
    Json& lines = programs[std::string(file.name)] = Json::array();
    std::string_view left = file.text;
    while (!left.empty()) {
      const std::size_t end = std::min(left.find('\n'), left.size());
      lines.push_back(left.substr(0, end));
      left.remove_prefix(std::min(end + 1, left.size()));
    }
  }
  return programs;
}

std::string with(std::string_view text, std::string_view mark, std::string_view value) {
  const std::size_t at = text.find(mark);
  return fmt::format("{}{}{}", text.substr(0, at), value, text.substr(at + mark.size()));
}

}  // namespace

void require_drawable(SceneView scene, std::string_view name) {
  if (scene.spheres.empty())
    throw LimitError(fmt::format("{}: a page without spheres shows nothing", name));
  if (scene.spheres.size() <= kMostDrawn) return;
  throw LimitError(fmt::format("{}: {} spheres; a page shows at most {}", name,
                               scene.spheres.size(), kMostDrawn));
}

std::string step_page(std::span<const RunTrace> runs) {
  std::string script = constant("SCENES", scenes_of(runs)) + constant("PROGRAMS", programs()) +
                       constant("MODULE", base64(page_module()));
  for (const PageFile& file : page_scripts()) script += fmt::format("{}\n", file.text);
  const std::string styled = with(page_frame(), "/*{{style}}*/", page_style());
  return with(styled, "/*{{script}}*/", script);
}

}  // namespace octocell::trace
