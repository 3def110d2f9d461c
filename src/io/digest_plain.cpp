// Builds without OpenImageIO (PORTALENS_PORTABLE), whose FarmHash the others take, have FNV-1a of
// 128 bits (Fowler, Noll, Vo; draft-eastlake-fnv). So such builds don't go on with each other's
// renders of scenes that name files.
#include <fmt/format.h>

#include <cstdint>

#include "io/digest.h"

namespace portalens {

std::string digest(std::string_view bytes) {
  __extension__ using Number = unsigned __int128;
  const auto of = [](std::uint64_t high, std::uint64_t low) { return Number{high} << 64 | low; };
  const Number prime = of(0x0000000001000000, 0x000000000000013b);
  Number hash = of(0x6c62272e07bb0142, 0x62b821756295c58d);
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * prime;
  return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(hash >> 64),
                     static_cast<std::uint64_t>(hash));
}

}  // namespace portalens
