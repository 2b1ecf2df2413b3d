#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace coop::sweep {

/// done/total and when it will be over, from the mean time of a run in this call: one line that
/// changes on a terminal, a line for each change elsewhere.
class Progress {
 public:
  Progress(std::size_t total, std::size_t done) : total_(total), before_(done) {}

  /// At most one word a second; in between it costs nothing to ask.
  [[nodiscard]] bool is_due() const;
  /// `engine`: what it says of itself.
  void show(std::size_t done, const std::string& engine);

 private:
  using Wall = std::chrono::steady_clock;
  std::size_t total_;
  std::size_t before_;
  std::size_t shown_ = ~std::size_t{0};
  std::string shown_status_;
  Wall::time_point begun_ = Wall::now();
  Wall::time_point last_{};
};

}  // namespace coop::sweep
