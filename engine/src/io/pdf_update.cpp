// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/pdf_update.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

namespace toile {
namespace {

/// The whole number after `key` at or after `from`.
std::optional<std::size_t> numberAfter(std::string_view text, std::string_view key,
                                       std::size_t from) {
  std::size_t at = text.find(key, from);
  if (at == std::string_view::npos) return std::nullopt;
  at += key.size();
  while (at < text.size() && (text[at] == ' ' || text[at] == '\n' || text[at] == '\r')) ++at;
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
  if (error != std::errc() || end == text.data() + at) return std::nullopt;
  return value;
}

}  // namespace

std::string withoutPrintScaling(std::string pdf) {
  const std::string_view text(pdf);
  const std::size_t startAt = text.rfind("startxref");
  if (startAt == std::string_view::npos) return pdf;
  const auto table = numberAfter(text, "startxref", startAt);
  if (!table || *table + 4 > text.size() || text.substr(*table, 4) != "xref") return pdf;
  const std::size_t trailer = text.find("trailer", *table);
  if (trailer == std::string_view::npos) return pdf;
  const auto size = numberAfter(text, "/Size", trailer);
  const auto root = numberAfter(text, "/Root", trailer);
  const auto info = numberAfter(text, "/Info", trailer);
  if (!size || !root) return pdf;
  const std::string header = fmt::format("\n{} 0 obj", *root);
  const std::size_t object = text.rfind(header, *table);
  if (object == std::string_view::npos) return pdf;
  const std::size_t begin = text.find("<<", object);
  const std::size_t end = text.find("endobj", object);
  if (begin == std::string_view::npos || end == std::string_view::npos || begin > end) return pdf;
  const std::size_t close = text.rfind(">>", end);
  const std::string_view catalog = text.substr(begin, close - begin);
  if (close <= begin || catalog.find("/Catalog") == std::string_view::npos ||
      catalog.find("/ViewerPreferences") != std::string_view::npos)
    return pdf;

  std::string update;
  if (text.back() != '\n') update += '\n';
  const std::size_t offset = text.size() + update.size();
  update += fmt::format("{} 0 obj\n{}   /ViewerPreferences << /PrintScaling /None >>\n>>\nendobj\n",
                        *root, catalog);
  const std::size_t newTable = text.size() + update.size();
  // Entries of a cross-reference table are 20 bytes.
  update += fmt::format("xref\n{} 1\n{:010} 00000 n \ntrailer\n<< /Size {}\n   /Root {} 0 R\n",
                        *root, offset, *size, *root);
  if (info) update += fmt::format("   /Info {} 0 R\n", *info);
  update += fmt::format("   /Prev {}\n>>\nstartxref\n{}\n%%EOF\n", *table, newTable);
  return pdf + update;
}

std::string withoutCreationDate(std::string pdf) {
  // The information dictionary is among the last objects; strings of pages are compressed.
  const std::size_t begin = pdf.rfind("/CreationDate (");
  if (begin == std::string::npos) return pdf;
  const std::size_t end = pdf.find(')', begin);
  if (end != std::string::npos) pdf.replace(begin, end + 1 - begin, end + 1 - begin, ' ');
  return pdf;
}

}  // namespace toile
