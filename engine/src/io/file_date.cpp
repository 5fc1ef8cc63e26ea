// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/file_date.h"

#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>

namespace toile {
namespace {

std::optional<int> digits(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<FileDate> parseIsoDate(std::string_view text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
  const auto year = digits(text.substr(0, 4));
  const auto month = digits(text.substr(5, 2));
  const auto day = digits(text.substr(8, 2));
  if (!year || !month || !day) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  return FileDate{*year, *month, *day, 0, 0, 0};
}

}  // namespace

std::optional<FileDate> fileDate(const Design& design) {
  if (const auto date = parseIsoDate(design.order.date)) return date;
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  if (epoch == nullptr) return std::nullopt;
  std::int64_t seconds = 0;
  const char* const last = epoch + std::strlen(epoch);
  const auto [end, error] = std::from_chars(epoch, last, seconds);
  // Until the year 9999.
  if (error != std::errc() || end != last || seconds < 0 || seconds > 253402300799)
    return std::nullopt;
  const std::chrono::sys_seconds time{std::chrono::seconds(seconds)};
  const auto midnight = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date{midnight};
  const auto ofDay = static_cast<int>((time - midnight).count());
  return FileDate{static_cast<int>(date.year()),
                  static_cast<int>(static_cast<unsigned>(date.month())),
                  static_cast<int>(static_cast<unsigned>(date.day())),
                  ofDay / 3600,
                  ofDay / 60 % 60,
                  ofDay % 60};
}

}  // namespace toile
