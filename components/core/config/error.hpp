#pragma once
#include <stdexcept>

namespace coop::config {

/// Bad configuration; the message is one line: file, line, key, what was expected.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace coop::config
