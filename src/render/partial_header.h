/// \file
/// What the file of a partial picture says before its pixels: where it comes from, which part of
/// which picture it holds, how far that is. To bytes, and back from bytes that nobody vouches for.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/image.h"
#include "render/exposure.h"
#include "render/fingerprint.h"

namespace portalens {

/// Where a partial picture comes from.
struct Provenance {
  Fingerprint fingerprint;  ///< of scene, program and processor
  Metadata metadata;        ///< what the file of the whole picture tells of its scene
  std::string scene_words;  ///< the scene and its settings, as words of a command line
};

struct PartialHeader {
  Provenance provenance;
  Assignment assignment;
  Account account;              ///< sums of begun pixels are with the pixels
  std::uint64_t body_size = 0;  ///< bytes, of the pixels
};

/// Why a file is no partial picture.
struct PartialRefusal {
  std::string problem, remedy = "it was damaged; use another copy, or take it anew";
};

/// @throws PartialRefusal if the condition does not hold
inline void require_of_partial(bool condition, const char* problem) {
  if (!condition) throw PartialRefusal{problem};
}

[[nodiscard]] std::string encoded_head(const Provenance& provenance, const Assignment& assignment,
                                       const Account& account);

/// Decodes all of the bytes; `encoded_head` of the result gives the same bytes.
/// @throws PartialRefusal if they are no sound head
[[nodiscard]] PartialHeader decoded_head(std::string_view bytes);

/// Bytes of the pixels that stand.
[[nodiscard]] std::uint64_t body_size(const Assignment& assignment, const Account& account);

}  // namespace portalens
