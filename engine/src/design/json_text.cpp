// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/json_text.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_set>

#include "toile/core/units.h"

namespace toile {
namespace {

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// Length of the UTF-8 sequence at the front of `text`; 0 when it is none (overlong forms,
/// surrogates and values past U+10FFFF are none).
std::size_t utf8Length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto follows = [&](std::size_t i) { return i < text.size() && (byte(i) & 0xC0) == 0x80; };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return follows(1) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    if (!follows(1) || !follows(2)) return 0;
    if (lead == 0xE0 && byte(1) < 0xA0) return 0;
    if (lead == 0xED && byte(1) > 0x9F) return 0;
    return 3;
  }
  if (lead >= 0xF0 && lead <= 0xF4) {
    if (!follows(1) || !follows(2) || !follows(3)) return 0;
    if (lead == 0xF0 && byte(1) < 0x90) return 0;
    if (lead == 0xF4 && byte(1) > 0x8F) return 0;
    return 4;
  }
  return 0;
}

void appendUtf8(std::string& out, std::uint32_t code) {
  const auto put = [&](std::uint32_t bits) { out += static_cast<char>(bits); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | (code >> 6));
    put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | (code >> 12));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | (code >> 18));
    put(0x80 | ((code >> 12) & 0x3F));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

/// Recursive descent; every function returns false after fail() has noted the error.
class Parser {
 public:
  Parser(std::string_view text, const std::string& file, const JsonLimits& limits)
      : text_(text), file_(file), limits_(limits) {}

  Result<JsonValue> parse() {
    JsonValue root;
    if (text_.size() > limits_.bytes) {
      fail("the file has more than " + std::to_string(limits_.bytes >> 20) + " MB");
    } else if (value(root, 0)) {
      skipBlanks();
      if (at_ < text_.size()) fail("nothing may follow the closing brace");
    }
    if (error_) return std::move(*error_);
    return root;
  }

