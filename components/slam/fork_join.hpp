#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace coop::slam {

/// Threads that share one loop at a time. The caller's thread works too; with one worker nothing
/// else runs. Which worker takes which index is left to chance: a body whose result depends on its
/// index alone gives the same with any number.
class ForkJoin {
 public:
  /// `workers` counts the caller's thread; at least 1.
  explicit ForkJoin(int workers);
  ~ForkJoin();
  ForkJoin(const ForkJoin&) = delete;
  ForkJoin& operator=(const ForkJoin&) = delete;

  using Body = std::function<void(std::size_t index, std::size_t worker)>;

  /// Runs body(i, worker) for all i < count and returns when all are done; worker < workers() tells
  /// apart scratch space. The first exception of a body is thrown on, after the others have ended.
  void run(std::size_t count, const Body& body);

  [[nodiscard]] std::size_t workers() const { return threads_.size() + 1; }

 private:
  void serve(const std::stop_token& stop, std::size_t worker);
  void work(std::size_t worker);

  std::mutex mutex_;
  std::condition_variable_any started_;
  std::condition_variable finished_;
  std::size_t round_ = 0;
  std::size_t busy_ = 0;
  const Body* body_ = nullptr;
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_{0};
  std::exception_ptr error_;
  std::vector<std::jthread> threads_;  // last: stopped and joined first
};

}  // namespace coop::slam
