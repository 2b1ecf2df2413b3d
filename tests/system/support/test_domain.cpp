#include "system/support/test_domain.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "launcher/unix_socket.hpp"

namespace coop::test {
namespace {

/// Domains 0 to 9 are left to people; above 101 the UDP ports of a domain lie where the kernel
/// gives out its own.
constexpr int kFirst = 10;
constexpr int kLast = 101;

struct Claim {
  int domain = 0;
  launcher::FileDescriptor socket;  ///< the kernel gives the name back when this process ends
};

Claim claim_domain() {
  const char* wanted = std::getenv("COOP_TEST_DOMAIN");
  const int first = wanted != nullptr ? std::atoi(wanted) : kFirst;
  for (int domain = first; domain <= kLast; ++domain) {
    auto socket = launcher::listen_unix("@coop/test-domain/" + std::to_string(domain));
    if (socket) return {domain, std::move(*socket)};
  }
  throw std::runtime_error("no DDS domain is free for this test");
}

}  // namespace

int test_domain() {
  static const Claim claim = claim_domain();
  return claim.domain;
}

int another_test_domain() {
  (void)test_domain();
  static const Claim claim = claim_domain();
  return claim.domain;
}

}  // namespace coop::test
