#pragma once
#include <algorithm>
#include <string_view>

namespace coop {

/// Whether a text may name a robot or a component: names become file names, topic keys, partitions
/// and command words. Letters, digits, '_' and '-', 64 at most.
[[nodiscard]] inline bool is_name(std::string_view text) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !text.empty() && text.size() <= 64 && text[0] != '-' && std::ranges::all_of(text, fits);
}

}  // namespace coop
