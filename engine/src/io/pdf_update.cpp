// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/pdf_update.h"

#include <fmt/format.h>

#include <charconv>
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

/// Where the parts of a document's last revision stand.
struct Trailer {
  std::size_t table, size, root;
  std::optional<std::size_t> info;
};

/// Of a file whose cross-reference is a plain table.
std::optional<Trailer> trailerOf(std::string_view text) {
  const std::size_t startAt = text.rfind("startxref");
  if (startAt == std::string_view::npos) return std::nullopt;
  const auto table = numberAfter(text, "startxref", startAt);
  if (!table || *table + 4 > text.size() || text.substr(*table, 4) != "xref") return std::nullopt;
  const std::size_t trailer = text.find("trailer", *table);
  if (trailer == std::string_view::npos) return std::nullopt;
  const auto size = numberAfter(text, "/Size", trailer);
  const auto root = numberAfter(text, "/Root", trailer);
  if (!size || !root) return std::nullopt;
  return Trailer{*table, *size, *root, numberAfter(text, "/Info", trailer)};
}

/// Appends a revision in which an object has another content.
std::string withObject(std::string pdf, const Trailer& trailer, std::size_t number,
                       std::string_view content) {
  if (pdf.back() != '\n') pdf += '\n';
  const std::size_t offset = pdf.size();
  pdf += fmt::format("{} 0 obj\n", number);
  pdf += content;
  pdf += "\nendobj\n";
  const std::size_t table = pdf.size();
  // Entries of a cross-reference table are 20 bytes.
  pdf += fmt::format("xref\n{} 1\n{:010} 00000 n \ntrailer\n<< /Size {}\n   /Root {} 0 R\n", number,
                     offset, trailer.size, trailer.root);
  if (trailer.info) pdf += fmt::format("   /Info {} 0 R\n", *trailer.info);
  return pdf + fmt::format("   /Prev {}\n>>\nstartxref\n{}\n%%EOF\n", trailer.table, table);
}

std::uint32_t bigEndian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char c : bytes.substr(0, 4)) value = value << 8U | static_cast<unsigned char>(c);
  return value;
}

}  // namespace

std::string withoutPrintScaling(std::string pdf) {
  const std::string_view text(pdf);
  const auto trailer = trailerOf(text);
  if (!trailer) return pdf;
  const std::string header = fmt::format("\n{} 0 obj", trailer->root);
  const std::size_t object = text.rfind(header, trailer->table);
  if (object == std::string_view::npos) return pdf;
  const std::size_t begin = text.find("<<", object);
  const std::size_t end = text.find("endobj", object);
  if (begin == std::string_view::npos || end == std::string_view::npos || begin > end) return pdf;
  const std::size_t close = text.rfind(">>", end);
  const std::string_view catalog = text.substr(begin, close - begin);
  if (close <= begin || catalog.find("/Catalog") == std::string_view::npos ||
      catalog.find("/ViewerPreferences") != std::string_view::npos)
    return pdf;
  const std::string content =
      fmt::format("{}   /ViewerPreferences << /PrintScaling /None >>\n>>", catalog);
  return withObject(std::move(pdf), *trailer, trailer->root, content);
}

std::optional<PngImage> parsePng(std::string_view png) {
  constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
  constexpr std::size_t kFrame = 12;  // length, kind and checksum of a chunk
  if (!png.starts_with(kSignature)) return std::nullopt;
  PngImage image;
  for (png.remove_prefix(kSignature.size()); png.size() >= kFrame;) {
    const std::size_t length = bigEndian(png);
    if (length > png.size() - kFrame) return std::nullopt;
    const std::string_view kind = png.substr(4, 4);
    const std::string_view data = png.substr(8, length);
    if (kind == "IHDR") {
      // 8 bits, red green blue, deflated, filtered, not interlaced.
      if (data.size() != 13 || data.substr(8) != std::string_view("\x08\x02\0\0\0", 5))
        return std::nullopt;
      image.columns = bigEndian(data);
      image.rows = bigEndian(data.substr(4));
    } else if (kind == "IDAT") {
      image.data += data;
    }
    png.remove_prefix(kFrame + length);
  }
  if (image.columns == 0 || image.rows == 0 || image.data.empty()) return std::nullopt;
  return image;
}

std::string withImage(std::string pdf, std::uint32_t columns, const PngImage& image) {
  const std::string_view text(pdf);
  const auto trailer = trailerOf(text);
  const std::size_t at = text.find(fmt::format("/Width {}\n   /Height 1\n", columns));
  if (!trailer || at == std::string_view::npos) return pdf;
  constexpr std::string_view kObject = " 0 obj\n";
  const std::size_t object = text.rfind(kObject, at);
  if (object == std::string_view::npos) return pdf;
  const std::size_t line = text.rfind('\n', object);
  const auto number = numberAfter(text, "\n", line);
  if (!number) return pdf;
  const std::string content = fmt::format(
      "<< /Type /XObject\n   /Subtype /Image\n   /Width {0}\n   /Height {1}\n"
      "   /ColorSpace /DeviceRGB\n   /Interpolate true\n   /BitsPerComponent 8\n"
      "   /Filter /FlateDecode\n   /DecodeParms << /Predictor 15 /Colors 3 /Columns {0} >>\n"
      "   /Length {2}\n>>\nstream\n{3}\nendstream",
      image.columns, image.rows, image.data.size(), image.data);
  return withObject(std::move(pdf), *trailer, *number, content);
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
