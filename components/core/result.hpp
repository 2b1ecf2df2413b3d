#pragma once
#include <string>
#include <tl/expected.hpp>

namespace coop {

/// A value, or the reason why there is none, for absence that is to be expected (no transform yet,
/// no path). Errors of the user (bad configuration, bad file at start) are exceptions instead.
template <class T, class E = std::string>
using Result = tl::expected<T, E>;

template <class E>
using Failure = tl::unexpected<E>;

/// `return fail(Reason::kNoPath);`
template <class E>
[[nodiscard]] tl::unexpected<std::decay_t<E>> fail(E&& error) {
  return tl::unexpected<std::decay_t<E>>(std::forward<E>(error));
}
[[nodiscard]] inline tl::unexpected<std::string> fail(const char* message) {
  return tl::unexpected<std::string>(message);
}

}  // namespace coop
