// SPDX-License-Identifier: GPL-3.0-or-later
// Options that several sub-commands have: said the same way in each.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "session.h"
#include "toile/io/pdf.h"

namespace toile::cli {

/// --body MODEL: a design on another model than its own.
void addBody(CLI::App& command, std::optional<std::string>& body);
/// --auto-cut
void addAutoCut(CLI::App& command, bool& autoCut);
/// --size WxH of a picture, px.
void addPictureSize(CLI::App& command, int& width, int& height);
/// --paper and --overlap of a PDF.
void addPaper(CLI::App& command, PdfOptions& pdf);

/// An option that takes one of a few words.
template <class Choice, class Target>
void addChoice(CLI::App& command, const std::string& name, Target& target,
               std::vector<std::pair<std::string, Choice>> choices, const std::string& help) {
  std::string names;
  for (const auto& [word, value] : choices) names += (names.empty() ? "" : ", ") + word;
  command
      .add_option_function<std::string>(
          name,
          [&target, choices, names, name](const std::string& text) {
            for (const auto& [word, value] : choices) {
              if (word != text) continue;
              target = value;
              return;
            }
            throw CLI::ValidationError(name + ": \"" + text + "\" is none of " + names);
          },
          help + ": " + names)
      ->type_name("NAME");
}

/// A wrong command line: prints the sentence and where help is. @return kWrongCommandLine
int refuse(const std::string& sentence, const std::string& command);

}  // namespace toile::cli
