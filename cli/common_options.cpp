// SPDX-License-Identifier: GPL-3.0-or-later
#include "common_options.h"

#include <charconv>
#include <cstdio>

namespace toile::cli {
namespace {

void readSize(const std::string& text, int& width, int& height) {
  const char* end = text.data() + text.size();
  const auto across = std::from_chars(text.data(), end, width);
  if (across.ec == std::errc() && across.ptr != end && *across.ptr == 'x') {
    const auto down = std::from_chars(across.ptr + 1, end, height);
    if (down.ec == std::errc() && down.ptr == end) return;
  }
  throw CLI::ValidationError("--size: \"" + text +
                             "\" is no size; write width and height in px, such as 1600x1000");
}

}  // namespace

void addBody(CLI::App& command, std::optional<std::string>& body) {
  command
      .add_option("--body", body,
                  "Take this model instead of the design's own: a mesh file, a .model.json or "
                  "builtin:...")
      ->type_name("MODEL");
}

void addAutoCut(CLI::App& command, bool& autoCut) {
  command.add_flag("--auto-cut", autoCut,
                   "Cut tubes open along the shortest way, so that they can lie flat");
}

void addPictureSize(CLI::App& command, int& width, int& height) {
  command
      .add_option_function<std::string>(
          "--size", [&](const std::string& text) { readSize(text, width, height); },
          "Width and height in px (default: 1600x1000)")
      ->type_name("WxH");
}

void addPaper(CLI::App& command, PdfOptions& pdf) {
  addParsed(command, "--paper", pdf.paper, parsePdfPaper,
            "Paper of the .pdf: a4-letter (prints on both), a4, letter, a3, a0, or one sheet")
      ->type_name("PAPER");
  command
      .add_option_function<std::string>(
          "--overlap",
          [&pdf](const std::string& text) {
            const Result<Length> overlap = parseLength(text);
            if (!overlap) throw CLI::ValidationError("--overlap: " + overlap.error().message);
            pdf.overlap = overlap->mm();
          },
          "Let the tiles of the .pdf overlap by this, to glue them, such as 12mm")
      ->type_name("LENGTH");
}

int refuse(const std::string& sentence, const std::string& command) {
  std::fprintf(stderr, "toile: %s (toile %s --help)\n", sentence.c_str(), command.c_str());
  return kWrongCommandLine;
}

}  // namespace toile::cli
