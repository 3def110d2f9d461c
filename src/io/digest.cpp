#include "io/digest.h"

#include <OpenImageIO/hash.h>
#include <fmt/format.h>

namespace portalens {

std::string digest(std::string_view bytes) {
  const auto hash = OIIO::farmhash::Fingerprint128(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", OIIO::farmhash::Uint128High64(hash),
                     OIIO::farmhash::Uint128Low64(hash));
}

}  // namespace portalens
