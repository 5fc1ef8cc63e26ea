// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stroke_font.h"

#include <cctype>
#include <cmath>
#include <string_view>

#include "io/ascii.h"

namespace toile {
namespace {

constexpr double kGridHeight = 6;  // a letter is 4 wide and 6 high
constexpr double kAdvance = 5.5;

/// Strokes as points of the grid, "xy xy ...", parted by commas; y up from the baseline.
std::string_view glyph(char c) {
  switch (c) {
    case 'A':
      return "00 26 40,12 32";
    case 'B':
      return "00 06 36 45 44 33 03,33 42 41 30 00";
    case 'C':
      return "41 30 10 01 05 16 36 45";
    case 'D':
      return "00 06 26 44 42 20 00";
    case 'E':
      return "40 00 06 46,03 33";
    case 'F':
      return "00 06 46,03 33";
    case 'G':
      return "45 36 16 05 01 10 30 41 43 23";
    case 'H':
      return "00 06,40 46,03 43";
    case 'I':
      return "10 30,20 26,16 36";
    case 'J':
      return "01 10 20 31 36";
    case 'K':
      return "00 06,46 03 40";
    case 'L':
      return "06 00 40";
    case 'M':
      return "00 06 23 46 40";
    case 'N':
      return "00 06 40 46";
    case 'O':
      return "10 01 05 16 36 45 41 30 10";
    case 'P':
      return "00 06 36 45 44 33 03";
    case 'Q':
      return "10 01 05 16 36 45 41 30 10,22 40";
    case 'R':
      return "00 06 36 45 44 33 03,23 40";
    case 'S':
      return "01 10 30 41 42 33 13 04 05 16 36 45";
    case 'T':
      return "06 46,20 26";
    case 'U':
      return "06 01 10 30 41 46";
    case 'V':
      return "06 20 46";
    case 'W':
      return "06 10 23 30 46";
    case 'X':
      return "00 46,06 40";
    case 'Y':
      return "06 23 46,23 20";
    case 'Z':
      return "06 46 00 40";
    case '0':
      return "10 01 05 16 36 45 41 30 10,11 35";
    case '1':
      return "14 26 20,10 30";
    case '2':
      return "05 16 36 45 44 00 40";
    case '3':
      return "05 16 36 45 44 33 42 41 30 10 01,13 33";
    case '4':
      return "30 36 02 42";
    case '5':
      return "46 06 03 33 42 41 30 00";
    case '6':
      return "36 16 05 01 10 30 41 42 33 03";
    case '7':
      return "06 46 10";
    case '8':
      return "13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33";
    case '9':
      return "10 30 41 45 36 16 05 04 13 43";
    case '-':
      return "13 33";
    case '+':
      return "13 33,22 24";
    case '.':
      return "20 21";
    case ',':
      return "21 10";
    case ':':
      return "21 22,24 25";
    case '/':
      return "00 46";
    case '(':
      return "30 21 25 36";
    case ')':
      return "10 21 25 16";
    case '%':
      return "00 46,05 16,30 41";
    case '\'':
      return "26 24";
    case '"':
      return "16 14,36 34";
    case '_':
      return "00 40";
    case '=':
      return "12 32,14 34";
    case '>':
      return "11 33 15";
    case '<':
      return "31 13 35";
    case '&':
      return "40 04 05 16 25 01 10 20 42";
    case '#':
      return "10 16,30 36,02 42,04 44";
    case '*':
      return "22 24,11 35,15 31";
    case '?':
      return "05 16 36 45 44 22,20 21";
    case '!':
      return "26 22,20 21";
    default:
      return "";
  }
}

std::string capitals(const std::string& utf8) {
  std::string text = toAscii(utf8);
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

double strokeTextWidth(const std::string& utf8) {
  return static_cast<double>(capitals(utf8).size()) * kAdvance / kGridHeight;
}

std::vector<Points2> strokeText(const std::string& utf8, const Eigen::Vector2d& middle,
                                double height, double angle) {
  const std::string text = capitals(utf8);
  const double scale = height / kGridHeight;
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d up(-along.y(), along.x());
  // The last letter's gap does not count.
  const double width = scale * (kAdvance * static_cast<double>(text.size()) - (kAdvance - 4));
  std::vector<Points2> strokes;
  double x = -0.5 * width;
  for (const char c : text) {
    Points2 stroke;
    const std::string_view lines = glyph(c);
    for (std::size_t i = 0; i < lines.size();) {
      if (lines[i] == ',') {
        strokes.push_back(std::move(stroke));
        stroke.clear();
      }
      if (lines[i] == ',' || lines[i] == ' ') {
        ++i;
        continue;
      }
      stroke.emplace_back(middle + (x + scale * (lines[i] - '0')) * along +
                          scale * (lines[i + 1] - '0') * up);
      i += 2;
    }
    if (stroke.size() > 1) strokes.push_back(std::move(stroke));
    x += scale * kAdvance;
  }
  return strokes;
}

}  // namespace toile
