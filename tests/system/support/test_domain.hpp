#pragma once

namespace coop::test {

/// A DDS domain that no other test process on this machine uses, the same throughout this process.
/// COOP_TEST_DOMAIN in the environment is where the search begins. Throws std::runtime_error where
/// all are taken.
[[nodiscard]] int test_domain();

/// A second one.
[[nodiscard]] int another_test_domain();

}  // namespace coop::test
