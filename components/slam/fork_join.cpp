#include "slam/fork_join.hpp"

#include <exception>
#include <utility>

namespace coop::slam {

ForkJoin::ForkJoin(int workers) {
  for (int i = 1; i < workers; ++i) {
    threads_.emplace_back(
        [this, i](const std::stop_token& stop) { serve(stop, static_cast<std::size_t>(i)); });
  }
}

ForkJoin::~ForkJoin() = default;

void ForkJoin::run(std::size_t count, const Body& body) {
  {
    const std::lock_guard lock(mutex_);
    body_ = &body;
    count_ = count;
    next_.store(0, std::memory_order_relaxed);
    busy_ = threads_.size();
    ++round_;
  }
  started_.notify_all();
  work(0);
  std::unique_lock lock(mutex_);
  finished_.wait(lock, [this] { return busy_ == 0; });
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void ForkJoin::serve(const std::stop_token& stop, std::size_t worker) {
  std::size_t served = 0;
  while (true) {
    {
      std::unique_lock lock(mutex_);
      if (!started_.wait(lock, stop, [&] { return round_ != served; })) return;
      served = round_;
    }
    work(worker);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) finished_.notify_one();
  }
}

void ForkJoin::work(std::size_t worker) {
  try {
    for (std::size_t i = next_.fetch_add(1); i < count_; i = next_.fetch_add(1))
      (*body_)(i, worker);
  } catch (...) {
    next_.store(count_);
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::current_exception();
  }
}

}  // namespace coop::slam
