#pragma once
#include "core/time.hpp"

namespace coop::test {

inline Time at(double seconds) {
  return time_from_seconds(seconds);
}

}  // namespace coop::test
