/// \file
/// A text line by line, each as words: what MTL and ordinary OBJ are made of.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace portalens {

/// Whether a text is of 16-bit letters: it begins with their byte order mark, or one of its first
/// two bytes is 0.
[[nodiscard]] bool is_utf16(std::string_view text);

/// A word in small letters, of ASCII.
[[nodiscard]] std::string in_small_letters(std::string_view word);

/// Walks over the lines that say something. A backslash at the end of a line continues it; `#`
/// begins a comment.
class LineReader {
 public:
  explicit LineReader(std::string_view text);

  /// Moves to the next line with a word in it; false at the end.
  bool next();

  /// The number of the line, from 1; of its beginning, if it is continued.
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  /// All from that word on, as one: a name with spaces. Empty where there is no such word.
  [[nodiscard]] std::string rest(std::size_t from = 1) const;

 private:
  void split(std::string_view text);

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 0, passed_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace portalens