 private:
  bool fail(const std::string& what) {
    if (error_) return false;
    const std::size_t column = at_ - lineStart_ + 1;
    error_ = Error{ErrorCode::FileFormat,
                   file_ + ", line " + std::to_string(line_) + ", column " +
                       std::to_string(column) + ": " + what,
                   {Element::line(line_)}};
    return false;
  }
  [[nodiscard]] bool isAtEnd() const { return at_ >= text_.size(); }
  [[nodiscard]] char peek() const { return isAtEnd() ? '\0' : text_[at_]; }
  bool failExpecting(const std::string& what) {
    if (isAtEnd()) return fail("the file ends where " + what + " is expected");
    return fail("expected " + what);
  }
  void skipBlanks() {
    for (; !isAtEnd(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') {
        ++line_;
        lineStart_ = at_ + 1;
      } else if (c != ' ' && c != '\t' && c != '\r') {
        return;
      }
    }
  }
  bool take(char c) {
    if (isAtEnd() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  bool value(JsonValue& out, int depth) {
    skipBlanks();
    if (++values_ > limits_.values) return fail("the file has too many values");
    if (depth > limits_.depth) return fail("values are nested too deeply");
    out.line = line_;
    const std::size_t begin = at_;
    if (!valueAt(out, depth)) return false;
    out.text = text_.substr(begin, at_ - begin);
    return true;
  }
  bool valueAt(JsonValue& out, int depth) {
    switch (peek()) {
      case '{':
        return object(out, depth);
      case '[':
        return array(out, depth);
      case '"':
        out.kind = JsonValue::Kind::String;
        return string(out.string);
      case 't':
        return word("true", out, JsonValue::Kind::Bool, true);
      case 'f':
        return word("false", out, JsonValue::Kind::Bool, false);
      case 'n':
        return word("null", out, JsonValue::Kind::Null, false);
      default:
        if (peek() == '-' || isDigit(peek())) return number(out);
        return failExpecting("a value");
    }
  }
  bool word(std::string_view expected, JsonValue& out, JsonValue::Kind kind, bool boolean) {
    if (text_.substr(at_, expected.size()) != expected) return failExpecting("a value");
    at_ += expected.size();
    out.kind = kind;
    out.boolean = boolean;
    return true;
  }
  bool digits() {
    if (!isDigit(peek())) return failExpecting("a digit");
    while (isDigit(peek())) ++at_;
    return true;
  }
  bool number(JsonValue& out) {
    const std::size_t begin = at_;
    take('-');
    if (take('0')) {
      if (isDigit(peek())) return fail("a number must not begin with 0");
    } else if (!digits()) {
      return false;
    }
    if (take('.') && !digits()) return false;
    if (take('e') || take('E')) {
      if (!take('+')) take('-');
      if (!digits()) return false;
    }
    const std::optional<double> parsed = parseDouble(text_.substr(begin, at_ - begin));
    if (!parsed) return fail("the number is too large or too small");
    out.kind = JsonValue::Kind::Number;
    out.number = *parsed;
    return true;
  }
  bool hex4(std::uint32_t& code) {
    code = 0;
    for (int i = 0; i < 4; ++i, ++at_) {
      const char c = peek();
      const int digit = isDigit(c)               ? c - '0'
                        : (c >= 'a' && c <= 'f') ? c - 'a' + 10
                        : (c >= 'A' && c <= 'F') ? c - 'A' + 10
                                                 : -1;
      if (digit < 0) return failExpecting("four hexadecimal digits");
      code = code * 16 + static_cast<std::uint32_t>(digit);
    }
    return true;
  }
  bool escape(std::string& out) {
    static constexpr std::string_view kLetters = "\"\\/bfnrt";
    static constexpr std::string_view kMeaning = "\"\\/\b\f\n\r\t";
    const std::size_t letter = isAtEnd() ? std::string_view::npos : kLetters.find(peek());
    if (letter != std::string_view::npos) {
      ++at_;
      out += kMeaning[letter];
      return true;
    }
    if (!take('u')) return failExpecting("an escape such as \\n or \\u00e9");
    std::uint32_t code = 0;
    if (!hex4(code)) return false;
    if (code >= 0xD800 && code < 0xDC00) {
      std::uint32_t low = 0;
      if (!take('\\') || !take('u')) return fail("half of a surrogate pair");
      if (!hex4(low)) return false;
      if (low < 0xDC00 || low > 0xDFFF) return fail("half of a surrogate pair");
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
    } else if (code >= 0xDC00 && code < 0xE000) {
      return fail("half of a surrogate pair");
    }
    appendUtf8(out, code);
    return true;
  }
  bool string(std::string& out) {
    if (!take('"')) return failExpecting("a name in quotes");
    while (true) {
      if (isAtEnd()) return fail("the file ends inside a text");
      const auto c = static_cast<unsigned char>(text_[at_]);
      if (c == '"') return take('"');
      if (c < 0x20) return fail("a line end or control character inside a text");
      if (c == '\\') {
        ++at_;
        if (!escape(out)) return false;
        continue;
      }
      const std::size_t length = utf8Length(text_.substr(at_));
      if (length == 0) return fail("the text is not UTF-8");
      out.append(text_.substr(at_, length));
      at_ += length;
    }
  }
  bool array(JsonValue& out, int depth) {
    out.kind = JsonValue::Kind::Array;
    take('[');
    skipBlanks();
    if (take(']')) return true;
    while (true) {
      if (!value(out.items.emplace_back(), depth + 1)) return false;
      skipBlanks();
      if (take(']')) return true;
      if (!take(',')) return failExpecting("\",\" or \"]\"");
    }
  }
  bool object(JsonValue& out, int depth) {
    out.kind = JsonValue::Kind::Object;
    take('{');
    skipBlanks();
    if (take('}')) return true;
    std::unordered_set<std::string> keys;
    while (true) {
      skipBlanks();
      auto& [key, member] = out.members.emplace_back();
      if (!string(key)) return false;
      if (!keys.insert(key).second) return fail("the key " + quoteJson(key) + " stands here twice");
      skipBlanks();
      if (!take(':')) return failExpecting("\":\"");
      if (!value(member, depth + 1)) return false;
      skipBlanks();
      if (take('}')) return true;
      if (!take(',')) return failExpecting("\",\" or \"}\"");
    }
  }

  std::string_view text_;
  const std::string& file_;
  JsonLimits limits_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t lineStart_ = 0;
  std::size_t values_ = 0;
  std::optional<Error> error_;
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view key) const {
  const auto found =
      std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.key == key; });
  return found == members.end() ? nullptr : &found->value;
}

Result<JsonValue> parseJson(std::string_view text, const std::string& file,
                            const JsonLimits& limits) {
  return Parser(text, file, limits).parse();
}

std::string quoteJson(std::string_view text) {
  static constexpr std::string_view kHex = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += "\\u00";
      out += kHex[static_cast<unsigned char>(c) >> 4];
      out += kHex[static_cast<unsigned char>(c) & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

}  // namespace toile
