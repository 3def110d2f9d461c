#include "io/exr_matrix.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/tokens.h"

namespace portalens {

std::optional<ExrMatrix> matrix_in(std::string_view text) {
  ExrMatrix matrix{};
  TokenStream words(text);
  for (float& entry : matrix) {
    const auto number = parse_number(words.next().text);
    if (!number) return std::nullopt;
    entry = static_cast<float>(*number);
  }
  return words.peek().at_end() ? std::optional(matrix) : std::nullopt;
}

std::string matrix_text(const ExrMatrix& matrix) {
  return fmt::format("{}", fmt::join(matrix, " "));
}

}  // namespace portalens
