#include "io/toml_depth.h"

#include <algorithm>
#include <cstddef>

namespace portalens {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  TomlDepth scan() {
    while (at_ < text_.size()) {
      const char letter = text_[at_];
      if (letter == '"' || letter == '\'') {
        pass_string(letter);
      } else if (letter == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else {
        count(letter);
        ++at_;
      }
    }
    return deepest_;
  }

 private:
  void count(char letter) {
    switch (letter) {
      case '\n':
        ++line_;
        dots_ = 0;
        break;
      case '[':
      case '{':
        dots_ = 0;
        if (++brackets_ > deepest_.brackets) {
          deepest_.brackets = brackets_;
          deepest_.brackets_line = line_;
        }
        break;
      case ']':
      case '}':
        dots_ = 0;
        brackets_ = std::max(0, brackets_ - 1);
        break;
      case '=':
      case ',':
        dots_ = 0;
        break;
      case '.':
        if (++dots_ > deepest_.dots) {
          deepest_.dots = dots_;
          deepest_.dots_line = line_;
        }
        break;
      default:
        break;
    }
  }

  void pass_string(char quote) {
    const bool triple =
        at_ + 2 < text_.size() && text_[at_ + 1] == quote && text_[at_ + 2] == quote;
    at_ += triple ? 3 : 1;
    while (at_ < text_.size()) {
      const char letter = text_[at_];
      if (letter == '\\' && quote == '"') {
        ++at_;
        if (at_ < text_.size() && text_[at_] == '\n') ++line_;
      } else if (letter == '\n') {
        if (!triple) return;
        ++line_;
      } else if (letter == quote) {
        if (!triple) break;
        const std::string_view ahead = text_.substr(at_, 5);
        const std::size_t quotes = std::min(ahead.find_first_not_of(quote), ahead.size());
        if (quotes >= 3) {  // up to two more quotes belong to the string itself
          at_ += quotes;
          return;
        }
      }
      ++at_;
    }
    ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, brackets_ = 0, dots_ = 0;
  TomlDepth deepest_;
};

}  // namespace

TomlDepth toml_depth(std::string_view text) { return Scanner(text).scan(); }

}  // namespace portalens
