#include "io/tokens.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <system_error>

namespace portalens {
namespace {

bool is_space(char letter) {
  return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\n' || letter == '\f' ||
         letter == '\v';
}

bool is_mark(char letter) {
  return letter == '<' || letter == '>' || letter == ',' || letter == '{' || letter == '}';
}

/// `std::from_chars` takes no plus sign; people do.
std::string_view without_plus(std::string_view word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
  return plus ? word.substr(1) : word;
}

/// `std::from_chars`, which emscripten's library lacks for doubles.
std::from_chars_result read_double(const char* begin, const char* end, double& number) {
#ifdef __cpp_lib_to_chars
  return std::from_chars(begin, end, number);
#else
  const std::string word(begin, end);
  if (word.find_first_not_of("0123456789+-.eE") != std::string_view::npos || word.find('+') == 0)
    return {begin, std::errc::invalid_argument};
  char* read = nullptr;
  errno = 0;
  number = std::strtod(word.c_str(), &read);
  return {begin + (read - word.c_str()), errno == ERANGE        ? std::errc::result_out_of_range
                                         : read == word.c_str() ? std::errc::invalid_argument
                                                                : std::errc{}};
#endif
}

}  // namespace

std::optional<double> parse_number(std::string_view word) {
  word = without_plus(word);
  double number = 0.0;
  const char* end = word.data() + word.size();
  const auto result = read_double(word.data(), end, number);
  if (result.ptr != end) return std::nullopt;
  if (result.ec == std::errc::result_out_of_range) {
    const bool tiny =
        word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    return tiny ? std::optional(0.0) : std::nullopt;
  }
  if (result.ec != std::errc() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  word = without_plus(word);
  std::int64_t number = 0;
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, number);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return number;
}

TokenStream::TokenStream(std::string_view text) : text_(text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text_.substr(0, byte_order_mark.size()) == byte_order_mark) at_ = byte_order_mark.size();
}

void TokenStream::pass_space() {
  while (at_ < text_.size()) {
    if (text_[at_] == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (is_space(text_[at_])) {
      if (text_[at_] == '\n') ++line_;
      ++at_;
    } else {
      return;
    }
  }
}

Token TokenStream::next() {
  pass_space();
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != '#') ++at_;
  return {text_.substr(begin, at_ - begin), line_};
}

Token TokenStream::next_part() {
  pass_space();
  const std::size_t begin = at_;
  if (at_ < text_.size() && is_mark(text_[at_])) {
    ++at_;
  } else {
    while (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != '#' &&
           !is_mark(text_[at_])) {
      ++at_;
    }
  }
  return {text_.substr(begin, at_ - begin), line_};
}

Token TokenStream::peek() const {
  TokenStream ahead = *this;
  return ahead.next();
}

Token TokenStream::peek_part() const {
  TokenStream ahead = *this;
  return ahead.next_part();
}

}  // namespace portalens
