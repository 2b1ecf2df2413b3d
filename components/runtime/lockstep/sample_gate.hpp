#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "runtime/transport.hpp"

namespace coop::runtime {

/// Where a writer stands in the order in which samples are handled.
struct WriterRank {
  std::string member;          ///< name of its component
  std::uint32_t endpoint = 0;  ///< its place among the endpoints of that component
  auto operator<=>(const WriterRank&) const = default;
};

/// Holds the samples of one reader back until their tick, and lets them out in an order that does
/// not depend on when they arrived: by writer, then by sequence number. Samples of writers that do
/// not take part in the lockstep come last, with the next release.
class SampleGate {
 public:
  /// `type`: of the messages, for the instances of latched topics, of which only the newest of each
  /// release is let out (an older one may have been replaced before it was sent).
  SampleGate(const MessageType& type, bool latched) : type_(type), latched_(latched) {}

  /// A writer known from now on. What it wrote up to `base` was written before this reader and that
  /// writer knew each other: of a latched topic it is expected, of others it is dropped. Samples
  /// that were there before are told apart by this call.
  void admit(const std::string& writer, const WriterRank& rank, std::uint64_t base);
  /// Forgets all writers but these, with the samples held of them.
  void keep_only(const std::vector<std::string>& writers);
  [[nodiscard]] bool knows(const std::string& writer) const;

  void hold(Sample sample);
  /// Samples of the writer up to this number belong to the next release.
  void expect(const WriterRank& rank, std::uint64_t sequence);
  /// Whether all samples expected are here.
  [[nodiscard]] bool is_complete() const;
  /// The first writer of which samples are missing, for people. Only when not complete.
  [[nodiscard]] std::string missing() const;

  /// Expects no more than what is here.
  void forgo_missing();

  void release();
  /// The next of the samples released; false when there is none.
  bool next(Sample& sample);
  /// Samples of writers outside the lockstep let out so far.
  [[nodiscard]] std::uint64_t from_outside() const { return from_outside_; }

 private:
  struct Source {
    std::string writer;
    WriterRank rank;
    std::uint64_t base = 0;
    std::uint64_t expected = 0;
    std::uint64_t received = 0;
    std::deque<Sample> held;
  };
  void let_out(std::deque<Sample>& held, std::uint64_t up_to);

  const MessageType& type_;
  bool latched_;
  std::vector<Source> sources_;  ///< by rank
  std::deque<Sample> outside_;
  std::deque<Sample> released_;
  std::uint64_t from_outside_ = 0;
};

}  // namespace coop::runtime
