#pragma once
#include <string>
#include <vector>

#include "launcher/plan.hpp"

namespace coop::launcher {

/// Asks every component that takes the common options to check its configuration (`EXECUTABLE ...
/// --check`), a few at a time. Answers one line for each that refuses: place in the launch file,
/// name, and what it says.
[[nodiscard]] std::vector<std::string> check_components(const Plan& plan);

}  // namespace coop::launcher
