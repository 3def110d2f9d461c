/// \file
/// Whether this build has a sanitizer in it, which takes time and address space of its own.
#pragma once

namespace portalens {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace portalens
