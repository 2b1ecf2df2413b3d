#pragma once
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>

namespace coop::runtime {

/// Signals arrivals to the waiting test.
class Arrivals {
 public:
  std::function<void()> callback() {
    return [this] {
      const std::scoped_lock lock(mutex_);
      arrived_.notify_all();
    };
  }
  /// Asks again at every arrival and, for what no arrival tells (matching), every 10 ms.
  template <class Condition>
  bool wait_until(Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    // The condition runs unlocked: it takes from readers, whose threads call back here.
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::unique_lock lock(mutex_);
      arrived_.wait_for(lock, std::chrono::milliseconds(10));
    }
    return true;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
};

inline int test_domain() {
  return 60 + static_cast<int>(::getpid()) % 100;
}

}  // namespace coop::runtime
