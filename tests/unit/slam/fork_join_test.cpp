#include "slam/fork_join.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace coop::slam {
namespace {

TEST(ForkJoin, RunsEveryIndexOnceForAnyNumberOfWorkers) {
  for (const int workers : {1, 2, 5}) {
    ForkJoin pool(workers);
    EXPECT_EQ(pool.workers(), static_cast<std::size_t>(workers));
    for (const std::size_t count : {0U, 1U, 3U, 1000U}) {
      std::vector<int> visits(count, 0);
      pool.run(count, [&](std::size_t i, std::size_t worker) {
        EXPECT_LT(worker, pool.workers());
        ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1));
    }
  }
}

TEST(ForkJoin, HandsOnTheExceptionOfABodyAndWorksOn) {
  ForkJoin pool(2);
  EXPECT_THROW(pool.run(100,
                        [](std::size_t i, std::size_t) {
                          if (i == 40) throw std::runtime_error("a body failed");
                        }),
               std::runtime_error);
  std::atomic<int> done{0};
  pool.run(10, [&](std::size_t, std::size_t) { ++done; });
  EXPECT_EQ(done, 10);
}

}  // namespace
}  // namespace coop::slam
