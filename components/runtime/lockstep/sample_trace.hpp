#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/message_type.hpp"

namespace coop::runtime {

/// Writes down a hash of every sample a component writes in lockstep: `RUN_DIR/trace/NAME.trace`,
/// one line a sample: tick, topic, sequence, hash of the sample as on the wire (64 bits, hex). A
/// new start of the component goes on at the end of the file.
class SampleTrace {
 public:
  /// Throws std::runtime_error where the file cannot be written.
  SampleTrace(const std::filesystem::path& run_dir, const std::string& component);
  ~SampleTrace();
  SampleTrace(const SampleTrace&) = delete;
  SampleTrace& operator=(const SampleTrace&) = delete;

  void begin_tick(std::uint64_t tick) { tick_ = tick; }
  void record(std::string_view topic, std::uint64_t sequence, const MessageType& type,
              const void* message);

 private:
  void flush();

  std::ofstream file_;
  std::string buffer_;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t tick_ = 0;
};

/// All traces of a run, merged in canonical order: tick, component, topic, sequence.
struct TraceSummary {
  struct Topic {
    std::uint64_t samples = 0;
    std::uint64_t hash = 0;
  };
  std::uint64_t samples = 0;
  std::uint64_t hash = 0;
  std::uint64_t last_tick = 0;
  std::map<std::string, Topic> topics;  ///< by "component topic"
};

/// Up to and including `last_tick`. Throws std::runtime_error where there is no trace or it cannot
/// be read.
[[nodiscard]] TraceSummary summarise_traces(const std::filesystem::path& run_dir,
                                            std::uint64_t last_tick = ~std::uint64_t{0});

/// The first sample, in canonical order, in which two runs differ, as one line for people; nothing
/// where they agree up to and including `last_tick`.
[[nodiscard]] std::optional<std::string> first_difference(
    const std::filesystem::path& run_dir, const std::filesystem::path& other_run_dir,
    std::uint64_t last_tick = ~std::uint64_t{0});

}  // namespace coop::runtime
