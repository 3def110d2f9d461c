#include "io/lines.h"

#include <algorithm>

namespace portalens {
namespace {

constexpr std::string_view space = " \t\r\f\v";

}  // namespace

bool is_utf16(std::string_view text) {
  if (text.size() < 2) return false;
  const std::string_view begin = text.substr(0, 2);
  return begin == "\xff\xfe" || begin == "\xfe\xff" || (begin[0] == '\0') != (begin[1] == '\0');
}

std::string in_small_letters(std::string_view word) {
  std::string small(word);
  for (char& letter : small)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return small;
}

LineReader::LineReader(std::string_view text) : text_(text) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text_.substr(0, byte_order_mark.size()) == byte_order_mark) at_ = byte_order_mark.size();
}

bool LineReader::next() {
  words_.clear();
  while (words_.empty() && at_ < text_.size()) {
    line_ = passed_ + 1;
    bool goes_on = true;
    while (goes_on && at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      std::string_view piece = text_.substr(at_, end - at_);
      at_ = end + 1;
      ++passed_;
      piece = piece.substr(0, std::min(piece.find('#'), piece.size()));
      const std::size_t last = piece.find_last_not_of(space);
      goes_on = last != std::string_view::npos && piece[last] == '\\';
      split(goes_on ? piece.substr(0, last) : piece);
    }
  }
  return !words_.empty();
}

void LineReader::split(std::string_view text) {
  std::size_t begin = text.find_first_not_of(space);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(space, begin), text.size());
    words_.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(space, end);
  }
}

std::string LineReader::rest(std::size_t from) const {
  if (words_.size() <= from) return {};
  // On one line the spaces between the words are kept as they stand.
  const char* const begin = words_[from].data();
  const char* const end = words_.back().data() + words_.back().size();
  const std::string_view whole = text_.substr(static_cast<std::size_t>(begin - text_.data()),
                                              static_cast<std::size_t>(end - begin));
  return std::string(whole.find('\n') == std::string_view::npos ? whole : words_[from]);
}

}  // namespace portalens
