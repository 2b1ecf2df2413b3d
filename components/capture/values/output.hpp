#pragma once
#include <ostream>
#include <stdexcept>
#include <string_view>

namespace coop::capture {

/// Throws std::runtime_error where the stream does not take it (disk full, reader gone).
inline void put(std::ostream& out, std::string_view text) {
  if (!out.write(text.data(), static_cast<std::streamsize>(text.size()))) {
    throw std::runtime_error("the output cannot be written");
  }
}

}  // namespace coop::capture
