#include "sweep/node/claim.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "launcher/system_lock.hpp"
#include "support/temporary_folder.hpp"

namespace coop::sweep {
namespace {

constexpr int kFirst = 210;

TEST(DomainClaim, two_never_get_the_same_and_one_that_is_given_back_is_free) {
  const DomainClaim first = claim_domain(kFirst);
  int given_back = 0;
  {
    const DomainClaim second = claim_domain(kFirst);
    given_back = second.domain;
    EXPECT_GT(given_back, first.domain);
  }
  EXPECT_EQ(claim_domain(kFirst).domain, given_back);
}

TEST(DomainClaim, a_domain_where_a_launcher_has_a_system_is_passed_over) {
  const int free = claim_domain(kFirst).domain;
  const auto lock = launcher::SystemLock::acquire("ducky", free);
  ASSERT_TRUE(lock) << lock.error();
  EXPECT_GT(claim_domain(kFirst).domain, free);
}

TEST(DomainClaim, where_all_are_taken_says_so) {
  EXPECT_THROW((void)claim_domain(233), std::runtime_error);
}

TEST(FolderClaim, is_for_one_at_a_time) {
  const test::TemporaryFolder folder;
  {
    const auto first = claim_folder(folder.path());
    EXPECT_TRUE(first.has_value());
    EXPECT_FALSE(claim_folder(folder.path()).has_value());
  }
  EXPECT_TRUE(claim_folder(folder.path()).has_value());
}

}  // namespace
}  // namespace coop::sweep
