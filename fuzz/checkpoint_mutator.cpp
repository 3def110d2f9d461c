// Changes heads and bodies of pieces apart, and mends their lengths and digests after it: else no
// damage would get past them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "checkpoint_partials.h"
#include "io/digest.h"
#include "render/partial_header.h"
#include "target.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using namespace portalens;

/// Some change of the fuzzer's own, to at most so many bytes.
std::string changed(std::string_view bytes, std::size_t most) {
  std::string buffer(bytes);
  buffer.resize(std::max(most, bytes.size()));
  buffer.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(buffer.data()), bytes.size(),
                                 buffer.size()));
  return buffer;
}

/// As long as the head says it is, with nothing where something is missing.
std::string fitting_body(const std::string& head, std::string body, std::size_t most) {
  try {
    body.resize(std::min<std::uint64_t>(decoded_head(head).body_size, most));
  } catch (const PartialRefusal&) {  // there is no right length
  }
  return body;
}

enum class Change { head, body };

std::string changed_partial(std::string_view piece, Change change, std::size_t most) {
  std::string head(fuzz::head_of(piece));
  const std::size_t body_at =
      std::min(piece.size(), fuzz::preamble_size + head.size() + fuzz::digest_size);
  std::string body(piece.substr(body_at));
  body.resize(body.size() - std::min(body.size(), fuzz::digest_size));
  if (change == Change::head)
    head = changed(head, most);
  else
    body = changed(body, most);
  body = fitting_body(head, std::move(body), most);

  std::string whole(piece.substr(0, std::min(piece.size(), fuzz::preamble_size)));
  whole.resize(fuzz::preamble_size);
  const auto length = static_cast<std::uint32_t>(head.size());
  std::memcpy(whole.data() + fuzz::preamble_size - sizeof length, &length, sizeof length);
  whole += head;
  whole += digest(whole);
  return whole + body + digest(body);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned int seed) {
  if (seed % 16 == 0) return LLVMFuzzerMutate(data, size, most);  // damage must be noticed, too
  const auto pieces = fuzz::partials_in(fuzz::as_text(data, size));
  const std::size_t chosen = seed / 16 % pieces.size();
  const Change change = seed / 1024 % 4 == 0 ? Change::body : Change::head;
  std::string whole;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    whole += i == chosen ? changed_partial(pieces[i], change, most) : std::string(pieces[i]);
  if (whole.size() > most) return size;
  std::copy(whole.begin(), whole.end(), data);
  return whole.size();
}
