#pragma once
#include <chrono>
#include <cstdint>
#include <random>
#include <vector>

namespace coop::test {

using Packet = std::vector<std::uint8_t>;

/// RTPS packets to and from the ports named, as they go over this machine's interfaces for
/// `duration`. Needs root (a raw socket); empty without.
[[nodiscard]] std::vector<Packet> capture_rtps(const std::vector<std::uint16_t>& ports,
                                               std::chrono::milliseconds duration);

/// Packets that end a program of bare Fast DDS 2.9.1 whoever sends them: a statistics sub-message
/// that is not the last of its packet fails an assertion, and a fragment that has parameters and no
/// payload is freed without having been allocated (CVE-2023-50716).
[[nodiscard]] std::vector<Packet> deadly_packets();

/// What somebody may throw at an open port: noise, noise behind a proper header, and genuine
/// packets cut short, with bits flipped, lengths changed, pieces swapped.
class Garbage {
 public:
  /// Whose name is on packets that have one: a stranger's, or, forged, that of the program from
  /// whose packet it was made.
  enum class Sender { kStranger, kForged };
  Garbage(std::vector<Packet> genuine, std::uint64_t seed, Sender sender);
  [[nodiscard]] Packet next();

 private:
  [[nodiscard]] std::size_t below(std::size_t limit);
  [[nodiscard]] Packet noise(std::size_t longest);
  [[nodiscard]] Packet mutated();
  void sign(Packet& packet) const;

  std::vector<Packet> genuine_;
  std::mt19937_64 random_;
  Sender sender_;
};

/// Sends packets to a port of this machine.
class Thrower {
 public:
  Thrower();
  ~Thrower();
  Thrower(const Thrower&) = delete;
  Thrower& operator=(const Thrower&) = delete;
  void throw_at(std::uint16_t port, const Packet& packet) const;

 private:
  int socket_;
};

}  // namespace coop::test
