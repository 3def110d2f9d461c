/// \file
/// Walking over the header of a file that nobody vouches for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/image_claim.h"

namespace portalens {

[[noreturn]] inline void refuse_as_broken(const std::string& why) {
  throw Refusal{"is broken: " + why, "save it again"};
}

/// Takes bytes from the front.
/// @throws Refusal for what lies beyond their end
class HeaderCursor {
 public:
  explicit HeaderCursor(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  [[nodiscard]] bool at_zero() const { return left() > 0 && bytes_[at_] == '\0'; }

  std::string_view take(std::size_t count) {
    if (count > left()) refuse_as_broken("its header is cut off");
    const std::string_view taken = bytes_.substr(at_, count);
    at_ += count;
    return taken;
  }
  std::int64_t big(std::size_t count) {
    std::int64_t number = 0;
    for (const char byte : take(count)) number = number * 256 + static_cast<unsigned char>(byte);
    return number;
  }
  /// Four bytes, the least first, with a sign.
  std::int64_t little() {
    const std::string_view four = take(4);
    std::uint32_t number = 0;
    for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(four[i]);
    return static_cast<std::int32_t>(number);
  }
  std::string_view text() {
    const std::size_t end = bytes_.find('\0', at_);
    if (end == std::string_view::npos) refuse_as_broken("its header is cut off");
    const std::string_view taken = take(end - at_);
    take(1);
    return taken;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// An attribute of an EXR file: its name, the name of its type, its bytes.
struct ExrAttribute {
  std::string_view name, type, value;
};

/// The attribute that begins there.
[[nodiscard]] inline ExrAttribute take_exr_attribute(HeaderCursor& in) {
  const std::string_view name = in.text();
  const std::string_view type = in.text();
  const std::int64_t length = in.little();
  if (length < 0) refuse_as_broken("an attribute has no length");
  return {name, type, in.take(static_cast<std::size_t>(length))};
}

}  // namespace portalens
