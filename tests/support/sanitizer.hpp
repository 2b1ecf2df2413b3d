#pragma once

namespace coop::test {

/// ThreadSanitizer makes code ten times slower and has nothing to see where there is one thread:
/// tests of algorithms that take minutes under it say "not run".
#if defined(__SANITIZE_THREAD__)
inline constexpr bool kThreadSanitizer = true;
#else
inline constexpr bool kThreadSanitizer = false;
#endif

}  // namespace coop::test
