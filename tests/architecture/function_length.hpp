#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace coop::architecture {

struct Function {
  std::string head;        ///< what stands before the body, on one line
  std::size_t line = 0;    ///< of the opening brace, from 1
  std::size_t length = 0;  ///< lines from opening to closing brace, both counted
};

/// The functions of C++ text, found by their braces: a pair whose head holds a parameter list and
/// that does not lie in another function. Approximate where macros hide braces.
[[nodiscard]] std::vector<Function> find_functions(std::string_view text);

}  // namespace coop::architecture
