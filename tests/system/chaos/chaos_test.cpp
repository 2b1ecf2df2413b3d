// The whole robot keeps its promises through twenty faults; `./coop chaos` makes more of them.
#include "experiments/chaos/chaos.hpp"

#include <gtest/gtest.h>

#include <iostream>

namespace coop::chaos {
namespace {

ChaosOptions short_run() {
  ChaosOptions options;
  options.faults = 20;
  options.gap = 5.0;
  options.rate = 2.0;
  options.recovery = 60.0;  // the machine may be busy
  return options;
}

TEST(Chaos, TwentyFaultsLoseNoEggAndHarmNobody) {
  const ChaosOptions options = short_run();
  const ChaosResult result = run_chaos(options, std::cout);
  EXPECT_EQ(result.incidents.size(), 20U);
  for (const std::string& wrong : result.wrong) ADD_FAILURE() << wrong;
  if (!result.wrong.empty()) std::cout << report_of(options, result);
}

}  // namespace
}  // namespace coop::chaos
