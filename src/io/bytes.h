/// \file
/// Numbers and texts as bytes, little-endian, and back from bytes that nobody vouches for.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace portalens {

static_assert(std::endian::native == std::endian::little, "bytes are copied as they lie in memory");

template <class T>
concept Number = std::integral<T> || std::floating_point<T>;

/// Appends to a string of bytes.
class ByteWriter {
 public:
  template <Number T>
  void number(T value) {
    numbers(std::span<const T>(&value, 1));
  }
  template <Number T>
  void numbers(std::span<const T> values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  /// Its length in four bytes, and itself.
  void text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes_.append(value);
  }
  void raw(std::string_view value) { bytes_.append(value); }
  void reserve(std::size_t size) { bytes_.reserve(size); }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::string release() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads from the front. After one reading too many, `failed`, and all that is read is 0 or empty.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <Number T>
  [[nodiscard]] T number() {
    T value{};
    numbers(std::span<T>(&value, 1));
    return value;
  }
  /// Fills `values`, or leaves them as they are.
  template <Number T>
  void numbers(std::span<T> values) {
    const std::string_view from = raw(values.size_bytes());
    if (!from.empty()) std::memcpy(values.data(), from.data(), from.size());
  }
  [[nodiscard]] std::string text() { return std::string(raw(number<std::uint32_t>())); }
  [[nodiscard]] std::string_view raw(std::size_t size) {
    if (size > bytes_.size()) {
      failed_ = true;
      bytes_ = {};
      return {};
    }
    const std::string_view front = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return front;
  }

  [[nodiscard]] bool failed() const { return failed_; }
  /// How many bytes are left.
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
  bool failed_ = false;
};

}  // namespace portalens
